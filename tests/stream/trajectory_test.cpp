// SPDX-License-Identifier: MIT
//
// The pipeline as one object: how close it stays to the curve and to the planned speed, and that it takes no memory.
#include "splinefeed/number/path_position.hpp"
#include "support/allocations.hpp"
#include "support/catch.hpp"
#include "support/stream_reference.hpp"

using namespace splinefeed_test;

namespace {

constexpr Real head_start = 0.414L; // of a segment

bool rests(const FeedSegment& segment, int axes) {
    return std::all_of(segment.start_velocity.begin(), segment.start_velocity.begin() + axes,
                       [](std::int64_t v) { return v == 0; });
}

/// Whether a motion left its standstill at the start of segment i with a head start: from samples d1, d2 behind the
/// stop, d2 / d1 is 2.91 with it and 4 without.
bool left_early(const Stream& stream, std::size_t i, int axes) {
    Real first = 0.0L;
    Real second = 0.0L;
    for (unsigned k = 0; k < static_cast<unsigned>(axes) && i + 2 < stream.segments.size(); ++k) {
        const auto from = static_cast<Real>(stream.segments[i].start[k]);
        const Real d1 = 6.0L * (static_cast<Real>(stream.segments[i + 1].start[k]) - from);
        const Real d2 = 6.0L * (static_cast<Real>(stream.segments[i + 2].start[k]) - from) - 4.0L * d1;
        if (std::fabs(d1) > std::fabs(first)) {
            first = d1;
            second = d2;
        }
    }
    return std::fabs(second) < 3.4L * std::fabs(first);
}

/// Where the plan is at a time, found from the planned parts: time passes at constant acceleration in each. It stands
/// where the stream does; that this is not later than it has to be is checked.
template <class S>
class Clock {
public:
    Clock(const Planned<S>& planned, const Stream& stream, Real segment_s) : planned_(&planned) {
        Real now = 0.0L;
        std::size_t joint = 0; // at (joint - 1) segments
        bool leaves = true;
        for (const PlannedPart<S>& part : planned.parts) {
            const int axes = planned.cells[part.cell].cell.axes;
            if (leaves && part.seconds > (2.0L + head_start) * segment_s && left_early(stream, joint, axes)) {
                now -= head_start * segment_s;
            }
            start_.push_back(now);
            now += part.seconds;
            leaves = part.profile.stops;
            if (leaves && part.cell + 1 < planned.cells.size()) {
                joint = static_cast<std::size_t>(std::max(0.0L, now / segment_s)) + 1;
                while (joint < stream.segments.size() && !rests(stream.segments[joint], axes)) {
                    ++joint;
                }
                // Three samples are equal, and the joint belongs to the second one.
                const Real arrival = static_cast<Real>(joint) - 2.0L - now / segment_s;
                CHECK(arrival > -head_start - 1e-3L);
                CHECK(arrival < 1.0L);
                now = static_cast<Real>(joint) * segment_s;
            }
        }
    }
    /// Position [mm] and path speed at a time; false in a dwell.
    bool at(Real time, PerAxis<Real>& position, Real& speed) {
        while (now_ + 1 < start_.size() && start_[now_ + 1] <= time) {
            ++now_;
        }
        const PlannedPart<S>& part = planned_->parts[now_];
        const Cell<S>& cell = planned_->cells[part.cell].cell;
        const Real v0 = std::sqrt(exact(part.profile.entry_sq));
        const Real v1 = std::sqrt(exact(part.profile.exit_sq));
        const Real t = time - start_[now_];
        if (t > part.seconds || v0 + v1 == 0.0L) {
            return false;
        }
        speed = v0 + (v1 - v0) * t / part.seconds;
        const Real x = exact(part.profile.stretch.from) + (v0 + speed) / 2.0L * t / exact(cell.length_mm);
        Real unused = 0.0L;
        const Jet jet = evaluate(cell, inverse_at(cell, std::min(x, 1.0L), unused));
        for (const unsigned k : splinefeed::indices(cell.axes)) {
            position[k] = exact_mm(cell.origin[k]) + jet.r[k];
        }
        return true;
    }

private:
    const Planned<S>* planned_;
    std::vector<Real> start_;
    std::size_t now_ = 0;
};

} // namespace

TEMPLATE_TEST_CASE("the emitted joints follow the planned motion", "[stream][trajectory]", double, Fixed) {
    // A joint is the sample plus a sixth of a second difference: at most T^2 |A| / 6 off per axis, and rounding.
    Random random(71);
    for (int run = 0; run < 12; ++run) {
        const int axes = random.integer(2, max_axes);
        const MachineSettings machine = random_machine(random, axes);
        const BezierPath path = random_path(random, axes, 6, random.decades(1.0, 20.0), 0.3, 0.3);
        const auto planned = plan_of<TestType>(path, machine, 1024);
        const Stream stream = stream_of<TestType>(path, machine, 1024);
        const Real segment_s = static_cast<Real>(stream.segments[0].duration_ticks) / 8e6L;
        Clock<TestType> clock(planned, stream, segment_s);
        std::size_t compared = 0;
        for (std::size_t i = 0; i < stream.segments.size(); ++i) {
            PerAxis<Real> position{};
            Real speed = 0.0L;
            // Segment i runs from the sample at i - 1 to that at i segments, the first two being the start
            if (i < 2 || !clock.at(static_cast<Real>(i - 1) * segment_s, position, speed)) {
                continue;
            }
            ++compared;
            for (const unsigned k : splinefeed::indices(axes)) {
                const AxisSettings& axis = machine.axis[k];
                const Real p = static_cast<Real>(stream.segments[i].start[k]) / units_per_mm(axis);
                const Real bound = segment_s * segment_s * real(axis.max_acceleration_mm_s2) / 6.0L;
                // Roundings: of the sample; of time, which adds up over the cells at the speed of the axis
                if (!(std::fabs(p - position[k]) <= bound + sample_rounding(axis) + 1e-7L)) {
                    CAPTURE(run, i, k, static_cast<double>(p - position[k]), static_cast<double>(bound));
                    FAIL("the joint is too far off");
                }
            }
        }
        CHECK(compared > stream.segments.size() / 2);
    }
}

TEMPLATE_TEST_CASE("the emitted speed is the planned speed", "[stream][trajectory]", double, Fixed) {
    const MachineSettings machine = machine_of(3, 100.0, 1000.0, 100.0);
    BezierPath path;
    Random random(72);
    for (int i = 0; i < 10; ++i) {
        path.push_back(random_shape(random, 3, 3, 60.0));
        if (i > 0) {
            join_smoothly(path[path.size() - 2], path.back());
        }
        path.back().feed_mm_s = i % 2 == 0 ? 20.0 : 45.0;
    }
    const auto planned = plan_of<TestType>(path, machine, 4096);
    const Stream stream = stream_of<TestType>(path, machine, 4096);
    const Real segment_s = static_cast<Real>(stream.segments[0].duration_ticks) / 8e6L;
    Clock<TestType> clock(planned, stream, segment_s);
    std::vector<Real> planned_speed(stream.segments.size() + 1, 0.0L); // at the sample that segment i starts from
    for (std::size_t i = 2; i < planned_speed.size(); ++i) {
        PerAxis<Real> position{};
        static_cast<void>(clock.at(static_cast<Real>(i - 1) * segment_s, position, planned_speed[i]));
    }
    int steady = 0;
    for (std::size_t i = 2; i < stream.segments.size(); ++i) {
        const Real speed = planned_speed[i];
        Real sum = 0.0L;
        for (unsigned k = 0; k < 3; ++k) {
            const Real v =
                static_cast<Real>(stream.segments[i].start_velocity[k]) / (units_per_mm(machine.axis[k]) * segment_s);
            sum += v * v;
        }
        // From the sample before to the one after; the chord of an arc is shorter by (v T kappa)^2 / 6, here below 1e-5
        if (speed > 0.0L && speed == planned_speed[i - 1] && speed == planned_speed[i + 1]) {
            ++steady;
            CAPTURE(i, static_cast<double>(std::sqrt(sum)), static_cast<double>(speed));
            REQUIRE(std::fabs(std::sqrt(sum) / speed - 1.0L) < 1e-4L);
        }
    }
    CHECK(steady > 1000);
}

TEMPLATE_TEST_CASE("next takes no memory", "[stream][trajectory]", double, float, Fixed) {
    const auto limits = MotionLimits<TestType>::make({}).value();
    std::vector<PlannedCell<TestType>> window(64);
    G2Spline<TestType> curve({.axes = 3});
    AccelerationPlanner<TestType> planner(window);
    auto trajectory = Trajectory<TestType>::make(curve, limits, planner).value();
    const Program program = loop_program();
    Feeder<TestType, G2Spline<TestType>> feeder(curve, program);
    FeedSegment segment;
    std::size_t count = 0;
    const std::size_t before = allocations();
    while (trajectory.state() != Pull::finished) {
        if (trajectory.next(segment) == Pull::item) {
            ++count;
        } else if (trajectory.state() == Pull::starved) {
            feeder.feed(5);
        }
    }
    const std::size_t after = allocations();
    CHECK(after == before);
    CHECK(count > 1000);
    static_assert(noexcept(trajectory.next(segment)));
}

TEMPLATE_TEST_CASE("the state tells why there is no segment", "[stream][trajectory]", double, float, Fixed) {
    const auto limits = MotionLimits<TestType>::make({.axes = 1}).value();
    std::vector<PlannedCell<TestType>> window(16);
    Polyline<TestType> curve({.axes = 1});
    AccelerationPlanner<TestType> planner(window);
    auto trajectory = Trajectory<TestType>::make(curve, limits, planner).value();
    FeedSegment segment;
    CHECK(trajectory.state() == Pull::starved);
    CHECK(trajectory.next(segment) != Pull::item);
    CHECK(trajectory.state() == Pull::starved);
    Waypoint<TestType> waypoint;
    REQUIRE(curve.push(waypoint).ok());
    waypoint.position[0] = position_from_mm(3.0);
    REQUIRE(curve.push(waypoint).ok());
    CHECK(trajectory.next(segment) != Pull::item);
    CHECK(trajectory.state() == Pull::starved);
    REQUIRE(curve.finish().ok());
    std::size_t count = 0;
    while (trajectory.next(segment) == Pull::item) {
        CHECK(trajectory.state() == Pull::item);
        REQUIRE(segment.index == count++);
        REQUIRE(segment.waypoint == 1);
    }
    CHECK(count > 100);
    CHECK(trajectory.state() == Pull::finished);
    CHECK(trajectory.next(segment) != Pull::item);
    CHECK(trajectory.state() == Pull::finished);
    CHECK(trajectory.arc_length().segments() == 1);
    CHECK(length_to_mm(trajectory.arc_length().travelled()) == Approx(3.0).epsilon(1e-6));
    CHECK(trajectory.feed_plan().window_limited() == 0);
}

TEMPLATE_TEST_CASE("the emitted curve stays on a straight line", "[stream][trajectory]", double, Fixed) {
    // No path error at all where there is no curvature: samples lie on the line, and so do their combinations
    const MachineSettings machine = machine_of(2, 100.0, 1000.0, 100.0);
    const Stream stream = stream_of<TestType>(BezierPath{line_shape(2, 3, {30.0, 60.0})}, machine);
    for (const FeedSegment& s : stream.segments) {
        // Control points are rounded to 6 units and to 2^-40 mm, which is 3.5 units of 1000 steps per mm
        REQUIRE(std::abs(2 * s.end[0] - s.end[1]) <= 3 * (6 + 4) * 3);
    }
}
