// SPDX-License-Identifier: MIT
#include "splinefeed/s5_pulse_train/step_timing.hpp"

#include "support/catch.hpp"

#include <limits>

using namespace splinefeed;

namespace {

Error refusal(const StepSettings& settings) {
    return StepTiming::make(settings).error();
}

} // namespace

TEST_CASE("Times of lines become ticks, never shorter than asked for") {
    constexpr Result<StepTiming> timing = StepTiming::make(
        {.step_length_us = 1.9, .step_space_us = 2.5, .direction_setup_us = 0.65, .direction_hold_us = 0.0});
    static_assert(timing.has_value());
    CHECK(timing->high == 16);
    CHECK(timing->low == 20);
    CHECK(timing->setup == 6);
    CHECK(timing->hold == 0);
    CHECK(timing->step_gap() == 36);
    CHECK(timing->turn_gap() == 36); // longer than 16 + 0 + 6

    const Result<StepTiming> fixed = StepTiming::make({.tick_us = 10.0, .step_length_us = 2.0, .step_space_us = 10.5});
    REQUIRE(fixed.has_value());
    CHECK(fixed->grid == 80);
    CHECK(fixed->high == 80);
    CHECK(fixed->low == 160);
    CHECK(fixed->setup == 80);
    CHECK(fixed->turn_gap() == 240);

    const Result<StepTiming> edges =
        StepTiming::make({.step_length_us = 3.0, .step_space_us = 2.0, .step_on_edge = true});
    CHECK(edges->step_gap() == 24);
    CHECK(edges->turn_gap() == 80);
    // The DDA moves less than half a count a tick, whatever the line could do.
    CHECK(StepTiming::make({.tick_us = 10.0, .step_on_edge = true})->step_gap() == 160);
}

TEST_CASE("Times that no drive asks for are refused") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {-1.0, 1000.5, nan}) {
        CAPTURE(bad);
        CHECK(refusal({.step_length_us = bad}) == Error::step_times_out_of_range);
        CHECK(refusal({.step_space_us = bad}) == Error::step_times_out_of_range);
        CHECK(refusal({.direction_setup_us = bad}) == Error::step_times_out_of_range);
        CHECK(refusal({.direction_hold_us = bad}) == Error::step_times_out_of_range);
        CHECK(refusal({.tick_us = bad}) == Error::step_tick_out_of_range);
    }
    CHECK(refusal({.step_length_us = 0.1}) == Error::step_times_out_of_range);
    CHECK(refusal({.tick_us = 0.3}) == Error::step_tick_out_of_range);
    CHECK(refusal({.tick_us = 0.125}) == Error::step_tick_out_of_range);
    CHECK(refusal({.tick_us = 0.25}) == Error::none);
    for (const double bad : {0.0, 0.3, 1000.25}) {
        CHECK(refusal({.tick_us = bad, .interpolated = true}) == Error::step_tick_out_of_range);
    }
    CHECK(refusal({.tick_us = 1000.0, .interpolated = true}) == Error::none);
    CHECK(refusal({.tick_us = 0.25, .interpolated = true}) == Error::none);
    CHECK(refusal({.tick_us = 1000.0, .step_length_us = 1000.0}) == Error::none);
}

TEST_CASE("What a machine asks of its lines is allowed up to the rate and the change of direction that they carry") {
    const StepTiming timing = *StepTiming::make({}); // 2 + 2 us; turning 2 + 5 + 5 us
    CHECK(timing.most_steps_per_s() == Approx(8e6 / 34.0));
    CHECK(timing.allows({235000.0, 1e6}).ok());
    CHECK(timing.allows({236000.0, 1e6}).error() == Error::step_rate_too_high);
    CHECK(timing.allows({std::numeric_limits<double>::quiet_NaN(), 1e6}).error() == Error::step_rate_too_high);
    // 12.25 us, A t^2 / 8 = 1 / 64
    CHECK(timing.most_left_out(8e8) == Approx(8e8 * 12.25e-6 * 12.25e-6 / 8.0));
    CHECK(timing.allows({1000.0, 8.2e8}).ok());
    CHECK(timing.allows({1000.0, 8.5e8}).error() == Error::direction_change_too_long);
    // More than StepDirSequencer holds.
    CHECK(StepTiming::make({.step_length_us = 0.5, .step_space_us = 0.5, .direction_setup_us = 30.0})
              ->allows({1.0, 1.0})
              .error() == Error::direction_change_too_long);
    // The fixed rate: its instants are the nearest ticks.
    const StepTiming fixed = *StepTiming::make({.tick_us = 10.0});
    CHECK(fixed.allows({49600.0, 1e5}).ok());
    CHECK(fixed.allows({50000.0, 1e5}).error() == Error::step_rate_too_high);
}
