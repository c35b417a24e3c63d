// SPDX-License-Identifier: MIT
// A user's program that needs the core alone: plans a straight move of 10 mm and says where it ends.
#include <splinefeed/splinefeed.hpp>

#include <cstdio>

using namespace splinefeed;

int main() {
    constexpr auto limits = MotionLimits<Fixed>::make(MachineSettings{});
    static_assert(limits.has_value());
    G2Spline<Fixed> curve(CurveOptions<Fixed>{});
    static PlannedCell<Fixed> window[16];
    static AccelerationPlanner<Fixed> planner(window);
    auto trajectory = Trajectory<Fixed>::make(curve, *limits, planner);
    Waypoint<Fixed> waypoint;
    bool good = trajectory.has_value() && curve.push(waypoint).ok();
    waypoint.position[0] = position_from_um(10000);
    good = good && curve.push(waypoint).ok() && curve.finish().ok();
    FeedSegment segment;
    while (good && trajectory->next(segment) == Pull::item) {
    }
    std::printf("%lld counts\n", good ? static_cast<long long>(segment.end[0] / units_per_count) : -1LL);
    return good ? 0 : 1;
}
