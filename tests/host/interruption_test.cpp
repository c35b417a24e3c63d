// SPDX-License-Identifier: MIT
#include "host_sim/base/interruption.hpp"

#include "support/catch.hpp"

#include <stdexcept>
#include <thread>

using namespace splinefeed::host;

namespace {

// Steps until the check has been called so often, or for a second.
void step_until(const int& calls, int most) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    while (calls < most && std::chrono::steady_clock::now() < end) {
        Interruption::point();
    }
}

} // namespace

TEST_CASE("a long computation is asked again and again, and ended by what the check throws") {
    Interruption::point(); // nobody asks
    int calls = 0;
    const auto begun = std::chrono::steady_clock::now();
    {
        const Interruption interruption([&calls] {
            if (++calls == 3) {
                throw std::runtime_error("enough");
            }
        });
        REQUIRE_THROWS_AS(step_until(calls, 4), std::runtime_error);
        CHECK(calls == 3);
        CHECK(std::chrono::steady_clock::now() - begun >= 3 * Interruption::period);
    }
    step_until(calls, 4);
    CHECK(calls == 3);
}

TEST_CASE("the innermost interruption of the own thread counts") {
    int outer = 0;
    int inner = 0;
    const Interruption first([&outer] { ++outer; });
    {
        const Interruption second([&inner] { ++inner; });
        step_until(inner, 1);
        std::thread([&inner] { step_until(inner, 2); }).join();
    }
    CHECK(outer == 0);
    CHECK(inner == 1);
    step_until(outer, 1);
    CHECK(outer == 1);
}
