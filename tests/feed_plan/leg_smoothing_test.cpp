// SPDX-License-Identifier: MIT
//
// The time that a leg is averaged over: that of the S-curve on a straight leg, and of the limits where it bends.
#include "splinefeed/s3_feed_plan/jerk_filtered/leg_smoothing.hpp"

#include "support/catch.hpp"
#include "support/pipeline.hpp"

using namespace splinefeed_test;

namespace {

/// 100 mm/s, 1000 mm/s^2, and 50 ms to the full acceleration.
MachineSettings slow_starter() {
    MachineSettings machine = machine_of(2, 100.0, 1000.0, 100.0);
    machine.jerk_tier = JerkTier::bounded;
    machine.axis[0].max_jerk_mm_s3 = machine.axis[1].max_jerk_mm_s3 = 20000.0;
    return machine;
}

/// A cell along the first axis, in which both axes bend with one over this radius.
template <Scalar S>
PathDerivativeBounds<S> bounds_of(double radius_mm) {
    PathDerivativeBounds<S> out;
    out.cap_sq = out.programmed_sq = from_integer<S>(10000);
    out.axis[0] = {from_integer<S>(1), from_double<S>(1.0 / radius_mm), from_double<S>(1.0 / (radius_mm * radius_mm)),
                   S{}};
    out.axis[1] = out.axis[0];
    return out;
}

/// In s. @param radii  of cells of equal length
template <Scalar S>
double averaged_s(const MotionLimits<S>& limits, double length_mm, const std::vector<double>& radii, bool ends,
                  bool& in_view) {
    LegSmoothing<S> leg(limits);
    for (const double radius : radii) {
        leg.add(bounds_of<S>(radius), from_double<S>(length_mm / static_cast<double>(radii.size())),
                from_integer<S>(10000));
    }
    if (ends) {
        leg.end_here();
    }
    return static_cast<double>(leg.longest_q8(in_view)) / 256.0 / to_double(limits.segments_per_s);
}

} // namespace

TEMPLATE_TEST_CASE("a straight leg has the time of the S-curve", "[feed_plan][smooth]", double, Fixed) {
    using S = TestType;
    const auto limits = MotionLimits<S>::make(slow_starter()).value();
    for (const double length : {0.01, 0.3, 3.0, 30.0, 300.0}) {
        bool in_view = false;
        const double jerk = to_double(limits.jerk_mm_s3[0]);
        const double least = std::min({1000.0 / 20000.0, std::cbrt(length / (2.0 * jerk)), std::sqrt(100.0 / jerk)});
        const double time = averaged_s(limits, length, {1e9, 1e9}, true, in_view);
        CAPTURE(length, time, least);
        CHECK(in_view);
        CHECK(time <= least * (1.0 + 1e-6));
        CHECK(time > least - 1e-5);
    }
}

TEMPLATE_TEST_CASE("only a leg with mild bends that is known to its end is averaged like a straight one",
                   "[feed_plan][smooth]", double, Fixed) {
    using S = TestType;
    const auto limits = MotionLimits<S>::make(slow_starter()).value();
    const double of_bends = static_cast<double>(limits.smoothing_q8) / 256.0 / to_double(limits.segments_per_s);
    bool in_view = false;
    CHECK(averaged_s(limits, 300.0, {100.0, 100.0}, true, in_view) > 0.0495);
    CHECK(averaged_s(limits, 300.0, {100.0, 100.0}, false, in_view) == of_bends);
    // With a radius of 2 mm, 45 mm/s use the acceleration: less than half of the fastest cell's speed
    CHECK(averaged_s(limits, 300.0, {100.0, 2.0}, true, in_view) == of_bends);
    CHECK(averaged_s(limits, 300.0, {100.0, 3.5}, true, in_view) > 0.0495);
    CHECK(in_view);
}

TEMPLATE_TEST_CASE("what is known of a leg that goes on takes three times the time of its average",
                   "[feed_plan][smooth]", double, Fixed) {
    using S = TestType;
    const auto limits = MotionLimits<S>::make(slow_starter()).value();
    bool in_view = true;
    const double time = averaged_s(limits, 6.0, {1e9, 1e9}, false, in_view); // 60 ms
    CHECK_FALSE(in_view);
    CHECK(time <= 0.02);
    CHECK(time > 0.0199);
}
