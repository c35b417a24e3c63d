// SPDX-License-Identifier: MIT
//
// Axes that go slower near the ends of their travel.
#include "support/catch.hpp"
#include "support/emitted.hpp"
#include "support/plan_reference.hpp"

using namespace splinefeed_test;

namespace {

void set_end(AxisSettings& axis, double low, double high, double zone, double velocity) {
    axis.travel_low_mm = low;
    axis.travel_high_mm = high;
    axis.travel_end_zone_mm = zone;
    axis.travel_end_velocity_mm_s = velocity;
}

/// The largest part of the end velocity that the axis has within its end zones, at 33 places of every segment.
Real fastest_at_end(const std::vector<FeedSegment>& segments, const AxisSettings& axis, unsigned k) {
    Real used = 0.0L;
    const Real scale = units_per_mm(axis);
    for (const FeedSegment& segment : segments) {
        const AxisMotion m = motion_of(segment, k);
        const Real duration = static_cast<Real>(segment.duration_ticks) / (ticks_per_us * 1e6L);
        const auto a0 = static_cast<Real>(m.a0);
        const auto change = static_cast<Real>(m.a1 - m.a0);
        for (int i = 0; i <= 32; ++i) {
            const Real u = static_cast<Real>(i) / 32.0L;
            const auto v0 = static_cast<Real>(m.v0);
            const Real mm = (static_cast<Real>(m.p0) + u * (v0 + u * (a0 / 2.0L + u * change / 6.0L))) / scale;
            const Real v = std::fabs(v0 + u * (a0 + u * change / 2.0L)) / (scale * duration);
            if (mm < real(axis.travel_low_mm + axis.travel_end_zone_mm) ||
                mm > real(axis.travel_high_mm - axis.travel_end_zone_mm)) {
                used = std::max(used, v / real(axis.travel_end_velocity_mm_s));
            }
        }
    }
    return used;
}

} // namespace

TEMPLATE_TEST_CASE("a line into the end zone slows down before it", "[feed_plan][travel_end]", double, Fixed) {
    for (const double sign : {1.0, -1.0}) {
        MachineSettings machine = machine_of(2, 1000.0, 1000.0, 100.0);
        set_end(machine.axis[0], sign > 0.0 ? -20.0 : -80.0, sign > 0.0 ? 80.0 : 20.0, 10.0, 10.0);
        // 0 to 75 mm: 100 mm/s, 10 from 70 on, and to rest
        const double least = 0.1 + (70.0 - 5.0 - 4.95) / 100.0 + 0.09 + 4.95 / 10.0 + 0.01;
        const auto planned = plan_of<TestType>({line_shape(2, 3, {75.0 * sign, 0.0})}, machine, 1U << 14);
        CHECK(planned.seconds() >= least * (1.0 - 1e-6));
        // Cells beside the zone are halves of halves: up to 5 % is lost while it brakes
        CHECK(planned.seconds() <= least * 1.06);
        // Along the other axis nothing is slower
        const auto across = plan_of<TestType>({line_shape(2, 3, {0.0, 75.0})}, machine, 1U << 14);
        CHECK(across.seconds() == Approx(0.85).epsilon(0.005));
        // An end velocity above that of the axis changes nothing
        machine.axis[0].travel_end_velocity_mm_s = 2000.0;
        const auto fast = plan_of<TestType>({line_shape(2, 3, {75.0 * sign, 0.0})}, machine, 1U << 14);
        CHECK(fast.seconds() == Approx(0.85).epsilon(0.005));
    }
}

TEMPLATE_TEST_CASE("what is emitted in an end zone keeps its velocity", "[feed_plan][travel_end]", double, float,
                   Fixed) {
    for (const int period : {250, 1000, 4000}) {
        for (const double velocity : {2.0, 20.0}) {
            MachineSettings machine = machine_of(3, 100.0, 1000.0, 100.0, period);
            set_end(machine.axis[0], -51.0, 51.0, 15.0, velocity);
            set_end(machine.axis[1], -31.0, 31.0, 4.0, velocity);
            const Stream stream = stream_of<TestType>(loop_program(), machine);
            CAPTURE(period, velocity);
            require_limits(stream, machine);
            for (const unsigned k : {0U, 1U}) {
                const Real most = fastest_at_end(stream.segments, machine.axis[k], k);
                CHECK(most <= 1.0L);
                CHECK(most > 0.95L);
            }
            MachineSettings open = machine;
            open.axis[0].travel_end_zone_mm = open.axis[1].travel_end_zone_mm = 0.0;
            CHECK(stream_of<TestType>(loop_program(), open).segments.size() < stream.segments.size());
        }
    }
}

TEMPLATE_TEST_CASE("an end zone has its ranges", "[feed_plan][limits]", double, float, Fixed) {
    const auto error = [](double low, double high, double zone, double velocity) {
        MachineSettings machine;
        set_end(machine.axis[1], low, high, zone, velocity);
        return MotionLimits<TestType>::make(machine).error();
    };
    CHECK(error(0.0, 100.0, 5.0, 10.0) == LimitError::none);
    CHECK(error(0.0, 100.0, 500.0, 10.0) == LimitError::none); // all of the travel
    CHECK(error(0.0, 0.0, 5.0, 10.0) == LimitError::travel_end_incomplete);
    CHECK(error(0.0, 2e6, 5.0, 10.0) == LimitError::travel_end_incomplete);
    CHECK(error(0.0, 100.0, -5.0, 10.0) == LimitError::travel_end_zone_out_of_range);
    CHECK(error(0.0, 100.0, 1e7, 10.0) == LimitError::travel_end_zone_out_of_range);
    CHECK(error(0.0, 100.0, 5.0, 0.0) == LimitError::travel_end_incomplete);
    CHECK(error(0.0, 100.0, 5.0, std::nan("")) == LimitError::travel_end_velocity_out_of_range);
}
