// SPDX-License-Identifier: MIT
#include "splinefeed/hal/standstill.hpp"
#include "support/catch.hpp"

#include <cmath>

using splinefeed::hal::Standstill;

namespace {

/// How long until still_us() is 40 ms, for positions of a millisecond each; 0: within a second it is not. [ms]
template <class Position>
std::uint64_t stands_after_ms(std::int64_t window, const Position& position) {
    Standstill standstill(window);
    for (std::uint64_t ms = 1; ms <= 1000; ++ms) {
        standstill.update(1000 * ms, position(ms));
        if (standstill.still_us() >= 40'000) {
            return ms - 1;
        }
    }
    return 0;
}

} // namespace

TEST_CASE("Standstill: what dithers stands, the later the wider it dithers; what creeps does not") {
    const auto dither = [](std::int64_t most) {
        return [most](std::uint64_t ms) {
            return ms % 2 == 0 ? most : -most;
        };
    };
    CHECK(stands_after_ms(4, [](std::uint64_t) { return 7; }) == 40);
    CHECK(stands_after_ms(4, dither(2)) == 40);
    CHECK(stands_after_ms(4, dither(3)) == 80);
    CHECK(stands_after_ms(4, dither(8)) == 160);
    CHECK(stands_after_ms(4, dither(16)) == 320);
    CHECK(stands_after_ms(4, dither(17)) == 0);
    for (const std::int64_t counts_s :
         {-140, 140, 1000, 100'000}) { // 4 counts in 40 ms are 100 a second, and up to one more by rounding
        CHECK(stands_after_ms(4, [&](std::uint64_t ms) {
                  return std::llround(static_cast<double>(counts_s) * 1e-3 * static_cast<double>(ms));
              }) == 0);
    }
}
