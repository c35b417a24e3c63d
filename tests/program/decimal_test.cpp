// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/text/decimal.hpp"
#include "splinefeed/s0_program/text/decimal_text.hpp"

#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <cmath>
#include <cstdio>
#include <random>
#include <string>

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

Decimal read(const std::string& text, ProgramError expected = ProgramError::none) {
    TextCursor cursor(text);
    Decimal out{-1};
    CAPTURE(text);
    CHECK(read_decimal(cursor, out).error() == expected);
    return out;
}

} // namespace

TEST_CASE("numbers are read exactly", "[program][decimal]") {
    CHECK(read("0").raw == 0);
    CHECK(read("12.5").raw == 12'500'000'000);
    CHECK(read("-.5").raw == -500'000'000);
    CHECK(read("+3.").raw == 3'000'000'000);
    CHECK(read(" 1 2 . 0 0 1 ").raw == 12'001'000'000);
    CHECK(read("0.000000001").raw == 1);
    CHECK(read("0.0000000005").raw == 1);  // the tenth decimal rounds
    CHECK(read("0.00000000049").raw == 0); // and only the tenth
    CHECK(read("-0.9999999995").raw == -1'000'000'000);
    CHECK(read("100000000").raw == 100'000'000 * Decimal::one);
    CHECK(read(std::string(300, '0').append(1, '7')).raw == 7 * Decimal::one);
    CHECK(read(std::string("0.").append(300, '3')).raw == 333'333'333);
    read("", ProgramError::number_invalid);
    read("-", ProgramError::number_invalid);
    read(".", ProgramError::number_invalid);
    read("x", ProgramError::number_invalid);
    read("--1", ProgramError::number_invalid);
    read("100000000.1", ProgramError::number_out_of_range);
    read(std::string(300, '9'), ProgramError::number_out_of_range);
}

TEST_CASE("every decimal of nine digits is read as itself", "[program][decimal]") {
    const unsigned seed = random_seed();
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    for (int i = 0; i < rounds(20000); ++i) {
        const auto raw =
            static_cast<std::int64_t>(random() % (200'000'000ULL * 1'000'000'000ULL)) - 100'000'000LL * 1'000'000'000LL;
        const auto size = static_cast<std::uint64_t>(raw < 0 ? -raw : raw);
        char text[40];
        std::snprintf(text, sizeof text, "%s%llu.%09llu", raw < 0 ? "-" : "",
                      static_cast<unsigned long long>(size / 1'000'000'000U),
                      static_cast<unsigned long long>(size % 1'000'000'000U));
        REQUIRE(read(text).raw == raw);
    }
}

TEST_CASE("decimals become positions rounded once", "[program][decimal]") {
    CHECK(to_position({Decimal::one}).raw == std::int64_t{1} << 40);
    CHECK(to_position({-Decimal::one / 2}).raw == -(std::int64_t{1} << 39));
    const unsigned seed = random_seed();
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    for (int i = 0; i < rounds(20000); ++i) {
        const auto raw = static_cast<std::int64_t>(random() >> (14 + random() % 50)) * (random() % 2 == 0 ? 1 : -1);
        __extension__ using Big = __int128;
        const Big twice = 2 * static_cast<Big>(raw) * (Big{1} << 31); // in halves of 1 / 5^9
        const Big rounded = (twice + (raw < 0 ? -1953125 : 1953125)) / (2 * 1953125);
        REQUIRE(to_position({raw}).raw == static_cast<std::int64_t>(rounded));
        REQUIRE(to_decimal(to_position({raw})).raw == raw);
    }
}

TEST_CASE("decimals become scalars", "[program][decimal]") {
    CHECK(to_scalar<double>(Decimal{1'250'000'000}) == 1.25);
    CHECK(to_scalar<float>(Decimal{1'250'000'000}) == 1.25F);
    CHECK(to_scalar<Fixed>(Decimal{1'250'000'000}).raw() == std::int64_t{5} << 30);
    CHECK(std::fabs(to_scalar<double>(Decimal::from_integer(1000), 60) - 1000.0 / 60.0) < 2e-10);
}

TEST_CASE("integers as RS274 reads them", "[program][decimal]") {
    std::int32_t out = 0;
    CHECK(to_integer({2'000'050'000}, out));
    CHECK(out == 2);
    CHECK(to_integer({-2'999'950'000}, out));
    CHECK(out == -3);
    CHECK(!to_integer({2'000'200'000}, out));
    CHECK(!to_integer({2'500'000'000}, out));
}
