// SPDX-License-Identifier: MIT
// program_call: M98 and M99, the call and the end of a numbered program.
#pragma once

#include "host_sim/program/gcode/flow_word.hpp"

namespace splinefeed::host {

/// How a dialect has numbered programs: O1000, M98 P1000 L2, M99.
enum class NumberedPrograms : std::uint8_t {
    none,     ///< M98 and M99 are words of no meaning
    linuxcnc, ///< they stand alone in their line
    fanuc,    ///< other words of the line are executed before; P30012 is three times O12
};

struct FlowRules {
    NumberedPrograms programs = NumberedPrograms::none;
    bool block_delete = false; ///< lines that begin with / are left out
};

/// M98 or M99 of a line. Nothing: it has none, or is left out. Cost: a search for an M in the line.
[[nodiscard]] std::optional<FlowWord> read_program_call(std::string_view text, const FlowRules& rules);

} // namespace splinefeed::host
