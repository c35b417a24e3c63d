// SPDX-License-Identifier: MIT
//
// Straight cells: the profile segments of one are allowed, and take the least time there is.
#include "splinefeed/s3_feed_plan/acceleration/peaked_segment.hpp"

#include "support/catch.hpp"
#include "support/pipeline.hpp"
#include "support/rounds.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 20261127;

template <Scalar S>
Cell<S> cell_of(const TestShape& line, const MotionLimits<S>& limits) {
    ListSource<S> source(BezierPath{line});
    ArcLength<S> arc_length(source, limits.refinement);
    Cell<S> cell;
    REQUIRE(arc_length.next(cell) == Pull::item);
    return cell;
}

// From v0 to v1 over a length, v at most: speeding up by a, braking by d.
Real least_seconds(Real length, Real v0, Real v1, Real v, Real a, Real d) {
    const Real meet = (2.0L * a * d * length + d * v0 * v0 + a * v1 * v1) / (a + d);
    const Real peak = std::min(v, std::sqrt(meet));
    const Real up = (peak * peak - v0 * v0) / (2.0L * a);
    const Real down = (peak * peak - v1 * v1) / (2.0L * d);
    return (peak - v0) / a + (peak - v1) / d + (length - up - down) / peak;
}

} // namespace

TEMPLATE_TEST_CASE("a line is one cell, and takes the time of the trapezoid", "[feed_plan][peak]", double, float,
                   Fixed) {
    using S = TestType;
    for (const double acceleration : {30.0, 1000.0, 1e5}) {
        for (const double feed : {0.5, 10.0, 100.0, 1000.0}) {
            for (const double length : {0.02, 1.0, 15.0}) {
                MachineSettings machine = machine_of(1, 2000.0, acceleration, feed);
                if (!MotionLimits<S>::make(machine).has_value() ||
                    (std::same_as<S, float> && (length < 1.0 || acceleration < 300.0 || feed < 10.0 || feed > 100.0))) {
                    continue; // float has no digits for it
                }
                const double longest = to_double(MotionLimits<S>::make(machine).value().refinement.longest_mm[0]);
                const auto planned = plan_of<S>({line_shape(1, 1, {length})}, machine, 1U << 10);
                const double least = length >= feed * feed / acceleration ? length / feed + feed / acceleration
                                                                          : 2.0 * std::sqrt(length / acceleration);
                CAPTURE(scalar_name<S>(), acceleration, feed, length, planned.seconds(), least);
                CHECK(planned.seconds() < least * (std::same_as<S, float> ? 1.02 : 1.001));
                CHECK(planned.seconds() > least * (1.0 - 1e-6));
                CHECK((length > longest || planned.cells.size() == 1));
            }
        }
    }
}

TEMPLATE_TEST_CASE("the parts of a straight cell are allowed and as fast as can be", "[feed_plan][peak]", double,
                   Fixed) {
    using S = TestType;
    for (int round = static_cast<int>(first_round()), count = rounds(300); round < count; ++round) {
        Random random(seed + static_cast<std::uint64_t>(round));
        MachineSettings machine = machine_of(1, 1000.0, random.decades(30.0, 1e5), 1000.0);
        if (random.chance(0.5)) {
            machine.axis[0].max_braking_mm_s2 = machine.axis[0].max_acceleration_mm_s2 * random.decades(0.3, 3.0);
        }
        const auto limits = MotionLimits<S>::make(machine).value();
        const double length = random.decades(2e-3, std::min(10.0, 0.99 * to_double(limits.refinement.longest_mm[0])));
        Cell<S> cell = cell_of<S>(line_shape(1, 1, {length}), limits);
        REQUIRE(has_parts(cell));
        cell.heading[0] = 1;
        const Real a = exact(limits.acceleration_mm_s2[0]);
        const Real d = exact(limits.braking_mm_s2[0]);
        const Real v = std::min<Real>(500.0L, std::sqrt(a * static_cast<Real>(length))) *
                       static_cast<Real>(random.between(0.01, 1.0));
        const Real v0 = v * static_cast<Real>(random.between(0.01, 1.0));
        const Real low = std::sqrt(std::max(0.0L, v0 * v0 - 1.99L * d * static_cast<Real>(length)));
        const Real high = std::min(v, std::sqrt(v0 * v0 + 1.99L * a * static_cast<Real>(length)));
        const Real v1 = low + (high - low) * static_cast<Real>(random.between(0.01, 1.0));
        PeakTarget<S> target{S{}, from_double<S>(static_cast<double>(v0 * v0)),
                             from_double<S>(static_cast<double>(v * v)), from_double<S>(static_cast<double>(v1 * v1))};
        CAPTURE(round, length, static_cast<double>(v), static_cast<double>(v0), static_cast<double>(v1));
        Real seconds = 0.0L;
        int parts = 0;
        for (S to{}; to < from_integer<S>(1); ++parts) {
            REQUIRE(parts < 4);
            const ProfileSegment<S> part = peaked_segment(cell, limits, target);
            REQUIRE(part.stretch.from == target.from);
            REQUIRE(part.stretch.to > target.from);
            REQUIRE(part.exit_sq <= target.most_sq);
            const Real v_from = std::sqrt(exact(part.entry_sq));
            const Real v_to = std::sqrt(exact(part.exit_sq));
            const Real way = exact(part.stretch.length()) * static_cast<Real>(length);
            CHECK(v_to * v_to - v_from * v_from <= 2.0L * a * way * (1.0L + 1e-6L));
            CHECK(v_from * v_from - v_to * v_to <= 2.0L * d * way * (1.0L + 1e-6L));
            seconds += 2.0L * way / (v_from + v_to);
            to = target.from = part.stretch.to;
            target.entry_sq = part.exit_sq;
        }
        CHECK(target.entry_sq == target.exit_sq);
        const Real least = least_seconds(static_cast<Real>(length), v0, v1, v, a, d);
        CHECK(seconds >= least * (1.0L - 1e-6L));
        CHECK(seconds <= least * 1.002L);
    }
}

TEMPLATE_TEST_CASE("the parts of a bent cell are allowed", "[feed_plan][peak]", double, float, Fixed) {
    using S = TestType;
    int peaks = 0;
    for (int round = static_cast<int>(first_round()), count = rounds(300); round < count; ++round) {
        Random random(seed + static_cast<std::uint64_t>(round));
        MachineSettings machine = machine_of(3, 500.0, 1000.0, 500.0);
        for (AxisSettings& axis : machine.axis) {
            axis.max_acceleration_mm_s2 = random.decades(300.0, 1e4);
            axis.max_braking_mm_s2 = random.chance(0.5) ? random.decades(300.0, 1e4) : 0.0;
        }
        const auto limits = MotionLimits<S>::make(machine).value();
        const Cell<S> cell = cell_of<S>(random_shape(random, 3, 3, random.decades(0.05, 5.0)), limits);
        if (!has_parts(cell)) {
            continue;
        }
        const S cap = SpeedCaps<S>(limits).cap(cell).least_sq();
        const AccelerationBound<S> bound(cell, limits);
        const PeakSpeeds<S> peak = bound.peak({cap, cap});
        const S entry = from_double<S>(random.between(0.0, 0.5)) * peak.entry_sq;
        const S exit = bound.largest_exit(entry, from_double<S>(random.between(0.0, 0.5)) * peak.largest_exit_sq);
        PeakTarget<S> target{S{}, entry, cap, larger(exit, bound.smallest_exit(entry, exit, cap))};
        CAPTURE(round, to_double(cell.length_mm), to_double(entry), to_double(exit), to_double(cap));
        for (S to{}; to < from_integer<S>(1);) {
            const ProfileSegment<S> part = peaked_segment(cell, limits, target);
            peaks += part.exit_sq > larger(target.entry_sq, target.exit_sq) ? 1 : 0;
            const AccelerationBound<S> of_part(cell, limits, part.stretch);
            const S slack = part.exit_sq * literal<S>(std::same_as<S, float> ? 1e-3 : 1e-5) + literal<S>(1e-6);
            CHECK(of_part.largest_exit(part.entry_sq, part.exit_sq) >= part.exit_sq - slack);
            CHECK(of_part.smallest_exit(part.entry_sq, part.exit_sq, cap + cap) <= part.exit_sq + slack);
            CHECK(part.exit_sq <= cap);
            REQUIRE(part.stretch.to > target.from);
            to = target.from = part.stretch.to;
            target.entry_sq = part.exit_sq;
        }
    }
    CHECK(peaks > 10);
}
