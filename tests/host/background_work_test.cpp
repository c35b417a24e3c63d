// SPDX-License-Identifier: MIT
#include "host_sim/base/background_work.hpp"

#include "support/catch.hpp"

#include <stdexcept>

using namespace splinefeed::host;

TEST_CASE("background work is done in order, and all of it") {
    constexpr int pieces = 20'000; // more than may wait
    for (const bool threaded : {false, true}) {
        std::vector<int> done;
        BackgroundWork work(threaded);
        for (int i = 0; i < pieces; ++i) {
            work.add([&done, i] { done.push_back(i); });
        }
        work.finish();
        REQUIRE(done.size() == pieces);
        for (int i = 0; i < pieces; ++i) {
            REQUIRE(done[static_cast<std::size_t>(i)] == i);
        }
        work.add([&done] { done.clear(); });
        work.finish();
        CHECK(done.empty());
        work.finish();
    }
}

TEST_CASE("behind an exception of background work nothing is done") {
    int done = 0;
    BackgroundWork work(true);
    for (int i = 0; i < 5000; ++i) {
        work.add([&done, i] {
            if (i == 700) {
                throw std::runtime_error("no");
            }
            ++done;
        });
    }
    CHECK_THROWS_AS(work.finish(), std::runtime_error);
    CHECK(done == 700);
    CHECK_THROWS_AS(BackgroundWork(false).add([] { throw std::runtime_error("no"); }), std::runtime_error);
}

TEST_CASE("background work that nobody finishes ends with its object") {
    int done = 0;
    {
        BackgroundWork work(true);
        for (int i = 0; i < 1000; ++i) {
            work.add([&done] { ++done; });
        }
    }
    CHECK(done <= 1000);
}
