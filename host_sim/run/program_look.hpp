// SPDX-License-Identifier: MIT
// program_look: a program's moves before it is planned.
#pragma once

#include "host_sim/planning/path_limits.hpp"
#include "host_sim/program/path_input.hpp"

namespace splinefeed::host {

/// Number of moves of a program; nothing: a move comes nearer to an end of its travel than its tolerance, so that only
/// the path itself says whether it stays within, or the program waits for an input. Reads it to its end: throws its
/// errors. Cost: a tenth of that of its path.
/// @pre input.within_tolerance(), and the input can be read again
[[nodiscard]] std::optional<std::uint64_t> look_at_moves(PathInput& input, const PathLimits& limits, int axes);

} // namespace splinefeed::host
