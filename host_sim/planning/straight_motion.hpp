// SPDX-License-Identifier: MIT
// StraightMotion: one straight move from rest to rest within a machine's limits, segment by segment.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/planning/planned_trajectory.hpp"

#include "splinefeed/s1_curve/polyline.hpp"

namespace splinefeed::host {

/// For moves that are no program: a search for a switch, the way to where a program begins.
class StraightMotion {
public:
    /// @param from, to  [mm] of each axis
    /// @param feed_mm_s  at most
    /// `machine` has limits that were checked.
    StraightMotion(const MachineDescription& machine, const PerAxis<double>& from, const PerAxis<double>& to,
                   double feed_mm_s);

    /// False: it is over, or it stands since it was held.
    [[nodiscard]] bool next(FeedSegment& segment);
    /// It brakes as hard as the limits allow, and is over.
    void hold() noexcept { planner_.trajectory().hold(); }

private:
    MotionLimits<double> limits_;
    Polyline<double> line_;
    PlannedTrajectory<double> planner_;
    bool moves_ = false;
};

} // namespace splinefeed::host
