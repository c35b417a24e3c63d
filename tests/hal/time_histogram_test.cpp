// SPDX-License-Identifier: MIT
#include "splinefeed/hal/rt/time_histogram.hpp"

#include "splinefeed/base/units.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using splinefeed::ns_per_us;
using splinefeed::hal::TimeHistogram;

namespace {

constexpr double bin_ratio = 1.1892071150027210667; // a quarter of an octave

/// The least value that this share of the values stays below or at.
std::uint64_t quantile(std::vector<std::uint64_t> values, double share) {
    std::sort(values.begin(), values.end());
    const auto at = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
    return values[std::max<std::size_t>(at, 1) - 1];
}

} // namespace

TEST_CASE("Time histogram: nothing was measured") {
    const TimeHistogram none;
    CHECK(none.total() == 0);
    CHECK(none.most_ns() == 0);
    CHECK(none.below_us(0.5) == 0.0);
}

TEST_CASE("Time histogram: shares to a quarter of an octave, whatever the values") {
    const auto seed = splinefeed_test::random_seed();
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> log2_us(0.0, 22.0);
    for (int round = 0; round < 50; ++round) {
        TimeHistogram times;
        std::vector<std::uint64_t> values;
        for (int i = 0; i < 500; ++i) {
            values.push_back(static_cast<std::uint64_t>(std::exp2(log2_us(random))));
            times.add(values.back() * ns_per_us);
        }
        CHECK(times.total() == values.size());
        CHECK(times.most_ns() == *std::max_element(values.begin(), values.end()) * ns_per_us);
        for (const double share : {0.01, 0.5, 0.9, 0.99, 1.0}) {
            const auto exact = static_cast<double>(quantile(values, share));
            CAPTURE(share, exact);
            CHECK(times.below_us(share) >= exact * (1.0 - 1e-12));
            CHECK(times.below_us(share) <= exact * bin_ratio * (1.0 + 1e-12));
        }
    }
}

TEST_CASE("Time histogram: on the edges of bins, and beyond the last one") {
    TimeHistogram times;
    for (const std::uint64_t us : {0U, 1U, 2U, 4U, 1024U}) {
        TimeHistogram alone;
        alone.add(us * ns_per_us);
        CHECK(alone.below_us(0.5) == static_cast<double>(us)); // never beyond the worst
        times.add(us * ns_per_us);
    }
    CHECK(times.below_us(0.4) == Approx(bin_ratio));
    CHECK(times.below_us(0.6) == Approx(2.0 * bin_ratio));
    times.add((std::uint64_t{1} << 40U) * ns_per_us); // two weeks
    CHECK(times.total() == 6);
    CHECK(times.most_ns() == (std::uint64_t{1} << 40U) * ns_per_us);
}

TEST_CASE("Time histogram: lateness is counted in octaves of a microsecond") {
    TimeHistogram late;
    for (const std::uint64_t ns : {0U, 999U, 1000U, 1999U, 2000U, 3999U, 4000U, 1'000'000U}) {
        late.add(ns);
    }
    CHECK(late.in_octave(0) == 2);
    CHECK(late.in_octave(1) == 2);
    CHECK(late.in_octave(2) == 2);
    CHECK(late.in_octave(3) == 1);
    CHECK(late.in_octave(10) == 1);
    CHECK(late.total() == 8);
    CHECK(late.most_ns() == 1'000'000);
    CHECK(late.below_us(0.5) == 2);
    CHECK(late.below_us(1.0) == 1000);
}
