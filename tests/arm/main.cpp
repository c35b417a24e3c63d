// SPDX-License-Identifier: MIT
// The whole pipeline on a microcontroller: plans a small path and prints a hash over every integer of every feed
// segment. The same source on the host must print the same hash.
#include "segment_hash.hpp"
#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/jerk_planner.hpp"
#include "splinefeed/s1_curve/g2_spline.hpp"
#include "splinefeed/trajectory.hpp"
#include "write_value.hpp"

#include <array>
#include <cstdint>
#include <new>
#include <type_traits>

using namespace splinefeed;

namespace {

using Real = PIPELINE_SCALAR;
constexpr bool jerk_limited = PIPELINE_JERK;

struct Point {
    std::int32_t x_um;
    std::int32_t y_um;
    std::int32_t z_um;
};

// A loop with tight and wide bends, a corner, a lift of the tool, and two points 3 um apart.
constexpr Point path[] = {
    {0, 0, 0},
    {10000, 2000, 0},
    {19000, 9000, -500},
    {22000, 20000, -1000},
    {18000, 29000, -1000},
    {9000, 33000, -800},
    {1000, 30000, -400},
    {-3000, 22000, 0},
    {-2000, 13000, 0},
    {4000, 9000, 0},
    {9500, 11000, 0},
    {9503, 11000, 0},
    {12000, 15000, 2000},
    {12000, 15000, 9000},
    {30000, 15000, 9000},
    {41000, 14000, 7000},
    {47000, 20000, 3000},
    {44000, 27000, 1000},
    {36000, 26000, 500},
    {30000, 20000, 0},
};

constexpr MachineSettings machine = [] {
    MachineSettings settings;
    settings.axes = 3;
    settings.axis[0].max_acceleration_mm_s2 = 1200.0;
    settings.axis[2].max_velocity_mm_s = 40.0;
    settings.axis[2].max_acceleration_mm_s2 = 500.0;
    settings.axis[2].steps_per_mm = 400.0;
    settings.centripetal_mm_s2 = 800.0;
    if (jerk_limited) {
        settings.axis[0].max_jerk_mm_s3 = 80000.0;
        settings.axis[1].max_jerk_mm_s3 = 60000.0;
        settings.axis[2].max_jerk_mm_s3 = 40000.0;
    }
    return settings;
}();
// At compile time: no arithmetic in double remains for the target.
constexpr auto limits = MotionLimits<Real>::make(machine);
static_assert(limits.has_value());

/// An object of static storage that is built in main: its bytes are counted, no constructor runs before main.
template <class T>
class Static {
public:
    template <class... Arguments>
    T& build(Arguments&&... arguments) {
        return *::new (static_cast<void*>(bytes_)) T(static_cast<Arguments&&>(arguments)...);
    }

private:
    alignas(T) unsigned char bytes_[sizeof(T)];
};

Static<G2Spline<Real>> curve_storage;
using Planner = std::conditional_t<jerk_limited, JerkPlanner<Real, float>, AccelerationPlanner<Real>>;
Static<Planner> planner_storage;
Static<std::array<PlannedCell<Real>, FeedPlan<Real>::smallest_window>> window_storage;
constexpr std::size_t cells = 16; // of the plan with a jerk limit: JerkPlan::smallest_window
Static<std::array<Cell<Real>, cells>> cells_storage;
Static<std::array<JerkNode<float>, cells + 1>> nodes_storage;
Static<std::array<LegNode<float>, cells + 1>> scratch_storage;
FeedSegment segment;

constexpr std::size_t jerk_cell_bytes = sizeof(Cell<Real>) + sizeof(JerkNode<float>) + sizeof(LegNode<float>);

/// What a motion with windows of that many cells has in RAM, without the stack.
constexpr std::size_t bytes_with(std::size_t planned, std::size_t jerk_cells) {
    return sizeof(G2Spline<Real>) + sizeof(Planner) + planned * sizeof(PlannedCell<Real>) +
           jerk_cells * jerk_cell_bytes + sizeof(Trajectory<Real>) + sizeof(FeedSegment);
}

// Some functions are kept apart from main, so that what they need on the stack is not below the deepest call.

[[gnu::noinline]] bool push(G2Spline<Real>& curve, const Point& point) {
    Waypoint<Real> waypoint;
    waypoint.position[0] = position_from_um(point.x_um);
    waypoint.position[1] = position_from_um(point.y_um);
    waypoint.position[2] = position_from_um(point.z_um);
    return curve.push(waypoint).ok();
}

[[gnu::noinline]] G2Spline<Real>& build_curve() {
    return curve_storage.build(CurveOptions<Real>{});
}

[[gnu::noinline]] Result<Trajectory<Real>> make_trajectory(G2Spline<Real>& curve) {
    auto& window = window_storage.build();
    write_value("bytes: curve", sizeof curve);
    write_value("bytes: arc_length", sizeof(ArcLength<Real>));
    write_value("bytes: feed_plan", sizeof(FeedPlan<Real>));
    write_value("bytes: window", sizeof window);
    write_value("bytes: stream", sizeof(SegmentStream<Real>) + sizeof(ProfileSampler<Real>));
    if constexpr (jerk_limited) {
        write_value("bytes: with_100_cells", bytes_with(52, 100));
        write_value("bytes: jerk_plan", sizeof(JerkPlan<Real, float>));
        write_value("bytes: jerk_cell", jerk_cell_bytes);
        return Trajectory<Real>::make(
            curve, *limits,
            planner_storage.build(window, JerkStorage<Real, float>{cells_storage.build(), nodes_storage.build(),
                                                                   scratch_storage.build()}));
    } else {
        write_value("bytes: with_52_cells", bytes_with(52, 0));
        return Trajectory<Real>::make(curve, *limits, planner_storage.build(window));
    }
}

} // namespace

int main() {
    auto& curve = build_curve();
    auto made = make_trajectory(curve);
    if (!made.has_value()) {
        return 1;
    }
    Trajectory<Real>& trajectory = *made;

    SegmentHash hash;
    std::uint64_t segments = 0;
    std::size_t pushed = 0;
    while (trajectory.state() != Pull::finished) {
        if (trajectory.next(segment) == Pull::item) {
            hash.add(segment);
            ++segments;
        } else if (trajectory.state() == Pull::starved) {
            while (pushed < std::size(path) && curve.has_room()) {
                if (!push(curve, path[pushed++])) {
                    return 1;
                }
            }
            if (pushed == std::size(path) && !curve.finish().ok()) {
                return 1;
            }
        }
    }
    write_value("segments          ", segments);
    write_value("hash              ", hash.value());
    return 0;
}
