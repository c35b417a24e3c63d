// SPDX-License-Identifier: MIT
// EmittedMoves: what a drive sees of a program of moves within its tolerances.
#pragma once

#include "splinefeed/s1_blended_path/tolerance_path.hpp"
#include "splinefeed/s3_feed_plan/limits/machine_path_rules.hpp"

#include "support/emitted.hpp"
#include "support/pipeline.hpp"
#include "support/programmed_moves.hpp"

namespace splinefeed_test {

struct EmittedMoves {
    std::vector<FeedSegment> segments;
    bool endless = false;
};

/// @param exact_stops  at the end of each move, instead of its tolerance
template <Scalar S>
EmittedMoves emit(const MoveProgram& program, const MachineSettings& machine, bool exact_stops = false) {
    TolerancePath<S> path(program.axes, rules_cast<S>(path_rules(machine, program.joint_tolerance_mm)));
    REQUIRE(path.start(position_of<S>(program.start)).ok());
    const auto limits = MotionLimits<S>::make(machine).value();
    AnyTrajectory<S> trajectory(path, limits, 1024);
    EmittedMoves out;
    FeedSegment segment;
    for (std::size_t next = 0;;) {
        const Pull pull = trajectory.trajectory().next(segment);
        if (pull == Pull::item) {
            out.segments.push_back(segment);
        } else if (pull == Pull::finished) {
            return out;
        } else if (next < program.moves.size()) {
            auto element = element_of<S>(program.moves[next++], program.axes);
            element.mode = exact_stops ? PathMode::exact_stop : element.mode;
            REQUIRE(path.push(element).ok());
        } else {
            REQUIRE(path.finish().ok());
        }
    }
}

} // namespace splinefeed_test
