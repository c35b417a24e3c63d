// SPDX-License-Identifier: MIT
// StraightMotion: one straight move from standstill to standstill within a machine's limits, segment by segment.
#pragma once

#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/hal/motion/jerk_memory.hpp"
#include "splinefeed/s1_curve/polyline.hpp"
#include "splinefeed/trajectory.hpp"

#include <optional>
#include <vector>

namespace splinefeed::hal {

/// For moves outside a program: a search for a switch, or the move to the start of a program.
class StraightMotion {
public:
    /// @param machine  limits that were checked
    /// @param from, to  [mm] of each axis
    /// @param feed_mm_s  upper limit of the feed
    StraightMotion(const MachineSettings& machine, const PerAxis<double>& from, const PerAxis<double>& to,
                   double feed_mm_s);

    /// Writes the next segment. false: the move is over, or it stands because it was held.
    [[nodiscard]] bool next(FeedSegment& segment);
    /// Brakes as hard as the limits allow, and ends the move unless it is resumed.
    void hold() noexcept { trajectory_.hold(); }
    void resume() noexcept { trajectory_.resume(); }
    /// The next segment while it is held and stands. false: it does not.
    [[nodiscard]] bool stand(FeedSegment& segment) { return trajectory_.stand(segment); }

private:
    MotionLimits<double> limits_;
    Polyline<double> line_;
    std::vector<PlannedCell<double>> window_;
    std::optional<AccelerationPlanner<double>> acceleration_; // one of both
    std::optional<JerkMemory<double, double>> jerk_;
    Trajectory<double> trajectory_;
    bool moves_ = false;
};

} // namespace splinefeed::hal
