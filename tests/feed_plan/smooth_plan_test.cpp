// SPDX-License-Identifier: MIT
//
// The motion that is to be averaged: continuous, inside what its cells allow, and with accelerations that change their
// sign only after a time without.
#include "splinefeed/s3_feed_plan/jerk_filtered/smooth_plan.hpp"

#include "support/catch.hpp"
#include "support/pipeline.hpp"
#include "support/rounds.hpp"

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 90210;

MachineSettings bounded_machine(Random& random) {
    MachineSettings machine = machine_of(2, 100.0, 1000.0, 100.0);
    machine.jerk_tier = JerkTier::bounded;
    for (AxisSettings& axis : machine.axis) {
        axis.max_acceleration_mm_s2 = random.decades(500.0, 5000.0);
        axis.max_jerk_mm_s3 = axis.max_acceleration_mm_s2 / random.decades(0.004, 0.05);
    }
    return machine;
}

/// A plan with its stages, and memory for it.
template <Scalar S>
struct Averaged {
    Averaged(const BezierPath& path, const MachineSettings& machine, std::size_t window)
        : limits(MotionLimits<S>::make(machine).value()), source(path), arc_length(source, limits.refinement),
          feed_window(64), feed_plan(arc_length, limits, feed_window), cells(window), plan(feed_plan, limits, cells) {}

    MotionLimits<S> limits;
    ListSource<S> source;
    ArcLength<S> arc_length;
    std::vector<PlannedCell<S>> feed_window;
    FeedPlan<S> feed_plan;
    std::vector<SmoothCell<S>> cells;
    SmoothPlan<S> plan;
};

} // namespace

TEMPLATE_TEST_CASE("an acceleration changes its sign only after the time that is averaged over", "[feed_plan][smooth]",
                   double, Fixed) {
    using S = TestType;
    for (int round = 0; round < rounds(20); ++round) {
        Random random(seed + static_cast<std::uint64_t>(round));
        const MachineSettings machine = bounded_machine(random);
        const BezierPath path = random_path(random, 2, 8, random.decades(0.5, 20.0), 0.2, 0.3);
        Averaged<S> planned(path, machine, random.chance(0.5) ? 24 : 256);
        SmoothPlan<S>& plan = planned.plan;
        CAPTURE(seed, round);
        Real speed_sq = 0.0L;
        Real since = 0.0L;
        int sign = 0;
        std::size_t profile_segments = 0;
        while (plan.prepare() == Pull::item && ++profile_segments < 200'000) {
            const ProfileSegment<S>& profile_segment = plan.profile_segment();
            const Real reach = static_cast<Real>((plan.smoothing_q8() + 255) / 256);
            const Real entry = exact(profile_segment.entry_sq);
            const Real exit = exact(profile_segment.exit_sq);
            REQUIRE(entry == speed_sq);
            REQUIRE(exit >= 0.0L);
            REQUIRE(exact(profile_segment.stretch.to) >= exact(profile_segment.stretch.from));
            if (entry == 0.0L) {
                sign = 0; // at rest for as long as it takes
            }
            const Real least = 0x1p-30L + entry * 0x1p-44L; // rounding
            const int now = exit > entry + least ? 1 : exit < entry - least ? -1 : 0;
            if (now != 0) {
                REQUIRE((sign == 0 || now == sign || since >= reach - 1e-3L));
                sign = now;
                since = 0.0L;
            } else {
                since += exact(plan.ticks());
            }
            speed_sq = exit;
            plan.advance();
            while (plan.can_release()) {
                plan.release();
            }
        }
        REQUIRE(plan.prepare() == Pull::finished);
        REQUIRE(speed_sq == 0.0L);
        CHECK(profile_segments > 10);
    }
}

TEMPLATE_TEST_CASE("no cell of a motion to be averaged is passed faster than the feed plan does", "[feed_plan][smooth]",
                   double, Fixed) {
    using S = TestType;
    for (int round = 0; round < rounds(10); ++round) {
        Random random(seed + 1000 + static_cast<std::uint64_t>(round));
        const MachineSettings machine = bounded_machine(random);
        const BezierPath path = random_path(random, 2, 8, random.decades(0.5, 20.0), 0.2, 0.0);
        Averaged<S> planned(path, machine, 256);
        Averaged<S> reference(path, machine, 256);
        CAPTURE(seed, round);
        Real seconds = 0.0L;
        while (planned.plan.prepare() == Pull::item) {
            seconds += exact(planned.plan.ticks()) / exact(planned.limits.segments_per_s);
            planned.plan.advance();
            while (planned.plan.can_release()) {
                planned.plan.release();
            }
        }
        Real least = 0.0L;
        FeedPlan<S>& feed = reference.feed_plan;
        while (feed.prepare() == Pull::item) {
            const ProfileSegment<S>& profile_segment = feed.profile_segment();
            const Real sum = std::sqrt(exact(profile_segment.entry_sq)) + std::sqrt(exact(profile_segment.exit_sq));
            least += 2.0L * exact(feed.cell().length_mm) * exact(profile_segment.stretch.length()) / sum;
            feed.advance();
        }
        CHECK(seconds >= least * 0.999L);
    }
}

TEMPLATE_TEST_CASE("along a straight line a motion to be averaged takes the time of the trapezoid",
                   "[feed_plan][smooth]", double, Fixed) {
    using S = TestType;
    MachineSettings machine = machine_of(2, 100.0, 1000.0, 100.0);
    machine.jerk_tier = JerkTier::bounded;
    machine.axis[0].max_jerk_mm_s3 = machine.axis[1].max_jerk_mm_s3 = 1e5;
    for (const double length : {13.0, 17.3, 40.0, 100.0}) {
        Averaged<S> planned({line_shape(2, 1, {length, 0.0})}, machine, 256);
        Real seconds = 0.0L;
        while (planned.plan.prepare() == Pull::item) {
            seconds += exact(planned.plan.ticks()) / exact(planned.limits.segments_per_s);
            planned.plan.advance();
            while (planned.plan.can_release()) {
                planned.plan.release();
            }
        }
        const Real v = exact(planned.limits.feed_mm_s);
        const Real least = real(length) / v + v / exact(planned.limits.acceleration_mm_s2[0]);
        CAPTURE(length, static_cast<double>(seconds), static_cast<double>(least));
        CHECK(seconds >= least * 0.9999L);
        CHECK(seconds <= least * 1.002L);
    }
}
