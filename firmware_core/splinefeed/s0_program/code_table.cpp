// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/code_table.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace splinefeed {

namespace {

constexpr std::uint8_t in_grbl = 1;
constexpr std::uint8_t in_marlin = 2;
constexpr std::uint8_t in_both = 3;

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
        Row{50, 51, motion, ProgramError::none, in_marlin},
        Row{52, 52, motion},
        Row{53, 53, non_modal},
        Row{70, 70, lathe_diameter, ProgramError::lathe_unsupported},
        Row{80, 80, lathe_diameter},
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
        Row{330, 331, motion, ProgramError::thread_unsupported},
        Row{382, 385, motion, ProgramError::none, in_both},
        Row{400, 400, cutter_radius, ProgramError::none, in_grbl},
        Row{410, 411, cutter_radius},
        Row{420, 421, cutter_radius},
        Row{430, 430, tool_length},
        Row{431, 431, tool_length, ProgramError::none, in_grbl},
        Row{432, 432, tool_length, ProgramError::tool_offset_sum_unsupported},
        Row{490, 490, tool_length, ProgramError::none, in_grbl},
        Row{520, 520, non_modal},
        Row{530, 530, non_modal, ProgramError::none, in_both},
        Row{540, 590, work_system, ProgramError::none, in_both},
        Row{591, 593, work_system, ProgramError::none, in_marlin},
        Row{610, 610, path_mode, ProgramError::none, in_both},
        Row{611, 611, path_mode},
        Row{640, 640, path_mode},
        Row{700, 723, motion, ProgramError::lathe_unsupported},
        Row{730, 730, motion},
        Row{740, 740, motion, ProgramError::tapping_unsupported},
        Row{760, 760, motion, ProgramError::thread_unsupported},
        Row{800, 800, motion, ProgramError::none, in_both},
        Row{810, 830, motion},
        Row{840, 840, motion, ProgramError::tapping_unsupported},
        Row{850, 860, motion},
        Row{870, 880, motion, ProgramError::boring_unsupported},
        Row{890, 890, motion},
        Row{900, 900, distance, ProgramError::none, in_both},
        Row{901, 901, centre_distance},
        Row{910, 910, distance, ProgramError::none, in_both},
        Row{911, 911, centre_distance, ProgramError::none, in_grbl},
        Row{920, 920, non_modal, ProgramError::none, in_both},
        Row{921, 921, non_modal, ProgramError::none, in_both},
        Row{922, 923, non_modal},
        Row{930, 930, feed_mode, ProgramError::none, in_grbl},
        Row{940, 940, feed_mode, ProgramError::none, in_both},
        Row{950, 950, feed_mode, ProgramError::feed_per_revolution_unsupported},
        Row{960, 960, spindle_mode, ProgramError::surface_speed_unsupported},
        Row{970, 970, spindle_mode},
        Row{980, 980, retract},
        Row{990, 990, retract},
    };

    static constexpr Row m[] = {
        Row{0, 2, stop, ProgramError::none, in_both},
        Row{3, 5, spindle, ProgramError::none, in_both},
        Row{6, 6, tool_change, ProgramError::none, in_marlin},
        Row{7, 9, coolant, ProgramError::none, in_both},
        Row{19, 19, spindle, ProgramError::spindle_orientation_unsupported},
        Row{30, 30, stop, ProgramError::none, in_grbl},
        Row{48, 53, override_mode},
        Row{60, 60, stop},
        Row{61, 61, tool_change},
        Row{62, 68, input_output},
        Row{70, 73, input_output, ProgramError::modal_state_unsupported},
        Row{98, 99, stop, ProgramError::subprogram_unsupported, in_grbl},
        Row{100, 199, input_output, ProgramError::user_code_unsupported},
    };
};

// Of printers; others are refused as unknown.
constexpr std::int16_t printer_codes[] = {17,  18,  73,  82,  83,  84,  104, 105, 106, 107, 109, 110, 115, 117,
                                          140, 141, 190, 191, 201, 203, 204, 205, 220, 221, 300, 400, 900};

template <std::size_t n>
CodeInfo find(const Row (&rows)[n], std::int32_t code, std::int32_t step, Dialect dialect) noexcept {
    for (const Row& row : rows) {
        if (code < row.code) {
            break;
        }
        // A range of whole numbers has no tenths in it: G0.5 is not between G0 and G3.
        const bool whole = row.code % step == 0 && row.last % step == 0 && row.last - row.code >= step;
        if (code > row.last || (whole && row.refusal == ProgramError::none && code % step != 0)) {
            continue;
        }
        const std::uint8_t needed = dialect == Dialect::grbl ? in_grbl : dialect == Dialect::marlin ? in_marlin : 0;
        const bool known = (row.dialects & needed) == needed || row.refusal != ProgramError::none;
        return {row.group, known ? row.refusal : ProgramError::not_in_dialect};
    }
    return {};
}

} // namespace

CodeInfo find_g_code(std::int32_t tenths, Dialect dialect) noexcept {
    if (dialect == Dialect::marlin && (tenths == 100 || tenths == 110)) {
        return {CodeGroup::non_modal, ProgramError::firmware_retraction_unsupported};
    }
    if (dialect == Dialect::marlin && tenths == 290) {
        return {CodeGroup::non_modal, ProgramError::bed_levelling_unsupported};
    }
    return find(CodeRows::g, tenths, 10, dialect);
}

CodeInfo find_m_code(std::int32_t number, Dialect dialect) noexcept {
    if (dialect == Dialect::marlin &&
        std::find(std::begin(printer_codes), std::end(printer_codes), number) != std::end(printer_codes)) {
        return {CodeGroup::printer, ProgramError::none};
    }
    return find(CodeRows::m, number, 1, dialect);
}

} // namespace splinefeed
