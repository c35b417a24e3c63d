// SPDX-License-Identifier: MIT
#include "splinefeed/s3_feed_plan/acceleration/cell_window.hpp"

#include "support/catch.hpp"

#include <array>
#include <deque>

using namespace splinefeed;

TEST_CASE("cells leave the window in the order in which they were measured, however often the ring turns", "[window]") {
    std::array<PlannedCell<double>, 5> storage{};
    CellWindow<double> window(storage);
    std::deque<std::uint32_t> reference;
    std::size_t taken = 0;
    std::uint32_t next = 0;
    std::uint32_t state = 1;
    for (int i = 0; i < 10'000; ++i) {
        state = state * 1664525U + 1013904223U;
        const std::uint32_t choice = (state >> 20) % 3;
        if (choice == 0 && window.measured() < window.room()) {
            window.at(window.measured()).cell.waypoint = next;
            window.add_measured();
            reference.push_back(next++);
        } else if (choice == 1 && window.size() < window.measured()) {
            window.take();
            ++taken;
        } else if (choice == 2 && window.size() > 0) {
            window.pop();
            reference.pop_front();
            --taken;
        }
        REQUIRE(window.size() == taken);
        REQUIRE(window.measured() == reference.size());
        for (std::size_t k = 0; k < reference.size(); ++k) {
            REQUIRE(window.at(k).cell.waypoint == reference[k]);
        }
    }
    CHECK(next > 1000);
    window.clear();
    CHECK(window.size() == 0);
    CHECK(window.measured() == 0);
    CHECK(window.room() == 5);
}
