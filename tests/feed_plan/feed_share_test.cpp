// SPDX-License-Identifier: MIT
//
// The feed counts the linear axes; rotary ones follow within limits of their own.
#include "splinefeed/s3_feed_plan/limits/feed_share.hpp"

#include "splinefeed/s1_blended_path/tolerance_path.hpp"
#include "splinefeed/s3_feed_plan/limits/machine_path_rules.hpp"

#include "support/catch.hpp"
#include "support/emitted.hpp"
#include "support/plan_reference.hpp"
#include "support/rounds.hpp"

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 71;

/// x and y in mm, a in degrees.
MachineSettings rotary_machine(double feed) {
    MachineSettings machine = machine_of(3, 500.0, 2000.0, feed);
    machine.axis[2].rotary = true;
    machine.axis[2].max_velocity_mm_s = 360.0;
    machine.axis[2].max_acceleration_mm_s2 = 3600.0;
    return machine;
}

double trapezoid_seconds(double length, double feed, double acceleration) {
    return length >= feed * feed / acceleration ? length / feed + feed / acceleration
                                                : 2.0 * std::sqrt(length / acceleration);
}

} // namespace

TEMPLATE_TEST_CASE("straight moves with a rotary axis", "[feed_plan][rotary]", double, Fixed) {
    const auto seconds = [](const MachineSettings& machine, const PerAxis<double>& move) {
        const auto planned = plan_of<TestType>({line_shape(3, 3, move)}, machine, 1U << 14);
        CHECK(use_of(planned.cells, machine).feed <= 1.0L);
        CHECK(use_of(planned.cells, machine).velocity <= 1.0L);
        CHECK(use_of(planned.cells, machine).acceleration <= 1.0L);
        return planned.seconds();
    };
    const MachineSettings machine = rotary_machine(20.0);
    // The feed is that of (30, 40): 50 mm in 2.5 s, with 200 degrees the acceleration of a leaves 900 mm/s2
    CHECK(seconds(machine, {30.0, 40.0, 200.0}) == Approx(trapezoid_seconds(50.0, 20.0, 900.0)).epsilon(0.005));
    // 1800 degrees: the axis needs 5 s, the feed follows
    CHECK(seconds(machine, {30.0, 40.0, 1800.0}) == Approx(trapezoid_seconds(1800.0, 360.0, 3600.0)).epsilon(0.005));
    // Nothing but a: the feed is in degrees/s
    CHECK(seconds(machine, {0.0, 0.0, 90.0}) == Approx(trapezoid_seconds(90.0, 20.0, 3600.0)).epsilon(0.005));
    // Without a programmed feed it may have a limit of its own, which linear axes do not have
    MachineSettings turning = machine;
    turning.max_turning_deg_s = 200.0;
    const auto turned = [&](const PerAxis<double>& move) {
        return plan_of<TestType>({line_shape(3, 3, move)}, turning, 1U << 14).seconds();
    };
    CHECK(turned({0.0, 0.0, 90.0}) == Approx(trapezoid_seconds(90.0, 200.0, 3600.0)).epsilon(0.005));
    CHECK(turned({30.0, 40.0, 200.0}) == seconds(machine, {30.0, 40.0, 200.0}));
    // A linear axis that hardly moves is one that moves
    CHECK(seconds(machine, {0.1, 0.0, 1800.0}) == Approx(trapezoid_seconds(1800.0, 360.0, 3600.0)).epsilon(0.005));
    // Were a linear, it would count
    MachineSettings linear = machine;
    linear.axis[2].rotary = false;
    CHECK(seconds(linear, {30.0, 40.0, 200.0}) ==
          Approx(trapezoid_seconds(std::hypot(50.0, 200.0), 20.0, 3600.0)).epsilon(0.005));
}

TEMPLATE_TEST_CASE("programmed feeds count the linear axes", "[feed_plan][rotary]", double, Fixed) {
    const MachineSettings machine = rotary_machine(100.0);
    BezierPath path{line_shape(3, 3, {30.0, 0.0, 60.0}), line_shape(3, 3, {0.0, 0.0, 60.0})};
    path[0].feed_mm_s = 10.0;
    path[1].feed_mm_s = 30.0;
    const auto planned = plan_of<TestType>(path, machine, 1U << 14);
    const double least = trapezoid_seconds(30.0, 10.0, 1800.0) + trapezoid_seconds(60.0, 30.0, 3600.0);
    CHECK(planned.seconds() == Approx(least).epsilon(0.005));
    MachineSettings turning = machine;
    turning.max_turning_deg_s = 360.0;
    CHECK(plan_of<TestType>(path, turning, 1U << 14).seconds() == planned.seconds());
}

// One place decides what is linear: a turn with the rounding of a post in x takes neither hours nor no time.
TEMPLATE_TEST_CASE("a turn beside which a linear axis hardly moves has the feed of that axis", "[feed_plan][rotary]",
                   double, float, Fixed) {
    using S = TestType;
    const MachineSettings machine = rotary_machine(100.0);
    const auto limits = MotionLimits<S>::make(machine).value();
    const auto seconds = [&](double x, double feed) {
        TolerancePath<S> path(3, rules_cast<S>(path_rules(machine)));
        REQUIRE(path.start({}).ok());
        PathElement<S> element;
        element.to = {position_from_mm(x), {}, position_from_mm(100.0)};
        element.tolerance_mm = literal<S>(0.1);
        element.feed_mm_s = from_double<S>(feed);
        REQUIRE(path.push(element).ok());
        REQUIRE(path.finish().ok());
        AnyTrajectory<S> any(path, limits, 64);
        FeedSegment segment;
        std::uint64_t ticks = 0;
        while (any.trajectory().next(segment) == Pull::item && ticks < 1'000'000'000) {
            ticks += segment.duration_ticks;
        }
        return static_cast<double>(ticks) / 8e6;
    };
    for (double x = 1.0; x > 1e-7; x *= 0.7) {
        CAPTURE(x);
        // With float up to half of a small feed is kept for rounding.
        const double least = trapezoid_seconds(100.0, 50.0, 3600.0);
        CHECK(seconds(x, x / 2.0) > 0.99 * least);
        CHECK(seconds(x, x / 2.0) < (std::same_as<S, float> ? 2.0 : 1.01) * least);
        CHECK(seconds(x, 10.0) == Approx(trapezoid_seconds(100.0, 360.0, 3600.0)).epsilon(0.03));
    }
    CHECK(seconds(0.0, 50.0) == Approx(trapezoid_seconds(100.0, 50.0, 3600.0)).epsilon(0.02));
}

TEST_CASE("a machine whose axes are all rotary feeds in degrees a second", "[feed_plan][rotary]") {
    MachineSettings machine = machine_of(2, 500.0, 2000.0, 20.0);
    const double linear = plan_of<double>({line_shape(2, 3, {30.0, 40.0})}, machine, 1U << 14).seconds();
    machine.axis[0].rotary = machine.axis[1].rotary = true;
    CHECK(plan_of<double>({line_shape(2, 3, {30.0, 40.0})}, machine, 1U << 14).seconds() == linear);
}

TEMPLATE_TEST_CASE("the share is the largest there is in the cell", "[feed_plan][rotary]", double, float, Fixed) {
    using S = TestType;
    Random random(seed);
    for (int run = 0; run < rounds(6); ++run) {
        const int axes = random.integer(2, max_axes);
        MachineSettings machine = random_machine(random, axes);
        make_rotary(random, machine);
        const auto limits = MotionLimits<S>::make(machine).value();
        ListSource<S> source(random_path(random, axes, 6, random.decades(1.0, 50.0), 0.2, 0.0));
        const bool rounds = std::same_as<S, float>;
        for (const Cell<S>& cell : cells_of(source, limits.refinement)) {
            const Real share = exact(feed_share(cell, limits));
            if (!limits.mixed) {
                REQUIRE(share == 1.0L);
                continue;
            }
            if (is_chord(cell)) {
                continue;
            }
            Real most = 0.0L;
            for (int i = 0; i <= 16; ++i) {
                Real unused = 0.0L;
                const Direction d = direction_at(cell, inverse_at(cell, i / 16.0L, unused));
                Real square = 0.0L;
                for (const unsigned k : splinefeed::indices(axes)) {
                    square += limits.rotary[k] ? 0.0L : d.tangent[k] * d.tangent[k];
                }
                most = std::max(most, std::sqrt(square));
            }
            CAPTURE(seed, run, static_cast<double>(share), static_cast<double>(most));
            REQUIRE(share >= most - (rounds ? 1e-4L : 2e-6L));
            const bool sharp = 2.0L * exact(cell.length_mm) * exact(cell.curvature_max[0]) > 0.4L;
            REQUIRE((sharp || share <= most + (rounds ? 2e-3L : 1e-3L)));
        }
    }
}

TEMPLATE_TEST_CASE("every limit holds and no node can be faster with rotary axes", "[feed_plan][rotary]", double, float,
                   Fixed) {
    // A fast path leaves Fixed fewer digits
    CHECK(require_best_plans<TestType>(seed + 1, rounds(6), make_rotary, 10.0L).feed > 0.99L);
}

TEMPLATE_TEST_CASE("what is emitted keeps the feed on the linear axes", "[feed_plan][rotary]", double, Fixed) {
    Random random(seed + 2);
    Real most = 0.0L;
    for (int run = 0; run < rounds(24); ++run) {
        const int axes = random.integer(2, max_axes);
        MachineSettings machine = random_machine(random, axes);
        make_rotary(random, machine);
        const Program program = random_program(random, axes);
        if (!MotionLimits<TestType>::make(machine).has_value()) {
            continue;
        }
        CAPTURE(seed, run);
        const Stream stream = stream_of<TestType>(program, machine, random.chance(0.5) ? 16 : 512);
        most = std::max(most, require_limits(stream, machine).feed);
    }
    CHECK(most > 0.999L);
}
