// SPDX-License-Identifier: MIT
// Three axes with step and direction lines go along a curve, once. Pins, steps per mm and points are examples.
//
// The loop plans and steps in turns: at each edge it waits for the edge's time, and what it plans between two edges delays the
// next one. That is good for a few thousand steps a second. Beyond that, let a timer's interrupt make the steps (TickDda), and
// give it its segments through a SegmentRing.
#include <splinefeed.h>

using namespace splinefeed;

namespace {

constexpr int axes = 3;
constexpr int step_pins[axes] = {2, 3, 4};
constexpr int direction_pins[axes] = {5, 6, 7};

constexpr MachineSettings machine = [] {
    MachineSettings settings;
    settings.axes = axes;
    for (int k = 0; k < axes; ++k) {
        settings.axis[k].max_velocity_mm_s = 20.0;
        settings.axis[k].max_acceleration_mm_s2 = 200.0;
        settings.axis[k].steps_per_mm = 80.0;
    }
    return settings;
}();
// At compile time: what cannot be is an error of the compiler, and no arithmetic in double is left for the chip.
constexpr auto limits = MotionLimits<Fixed>::make(machine);
static_assert(no_error<limits.error()>());
constexpr auto timing = StepTiming::make({});
static_assert(no_error<timing.error()>());

constexpr std::int32_t points_um[][axes] = {{0, 0, 0}, {10000, 5000, 0}, {20000, 0, 1000}, {30000, 8000, 1000}, {20000, 10000, -5000}};
constexpr int point_count = sizeof points_um / sizeof points_um[0];

PlannedCell<Fixed> window[16];
AccelerationPlanner<Fixed> planner(window);
G2Spline<Fixed> curve(CurveOptions<Fixed>{});
Trajectory<Fixed> trajectory;
PulseTrain<StepIntervals> train(StepIntervals(axes), StepDirSequencer(axes, *timing));
FeedSegment segment;
int pushed = 0;
bool finished = false;
std::uint32_t began_us = 0;

// Points, as far as there is room, and a segment of the motion along them.
void plan() {
    while (pushed < point_count && curve.has_room()) {
        Waypoint<Fixed> waypoint;
        for (int k = 0; k < axes; ++k) {
            waypoint.position[k] = position_from_um(points_um[pushed][k]);
        }
        if (!curve.push(waypoint).ok()) {
            finished = true; // refused: an example has nobody to tell
            return;
        }
        if (++pushed == point_count && !curve.finish().ok()) {
            finished = true;
            return;
        }
    }
    const Pull pull = trajectory.next(segment);
    if (pull == Pull::item) {
        train.take(segment);
    } else if (pull == Pull::finished) {
        train.finish();
        finished = true;
    }
}

} // namespace

void setup() {
    for (int k = 0; k < axes; ++k) {
        pinMode(step_pins[k], OUTPUT);
        pinMode(direction_pins[k], OUTPUT);
    }
    const auto made = Trajectory<Fixed>::make(curve, *limits, planner);
    if (made.has_value()) {
        trajectory = *made;
    } else {
        finished = true;
    }
    began_us = micros();
}

void loop() {
    Edge edge;
    if (!train.next(edge)) {
        if (!finished) {
            plan();
        }
        return;
    }
    const auto due_us = static_cast<std::uint32_t>(edge.tick / ticks_per_us);
    while (micros() - began_us < due_us) {
    }
    digitalWrite((edge.line == Line::step ? step_pins : direction_pins)[edge.axis], edge.level ? HIGH : LOW);
}
