// SPDX-License-Identifier: MIT
//
// The stages behind the curve, run to the end: planned cells, feed segments, machines to run them on.
#pragma once

#include "cell_reference.hpp"
#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/jerk_planner.hpp"
#include "splinefeed/trajectory.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>

namespace splinefeed_test {

/// Equal axes.
inline MachineSettings machine_of(int axes, double velocity, double acceleration, double feed, int period_us = 1000,
                                  double steps = 1000.0) {
    MachineSettings machine;
    machine.axes = axes;
    machine.max_feed_mm_s = feed;
    machine.sample_period_us = period_us;
    for (AxisSettings& axis : machine.axis) {
        axis.max_velocity_mm_s = velocity;
        axis.max_acceleration_mm_s2 = acceleration;
        axis.steps_per_mm = steps;
    }
    return machine;
}

/// The same with this limit of the jerk of each axis. [mm/s^3] 0: none
inline MachineSettings with_jerk(MachineSettings machine, double jerk) {
    for (AxisSettings& axis : machine.axis) {
        axis.max_jerk_mm_s3 = jerk;
    }
    return machine;
}

/// A profile segment of a planned cell, and the time that it takes.
template <Scalar S>
struct PlannedPart {
    std::size_t cell = 0;
    ProfileSegment<S> profile{};
    Real seconds = 0.0L;
};

/// What the plan of a whole path was, and how it came about.
template <Scalar S>
struct Planned {
    std::vector<PlannedCell<S>> cells;
    std::vector<PlannedPart<S>> parts;
    std::uint64_t limited = 0; ///< FeedPlan::window_limited
    std::size_t passes = 0;    ///< calls that took cells in, each followed by one pass over the window
    std::size_t starvations = 0;
    [[nodiscard]] double seconds() const {
        double sum = 0.0;
        for (const PlannedPart<S>& part : parts) {
            sum += static_cast<double>(part.seconds);
        }
        return sum;
    }
};

/// Travels the front cell, in all its profile segments.
template <Scalar S>
void travel_front(FeedPlan<S>& plan, Planned<S>& planned) {
    const std::size_t cell = planned.cells.size();
    planned.cells.push_back(plan.front());
    for (bool at_end = false; !at_end;) {
        const ProfileSegment<S> part = plan.profile_segment();
        const Real sum = std::sqrt(exact(part.entry_sq)) + std::sqrt(exact(part.exit_sq));
        const Real seconds = 2.0L * exact(plan.front().cell.length_mm) * exact(part.stretch.length()) / sum;
        planned.parts.push_back({cell, part, seconds});
        at_end = part.stretch.to == from_integer<S>(1);
        plan.advance();
        REQUIRE((at_end || plan.prepare() == Pull::item));
    }
}

template <Scalar S>
Planned<S> plan_of(CurveSource<S>& source, const MotionLimits<S>& limits, std::size_t window_size,
                   std::size_t most = 1U << 20) {
    ArcLength<S> arc_length(source, limits.refinement);
    std::vector<PlannedCell<S>> window(window_size);
    FeedPlan<S> plan(arc_length, limits, window);
    Planned<S> planned;
    while (planned.cells.size() < most) {
        const Wide before = arc_length.travelled();
        const Pull pull = plan.prepare();
        if (pull == Pull::finished) {
            break;
        }
        planned.passes += arc_length.travelled() != before ? 1U : 0U;
        if (pull == Pull::starved) {
            ++planned.starvations;
            continue;
        }
        travel_front(plan, planned);
    }
    planned.limited = plan.window_limited();
    return planned;
}

template <Scalar S>
Planned<S> plan_of(const BezierPath& path, const MachineSettings& machine, std::size_t window_size) {
    ListSource<S> source(path);
    return plan_of<S>(source, MotionLimits<S>::make(machine).value(), window_size);
}

/// Every byte of a storage.
template <class T>
void fill_bytes(std::vector<T>& storage, unsigned char value) {
    for (std::byte& byte : std::as_writable_bytes(std::span<T>(storage))) {
        byte = std::byte{value};
    }
}

/// A scalar of the pipeline and the number type of its jerk-limited plan, for tests of both.
template <Scalar Of, Floating In>
struct Planning {
    using S = Of;
    using R = In;
};
using DoubleInDouble = Planning<double, double>;
using FixedInDouble = Planning<Fixed, double>;
using FixedInFloat = Planning<Fixed, float>;

/// The limits for a plan that is made in R: what the tool gives it.
template <Scalar S, Floating R>
auto limits_for(const MachineSettings& machine) {
    return MotionLimits<S>::make(machine, std::same_as<R, double> ? SampledIn::float64 : SampledIn::scalar);
}

/// The pipeline that the limits ask for, with its memory. @param left_over  what every byte of that holds before; 0:
/// what its constructors make of it
template <Scalar S, Floating R = double>
class AnyTrajectory {
public:
    AnyTrajectory(CurveSource<S>& curve, const MotionLimits<S>& limits, std::size_t window_size,
                  unsigned char left_over = 0)
        : window_(window_size), cells_(window_size), nodes_(window_size + 1), scratch_(window_size + 1) {
        if (left_over != 0) {
            fill_bytes(window_, left_over);
            fill_bytes(cells_, left_over);
            fill_bytes(nodes_, left_over);
        }
        Planner<S>* planner = nullptr;
        if constexpr (!std::same_as<S, float>) {
            if (limits.jerk_limited) {
                planner = &jerk_.emplace(window_, JerkStorage<S, R>{cells_, nodes_, scratch_});
            }
        }
        trajectory_ =
            Trajectory<S>::make(curve, limits, planner != nullptr ? *planner : acceleration_.emplace(window_)).value();
    }
    [[nodiscard]] Trajectory<S>& trajectory() { return trajectory_; }
    [[nodiscard]] std::uint64_t slow_legs() const { return jerk_ ? jerk_->plan().slow_legs() : 0; }
    [[nodiscard]] std::uint64_t window_limited() const { return jerk_ ? jerk_->plan().window_limited() : 0; }

private:
    using JerkScalar = std::conditional_t<std::same_as<S, float>, double, S>;

    std::vector<PlannedCell<S>> window_;
    std::vector<Cell<S>> cells_;
    std::vector<JerkNode<R>> nodes_;
    std::vector<LegNode<R>> scratch_;
    std::optional<AccelerationPlanner<S>> acceleration_;
    std::optional<JerkPlanner<JerkScalar, R>> jerk_;
    Trajectory<S> trajectory_;
};

/// A path of smooth runs and corners, with feeds of its own.
inline BezierPath random_path(Random& random, int axes, int segments, double size_mm, double corners, double feeds) {
    BezierPath path;
    for (int i = 0; i < segments; ++i) {
        TestShape next = random_shape(random, axes, random.integer(3, 5), size_mm * random.decades(0.2, 5.0));
        if (i > 0 && !random.chance(corners)) {
            join_smoothly(path.back(), next);
        }
        if (random.chance(feeds)) {
            next.feed_mm_s = random.decades(1.0, 1000.0);
        }
        path.push_back(next);
    }
    return path;
}

inline MachineSettings random_machine(Random& random, int axes) {
    MachineSettings machine = machine_of(axes, 100.0, 1000.0, random.decades(10.0, 1000.0));
    for (AxisSettings& axis : machine.axis) {
        axis.max_velocity_mm_s = random.decades(10.0, 1000.0);
        axis.max_acceleration_mm_s2 = random.decades(100.0, 1e5);
        axis.steps_per_mm = random.decades(10.0, 1e5);
    }
    machine.centripetal_mm_s2 = random.chance(0.4) ? random.decades(100.0, 1e5) : 0.0;
    machine.chord_error_mm = random.chance(0.4) ? random.decades(1e-5, 0.1) : 0.0;
    machine.sample_period_us = random.integer(250, 4000);
    return machine;
}

/// Some linear axes first, then rotary ones.
inline void make_rotary(Random& random, MachineSettings& machine) {
    const int first = random.integer(0, machine.axes);
    for (int k = first; k < machine.axes; ++k) {
        machine.axis[static_cast<unsigned>(k)].rotary = true;
    }
}

/// Axes that brake harder or less hard than they accelerate.
inline void brake_differently(Random& random, MachineSettings& machine) {
    for (AxisSettings& axis : machine.axis) {
        axis.max_braking_mm_s2 =
            random.chance(0.2) ? 0.0 : std::clamp(axis.max_acceleration_mm_s2 * random.decades(0.1, 10.0), 30.0, 1e6);
    }
}

/// A random machine that was changed, and that the scalar has digits for.
template <Scalar S, class Change>
MachineSettings changed_machine(Random& random, int axes, Change&& change) {
    for (;;) {
        MachineSettings machine = random_machine(random, axes);
        change(random, machine);
        if (MotionLimits<S>::make(machine).has_value()) {
            return machine;
        }
    }
}

} // namespace splinefeed_test
