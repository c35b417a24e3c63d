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

constexpr std::int8_t of_group = -1; // the class of a word is that of its group

struct Row {
    std::int16_t code = 0; // of the first word
    std::int16_t last = 0; // and the last one
    CodeGroup group = CodeGroup::none;
    ProgramError refusal = ProgramError::none;
    std::uint8_t dialects = 0; // beside LinuxCNC's
    std::int8_t effect = of_group;
};

constexpr auto machine = static_cast<std::int8_t>(CodeEffect::machine);
constexpr auto order = static_cast<std::int8_t>(CodeEffect::flow);
constexpr auto placing = static_cast<std::int8_t>(CodeEffect::coordinates);
constexpr auto moving = static_cast<std::int8_t>(CodeEffect::motion);

constexpr CodeEffect effect_of(const Row& row) noexcept {
    if (row.effect != of_group) {
        return static_cast<CodeEffect>(row.effect);
    }
    switch (row.group) {
    case CodeGroup::motion:
    case CodeGroup::feed_mode:
    case CodeGroup::retract:
    case CodeGroup::path_mode: return CodeEffect::motion;
    case CodeGroup::stop: return CodeEffect::flow;
    case CodeGroup::spindle_mode:
    case CodeGroup::input_output:
    case CodeGroup::tool_change:
    case CodeGroup::spindle:
    case CodeGroup::coolant:
    case CodeGroup::override_mode:
    case CodeGroup::printer: return CodeEffect::machine;
    default: return CodeEffect::coordinates;
    }
}

// In a struct: the words of CodeGroup stay in it where sources are compiled as one.
struct CodeRows {
    using enum CodeGroup;

    // By tenths.
    static constexpr Row g[] = {
        Row{0, 30, motion, ProgramError::none, in_both},
        Row{40, 40, non_modal, ProgramError::none, in_both, machine},
        Row{50, 51, motion, ProgramError::none, in_both},
        Row{52, 52, motion},
        Row{53, 53, non_modal},
        Row{55, 55, motion, ProgramError::none, in_both}, // of no dialect: a curve through points
        Row{70, 80, lathe_diameter},
        Row{100, 100, non_modal, ProgramError::none, in_grbl},
        Row{120, 131, motion, ProgramError::pocket_unsupported},
        Row{160, 160, plane, ProgramError::coordinates_unsupported},
        Row{170, 170, plane, ProgramError::none, in_both},
        Row{171, 171, plane, ProgramError::plane_unsupported},
        Row{180, 180, plane, ProgramError::none, in_both},
        Row{181, 181, plane, ProgramError::plane_unsupported},
        Row{190, 190, plane, ProgramError::none, in_both},
        Row{191, 191, plane, ProgramError::plane_unsupported},
        Row{200, 200, units, ProgramError::none, in_both},
        Row{210, 210, units, ProgramError::none, in_both},
        Row{280, 280, non_modal, ProgramError::none, in_both, machine},
        Row{281, 281, non_modal, ProgramError::none, in_grbl},
        Row{300, 300, non_modal, ProgramError::none, in_grbl, machine},
        Row{301, 301, non_modal, ProgramError::none, in_grbl},
        Row{330, 331, motion},
        Row{382, 385, motion, ProgramError::none, in_both},
        Row{400, 400, cutter_radius, ProgramError::none, in_grbl, machine},
        Row{410, 411, cutter_radius, ProgramError::none, 0, machine},
        Row{420, 421, cutter_radius, ProgramError::none, 0, machine},
        Row{430, 430, tool_length, ProgramError::none, in_grbl, machine},
        Row{431, 431, tool_length, ProgramError::none, in_grbl},
        Row{432, 432, tool_length, ProgramError::tool_offset_sum_unsupported},
        Row{490, 490, tool_length, ProgramError::none, in_grbl, machine},
        Row{510, 511, work_system, ProgramError::coordinates_unsupported},
        Row{520, 520, non_modal},
        Row{530, 530, non_modal, ProgramError::none, in_both},
        Row{540, 590, work_system, ProgramError::none, in_both},
        Row{541, 541, work_system, ProgramError::coordinates_unsupported},
        Row{591, 593, work_system, ProgramError::none, in_both},
        Row{610, 610, path_mode, ProgramError::none, in_both},
        Row{611, 611, path_mode, ProgramError::none, in_grbl},
        Row{640, 640, path_mode, ProgramError::none, in_grbl},
        Row{650, 661, non_modal, ProgramError::macro_unsupported, 0, order},
        Row{680, 680, work_system, ProgramError::coordinates_unsupported},
        Row{682, 684, work_system, ProgramError::coordinates_unsupported},
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
        Row{1540, 1540, work_system, ProgramError::coordinates_unsupported},
    };

    // Words that are of some dialects only, or mean something else there. `dialects` has all of them.
    static constexpr Row g_extras[] = {
        Row{50, 51, without_effect, ProgramError::none, in_fanuc, machine}, // look-ahead
        Row{52, 53, motion, ProgramError::not_in_dialect, in_fanuc},
        Row{70, 70, lathe_diameter, ProgramError::not_in_dialect, in_fanuc},
        Row{80, 80, without_effect, ProgramError::none, in_fanuc, machine}, // look-ahead
        Row{100, 110, non_modal, ProgramError::firmware_retraction_unsupported, in_printers, machine},
        Row{131, 131, without_effect, ProgramError::none, in_fanuc}, // the ends of what is refused
        Row{150, 150, without_effect, ProgramError::none, in_fanuc},
        Row{200, 200, units, ProgramError::not_in_dialect, in_klipper},
        Row{260, 260, non_modal, ProgramError::bed_levelling_unsupported, in_printers, machine}, // its pattern
        Row{290, 290, non_modal, ProgramError::bed_levelling_unsupported, in_printers, machine},
        Row{320, 320, motion, ProgramError::thread_unsupported, in_fanuc}, // of lathes, where X is a diameter
        Row{331, 331, motion, ProgramError::thread_unsupported, in_fanuc},
        Row{401, 401, without_effect, ProgramError::none, in_fanuc},
        Row{500, 500, without_effect, ProgramError::none, in_fanuc | in_grbl},
        Row{501, 501, without_effect, ProgramError::none, in_fanuc},
        Row{510, 511, extension, ProgramError::none, in_fanuc},
        Row{520, 520, extension, ProgramError::none, in_fanuc},
        Row{541, 541, extension, ProgramError::none, in_fanuc},
        Row{650, 650, stop, ProgramError::none, in_fanuc, order}, // a call, as M98 is
        Row{670, 670, without_effect, ProgramError::none, in_fanuc},
        Row{680, 680, extension, ProgramError::none, in_fanuc},
        Row{690, 690, without_effect, ProgramError::none, in_fanuc},
        Row{750, 750, motion, ProgramError::lathe_unsupported, in_fanuc},
        Row{760, 760, motion, ProgramError::boring_unsupported, in_fanuc},
        Row{960, 960, spindle_mode, ProgramError::surface_speed_unsupported, in_fanuc},
        Row{1100, 1290, extension, ProgramError::none, in_fanuc},
        Row{1540, 1540, extension, ProgramError::none, in_fanuc},
    };

    static constexpr Row m_extras[] = {
        Row{25, 26, none, ProgramError::none, in_printers, machine}, // unknown, as 91 is: they move other machines
        Row{29, 29, without_effect, ProgramError::none, in_fanuc, machine}, // that G84 is rigid
        Row{47, 47, stop, ProgramError::macro_unsupported, in_fanuc},
        Row{70, 73, spindle, ProgramError::m_code_unknown, in_fanuc}, // of the machine's builder
        Row{70, 73, spindle, ProgramError::modal_state_unsupported, in_grbl | in_printers, placing},
        Row{91, 91, none, ProgramError::none, in_printers, machine},
        Row{96, 96, stop, ProgramError::macro_unsupported, in_fanuc},
        Row{97, 97, stop, ProgramError::none, in_fanuc}, // of whoever reads the file
        Row{98, 99, stop, ProgramError::subprogram_unsupported, in_grbl | in_printers},
        Row{198, 198, stop, ProgramError::macro_unsupported, in_fanuc},
        // Of printers: other files, loops and macros; an emergency stop, and the end of a print.
        Row{32, 32, stop, ProgramError::printer_flow_unsupported, in_printers},
        Row{112, 112, stop, ProgramError::printer_flow_unsupported, in_printers},
        Row{524, 524, stop, ProgramError::printer_flow_unsupported, in_printers},
        Row{622, 623, stop, ProgramError::printer_flow_unsupported, in_printers}, // Bambu's conditions
        Row{808, 808, stop, ProgramError::printer_flow_unsupported, in_printers},
        Row{810, 819, stop, ProgramError::printer_flow_unsupported, in_printers},
        // They shift it, or change what a step or a coordinate is.
        Row{92, 92, input_output, ProgramError::printer_move_unsupported, in_printers, placing},
        Row{206, 206, input_output, ProgramError::printer_move_unsupported, in_printers, placing},
        Row{218, 218, input_output, ProgramError::printer_move_unsupported, in_printers, placing},
        Row{290, 290, input_output, ProgramError::printer_move_unsupported, in_printers, placing},
        Row{350, 350, input_output, ProgramError::printer_move_unsupported, in_printers, placing},
        Row{360, 364, input_output, ProgramError::printer_move_unsupported, in_printers, placing},
        Row{428, 428, input_output, ProgramError::printer_move_unsupported, in_printers, placing},
        Row{665, 666, input_output, ProgramError::printer_move_unsupported, in_printers, placing},
        Row{852, 852, input_output, ProgramError::printer_move_unsupported, in_printers, placing},
        // They move it, and back.
        Row{48, 48, input_output, ProgramError::printer_move_unsupported, in_printers},
        Row{125, 125, input_output, ProgramError::printer_move_unsupported, in_printers},
        Row{600, 600, input_output, ProgramError::printer_move_unsupported, in_printers},
        Row{701, 702, input_output, ProgramError::printer_move_unsupported, in_printers},
    };

    static constexpr Row m[] = {
        Row{0, 1, stop, ProgramError::none, in_both, machine},
        Row{2, 2, stop, ProgramError::none, in_both},
        Row{3, 5, spindle, ProgramError::none, in_both},
        Row{6, 6, tool_change, ProgramError::none, in_both},
        Row{7, 9, coolant, ProgramError::none, in_both},
        Row{19, 19, spindle},
        Row{25, 26, input_output, ProgramError::m_code_unknown, 0, moving}, // Centroid's: they retract and home
        Row{30, 30, stop, ProgramError::none, in_grbl},
        Row{48, 53, override_mode, ProgramError::none, in_grbl},
        Row{60, 60, stop, ProgramError::none, in_grbl, machine},
        Row{61, 61, tool_change, ProgramError::none, in_grbl},
        Row{62, 66, input_output, ProgramError::none, in_grbl},
        Row{67, 68, input_output},
        Row{70, 73, spindle, ProgramError::none, 0, placing},               // these are of whoever reads the file,
        Row{91, 92, input_output, ProgramError::m_code_unknown, 0, moving}, // home, of Centroid's
        Row{98, 99, stop},                                                  // and so are these
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
CodeInfo find(const Row (&rows)[n], const Row (&extras)[more], std::int32_t code, std::int32_t step, Dialect dialect,
              CodeEffect of_unknown) noexcept {
    const std::uint8_t bit = bit_of(dialect);
    for (std::size_t i = 0; bit != 0 && i < more; ++i) { // LinuxCNC has none
        if (const Row& row = extras[i]; (row.dialects & bit) != 0 && is_within(row, code, step)) {
            return {row.group, row.refusal, effect_of(row)};
        }
    }
    const std::uint8_t needed = dialect == Dialect::klipper ? in_marlin : bit & in_both;
    for (const Row& row : rows) {
        if (is_within(row, code, step)) {
            const bool known = (row.dialects & needed) == needed || row.refusal != ProgramError::none;
            return {row.group, known ? row.refusal : ProgramError::not_in_dialect, effect_of(row)};
        }
    }
    return {CodeGroup::none, ProgramError::none, of_unknown};
}

} // namespace

CodeInfo find_g_code(std::int32_t tenths, Dialect dialect) noexcept {
    return find(CodeRows::g, CodeRows::g_extras, tenths, 10, dialect, CodeEffect::motion);
}

CodeInfo find_m_code(std::int32_t number, Dialect dialect) noexcept {
    if ((bit_of(dialect) & in_printers) != 0 &&
        std::find(std::begin(printer_codes), std::end(printer_codes), number) != std::end(printer_codes)) {
        return {CodeGroup::printer, ProgramError::none, CodeEffect::machine};
    }
    return find(CodeRows::m, CodeRows::m_extras, number, 1, dialect, CodeEffect::machine);
}

} // namespace splinefeed
