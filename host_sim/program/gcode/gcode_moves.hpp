// SPDX-License-Identifier: MIT
// gcode_moves: a program in G-code as steps.
#pragma once

#include "host_sim/base/scalar_kind.hpp"
#include "host_sim/program/gcode_settings.hpp"
#include "host_sim/program/move_source.hpp"
#include "host_sim/program/problem_list.hpp"
#include "host_sim/program/source_line.hpp"

#include <memory>
#include <string>

namespace splinefeed::host {

/// Reads a line when the step before it has been taken, so motion can begin before the program ends. Errors have the
/// line and the column.
/// @param settings  must outlive it
/// @param file      for messages
/// @param scalar    in which lengths and feeds of moves are computed
/// @param problems  gets what is wrong with lines, which are left out; null: the first one ends the program
[[nodiscard]] std::unique_ptr<MoveSource> gcode_moves(const GcodeSettings& settings, std::string file,
                                                      std::unique_ptr<SourceLines> lines, ScalarKind scalar,
                                                      ProblemList* problems = nullptr);

} // namespace splinefeed::host
