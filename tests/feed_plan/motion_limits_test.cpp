// SPDX-License-Identifier: MIT
//
// What a machine may state, and what the pipeline makes of it.
#include "support/catch.hpp"
#include "support/pipeline.hpp"

#include <limits>
#include <string>

using namespace splinefeed_test;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

template <class S>
LimitError error_of(const MachineSettings& machine) {
    return MotionLimits<S>::make(machine).error();
}

/// A slow machine with long periods: rounding is no obstacle to any of its numbers.
MachineSettings slow_machine() {
    return machine_of(3, 100.0, 0.1, 100.0, 100000);
}

/// A field of the settings within [low, high], and the error outside of it.
template <class S, class Field>
void check_range(Field field, double low, double high, LimitError error) {
    const auto with = [&](double value) {
        MachineSettings machine = slow_machine();
        field(machine) = value;
        return error_of<S>(machine);
    };
    CHECK(with(low) == LimitError::none);
    CHECK(with(high) == LimitError::none);
    for (const double bad : {std::nextafter(low, 0.0), std::nextafter(high, infinity), -low, -1.0, not_a_number,
                             infinity, -infinity, 1e300, -1e300, 1e-300}) {
        CAPTURE(bad);
        CHECK(with(bad) == error);
    }
}

} // namespace

TEMPLATE_TEST_CASE("segments of a sample are a whole number of ticks, and travel is counted", "[feed_plan][limits]",
                   double, float, Fixed) {
    using S = TestType;
    MachineSettings machine = slow_machine();
    const auto with = [&](int segments, int period_us) {
        machine.segments_per_sample = segments;
        machine.sample_period_us = period_us;
        return error_of<S>(machine);
    };
    for (const int whole : {0, 1, 2, 4, 5, 8}) {
        CAPTURE(whole);
        CHECK(with(whole, 100000) == LimitError::none);
    }
    for (const int broken : {3, 6, 7}) {
        CHECK(with(broken, 100000) == LimitError::segments_per_sample_invalid);
    }
    CHECK(with(7, 70000) == LimitError::none);
    for (const int outside : {-1, 9, 16, 1000}) {
        CHECK(with(outside, 90000) == LimitError::segments_per_sample_invalid);
    }
    machine = slow_machine();
    machine.axis[1].travel_end_zone_mm = machine.axis[1].travel_end_velocity_mm_s = 10.0;
    machine.axis[1].steps_per_mm = 1e6;
    machine.axis[1].travel_low_mm = -2147.0;
    machine.axis[1].travel_high_mm = 2147.0;
    CHECK(error_of<S>(machine) == LimitError::none);
    machine.axis[1].travel_high_mm = 2148.0;
    CHECK(error_of<S>(machine) == LimitError::counts_out_of_range);
}

TEMPLATE_TEST_CASE("every number of a machine has a range", "[feed_plan][limits]", double, float, Fixed) {
    using S = TestType;
    CHECK(error_of<S>({}) == LimitError::none);
    check_range<S>([](MachineSettings& m) -> double& { return m.max_feed_mm_s; }, 0.001, 10000.0,
                   LimitError::feed_out_of_range);
    check_range<S>([](MachineSettings& m) -> double& { return m.centripetal_mm_s2; }, 0.1, 1e6,
                   LimitError::centripetal_out_of_range);
    check_range<S>([](MachineSettings& m) -> double& { return m.chord_error_mm; }, 1e-6, 1.0,
                   LimitError::chord_error_out_of_range);
    for (unsigned k = 0; k < 3; ++k) {
        check_range<S>([k](MachineSettings& m) -> double& { return m.axis[k].max_velocity_mm_s; }, 0.001, 10000.0,
                       LimitError::velocity_out_of_range);
        check_range<S>([k](MachineSettings& m) -> double& { return m.axis[k].steps_per_mm; }, 0.001, 1e6,
                       LimitError::steps_out_of_range);
        check_range<S>([k](MachineSettings& m) -> double& { return m.axis[k].max_acceleration_mm_s2; }, 0.1, 1e6,
                       LimitError::acceleration_out_of_range);
        check_range<S>([k](MachineSettings& m) -> double& { return m.axis[k].max_braking_mm_s2; }, 0.1, 1e6,
                       LimitError::braking_out_of_range);
    }
    MachineSettings machine;
    for (const int bad : {0, -1, max_axes + 1, 1000, std::numeric_limits<int>::min()}) {
        machine.axes = bad;
        CHECK(error_of<S>(machine) == LimitError::axes_out_of_range);
    }
    machine = {};
    for (const int bad : {0, -1, 49, 100001, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
        machine.sample_period_us = bad;
        CHECK(error_of<S>(machine) == LimitError::sample_period_out_of_range);
    }
}

TEST_CASE("every error of limits has a sentence, which names no option of the host", "[feed_plan][limits]") {
    for (int error = 0; error <= static_cast<int>(LimitError::period_too_short); ++error) {
        const std::string sentence = describe(static_cast<LimitError>(error));
        CAPTURE(error, sentence);
        CHECK(sentence != "unknown error");
        CHECK(sentence.size() > 7);
        CHECK(sentence.find("--") == std::string::npos);
    }
    CHECK(describe(static_cast<LimitError>(255)) == std::string("unknown error"));
}

TEMPLATE_TEST_CASE("zero means no such limit", "[feed_plan][limits]", double, float, Fixed) {
    const auto limits = MotionLimits<TestType>::make({}).value();
    CHECK(limits.centripetal_mm_s2 == TestType{});
    CHECK(limits.chord_mm_s2 == TestType{});
    CHECK(limits.braking_mm_s2 == limits.acceleration_mm_s2);
}

TEMPLATE_TEST_CASE("jerk limits out of range are refused", "[feed_plan][limits]", double, float, Fixed) {
    for (const double jerk : {1e-300, 0.999, 1.001e9, -1.0, not_a_number, infinity}) {
        MachineSettings machine;
        machine.axis[2].max_jerk_mm_s3 = jerk;
        CHECK(error_of<TestType>(machine) == LimitError::jerk_out_of_range);
        machine.axes = 2; // an axis that the machine does not have says nothing
        CHECK(error_of<TestType>(machine) == LimitError::none);
    }
}

TEST_CASE("float cannot limit the jerk", "[feed_plan][limits]") {
    MachineSettings machine;
    machine.axis[1].max_jerk_mm_s3 = 3e4;
    CHECK(error_of<float>(machine) == LimitError::jerk_in_float);
}

TEMPLATE_TEST_CASE("a jerk limit shortens cells and their grades", "[feed_plan][limits]", double, Fixed) {
    MachineSettings machine;
    const MotionLimits<TestType> without = MotionLimits<TestType>::make(machine).value();
    CHECK_FALSE(without.jerk_limited);
    machine.axis[1].max_jerk_mm_s3 = 3e4;
    const MotionLimits<TestType> with = MotionLimits<TestType>::make(machine).value();
    CHECK(with.jerk_limited);
    // In double rounding needs no short cells.
    CHECK((with.refinement.longest_mm[1] < without.refinement.longest_mm[1]) == std::same_as<TestType, Fixed>);
    CHECK(with.refinement.finest_grade_log2 > without.refinement.finest_grade_log2);
    CHECK(to_double(with.jerk_mm_s3[1]) <= 3e4);
    CHECK(to_double(with.jerk_mm_s3[1]) >= 0.99 * 3e4);
    CHECK(to_double(with.jerk_mm_s3[0]) >= 0.99 * 2e6); // 2 A / T: no more can be emitted
    machine.sample_period_us = 250; // cells of 0.12 mm, of which a window would show too little of the path
    machine.axis[1].max_jerk_mm_s3 = 6e4;
    const auto fine = MotionLimits<TestType>::make(machine).value();
    CHECK((to_double(fine.refinement.longest_mm[1]) == 0.25) == std::same_as<TestType, Fixed>);
    const auto in_double = MotionLimits<TestType>::make(machine, SampledIn::float64).value();
    CHECK(to_double(in_double.refinement.longest_mm[1]) > 100.0);
    CHECK(to_double(in_double.jerk_mm_s3[1]) > 0.999 * 6e4); // rounding takes next to nothing of it
    machine.sample_period_us = 50;                           // its rounding would be a jerk of its own
    machine.axis[1].max_jerk_mm_s3 = 1.0;
    CHECK(error_of<TestType>(machine) == LimitError::period_too_short);
}

TEMPLATE_TEST_CASE("axes that the machine lacks are not checked", "[feed_plan][limits]", double, float, Fixed) {
    MachineSettings machine;
    machine.axes = 1;
    machine.axis[1] = {not_a_number, not_a_number, not_a_number, not_a_number, not_a_number};
    CHECK(error_of<TestType>(machine) == LimitError::none);
}

TEMPLATE_TEST_CASE("a period in which rounding exceeds the acceleration is refused", "[feed_plan][limits]", double,
                   float, Fixed) {
    // Positions of 2^-41 mm and counts of 2^-30 in a second difference: 4 e / T^2 against a quarter of the limit
    MachineSettings machine = machine_of(1, 100.0, 10.0, 100.0, 50, 0.001);
    CHECK(error_of<TestType>(machine) == LimitError::period_too_short);
    machine.sample_period_us = 100000;
    CHECK(error_of<TestType>(machine) == LimitError::none);
    machine = machine_of(1, 100.0, 1e5, 100.0, 1000, 1.0);
    CHECK(error_of<TestType>(machine) == LimitError::none);
}

TEMPLATE_TEST_CASE("derived numbers", "[feed_plan][limits]", double, float, Fixed) {
    using S = TestType;
    MachineSettings machine = machine_of(3, 80.0, 2000.0, 120.0, 2000, 640.5);
    machine.axis[1].max_acceleration_mm_s2 = 500.0;
    machine.axis[2].max_velocity_mm_s = 7.0;
    machine.axis[2].max_braking_mm_s2 = 700.0;
    machine.centripetal_mm_s2 = 900.0;
    machine.chord_error_mm = 0.002;
    const auto limits = MotionLimits<TestType>::make(machine).value();
    const bool is_float = std::same_as<TestType, float>;
    const double kept = is_float ? 1e-3 : 6e-6; // for relative rounding
    // Cells of 16 mm at most keep a resolution of 4.7e-10 (float: 2.4e-7) of themselves; e = 7.6e-9 mm (3.9e-6) at
    // most.
    const double e = 16.0 * (is_float ? 2.4e-7 : 4.8e-10);
    const double segment_s = 0.0005;
    const auto usable = [&](double limit, double noise) {
        return [=](S value) {
            return to_double(value) < limit * (1.0 - 0.9 * kept) &&
                   to_double(value) > limit * (1.0 - 1.1 * kept) - noise;
        };
    };
    const auto near = [](double value) {
        return Approx(value).epsilon(is_float ? 1e-6 : 1e-7).margin(1e-8);
    };
    CHECK(limits.axes == 3);
    for (unsigned k = 0; k < 3; ++k) {
        // What is left of a limit: rounding of samples becomes 2 e / T and 4 e / T^2 in their differences.
        CHECK(usable(machine.axis[k].max_velocity_mm_s, 2.0 * e / segment_s)(limits.velocity_mm_s[k]));
        const double share = 0.025 * machine.axis[k].smaller_acceleration_mm_s2();
        CHECK(usable(machine.axis[k].max_acceleration_mm_s2, share)(limits.acceleration_mm_s2[k]));
        CHECK(usable(k == 2 ? 700.0 : machine.axis[k].max_acceleration_mm_s2, share)(limits.braking_mm_s2[k]));
        CHECK(limits.steps_per_mm_q32[k] == (std::uint64_t{1281} << 31));
    }
    CHECK(usable(120.0, 3.0 * 2.0 * e / segment_s)(limits.feed_mm_s));
    CHECK(usable(50.0, 3.0 * 2.0 * e / segment_s)(limits.usable_feed(from_integer<S>(50))));
    CHECK(limits.usable_feed(from_double<S>(1e-6)) >= from_double<S>(0.49e-6)); // never nothing
    CHECK(to_double(limits.centripetal_mm_s2) == near(900.0 * (1.0 - kept)));
    CHECK(to_double(limits.chord_mm_s2) == near(8.0 * 0.002 / (0.002 * 0.002)));
    // |A| = 2872 mm/s2: T^2 |A| / 6 is 1.9 um at 2 ms, 0.48 at 1 ms, 0.12 at 0.5 ms
    CHECK(limits.segments_per_sample == 4);
    CHECK(limits.segment_ticks == 2000 * 8 / 4);
    CHECK(to_double(limits.segments_per_s) == near(2000.0));
    CHECK(to_double(limits.refinement.max_feed_mm_s) == to_double(limits.feed_mm_s));
    for (const unsigned k : indices(machine.axes)) {
        CHECK(to_double(limits.refinement.longest_mm[k]) >= 0.0625);
        CHECK(to_double(limits.refinement.longest_mm[k]) <= 16.0);
    }
}

TEMPLATE_TEST_CASE("as many segments per sample as smoothing needs", "[feed_plan][limits]", double, float, Fixed) {
    Random random(51);
    for (int run = 0; run < 2000; ++run) {
        MachineSettings machine =
            machine_of(random.integer(1, max_axes), 100.0, 1.0, 100.0, random.integer(50, 100000));
        double sum = 0.0;
        for (int k = 0; k < machine.axes; ++k) {
            double& acceleration = machine.axis[static_cast<unsigned>(k)].max_acceleration_mm_s2;
            acceleration = random.decades(10.0, 1e6);
            sum += acceleration * acceleration;
        }
        const auto limits = MotionLimits<TestType>::make(machine);
        if (!limits.has_value()) {
            REQUIRE(limits.error() == LimitError::period_too_short);
            continue;
        }
        const int n = limits->segments_per_sample;
        const double period = machine.sample_period_us * 1e-6;
        const auto smoothing = [&](int parts) {
            return period * period / (parts * parts) * std::sqrt(sum) / 6.0;
        };
        REQUIRE((n == 1 || n == 2 || n == 4 || n == 8));
        REQUIRE((n == 8 || smoothing(n) <= 0.35e-3 * (1.0 + 1e-9)));
        REQUIRE((n == 1 || smoothing(n / 2) > 0.35e-3 * (1.0 - 1e-9)));
        REQUIRE(limits->segment_ticks * static_cast<unsigned>(n) ==
                static_cast<unsigned>(machine.sample_period_us) * 8U);
    }
}

TEMPLATE_TEST_CASE("an acceleration that the jerk keeps an axis from is no limit", "[feed_plan][limits]", double,
                   Fixed) {
    MachineSettings machine;
    for (AxisSettings& axis : machine.axis) {
        axis.max_velocity_mm_s = 50.0;
        axis.max_jerk_mm_s3 = 2e4; // 1414 mm/s^2 at most: to it in 71 ms and 50 mm/s, and back in as much
    }
    const auto planned = [&](double acceleration) {
        machine.axis[0].max_acceleration_mm_s2 = machine.axis[0].max_braking_mm_s2 = acceleration;
        return to_double(MotionLimits<TestType>::make(machine).value().acceleration_mm_s2[0]);
    };
    CHECK(planned(1410.0) == Approx(1410.0).epsilon(0.01));
    CHECK(planned(1e6) == planned(1500.0));
    CHECK(planned(1e6) == Approx(std::sqrt(2.0 * 2e4 * 50.0)).epsilon(0.01));
}

TEST_CASE("limits can be made by the compiler", "[feed_plan][limits]") {
    constexpr auto good = MotionLimits<Fixed>::make({});
    static_assert(good.has_value() && good.value().axes == 3 && good.value().segment_ticks == 8000);
    constexpr auto bad = MotionLimits<double>::make({.axes = 0});
    static_assert(!bad.has_value() && bad.error() == LimitError::axes_out_of_range);
    static_assert(MotionLimits<float>::make({}).has_value());
    REQUIRE(good->steps_per_mm_q32[0] == (std::uint64_t{1000} << 32));
}
