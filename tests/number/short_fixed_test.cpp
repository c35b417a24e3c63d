// SPDX-License-Identifier: MIT
//
// Numbers of one word against exact arithmetic of 128 bits.
#include "splinefeed/number/short_fixed.hpp"

#include "random_operands.hpp"

#include "splinefeed/number/scalar.hpp"
#include "splinefeed/number/vector.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

std::int32_t nearest_word(Int128 value) {
    constexpr std::int32_t low = std::numeric_limits<std::int32_t>::min();
    constexpr std::int32_t high = std::numeric_limits<std::int32_t>::max();
    return value < low ? low : value > high ? high : static_cast<std::int32_t>(value);
}

void check_pair(std::int32_t a, std::int32_t b) {
    const ShortFixed x = ShortFixed::from_raw(a);
    const ShortFixed y = ShortFixed::from_raw(b);
    const Int128 product = static_cast<Int128>(a) * b;
    if ((x + y).raw() != nearest_word(static_cast<Int128>(a) + b) ||
        (x - y).raw() != nearest_word(static_cast<Int128>(a) - b) ||
        (x * y).raw() != nearest_word(rounded_quotient(product, Uint128{1} << 30)) ||
        times(a, y).raw() != nearest_word(product) || detail::signed_product_of_halves(a, b) != product ||
        (x < y) != (a < b)) {
        FAIL_SAMPLE(a, b);
    }
}

void check_mean(std::int32_t a, std::int32_t b) {
    const std::int64_t sum = std::int64_t{a} + b;
    const std::int64_t twice = 2 * std::int64_t{mean(ShortFixed::from_raw(a), ShortFixed::from_raw(b)).raw()};
    const bool tie = sum % 2 != 0;
    if (sum == nearest_word(sum) && (tie ? twice % 4 != 0 || (twice != sum - 1 && twice != sum + 1) : twice != sum)) {
        FAIL_SAMPLE(a, b);
    }
}

void check_long_product(std::int64_t value, std::int32_t word) {
    const Int128 nearest = (static_cast<Int128>(value) * word + (Int128{1} << 29)) >> 30;
    const Int128 quarter = (static_cast<Int128>(value) * word) >> 32;
    if (quarter_product(Fixed::from_raw(value), ShortFixed::from_raw(word)).raw() != quarter) {
        FAIL_SAMPLE(value, word);
    }
    const Int128 error = (Fixed::from_raw(value) * ShortFixed::from_raw(word)).raw() - clamped(nearest);
    const bool near_limit = size_of(nearest) > (Uint128{1} << 63) - (Uint128{1} << 34);
    if (size_of(error) > (near_limit ? Uint128{1} << 34 : 0)) {
        FAIL_SAMPLE(value, word);
    }
}

std::vector<std::int32_t> word_edges() {
    std::vector<std::int32_t> words{0, std::numeric_limits<std::int32_t>::max()};
    for (unsigned k = 0; k < 32; ++k) {
        for (const std::uint32_t word : {(1U << k) - 1U, 1U << k, (1U << k) + 1U}) {
            words.push_back(static_cast<std::int32_t>(word));
            words.push_back(static_cast<std::int32_t>(0U - word));
        }
    }
    return words;
}

std::int32_t random_word(Operands& random) {
    return static_cast<std::int32_t>(random.signed_below(31)) >> random.between(0, 12);
}

} // namespace

TEST_CASE("numbers of one word: sums, products, multiples and means are exact, nearest or saturated",
          "[number][short]") {
    each_pair(word_edges(), [](std::int32_t a, std::int32_t b) {
        check_pair(a, b);
        check_mean(a, b);
    });
    Operands random;
    for (int i = 0; i < samples; ++i) {
        const std::int32_t a = random_word(random);
        const std::int32_t b = random_word(random);
        check_pair(a, b);
        check_mean(a, b);
    }
}

TEST_CASE("numbers of one word: a product with Fixed is the nearest or saturates", "[number][short]") {
    for (const std::int64_t value : signed_edges()) {
        for (const std::int32_t word : word_edges()) {
            check_long_product(value, word);
        }
    }
    Operands random;
    for (int i = 0; i < samples; ++i) {
        check_long_product(random.signed64(), random_word(random));
    }
}

TEST_CASE("numbers of one word: conversions are rounded to nearest or saturate", "[number][short]") {
    sampled(samples, [&](Operands& random) {
        const Fixed x = Fixed::from_raw(random.signed64());
        const int log2 = random.between(-40, 40);
        const int exponent = log2 - 2; // from 32 to 30 bits
        const Int128 exact = exponent >= 0 ? static_cast<Int128>(x.raw()) * (Int128{1} << exponent)
                                           : rounded_quotient(x.raw(), Uint128{1} << -exponent);
        const std::int32_t word = shortened<ShortFixed>(x, log2).raw();
        const Fixed back = lengthened<Fixed>(ShortFixed::from_raw(word), 5);
        const bool fits = log2 >= -29 && log2 <= 29 && exact == nearest_word(exact);
        if (fits && shortened_to_fit<ShortFixed>(x, log2).raw() != word) {
            FAIL_SAMPLE(x.raw(), log2);
        }
        if (word != nearest_word(exact) || back.raw() != std::int64_t{word} * 128) {
            FAIL_SAMPLE(x.raw(), log2);
        }
    });
    STATIC_REQUIRE(std::same_as<Ratio<Fixed>, ShortFixed>);
    STATIC_REQUIRE(std::same_as<Ratio<float>, float>);
    STATIC_REQUIRE(literal<ShortFixed>(0.75).raw() == 3 << 28);
    STATIC_REQUIRE(from_integer<ShortFixed>(-1).raw() == -(1 << 30));
    STATIC_REQUIRE(from_integer<ShortFixed>(7) == ShortFixed::max());
    REQUIRE(ShortFixed::from_double(5.0) == ShortFixed::max());
    REQUIRE(ShortFixed::from_double(-5.0) == ShortFixed::lowest());
    REQUIRE(-ShortFixed::lowest() == ShortFixed::max());
    REQUIRE(absolute(literal<ShortFixed>(-0.5)) == literal<ShortFixed>(0.5));
    REQUIRE(half(ShortFixed::from_raw(-3)) == ShortFixed::from_raw(-2));
}

TEST_CASE("a small multiple of Fixed is exact or saturates", "[number][short]") {
    Operands random;
    for (int i = 0; i < samples; ++i) {
        const std::int64_t raw = random.signed64();
        const int factor = random.between(-20000, 20000);
        if (times(factor, Fixed::from_raw(raw)).raw() != clamped(static_cast<Int128>(raw) * factor)) {
            FAIL_SAMPLE(raw, factor);
        }
    }
}

TEST_CASE("numbers of one word: the length of a vector is the nearest or saturates", "[number][short]") {
    Operands random;
    for (int i = 0; i < samples; ++i) {
        std::array<ShortFixed, 6> v{};
        const int n = random.between(0, 6);
        Uint128 sum = 0;
        const int shorter = random.between(0, 30);
        for (const unsigned k : indices(n)) {
            v[k] = ShortFixed::from_raw(random_word(random) >> shorter);
            sum += size_of(static_cast<Int128>(v[k].raw()) * v[k].raw());
        }
        // The nearest r: (r - 1/2)^2 < sum < (r + 1/2)^2.
        const auto r = static_cast<Uint128>(norm(v, n).raw());
        const bool saturated = r == 0x7fff'ffffU && sum > r * r;
        if ((r > 0 && (2 * r - 1) * (2 * r - 1) > 4 * sum) || (!saturated && (2 * r + 1) * (2 * r + 1) < 4 * sum)) {
            FAIL_SAMPLE(i, n);
        }
    }
    const std::array<ShortFixed, 6> longest{ShortFixed::lowest(), ShortFixed::lowest(), ShortFixed::lowest(),
                                            ShortFixed::lowest(), ShortFixed::lowest(), ShortFixed::lowest()};
    REQUIRE(norm(longest, 6) == ShortFixed::max());
}
