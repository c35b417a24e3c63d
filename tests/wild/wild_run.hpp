// SPDX-License-Identifier: MIT
// WildRun: a arguments through the planner and the simulated machine, which checks every limit, for so many segments.
#pragma once

#include "host_sim/run/runner.hpp"

#include <cstdint>
#include <string>

namespace splinefeed_test {

struct WildRun {
    std::string refused; ///< why the machine or the path was not taken; empty: it was
    std::string fault;   ///< what the machine has against it, or that it does not end where the path does
    bool ended = false;  ///< else there were too many segments
    double seconds = 0.0;
    double least_s = 0.0; ///< OptimumTime, of a run that ended
    double most_s = 0.0;  ///< from rest to rest on every segment of the curve, all by the softest limits of the axes
    bool short_window = false;       ///< that of the plan was
    std::uint64_t searched_legs = 0; ///< JerkPlan::searched_legs()
    std::uint64_t slow_legs = 0;     ///< JerkPlan::slow_legs()
    std::uint64_t segments = 0;
    double sample_s = 0.0;
};

/// In the scalar of the arguments.
[[nodiscard]] WildRun wild_run(const splinefeed::host::RunArguments& arguments, std::uint64_t most_segments);

} // namespace splinefeed_test
