// SPDX-License-Identifier: MIT
#include "host_sim/run/program_steps.hpp"

#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

PendingStep behind(std::optional<std::uint32_t> row, double x, double dwell_s = 0.0) {
    PendingStep step;
    step.row = row;
    step.place[0] = position_from_mm(x);
    step.dwell_s = dwell_s;
    return step;
}

} // namespace

TEST_CASE("A step is passed by the first segment of a later row, also where rows begin again at 0") {
    PendingSteps steps;
    CHECK(steps.passed(5) == nullptr);
    steps.add(behind(0xffffffffU, 1.0));
    CHECK(steps.passed(0xfffffffeU) == nullptr);
    CHECK(steps.passed(0xffffffffU) == nullptr);
    CHECK(steps.passed(0) != nullptr);
    CHECK(steps.take().row == 0xffffffffU);
    CHECK(steps.empty());
}

TEST_CASE("A step is reached where its move ends, not on the way and not at another move's end at the same place") {
    PendingSteps steps;
    steps.add(behind(3, 10.0, 0.5));
    CHECK(steps.reached(3, {9.99}, 1) == nullptr);
    CHECK(steps.reached(2, {10.0}, 1) == nullptr);
    CHECK(steps.reached(std::nullopt, {10.0}, 1) == nullptr);
    REQUIRE(steps.reached(3, {10.00005}, 1) != nullptr);
    CHECK(steps.reached(3, {10.0}, 1)->dwell_s == 0.5);
}

TEST_CASE(
    "A step before every move is reached before anything has moved, wherever that is, and passed by any segment") {
    PendingSteps steps;
    steps.add(behind(std::nullopt, 7.0));
    CHECK(steps.reached(0, {7.0}, 1) == nullptr);
    CHECK(steps.reached(std::nullopt, {0.0}, 1) != nullptr);
    CHECK(steps.passed(0) != nullptr);
}

TEST_CASE("A step behind moves without a length is due at the end of each of them, and passed behind the last") {
    PendingSteps steps;
    PendingStep step = behind(0xffffffffU, 10.0);
    step.short_rows = 2;
    steps.add(step);
    for (const std::uint32_t row : {0xffffffffU, 0U, 1U}) {
        CHECK(steps.passed(row) == nullptr);
        CHECK(steps.reached(row, {10.00005}, 1) != nullptr);
    }
    CHECK(steps.reached(2, {10.0}, 1) == nullptr);
    CHECK(steps.reached(0xfffffffeU, {10.0}, 1) == nullptr);
    CHECK(steps.passed(2) != nullptr);
}
