// SPDX-License-Identifier: MIT
// A user's program: plans a straight move of 10 mm and says where it ends.
#include "splinefeed/hal.hpp"
#include "splinefeed/splinefeed.hpp"

#include <array>
#include <cstdio>

using namespace splinefeed;

int main() {
    const auto limits = MotionLimits<Fixed>::make(MachineSettings{});
    G2Spline<Fixed> curve(CurveOptions<Fixed>{});
    static std::array<PlannedCell<Fixed>, 64> window;
    static AccelerationPlanner<Fixed> planner(window);
    auto trajectory = Trajectory<Fixed>::make(curve, *limits, planner);
    if (!trajectory.has_value()) {
        return 1;
    }

    Waypoint<Fixed> waypoint;
    if (!curve.push(waypoint).ok()) {
        return 1;
    }
    waypoint.position[0] = position_from_mm(10.0);
    if (!curve.push(waypoint).ok() || !curve.finish().ok()) {
        return 1;
    }
    FeedSegment segment;
    while (trajectory->next(segment) == Pull::item) {
    }
    const hal::PortState port;
#ifdef SPLINEFEED_HAS_MODBUS
    const hal::modbus::ModbusPort drives({}, {});
    const hal::modbus::SetpointPort other_drives({}, {});
    if (drives.drives() + other_drives.drives() != 0) {
        return 1;
    }
#endif
#ifdef SPLINEFEED_HAS_GPIO
    const hal::gpio::StepPort lines({}, {});
    if (lines.counts(0) != 0) {
        return 1;
    }
#endif
    std::printf("%s after %lld counts\n", port.phase == hal::PortPhase::idle ? "idle" : "busy",
                static_cast<long long>(segment.end[0] / units_per_count));
    return 0;
}
