// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/text/elementary.hpp"

#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <cmath>
#include <random>

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

using Real = long double;
constexpr Real pi = 3.14159265358979323846264338327950288L;

Real real(Decimal value) {
    return static_cast<Real>(value.raw) * 1e-9L;
}

/// Of any size, as many small as large.
Decimal any(std::mt19937_64& random, int bits) {
    const std::uint64_t size = random() >> (64 - 1 - static_cast<int>(random() % static_cast<unsigned>(bits)));
    return {static_cast<std::int64_t>(size) * (random() % 2 == 0 ? 1 : -1)};
}

} // namespace

TEST_CASE("elementary functions against long double", "[program][elementary]") {
    const unsigned seed = random_seed();
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    const Real q62 = std::ldexp(1.0L, -62);
    for (int i = 0; i < rounds(20000); ++i) {
        const Decimal angle = any(random, 56);
        const Real radians = real({angle.raw % 360'000'000'000}) * pi / 180.0L;
        const SineCosine at = sine_cosine(angle);
        REQUIRE(std::fabs(static_cast<Real>(at.sine) * q62 - std::sin(radians)) < 1e-17L);
        REQUIRE(std::fabs(static_cast<Real>(at.cosine) * q62 - std::cos(radians)) < 1e-17L);
        const Decimal x = any(random, 62);
        const Decimal y = any(random, 62);
        CAPTURE(x.raw, y.raw);
        REQUIRE(std::fabs(real(angle_of(x, y)) - std::atan2(real(y), real(x)) * 180.0L / pi) < 1.01e-9L);
        const Decimal positive{x.raw < 0 ? -x.raw : x.raw + 1};
        REQUIRE(std::fabs(real(square_root(positive)) - std::sqrt(real(positive))) < 0.501e-9L);
        REQUIRE(std::fabs(real(logarithm(positive)) - std::log(real(positive))) < 1.01e-9L);
        const Decimal power_of{static_cast<std::int64_t>(random() % 50'000'000'000U) - 27'000'000'000};
        const Real exact = std::exp(real(power_of));
        const ProgramResult<Decimal> exponent = exponential(power_of);
        REQUIRE(exponent.has_value() == (exact < 9223372036.854L));
        if (exponent.has_value()) {
            REQUIRE(std::fabs(real(*exponent) - exact) < 0.6e-9L + exact * 1e-15L);
        }
        REQUIRE(std::fabs(real(hypotenuse({x.raw / 8}, {y.raw / 8})) -
                          std::hypot(real({x.raw / 8}), real({y.raw / 8}))) < 0.55e-9L);
    }
}

TEST_CASE("special angles are exact", "[program][elementary]") {
    constexpr std::int64_t one = std::int64_t{1} << 62;
    for (int turns = -3; turns <= 3; ++turns) {
        const auto at = [&](int degrees) {
            return sine_cosine(Decimal::from_integer(360 * turns + degrees));
        };
        CHECK(at(0).sine == 0);
        CHECK(at(0).cosine == one);
        CHECK(at(90).sine == one);
        CHECK(at(90).cosine == 0);
        CHECK(at(180).cosine == -one);
        CHECK(at(270).sine == -one);
    }
    CHECK(turned(Decimal::from_integer(2), sine_cosine(Decimal::from_integer(30)).sine).raw == Decimal::one);
    CHECK(angle_of({0}, {0}).raw == 0);
    CHECK(angle_of({-1}, {0}).raw == 180 * Decimal::one);
    CHECK(angle_of({0}, {-5}).raw == -90 * Decimal::one);
    CHECK(angle_of({7}, {7}).raw == 45 * Decimal::one);
    CHECK(radians_q32(Decimal::from_integer(180)) == 13493037705); // pi * 2^32
}

TEST_CASE("powers", "[program][elementary]") {
    const auto of = [](int base, int exponent) {
        return power(Decimal::from_integer(base), Decimal::from_integer(exponent));
    };
    CHECK((*of(2, 10)).raw == 1024 * Decimal::one);
    CHECK((*of(-3, 3)).raw == -27 * Decimal::one);
    CHECK((*of(10, 9)).raw == 1'000'000'000 * Decimal::one);
    CHECK((*of(2, -1)).raw == Decimal::one / 2);
    CHECK((*of(0, 0)).raw == Decimal::one);
    CHECK(of(0, -1).error() == ProgramError::division_by_zero);
    CHECK(of(10, 10).error() == ProgramError::result_out_of_range);
    CHECK(power(Decimal::from_integer(-2), {Decimal::one / 2}).error() == ProgramError::power_invalid);
    CHECK(exponential(Decimal::from_integer(-60)).value().raw == 0);
    CHECK(exponential(Decimal::from_integer(1000)).error() == ProgramError::result_out_of_range);
}
