// SPDX-License-Identifier: MIT
#include "host_sim/ports/histogram_picture.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <sstream>

using splinefeed::hal::TimeHistogram;
using splinefeed::host::histogram_picture;

TEST_CASE("Histogram picture: nothing was measured") {
    CHECK(histogram_picture(TimeHistogram{}).empty());
}

TEST_CASE("Histogram picture: it holds every value once, the longest bar where the most are") {
    TimeHistogram trips;
    for (int i = 0; i < 100; ++i) {
        trips.add(60'000);
    }
    trips.add(70'000);
    trips.add(5'000'000);
    std::istringstream lines(histogram_picture(trips));
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
