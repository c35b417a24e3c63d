// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/dialects/code_table.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace splinefeed {

namespace {

constexpr std::uint8_t in_grbl = 1; // and grblHAL
constexpr std::uint8_t in_marlin = 2;
constexpr std::uint8_t in_both = 3;
constexpr std::uint8_t in_klipper = 4; // these two of `extras` alone: it has Marlin's words,
constexpr std::uint8_t in_fanuc = 8;   // and this one LinuxCNC's
constexpr std::uint8_t in_printers = in_marlin | in_klipper;

struct Row {
    std::int16_t code = 0; // of the first word
    std::int16_t last = 0; // and the last one
    CodeGroup group = CodeGroup::none;
    ProgramError refusal = ProgramError::none;
    std::uint8_t dialects = 0; // beside LinuxCNC's
};

// In a struct: the words of CodeGroup stay in it where sources are compiled as one.
struct CodeRows {
    using enum CodeGroup;

    // By tenths.
    static constexpr Row g[] = {
        Row{0, 30, motion, ProgramError::none, in_both},
        Row{40, 40, non_modal, ProgramError::none, in_both},
        Row{50, 51, motion, ProgramError::none, in_both},
        Row{52, 52, motion},
        Row{53, 53, non_modal},
        Row{55, 55, motion, ProgramError::none, in_both}, // of no dialect: a curve through points
        Row{70, 80, lathe_diameter},
        Row{100, 100, non_modal, ProgramError::none, in_grbl},
        Row{170, 170, plane, ProgramError::none, in_both},
        Row{171, 171, plane, ProgramError::plane_unsupported},
        Row{180, 180, plane, ProgramError::none, in_both},
        Row{181, 181, plane, ProgramError::plane_unsupported},
        Row{190, 190, plane, ProgramError::none, in_both},
        Row{191, 191, plane, ProgramError::plane_unsupported},
        Row{200, 200, units, ProgramError::none, in_both},
        Row{210, 210, units, ProgramError::none, in_both},
        Row{280, 280, non_modal, ProgramError::none, in_both},
        Row{281, 281, non_modal, ProgramError::none, in_grbl},
        Row{300, 301, non_modal, ProgramError::none, in_grbl},
        Row{330, 331, motion},
        Row{382, 385, motion, ProgramError::none, in_both},
        Row{400, 400, cutter_radius, ProgramError::none, in_grbl},
        Row{410, 411, cutter_radius},
        Row{420, 421, cutter_radius},
        Row{430, 430, tool_length, ProgramError::none, in_grbl},
        Row{431, 431, tool_length, ProgramError::none, in_grbl},
        Row{432, 432, tool_length, ProgramError::tool_offset_sum_unsupported},
        Row{490, 490, tool_length, ProgramError::none, in_grbl},
        Row{520, 520, non_modal},
        Row{530, 530, non_modal, ProgramError::none, in_both},
        Row{540, 590, work_system, ProgramError::none, in_both},
        Row{591, 593, work_system, ProgramError::none, in_both},
        Row{610, 610, path_mode, ProgramError::none, in_both},
        Row{611, 611, path_mode, ProgramError::none, in_grbl},
        Row{640, 640, path_mode, ProgramError::none, in_grbl},
        Row{700, 723, motion, ProgramError::lathe_unsupported},
        Row{730, 730, motion, ProgramError::none, in_grbl},
        Row{740, 740, motion},
        Row{760, 760, motion},
        Row{800, 800, motion, ProgramError::none, in_both},
        Row{810, 830, motion, ProgramError::none, in_grbl},
        Row{840, 840, motion},
        Row{850, 860, motion, ProgramError::none, in_grbl},
        Row{870, 880, motion, ProgramError::boring_unsupported},
        Row{890, 890, motion, ProgramError::none, in_grbl},
        Row{900, 900, distance, ProgramError::none, in_both},
        Row{901, 901, centre_distance},
        Row{910, 910, distance, ProgramError::none, in_both},
        Row{911, 911, centre_distance, ProgramError::none, in_grbl},
        Row{920, 920, non_modal, ProgramError::none, in_both},
        Row{921, 921, non_modal, ProgramError::none, in_both},
        Row{922, 923, non_modal, ProgramError::none, in_grbl},
        Row{930, 930, feed_mode, ProgramError::none, in_grbl},
        Row{940, 940, feed_mode, ProgramError::none, in_both},
        Row{950, 950, feed_mode},
        Row{960, 970, spindle_mode},
        Row{980, 980, retract, ProgramError::none, in_grbl},
        Row{990, 990, retract, ProgramError::none, in_grbl},
    };

    // Words that are of some dialects only, or mean something else there. `dialects` has all of them.
    static constexpr Row g_extras[] = {
        Row{50, 51, without_effect, ProgramError::none, in_fanuc}, // look-ahead
        Row{52, 53, motion, ProgramError::not_in_dialect, in_fanuc},
        Row{70, 70, lathe_diameter, ProgramError::not_in_dialect, in_fanuc},
        Row{80, 80, without_effect, ProgramError::none, in_fanuc}, // look-ahead
        Row{100, 110, non_modal, ProgramError::firmware_retraction_unsupported, in_printers},
        Row{131, 131, without_effect, ProgramError::none, in_fanuc}, // the ends of what is refused
        Row{150, 150, without_effect, ProgramError::none, in_fanuc},
        Row{200, 200, units, ProgramError::not_in_dialect, in_klipper},
        Row{290, 290, non_modal, ProgramError::bed_levelling_unsupported, in_printers},
        Row{320, 320, motion, ProgramError::thread_unsupported, in_fanuc}, // of lathes, where X is a diameter
        Row{331, 331, motion, ProgramError::thread_unsupported, in_fanuc},
        Row{500, 500, without_effect, ProgramError::none, in_fanuc | in_grbl},
        Row{501, 501, without_effect, ProgramError::none, in_fanuc},
        Row{670, 670, without_effect, ProgramError::none, in_fanuc},
        Row{690, 690, without_effect, ProgramError::none, in_fanuc},
        Row{760, 760, motion, ProgramError::boring_unsupported, in_fanuc},
        Row{960, 960, spindle_mode, ProgramError::surface_speed_unsupported, in_fanuc},
    };

    static constexpr Row m_extras[] = {
        Row{29, 29, without_effect, ProgramError::none, in_fanuc}, // that G84 is rigid
        Row{70, 73, spindle, ProgramError::modal_state_unsupported, in_grbl | in_printers | in_fanuc},
        Row{98, 99, stop, ProgramError::subprogram_unsupported, in_grbl | in_printers},
        // Of printers: they move or shift it.
        Row{125, 125, input_output, ProgramError::printer_move_unsupported, in_printers},
        Row{206, 206, input_output, ProgramError::printer_move_unsupported, in_printers},
        Row{290, 290, input_output, ProgramError::printer_move_unsupported, in_printers},
        Row{428, 428, input_output, ProgramError::printer_move_unsupported, in_printers},
        Row{600, 600, input_output, ProgramError::printer_move_unsupported, in_printers},
        Row{665, 666, input_output, ProgramError::printer_move_unsupported, in_printers},
        Row{701, 702, input_output, ProgramError::printer_move_unsupported, in_printers},
        Row{852, 852, input_output, ProgramError::printer_move_unsupported, in_printers},
    };

    static constexpr Row m[] = {
        Row{0, 2, stop, ProgramError::none, in_both},
        Row{3, 5, spindle, ProgramError::none, in_both},
        Row{6, 6, tool_change, ProgramError::none, in_both},
        Row{7, 9, coolant, ProgramError::none, in_both},
        Row{19, 19, spindle},
        Row{30, 30, stop, ProgramError::none, in_grbl},
        Row{48, 53, override_mode, ProgramError::none, in_grbl},
        Row{60, 60, stop, ProgramError::none, in_grbl},
        Row{61, 61, tool_change, ProgramError::none, in_grbl},
        Row{62, 66, input_output, ProgramError::none, in_grbl},
        Row{67, 68, input_output},
        Row{70, 73, spindle}, // these are of whoever reads the file,
        Row{98, 99, stop},    // and so are these
        Row{100, 199, input_output, ProgramError::user_code_unsupported},
    };
};

// Of printers; others are refused as unknown.
constexpr std::int16_t printer_codes[] = {17,  18,  73,  82,  83,  84,  104, 105, 106, 107, 109, 110, 115, 117,
                                          140, 141, 190, 191, 201, 203, 204, 205, 220, 221, 300, 400, 900};

constexpr bool is_within(const Row& row, std::int32_t code, std::int32_t step) noexcept {
    // A range of whole numbers has no tenths in it: G0.5 is not between G0 and G3.
    const bool whole = row.code % step == 0 && row.last % step == 0 && row.last - row.code >= step;
    return code >= row.code && code <= row.last && !(whole && row.refusal == ProgramError::none && code % step != 0);
}

constexpr std::uint8_t bit_of(Dialect dialect) noexcept {
    constexpr std::uint8_t bits[] = {0, in_grbl, in_marlin, in_fanuc, in_klipper};
    return bits[static_cast<unsigned>(dialect)];
}

template <std::size_t n, std::size_t more>
CodeInfo find(const Row (&rows)[n], const Row (&extras)[more], std::int32_t code, std::int32_t step,
              Dialect dialect) noexcept {
    for (const Row& row : extras) {
        if ((row.dialects & bit_of(dialect)) != 0 && is_within(row, code, step)) {
            return {row.group, row.refusal};
        }
    }
    const std::uint8_t needed = dialect == Dialect::klipper ? in_marlin : bit_of(dialect) & in_both;
    for (const Row& row : rows) {
        if (is_within(row, code, step)) {
            const bool known = (row.dialects & needed) == needed || row.refusal != ProgramError::none;
            return {row.group, known ? row.refusal : ProgramError::not_in_dialect};
        }
    }
    return {};
}

} // namespace

CodeInfo find_g_code(std::int32_t tenths, Dialect dialect) noexcept {
    return find(CodeRows::g, CodeRows::g_extras, tenths, 10, dialect);
}

CodeInfo find_m_code(std::int32_t number, Dialect dialect) noexcept {
    if ((bit_of(dialect) & in_printers) != 0 &&
        std::find(std::begin(printer_codes), std::end(printer_codes), number) != std::end(printer_codes)) {
        return {CodeGroup::printer, ProgramError::none};
    }
    return find(CodeRows::m, CodeRows::m_extras, number, 1, dialect);
}

} // namespace splinefeed
