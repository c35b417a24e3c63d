// SPDX-License-Identifier: MIT
#include "host_sim/base/compensated_sum.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;

TEST_CASE("small steps are not lost in a large sum") {
    // After 10^10 steps of 0.25 ms the next ones are below a half of the last digit, or near it.
    constexpr double far = 2.5e6;
    constexpr double step = 1e-10;
    CompensatedSum sum(far);
    double plain = far;
    constexpr int steps = 1'000'000;
    for (int i = 0; i < steps; ++i) {
        sum += step;
        plain += step;
    }
    CHECK(sum.value() - far == Approx(steps * step).epsilon(1e-5)); // 2e-16 of the sum
    CHECK(plain == far);                                            // what it mends
}

TEST_CASE("a large step after small ones") {
    CompensatedSum sum;
    for (int i = 0; i < 1000; ++i) {
        sum += 1e-12;
    }
    sum += 1e6;
    CHECK(sum.value() - 1e6 == Approx(1e-9).margin(1.2e-10));
}
