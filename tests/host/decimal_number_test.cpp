// SPDX-License-Identifier: MIT
#include "host_sim/config/decimal_number.hpp"

#include "support/catch.hpp"

#include <random>

using namespace splinefeed;
using namespace splinefeed::host;

TEST_CASE("A Decimal comes back from its double") {
    CHECK(number_of(Decimal{-1'500'000'000}) == -1.5);
    CHECK(decimal_of(0.3) == Decimal{300'000'000});
    CHECK(decimal_of(-2e-10) == Decimal{});
    std::mt19937_64 random(3); // NOLINT: the same numbers each time
    std::uniform_int_distribution<std::int64_t> any(-1'048'576'000'000'000, 1'048'576'000'000'000);
    for (int i = 0; i < 1000; ++i) {
        const Decimal value{any(random)};
        CHECK(decimal_of(number_of(value)) == value);
    }
}
