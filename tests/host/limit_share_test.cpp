// SPDX-License-Identifier: MIT
//
// Shares of motions of which it is known what bounds them when.
#include "host_sim/analysis/limit_share.hpp"

#include "support/catch.hpp"
#include "support/machine_motion.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

LimitShares shares_of(const MachineSettings& machine, const Motion& motion) {
    LimitShare share(machine);
    for (const FeedSegment& segment : motion) {
        share.segment(segment);
    }
    return share.shares();
}

// A circle in x, y at a constant speed.
Motion circle(double radius, double speed) {
    std::vector<long double> x;
    std::vector<long double> y;
    for (int i = 0; i < 2000; ++i) {
        const long double angle = static_cast<long double>(speed) / static_cast<long double>(radius) * 1e-3L * i;
        x.push_back(static_cast<long double>(radius) * std::cos(angle));
        y.push_back(static_cast<long double>(radius) * std::sin(angle));
    }
    const Motion motion = both(motion_of(x, 0), motion_of(y, 1));
    // without its ends, where the samples start and stop at once
    return Motion(motion.begin() + 10, motion.end() - 10);
}

} // namespace

TEST_CASE("a trapezoid binds acceleration, velocity, acceleration") {
    MachineSettings machine = machine_of({"x", "y"}).settings;
    const unsigned axis = GENERATE(0U, 1U);
    const Motion motion = there(100.0, 1000.0, axis);
    const LimitShares shares = shares_of(machine, motion);
    const auto total = static_cast<double>(motion.size());
    REQUIRE(shares.axis.size() == 2);
    CHECK(shares.axis[axis].acceleration == Approx(200.0 / total).margin(3.0 / total));
    CHECK(shares.axis[axis].velocity == Approx((10.0 + 2.0 * 5.0) / total).margin(3.0 / total)); // 95 % on the ramps
    CHECK_FALSE(shares.axis[axis].jerk);
    CHECK(shares.axis[1 - axis].acceleration == 0.0);
    CHECK(shares.axis[1 - axis].velocity == 0.0);
    CHECK(shares.feed == 0.0);
    CHECK_FALSE(shares.centripetal);
    CHECK_FALSE(shares.chord);
    CHECK(shares.none <= 12.0 / total); // at rest before and behind, and where two phases meet
    SECTION("with far limits, nothing binds") {
        machine.axis[axis].max_velocity_mm_s = 106.0;
        machine.axis[axis].max_acceleration_mm_s2 = 1060.0;
        const LimitShares free = shares_of(machine, motion);
        CHECK(free.none == 1.0);
        CHECK(free.axis[axis].velocity == 0.0);
        CHECK(free.axis[axis].acceleration == 0.0);
    }
    SECTION("limits bind together, and none is what is left") {
        machine.max_feed_mm_s = 100.0;
        machine.axis[axis].max_acceleration_mm_s2 = 2000.0;
        const LimitShares both = shares_of(machine, motion);
        CHECK(both.feed == both.axis[axis].velocity);
        CHECK(both.feed > 0.0);
        CHECK(both.none == Approx(1.0 - both.feed).epsilon(1e-12));
    }
}

TEST_CASE("jerk binds where the machine limits it") {
    MachineSettings machine = machine_of({"x"}).settings;
    machine.axis[0].max_jerk_mm_s3 = 20000.0;
    std::vector<long double> ramp;
    for (const int sign : {1, -1, -1, 1}) {
        for (int i = 1; i <= 20; ++i) {
            ramp.push_back((ramp.empty() ? 0.0L : ramp.back()) + sign * 20000.0L * 1e-3L);
        }
    }
    const Motion motion = motion_of(integrated(ramp), 0);
    const LimitShares shares = shares_of(machine, motion);
    CHECK(shares.axis[0].jerk.value() == Approx(80.0 / static_cast<double>(motion.size())).epsilon(1e-9));
}

TEST_CASE("on a circle the part of the acceleration across the path counts") {
    MachineSettings machine = machine_of({"x", "y"}).settings;
    const Motion motion = circle(20.0, 60.0); // 180 mm/s^2
    SECTION("centripetal") {
        machine.centripetal_mm_s2 = 180.0 * 1.04;
        CHECK(shares_of(machine, motion).centripetal.value() == 1.0);
        CHECK(shares_of(machine, motion).none == 0.0);
        machine.centripetal_mm_s2 = 180.0 * 1.06;
        CHECK(shares_of(machine, motion).centripetal.value() == 0.0);
        CHECK(shares_of(machine, motion).none == 1.0);
    }
    SECTION("chord error: kappa v^2 T^2 / 8") {
        const double sagitta = 180.0 * 1e-6 / 8.0;
        machine.chord_error_mm = sagitta * 1.04;
        CHECK(shares_of(machine, motion).chord.value() == 1.0);
        machine.chord_error_mm = sagitta * 1.06;
        CHECK(shares_of(machine, motion).chord.value() == 0.0);
    }
    SECTION("the speed along the path is that of all axes") {
        machine.max_feed_mm_s = 60.0 * 1.04;
        CHECK(shares_of(machine, motion).feed == 1.0);
        machine.max_feed_mm_s = 60.0 * 1.06;
        CHECK(shares_of(machine, motion).feed == 0.0);
    }
    SECTION("axes bind in turn") {
        machine.axis[0].max_velocity_mm_s = 60.0; // where |sin| > 0.95
        CHECK(shares_of(machine, motion).axis[0].velocity == Approx(0.2022).margin(0.02));
        CHECK(shares_of(machine, motion).axis[1].velocity == 0.0);
    }
}

TEST_CASE("on a straight line nothing goes across the path") {
    MachineSettings machine = machine_of({"x", "y"}).settings;
    machine.centripetal_mm_s2 = 1.0;
    machine.chord_error_mm = 1e-6;
    const LimitShares shares = shares_of(machine, both(there(80.0, 500.0, 0), there(80.0, 500.0, 1)));
    CHECK(shares.centripetal.value() == 0.0);
    CHECK(shares.chord.value() == 0.0);
    CHECK(shares.none == 1.0);
}

TEST_CASE("the feed is that of the waypoint") {
    const MachineSettings machine = machine_of({"x"}).settings; // 1000 mm/s
    Motion motion;
    for (std::uint32_t waypoint = 0; waypoint < 4; ++waypoint) {
        for (int i = 0; i < 10; ++i) {
            FeedSegment segment = stroke(0.05, millisecond, units(0.05)); // 50 mm/s
            segment.start_velocity[0] = segment.end_velocity[0];
            segment.waypoint = waypoint;
            motion.push_back(segment);
        }
    }
    LimitShare share(machine);
    share.programmed(0, 50.0);
    share.programmed(1, 0.0);
    share.programmed(1, 0.0); // a second segment of the curve
    share.programmed(2, 55.0);
    share.programmed(3, 51.0);
    share.programmed(4, 50.0); // not reached yet
    for (const FeedSegment& segment : motion) {
        share.segment(segment);
    }
    CHECK(share.shares().feed == 0.5);
    CHECK(share.shares().programmed_feed == 0.5);
    CHECK(share.shares().none == 0.5);
}

TEST_CASE("an override, a hold and a dwell are limits of their own") {
    MachineSettings machine = machine_of({"x"}).settings;
    machine.max_feed_mm_s = 90.0;
    FeedSegment moves = stroke(0.05, millisecond, units(0.05)); // 50 mm/s
    moves.start_velocity[0] = moves.end_velocity[0];
    FeedSegment rest;
    rest.duration_ticks = millisecond;
    LimitShare share(machine);
    share.programmed(0, 100.0 / 3.0);
    const auto kind_of = [&](const FeedSegment& segment, const OperatorState& steered) {
        share.segment(segment, steered);
        return share.binding_limit().kind;
    };
    CHECK(kind_of(moves, {.override_feed = 1.5}) == LimitKind::override_feed);
    CHECK(kind_of(moves, {.override_feed = 1.7}) == LimitKind::none); // 56.7 mm/s are allowed
    CHECK(kind_of(moves, {}) == LimitKind::feed);
    CHECK(kind_of(moves, {.standstill = LimitKind::hold}) == LimitKind::hold); // it brakes
    CHECK(kind_of(rest, {.standstill = LimitKind::hold}) == LimitKind::hold);
    CHECK(kind_of(rest, {.standstill = LimitKind::dwell}) == LimitKind::dwell);
    CHECK(kind_of(rest, {}) == LimitKind::none);
    const LimitShares shares = share.shares();
    CHECK(shares.override_feed == Approx(1.0 / 7.0));
    CHECK(shares.programmed_feed == Approx(2.0 / 7.0)); // the hold's, too
    CHECK(shares.feed == Approx(3.0 / 7.0));
    CHECK(shares.hold == Approx(2.0 / 7.0));
    CHECK(shares.dwell == Approx(1.0 / 7.0));
    CHECK(shares.none == Approx(2.0 / 7.0));
    SECTION("a rapid has none, and none is above the machine's feed") {
        machine.max_feed_mm_s = 50.0;
        LimitShare other(machine);
        other.programmed(0, 0.0, true);
        other.segment(moves, {.override_feed = 0.5});
        CHECK(other.binding_limit().kind == LimitKind::machine_feed);
        LimitShare fast(machine);
        fast.programmed(0, 40.0);
        fast.segment(moves, {.override_feed = 2.0});
        CHECK(fast.binding_limit().kind == LimitKind::machine_feed);
    }
}

TEST_CASE("a waypoint that no segment stops to tell of is passed over, and a feed above the machine's is not a limit") {
    MachineSettings machine = machine_of({"x"}).settings;
    machine.max_feed_mm_s = 50.0;
    FeedSegment segment = stroke(0.05, millisecond, units(0.05));
    segment.start_velocity[0] = segment.end_velocity[0];
    segment.waypoint = 7;
    LimitShare share(machine);
    share.programmed(5, 10.0);
    share.programmed(6, 10.0);
    share.programmed(7, 500.0);
    share.segment(segment);
    CHECK(share.shares().feed == 1.0);
    CHECK(share.shares().programmed_feed == 0.0);
}

TEST_CASE("without a motion there are no shares") {
    const LimitShares shares = shares_of(machine_of({"x"}).settings, {});
    CHECK(shares.none == 0.0);
    CHECK(shares.axis[0].velocity == 0.0);
}

TEST_CASE("segments count by their duration") {
    const MachineSettings machine = machine_of({"x"}).settings;
    FeedSegment fast = stroke(0.1, millisecond, units(0.1)); // at the limit
    fast.start_velocity[0] = fast.end_velocity[0];
    FeedSegment rest;
    rest.duration_ticks = 3 * millisecond;
    CHECK(shares_of(machine, {fast, rest}).axis[0].velocity == 0.25);
    CHECK(shares_of(machine, {fast, rest}).none == 0.75);
}
