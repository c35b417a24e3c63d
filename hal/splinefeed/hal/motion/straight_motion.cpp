// SPDX-License-Identifier: MIT
#include "splinefeed/hal/motion/straight_motion.hpp"

#include "splinefeed/number/vector.hpp"

namespace splinefeed::hal {

namespace {

constexpr std::size_t window_cells = 256; // a line has few

} // namespace

StraightMotion::StraightMotion(const MachineSettings& machine, const PerAxis<double>& from, const PerAxis<double>& to,
                               double feed_mm_s)
    : limits_(MotionLimits<double>::make(machine).value()), line_({.axes = machine.axes}), window_(window_cells) {
    Planner<double>& planner = limits_.jerk_limited ? static_cast<Planner<double>&>(jerk_.emplace(window_).planner)
                                                    : acceleration_.emplace(window_);
    trajectory_ = *Trajectory<double>::make(line_, limits_, planner);
    const auto waypoint = [&](const PerAxis<double>& place) {
        Waypoint<double> point;
        point.position = position_from_mm(place, machine.axes);
        point.feed_mm_s = feed_mm_s;
        return point;
    };
    static_cast<void>(line_.push(waypoint(from)));
    static_cast<void>(line_.push(waypoint(to)));
    moves_ = line_.finish().ok(); // refused: there is no way to go
}

bool StraightMotion::next(FeedSegment& segment) {
    return moves_ && trajectory_.next(segment) == Pull::item;
}

} // namespace splinefeed::hal
