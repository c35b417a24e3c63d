// SPDX-License-Identifier: MIT
// flow_code: M words that belong to subprograms: M97 to M99 of numbered ones, M70 to M73 of saved modes.
#pragma once

#include "host_sim/program/gcode/flow_word.hpp"
#include "host_sim/program/gcode/saved_modes.hpp"
#include "host_sim/program/left_out_list.hpp"

namespace splinefeed::host {

/// How a dialect has numbered programs: O1000, M98 P1000 L2, M99.
enum class NumberedPrograms : std::uint8_t {
    none,     ///< M98 and M99 are words of no meaning
    linuxcnc, ///< they stand alone in their line
    fanuc,    ///< other words of the line are executed before; P30012 is three times O12; there is M97, too
};

struct FlowRules {
    NumberedPrograms programs = NumberedPrograms::none;
    bool block_delete = false;             ///< lines that begin with / are left out
    bool saves_modes = false;              ///< there are M70 to M73, which stand alone in their line
    bool macros = false;                   ///< there are the statements of macro_word
    bool increments = false;               ///< numbers of G65 without a decimal point count 0.001 mm
    LeftOutList* left_out = nullptr;       ///< is told an M99 that would begin the program again; null: nobody asks
    const CoolantState* coolant = nullptr; ///< where the program is; null: nobody knows, it is off
    std::vector<std::string> axes{};       ///< of the machine: x, y, z, ...
    std::uint64_t runs = 1;                ///< of a main program that M99 ends
    std::vector<std::string> folders{};    ///< of subprograms in files of their own, in the order of search
};

/// Whether the line has M2 or M30.
[[nodiscard]] bool has_program_end(std::string_view text);

/// Such a word of a line. Nothing: it has none, or is left out. Cost: a search for an M in the line.
[[nodiscard]] std::optional<FlowWord> read_flow_code(std::string_view text, const FlowRules& rules);

} // namespace splinefeed::host
