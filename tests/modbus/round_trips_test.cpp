// SPDX-License-Identifier: MIT
#include "host_sim/diagnose/round_trips.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <vector>

using splinefeed::host::RoundTrips;

namespace {

constexpr double bin_ratio = 1.1892071150027210667; // a quarter of an octave

/// The least value that this share of the values stays below or at.
std::uint64_t quantile(std::vector<std::uint64_t> values, double share) {
    std::sort(values.begin(), values.end());
    const auto at = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
    return values[std::max<std::size_t>(at, 1) - 1];
}

} // namespace

TEST_CASE("Round trips: nothing was measured") {
    const RoundTrips none;
    CHECK(none.count() == 0);
    CHECK(none.worst_us() == 0);
    CHECK(none.below_us(0.5) == 0.0);
    CHECK(none.picture().empty());
}

TEST_CASE("Round trips: shares to a quarter of an octave, whatever the values") {
    const auto seed = std::random_device{}();
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> log2_us(0.0, 22.0);
    for (int round = 0; round < 50; ++round) {
        RoundTrips trips;
        std::vector<std::uint64_t> values;
        for (int i = 0; i < 500; ++i) {
            values.push_back(static_cast<std::uint64_t>(std::exp2(log2_us(random))));
            trips.add(values.back());
        }
        CHECK(trips.count() == values.size());
        CHECK(trips.worst_us() == *std::max_element(values.begin(), values.end()));
        for (const double share : {0.01, 0.5, 0.9, 0.99, 1.0}) {
            const auto exact = static_cast<double>(quantile(values, share));
            CAPTURE(share, exact);
            CHECK(trips.below_us(share) >= exact * (1.0 - 1e-12));
            CHECK(trips.below_us(share) <= exact * bin_ratio * (1.0 + 1e-12));
        }
    }
}

TEST_CASE("Round trips: on the edges of bins, and beyond the last one") {
    RoundTrips trips;
    for (const std::uint64_t us : {0U, 1U, 2U, 4U, 1024U}) {
        RoundTrips alone;
        alone.add(us);
        CHECK(alone.below_us(0.5) == static_cast<double>(us)); // never beyond the worst
        trips.add(us);
    }
    CHECK(trips.below_us(0.4) == 1.0);
    CHECK(trips.below_us(0.6) == 2.0);
    trips.add(std::uint64_t{1} << 40U); // two weeks
    CHECK(trips.count() == 6);
    CHECK(trips.worst_us() == std::uint64_t{1} << 40U);
}

TEST_CASE("Round trips: the picture holds every value once, the longest bar where the most are") {
    RoundTrips trips;
    for (int i = 0; i < 100; ++i) {
        trips.add(60);
    }
    trips.add(70);
    trips.add(5000);
    std::istringstream lines(trips.picture());
    int count = 0;
    int rows = 0;
    std::size_t longest = 0;
    for (std::string line; std::getline(lines, line); ++rows) {
        double edge_us = 0.0;
        int in_bin = 0;
        REQUIRE(std::sscanf(line.c_str(), " below %lf us %d", &edge_us, &in_bin) == 2);
        const auto bar = static_cast<std::size_t>(std::count(line.begin(), line.end(), '#'));
        CHECK((in_bin == 100) == (bar == 50));
        CHECK(bar >= 1);
        longest = std::max(longest, bar);
        count += in_bin;
    }
    CHECK(rows == 3);
    CHECK(count == 102);
    CHECK(longest == 50);
}
