// SPDX-License-Identifier: MIT
#include "host_sim/planning/straight_motion.hpp"

namespace splinefeed::host {

namespace {

constexpr PlannerChoice choice{.window_cells = 256}; // a line has few

} // namespace

StraightMotion::StraightMotion(const MachineDescription& machine, const PerAxis<double>& from,
                               const PerAxis<double>& to, double feed_mm_s)
    : limits_(MotionLimits<double>::make(machine.settings).value()), line_({.axes = machine.settings.axes}),
      planner_(line_, limits_, choice) {
    const auto waypoint = [&](const PerAxis<double>& place) {
        Waypoint<double> point;
        for (const unsigned k : indices(machine.settings.axes)) {
            point.position[k] = position_from_mm(place[k]);
        }
        point.feed_mm_s = feed_mm_s;
        return point;
    };
    static_cast<void>(line_.push(waypoint(from)));
    static_cast<void>(line_.push(waypoint(to)));
    moves_ = line_.finish().ok(); // refused: there is no way to go
}

bool StraightMotion::next(FeedSegment& segment) {
    return moves_ && planner_.trajectory().next(segment) == Pull::item;
}

} // namespace splinefeed::host
