// SPDX-License-Identifier: MIT
//
// What does not fit together is refused where it is built, or at rest before the first segment that does not fit; and
// what a storage held before changes nothing.
#include "support/catch.hpp"
#include "support/emitted.hpp"
#include "support/steered_run.hpp"

#include <array>
#include <utility>

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 1312;

// Limits that end with the line would dangle.
template <class Limits>
concept TakesLimits = requires(CurveSource<double>& curve, Limits&& limits, Planner<double>& planner) {
    Trajectory<double>::make(curve, std::forward<Limits>(limits), planner);
};
static_assert(!TakesLimits<MotionLimits<double>>);
static_assert(TakesLimits<const MotionLimits<double>&>);

MachineSettings jerk_machine() {
    return with_jerk(machine_of(2, 100.0, 1000.0, 100.0), 5e4);
}

/// Machines for each of the planners that the scalar has.
template <Scalar S>
std::vector<MachineSettings> machines() {
    std::vector<MachineSettings> all{machine_of(2, 100.0, 1000.0, 100.0)};
    if (!std::same_as<S, float>) {
        all.push_back(jerk_machine());
    }
    return all;
}

template <Scalar S>
MotionLimits<S> limits_of(const MachineSettings& machine) {
    return MotionLimits<S>::make(machine).value();
}

template <Scalar S>
Error refusal(CurveSource<S>& curve, const MotionLimits<S>& limits, Planner<S>& planner) {
    return Trajectory<S>::make(curve, limits, planner).error();
}

template <Scalar S>
ListSource<S> line_source(int axes, const PerAxis<double>& to, const PerAxis<double>& from = {}) {
    return ListSource<S>(segments_of<S>(BezierPath{line_shape(axes, 3, to)}, from), 0, 0);
}

} // namespace

TEST_CASE("a planner that the limits do not ask for is refused", "[stream][refusal]") {
    using S = Fixed;
    ListSource<S> source = line_source<S>(2, {10.0, 5.0});
    const auto plain = limits_of<S>(machine_of(2, 100.0, 1000.0, 100.0));
    const auto limited = limits_of<S>(jerk_machine());
    std::vector<PlannedCell<S>> window(64);
    std::vector<Cell<S>> cells(64);
    std::vector<JerkNode<float>> nodes(65);
    std::vector<LegNode<float>> scratch(65);
    AccelerationPlanner<S> acceleration_planner(window);
    JerkPlanner<S, float> jerk_planner(window, {cells, nodes, scratch});
    const std::array<Planner<S>*, 2> planners{&acceleration_planner, &jerk_planner};
    const std::array limits{plain, limited};
    for (std::size_t i = 0; i < limits.size(); ++i) {
        for (std::size_t j = 0; j < planners.size(); ++j) {
            CAPTURE(i, j);
            CHECK(refusal<S>(source, limits[i], *planners[j]) == (i == j ? Error::none : Error::planner_unsuited));
        }
    }
    // Limits for a motion that is sampled in double leave too little for the rounding of a Fixed.
    const auto in_double = MotionLimits<S>::make(jerk_machine(), SampledIn::float64).value();
    CHECK(refusal<S>(source, in_double, jerk_planner) == Error::planner_unsuited);
    std::vector<JerkNode<double>> double_nodes(65);
    std::vector<LegNode<double>> double_scratch(65);
    JerkPlanner<S, double> double_planner(window, {cells, double_nodes, double_scratch});
    CHECK(refusal<S>(source, in_double, double_planner) == Error::none);
    CHECK(refusal<S>(source, limited, double_planner) == Error::none); // coarser ones suit it, too
    const MotionLimits<S> none{};
    CHECK(refusal<S>(source, none, acceleration_planner) == Error::axes_out_of_range);
}

TEST_CASE("storage that is too small is refused and not written to", "[stream][refusal]") {
    using S = Fixed;
    ListSource<S> source = line_source<S>(2, {10.0, 5.0});
    const auto plain = limits_of<S>(machine_of(2, 100.0, 1000.0, 100.0));
    const auto limited = limits_of<S>(jerk_machine());
    std::vector<PlannedCell<S>> window(64);
    std::vector<Cell<S>> cells(16);
    std::vector<JerkNode<float>> nodes(17);
    std::vector<LegNode<float>> scratch(17);
    const auto first = [](auto& storage, std::size_t n) {
        return std::span(storage).first(n);
    };
    for (const std::size_t size : {0U, 1U, 9U}) {
        AccelerationPlanner<S> planner(first(window, size));
        CHECK(refusal<S>(source, plain, planner) == Error::window_too_small);
        JerkPlanner<S, float> other(first(window, size), {cells, nodes, scratch});
        CHECK(refusal<S>(source, limited, other) == Error::window_too_small);
    }
    for (const std::size_t size : {0U, 15U}) {
        JerkPlanner<S, float> planner(window, {first(cells, size), nodes, scratch});
        CHECK(refusal<S>(source, limited, planner) == Error::window_too_small);
    }
    for (const std::size_t size : {std::size_t{0}, nodes.size() - 1}) {
        JerkPlanner<S, float> planner(window, {cells, first(nodes, size), scratch});
        JerkPlanner<S, float> other(window, {cells, nodes, first(scratch, size)});
        CHECK(refusal<S>(source, limited, other) == Error::storage_too_small);
        CHECK(refusal<S>(source, limited, planner) == Error::storage_too_small);
    }
    JerkPlanner<S, float> least(first(window, 10), {cells, nodes, scratch});
    CHECK(refusal<S>(source, limited, least) == Error::none);
}

TEMPLATE_TEST_CASE("a curve of other axes than the machine's is refused", "[stream][refusal]", double, float, Fixed) {
    using S = TestType;
    for (const MachineSettings& machine : machines<S>()) {
        const auto limits = limits_of<S>(machine);
        for (const int axes : {1, 3}) {
            ListSource<S> source = line_source<S>(axes, {10.0, 5.0, 5.0});
            AnyTrajectory<S> any(source, limits, 64);
            FeedSegment segment;
            CHECK(any.trajectory().next(segment) != Pull::item);
            CHECK(any.trajectory().state() == Pull::finished);
            CHECK(any.trajectory().status().error() == Error::axes_differ);
            CHECK_FALSE(any.trajectory().stand(segment));
        }
    }
}

TEMPLATE_TEST_CASE("counts out of range end the path at rest before them", "[stream][refusal]", double, float, Fixed) {
    using S = TestType;
    for (MachineSettings machine : machines<S>()) {
        // 2147.48 mm either way, of which the second move goes beyond
        machine.axis[0].steps_per_mm = 1e6;
        const auto limits = limits_of<S>(machine);
        for (const double sign : {1.0, -1.0}) {
            const BezierPath path{line_shape(2, 3, {sign * 400.0, 5.0}), line_shape(2, 3, {sign * 300.0, 5.0})};
            ListSource<S> source(segments_of<S>(path, {sign * 1700.0, 0.0}), 0, 0);
            AnyTrajectory<S> any(source, limits, 256);
            SteeredRun run;
            run_steered<S>(any.trajectory(), {}, run);
            CHECK(any.trajectory().status().error() == Error::counts_out_of_range);
            REQUIRE(run.finished);
            require_limits(run, machine, std::same_as<S, float> ? 5e-2L : 0.0L);
            require_ends(run, machine, {sign * 1700.0, 0.0}, {sign * 2100.0, 5.0});
        }
    }
}

TEMPLATE_TEST_CASE("a new program begins where the machine stands, or is refused", "[stream][refusal][steering]",
                   double, float, Fixed) {
    using S = TestType;
    for (const MachineSettings& machine : machines<S>()) {
        const auto limits = limits_of<S>(machine);
        ListSource<S> source = line_source<S>(2, {10.0, 5.0});
        AnyTrajectory<S> any(source, limits, 64);
        Trajectory<S>& trajectory = any.trajectory();
        FeedSegment segment;
        CHECK_FALSE(trajectory.stand(segment)); // nowhere yet
        for (int i = 0; i < 50; ++i) {
            REQUIRE(trajectory.next(segment) == Pull::item);
        }
        CHECK_FALSE(trajectory.stand(segment));
        ListSource<S> elsewhere = line_source<S>(2, {1.0, 0.0}, {10.0, 5.0001});
        CHECK(trajectory.start(elsewhere).error() == Error::still_moving);
        while (trajectory.next(segment) == Pull::item) {
        }
        REQUIRE(trajectory.start(elsewhere).ok());
        CHECK(trajectory.next(segment) != Pull::item);
        CHECK(trajectory.state() == Pull::finished);
        CHECK(trajectory.status().error() == Error::start_elsewhere);
        const auto stood = segment.end;
        REQUIRE(trajectory.stand(segment));
        CHECK(segment.end == stood);
        // The right one, with a hold and an override from before
        trajectory.hold();
        trajectory.override_feed(literal<S>(0.5));
        ListSource<S> here = line_source<S>(2, {1.0, 0.0}, {10.0, 5.0});
        REQUIRE(trajectory.start(here).ok());
        CHECK(trajectory.status().ok());
        CHECK(trajectory.activity() == Activity::held);
        CHECK(trajectory.next(segment) != Pull::item);
        CHECK(trajectory.state() == Pull::held);
        trajectory.resume();
        int count = 0;
        while (trajectory.next(segment) == Pull::item) {
            ++count;
        }
        CHECK(trajectory.state() == Pull::finished);
        CHECK(trajectory.status().ok());
        CHECK(segment.end[0] == target_units(11.0, machine.axis[0]));
        CHECK(count > 30);
    }
}

TEMPLATE_TEST_CASE("what a storage held before, and a program before, changes nothing", "[stream][refusal]", double,
                   float, Fixed) {
    using S = TestType;
    const auto same = [](const FeedSegment& a, const FeedSegment& b) {
        return a.start == b.start && a.end == b.end && a.start_velocity == b.start_velocity &&
               a.end_velocity == b.end_velocity;
    };
    for (const MachineSettings& machine : machines<S>()) {
        const auto limits = limits_of<S>(machine);
        Random random(seed);
        const BezierPath path = random_path(random, 2, 8, 10.0, 0.3, 0.3);
        const std::vector<Event> events{{40, Order::hold}, {400, Order::resume}, {500, Order::override_feed, 0.7}};
        SteeredRun clean;
        {
            ListSource<S> source(segments_of<S>(path, {}), 0, 0);
            AnyTrajectory<S> any(source, limits, 64);
            run_steered<S>(any.trajectory(), events, clean);
        }
        REQUIRE(clean.finished);
        for (const unsigned left_over : {0xFFU, 0x7FU, 0x40U, 0x01U}) {
            ListSource<S> source(segments_of<S>(path, {}), 0, 0);
            AnyTrajectory<S> any(source, limits, 64, static_cast<unsigned char>(left_over));
            SteeredRun run;
            run_steered<S>(any.trajectory(), events, run);
            CAPTURE(left_over);
            REQUIRE(run.segments.size() == clean.segments.size());
            REQUIRE(std::equal(run.segments.begin(), run.segments.end(), clean.segments.begin(), same));
        }
        // And a program that is aborted at some time, with another behind it
        for (const std::size_t at : {1U, 77U, 333U, 900U}) {
            CAPTURE(at);
            ListSource<S> source(segments_of<S>(path, {}), 0, 0);
            AnyTrajectory<S> any(source, limits, 64);
            SteeredRun run;
            run_steered<S>(any.trajectory(), {{at, Order::abort}}, run);
            REQUIRE(run.finished);
            const std::size_t before = run.segments.size();
            PerAxis<double> start{};
            for (unsigned k = 0; k < 2; ++k) {
                start[k] = to_mm(run.position[k]);
            }
            ListSource<S> next(segments_of<S>(path, start), 0, 0);
            REQUIRE(any.trajectory().start(next).ok());
            run_steered<S>(any.trajectory(), {}, run);
            ListSource<S> again(segments_of<S>(path, start), 0, 0);
            AnyTrajectory<S> fresh(again, limits, 64);
            SteeredRun alone;
            run_steered<S>(fresh.trajectory(), {}, alone);
            REQUIRE(run.segments.size() - before == alone.segments.size());
            REQUIRE(std::equal(alone.segments.begin(), alone.segments.end(),
                               run.segments.begin() + static_cast<std::ptrdiff_t>(before), same));
        }
    }
}
