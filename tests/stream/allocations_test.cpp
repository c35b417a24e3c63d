// SPDX-License-Identifier: MIT
// What every test that counts allocations relies on.
#include "support/allocations.hpp"
#include "support/catch.hpp"

#include <cstdlib>
#include <string>

TEST_CASE("allocations are counted", "[stream]") {
    const std::size_t before = splinefeed_test::allocations();
    const std::string text(static_cast<std::size_t>(std::rand() % 2) + 1000, 'x'); // not to be optimised away
    const std::size_t after = splinefeed_test::allocations();
    CHECK(text.size() >= 1000);
    CHECK(after > before);
}
