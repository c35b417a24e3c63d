// SPDX-License-Identifier: MIT
// move_sources: the moves of an input, whatever its format is.
#pragma once

#include "host_sim/program/move_source.hpp"
#include "host_sim/program/path_input.hpp"
#include "host_sim/program/problem_list.hpp"

#include <memory>

namespace splinefeed::host {

/// The program from its beginning. `input` must outlive it. @pre input.within_tolerance()
/// @param scalar    in which a program in G-code is computed
/// @param problems  of a program in G-code: wrong lines are left out, and told to them; null: they end the program
[[nodiscard]] std::unique_ptr<MoveSource> move_source(PathInput& input, ScalarKind scalar,
                                                      ProblemList* problems = nullptr);

} // namespace splinefeed::host
