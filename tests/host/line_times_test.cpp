// SPDX-License-Identifier: MIT
#include "host_sim/report/line_times.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;

TEST_CASE("lines have their first start, all their time, and the code that held longest") {
    LineTimes times;
    times.add(3, 1.0, 0.5, 8);
    times.add(5, 1.5, 2.0, 9);
    times.add(3, 3.5, 0.25, 10); // once more, in a loop
    times.add(0, 4.0, 1.0, 9);   // of no line
    times.add(LineTimes::most_lines + 1, 5.0, 1.0, 9);
    REQUIRE(times.lines().size() == 6);
    CHECK(times.lines()[3].start_s == 1.0);
    CHECK(times.lines()[3].seconds == 0.75);
    CHECK(times.lines()[3].code == 8);
    CHECK(times.lines()[4].start_s < 0.0);
    CHECK(times.slowest(10) == std::vector<std::uint64_t>{5, 3});
    CHECK(times.slowest(1) == std::vector<std::uint64_t>{5});
}
