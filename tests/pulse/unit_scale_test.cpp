// SPDX-License-Identifier: MIT
#include "splinefeed/s5_pulse_train/unit_scale.hpp"

#include "random_segments.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

__extension__ using Int128 = __int128;

long double value(const UnitScale& scale) {
    return std::ldexp(static_cast<long double>(scale.mantissa), -scale.shift);
}

} // namespace

TEST_CASE("Ratios have 62 good bits, their products and powers too") {
    const std::uint64_t seed = random_seed();
    CAPTURE(seed);
    RandomSegments random(seed);
    for (int round = 0; round < rounds(5'000); ++round) {
        const auto n = static_cast<std::uint32_t>(random.decades(1.0, 4294967295.0));
        const auto d = static_cast<std::uint32_t>(random.decades(1.0, 4294967295.0));
        CAPTURE(n, d);
        const UnitScale ratio = UnitScale::ratio(n, d);
        REQUIRE(ratio.mantissa >> 63 == 1);
        const long double exact = static_cast<long double>(n) / d;
        REQUIRE(std::fabs(value(ratio) / exact - 1.0L) <= 0x1p-61L);
        const UnitScale square = ratio.times(ratio);
        REQUIRE(square.mantissa >> 63 == 1);
        REQUIRE(std::fabs(value(square) / (exact * exact) - 1.0L) <= 0x1p-60L);
    }
    CHECK(UnitScale::ratio(1, 1).mantissa == std::uint64_t{1} << 63);
    CHECK(UnitScale::ratio(4294967295U, 4294967295U).shift == 63);
}

TEST_CASE("Products with a scale or a fraction are rounded to the nearest, on both sides of zero") {
    const std::uint64_t seed = random_seed();
    CAPTURE(seed);
    RandomSegments random(seed);
    for (int round = 0; round < rounds(5'000); ++round) {
        const auto a = static_cast<std::int64_t>(random.between(-1.0, 1.0) * random.decades(1.0, 0x1p61));
        const std::uint64_t fraction = static_cast<std::uint64_t>(random.between(0.0, 1.0) * 0x1p53) << 11U | 5U;
        const Int128 doubled =
            static_cast<Int128>(a) * static_cast<Int128>(fraction >> 1U) * 2 + (fraction & 1U) * static_cast<Int128>(a);
        const Int128 off = doubled - (static_cast<Int128>(times_q64(a, fraction)) << 64);
        REQUIRE(off <= static_cast<Int128>(1) << 63);
        REQUIRE(off >= -(static_cast<Int128>(1) << 63));
        const UnitScale scale{fraction | std::uint64_t{1} << 63, 64 + random.below(30)};
        const auto product = static_cast<long double>(a) * value(scale);
        REQUIRE(std::fabs(static_cast<long double>(scaled_by(a, scale)) - product) <=
                0.5L + std::fabs(product) * 0x1p-62L);
    }
    CHECK(scaled_by(-3, {std::uint64_t{1} << 63, 64}) == -2);                   // -1.5, ties away from zero
    CHECK(scaled_by(std::int64_t{1} << 62, {std::uint64_t{1} << 63, 61}) == 0); // 2^64, modulo that
}
