// SPDX-License-Identifier: MIT
// StraightMotion: one straight move from standstill to standstill within a machine's limits, segment by segment.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/planning/planned_trajectory.hpp"

#include "splinefeed/s1_curve/polyline.hpp"

namespace splinefeed::host {

/// For moves outside a program: a search for a switch, or the move to the start of a program.
class StraightMotion {
public:
    /// @param from, to  [mm] of each axis
    /// @param feed_mm_s  upper limit of the feed
    /// `machine` must have limits that were checked.
    StraightMotion(const MachineDescription& machine, const PerAxis<double>& from, const PerAxis<double>& to,
                   double feed_mm_s);

    /// Writes the next segment. false: the move is over, or it stands because it was held.
    [[nodiscard]] bool next(FeedSegment& segment);
    /// Brakes as hard as the limits allow, and ends the move unless it is resumed.
    void hold() noexcept { planner_.trajectory().hold(); }
    void resume() noexcept { planner_.trajectory().resume(); }
    /// The next segment while it is held and stands. false: it does not.
    [[nodiscard]] bool stand(FeedSegment& segment) { return planner_.trajectory().stand(segment); }

private:
    MotionLimits<double> limits_;
    Polyline<double> line_;
    PlannedTrajectory<double> planner_;
    bool moves_ = false;
};

} // namespace splinefeed::host
