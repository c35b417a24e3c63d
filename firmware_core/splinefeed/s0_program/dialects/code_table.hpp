// SPDX-License-Identifier: MIT
// code_table: the G and M words of the interpreter, and those that it refuses by name.
#pragma once

#include "splinefeed/s0_program/dialects/program_settings.hpp"
#include "splinefeed/s0_program/text/program_errors.hpp"

namespace splinefeed {

/// Words of one group exclude each other in a block.
enum class CodeGroup : std::uint8_t {
    // G
    non_modal,       ///< G4 G10 G28 G28.1 G30 G30.1 G52 G53 G92 to G92.3, G5.3
    motion,          ///< G0 to G3, G5, G5.1, G5.2, G5.5, G33, G33.1, G38.2 to G38.5, G73, G74, G76, G80 to G89
    plane,           ///< G17 G18 G19
    distance,        ///< G90 G91
    centre_distance, ///< G90.1 G91.1
    feed_mode,       ///< G93 G94 G95
    units,           ///< G20 G21
    cutter_radius,   ///< G40 G41 G41.1 G42 G42.1
    tool_length,     ///< G43 G43.1 G49
    retract,         ///< G98 G99
    work_system,     ///< G54 to G59.3
    path_mode,       ///< G61 G61.1 G64
    spindle_mode,    ///< G96 G97
    lathe_diameter,  ///< G7 G8
    without_effect,  ///< G15 G50 G69 and others of fanuc; they do not exclude each other
    // M
    stop,          ///< M0 M1 M2 M30 M60 M98 M99
    input_output,  ///< M62 to M68
    tool_change,   ///< M6 M61
    spindle,       ///< M3 M4 M5 M19 M70 to M73
    coolant,       ///< M7 M8 M9
    override_mode, ///< M48 to M53
    printer,       ///< M82 M83 M104 ... of Dialect::marlin
    none,
    extension, ///< of a WordExtension
};
inline constexpr unsigned code_groups = static_cast<unsigned>(CodeGroup::none);

/// What a word changes. Only what leaves the path as it is may be left out of a program.
enum class CodeEffect : std::uint8_t {
    motion,      ///< the path, or how it is travelled
    coordinates, ///< where the path lies
    flow,        ///< the order of the blocks, and the end
    machine,     ///< spindle, coolant, heaters, displays; waits; the set-up: reference moves, tools of the table
};
[[nodiscard]] constexpr bool may_be_left_out(CodeEffect effect) noexcept {
    return effect == CodeEffect::machine;
}

struct CodeInfo {
    CodeGroup group = CodeGroup::none;
    ProgramError refusal = ProgramError::none; ///< why the word is not followed
    CodeEffect effect = CodeEffect::motion;
};

/// A word of no table has no group. Such a G word counts as motion, which it may be, and such an M word as the
/// machine's.
/// @param tenths  ten times the number: 382 for G38.2
[[nodiscard]] CodeInfo find_g_code(std::int32_t tenths, Dialect dialect) noexcept;
[[nodiscard]] CodeInfo find_m_code(std::int32_t number, Dialect dialect) noexcept;

/// Whether a motion word is that of a cycle. @param motion  ten times the G word
[[nodiscard]] constexpr bool is_cycle(std::int16_t motion) noexcept {
    return motion == 730 || motion == 740 || (motion > 800 && motion <= 890);
}

/// Whether it is that of a tapping cycle.
[[nodiscard]] constexpr bool taps(std::int16_t motion) noexcept {
    return motion == 740 || motion == 840;
}

} // namespace splinefeed
