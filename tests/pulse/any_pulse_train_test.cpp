// SPDX-License-Identifier: MIT
#include "splinefeed/s5_pulse_train/any_pulse_train.hpp"
#include "support/catch.hpp"

using namespace splinefeed;

TEST_CASE("Any pulse train: a timing with a grid has the engine that steps on it") {
    const auto crossings = StepTiming::make({});
    const auto grid = StepTiming::make({.tick_us = 10.0});
    REQUIRE(crossings.error() == Error::none);
    REQUIRE(grid.error() == Error::none);
    CHECK(std::holds_alternative<PulseTrain<StepIntervals>>(make_pulse_train(3, crossings.value())));
    CHECK(std::holds_alternative<PulseTrain<FixedRate>>(make_pulse_train(3, grid.value())));
    const Result<StepTiming> between = StepTiming::make({.tick_us = 40.0, .interpolated = true});
    CHECK(std::holds_alternative<PulseTrain<InterpolatedSteps>>(make_pulse_train(3, between.value())));
}
