// SPDX-License-Identifier: MIT
//
// Digits of 32 bits against the compiler's 128 bit arithmetic.
#include "splinefeed/number/digits.hpp"

#include "random_operands.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

void check_reciprocal(std::uint32_t word) {
    if (detail::word_reciprocal(word) != ~std::uint64_t{0} / word - (std::uint64_t{1} << 32)) {
        FAIL_SAMPLE(word);
    }
    if (detail::short_reciprocals[(word >> 22) - 512U] != detail::short_reciprocal(word >> 22)) {
        FAIL_SAMPLE(word);
    }
}

/// Digits of a quotient one after the other.
void check_division(std::uint64_t value, Uint128 numerator) {
    const detail::Divisor by(value);
    if (by.normalised() != value << by.shift() || (by.normalised() >> 63) != 1) {
        FAIL_SAMPLE(value, by.normalised(), by.shift());
    }
    std::uint64_t rest = static_cast<std::uint64_t>(numerator >> 64) % by.normalised();
    for (const auto digit : {static_cast<std::uint32_t>(numerator), static_cast<std::uint32_t>(numerator >> 32), 0U}) {
        const Uint128 part = (static_cast<Uint128>(rest) << 32) | digit;
        const std::uint32_t quotient = by.divide(rest, digit);
        if (quotient != part / by.normalised() || rest != part % by.normalised()) {
            FAIL_SAMPLE(value, static_cast<std::uint64_t>(part >> 32), digit, quotient, rest);
        }
    }
}

} // namespace

TEST_CASE("a product of two words by digits of 16 bits", "[number][digits]") {
    each_pair(edges(), [](std::uint64_t a, std::uint64_t b) {
        const auto x = static_cast<std::uint32_t>(a);
        const auto y = static_cast<std::uint32_t>(b);
        if (detail::product_of_halves(x, y) != static_cast<std::uint64_t>(x) * y) {
            FAIL_SAMPLE(x, y);
        }
    });
    sampled(samples, [&](Operands& random) {
        const auto x = static_cast<std::uint32_t>(random.unsigned64());
        const auto y = static_cast<std::uint32_t>(random.unsigned64());
        if (detail::product_of_halves(x, y) != static_cast<std::uint64_t>(x) * y) {
            FAIL_SAMPLE(x, y);
        }
    });
}

TEST_CASE("reciprocals of words", "[number][digits]") {
    // All of them take half a minute; they were tried once.
    for (std::uint64_t word = std::uint64_t{1} << 31; word < std::uint64_t{1} << 32; word += 977) {
        check_reciprocal(static_cast<std::uint32_t>(word));
    }
    for (const std::uint64_t edge : edges()) {
        check_reciprocal(static_cast<std::uint32_t>(edge) | 0x80000000U);
        check_reciprocal(~static_cast<std::uint32_t>(edge) | 0x80000000U);
    }
    for (std::uint32_t first = 512; first < 1024; ++first) { // where an entry of the table begins and ends
        check_reciprocal(first << 22);
        check_reciprocal((first << 22) | 0x3fffffU);
    }
}

TEST_CASE("digits of quotients", "[number][digits]") {
    for (const std::uint64_t value : edges()) {
        for (const std::uint64_t high : edges()) {
            for (const std::uint64_t low : {std::uint64_t{0}, ~std::uint64_t{0}, high}) {
                if (value != 0) {
                    check_division(value, (static_cast<Uint128>(high) << 64) | low);
                }
            }
        }
    }
    sampled(samples, [&](Operands& random) {
        const std::uint64_t value = random.unsigned64() | 1U;
        check_division(value, (static_cast<Uint128>(random.unsigned64()) << 64) | random.unsigned64());
        // just below a multiple of the divisor
        check_division(value, (static_cast<Uint128>(value << std::countl_zero(value)) << 64) - 1U);
    });
}
