// SPDX-License-Identifier: MIT
//
// 128 bit arithmetic against the compiler's, at every power of two and for millions of random operands.
#include "splinefeed/number/wide.hpp"
#include "splinefeed/number/wide_root.hpp"

#include "random_operands.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

Uint128 value_of(Wide a) {
    return (static_cast<Uint128>(a.high) << 64) | a.low;
}

Wide wide_of(Uint128 value) {
    return {static_cast<std::uint64_t>(value >> 64), static_cast<std::uint64_t>(value)};
}

void check_multiply(std::uint64_t a, std::uint64_t b) {
    const Uint128 product = static_cast<Uint128>(a) * b;
    if (value_of(multiply(a, b)) != product || value_of(detail::multiply_digits(a, b)) != product) {
        FAIL_SAMPLE(a, b);
    }
}

void check_sums(Wide a, Wide b) {
    if (value_of(add(a, b)) != value_of(a) + value_of(b) || value_of(subtract(a, b)) != value_of(a) - value_of(b) ||
        (a < b) != (value_of(a) < value_of(b)) || (a == b) != (value_of(a) == value_of(b))) {
        FAIL_SAMPLE(a.high, a.low, b.high, b.low);
    }
}

void check_divide(Wide numerator, std::uint64_t denominator) {
    const auto check = [&](const WideQuotient& result) {
        if (result.quotient != value_of(numerator) / denominator ||
            result.remainder != value_of(numerator) % denominator) {
            FAIL_SAMPLE(numerator.high, numerator.low, denominator, result.quotient, result.remainder);
        }
    };
    check(divide(numerator, denominator));
    if (numerator.high != 0) {
        check(detail::divide_digits(numerator, denominator));
    }
}

void check_root(Wide a) {
    const Uint128 n = value_of(a);
    const std::uint64_t root = square_root(a);
    // n - r^2 in 0 ... 2r, without forming (r+1)^2, which may need 129 bits
    const Uint128 square = static_cast<Uint128>(root) * root;
    if (square > n || n - square > 2 * static_cast<Uint128>(root)) {
        FAIL_SAMPLE(a.high, a.low, root);
    }
    if ((a.high >> 63) != 0) {
        return;
    }
    // (r - 1/2)^2 < n < (r + 1/2)^2 in integers
    const Uint128 nearest = square_root_rounded(a);
    if (n > nearest * nearest + nearest || (n != 0 && n <= nearest * nearest - nearest)) {
        FAIL_SAMPLE(a.high, a.low, static_cast<std::uint64_t>(nearest));
    }
}

/// The squares of k and its neighbours, where the floor and the rounding change.
void check_roots_at_square(std::uint64_t k) {
    const Uint128 square = static_cast<Uint128>(k) * k;
    for (int offset = -2; offset <= 2; ++offset) {
        check_root(wide_of(square + static_cast<Uint128>(static_cast<Int128>(offset))));
        check_root(wide_of(square + k + static_cast<Uint128>(static_cast<Int128>(offset))));
    }
    check_root(wide_of(square + 2 * static_cast<Uint128>(k)));
}

} // namespace

TEST_CASE("a product has all 128 bits", "[number][wide]") {
    each_pair(edges(), check_multiply);
    sampled(samples, [&](Operands& random) { check_multiply(random.unsigned64(), random.unsigned64()); });
    static_assert(multiply(~0ULL, ~0ULL) == Wide{~0ULL - 1U, 1U});
    static_assert(detail::multiply_digits(~0ULL, ~0ULL) == Wide{~0ULL - 1U, 1U});
}

TEST_CASE("sums, differences and comparisons carry between the halves", "[number][wide]") {
    each_pair(edges(), [](std::uint64_t a, std::uint64_t b) {
        check_sums({a, b}, {b, a});
        check_sums({1U, a}, {0U, b});
        check_sums({a, b}, {a, b});
    });
    sampled(samples, [&](Operands& random) {
        const Wide a{random.unsigned64(), random.unsigned64()};
        check_sums(a, {(random.bits() & 3U) == 0 ? a.high : random.unsigned64(), random.unsigned64()});
    });
}

TEST_CASE("every shift of every bit", "[number][wide]") {
    for (int count = 0; count <= 140; ++count) {
        for (int bit = 0; bit < 128; ++bit) {
            const Uint128 one = Uint128{1} << bit;
            for (const Uint128 value : {one, ~one, one - 1U}) {
                const Uint128 left = count < 128 ? value << count : 0U;
                const Uint128 right = count < 128 ? value >> count : 0U;
                if (value_of(shift_left(wide_of(value), count)) != left ||
                    value_of(shift_right(wide_of(value), count)) != right) {
                    FAIL_SAMPLE(count, bit);
                }
            }
        }
    }
    for (int bit = 0; bit < 128; ++bit) {
        const Uint128 one = Uint128{1} << bit;
        REQUIRE(leading_zeros(wide_of(one)) == 127 - bit);
        REQUIRE(leading_zeros(wide_of(one | (one - 1U))) == 127 - bit);
    }
    REQUIRE(leading_zeros(Wide{}) == 128);
}

TEST_CASE("quotient and remainder are exact", "[number][wide]") {
    for (const std::uint64_t denominator : edges()) {
        for (const std::uint64_t a : edges()) {
            for (const std::uint64_t b : edges()) {
                if (denominator != 0) {
                    check_divide({a % denominator, b}, denominator);
                }
            }
        }
    }
    Operands random;
    for (int i = 0; i < samples; ++i) {
        const std::uint64_t denominator = random.unsigned64();
        if (denominator != 0) {
            check_divide({random.unsigned64() % denominator, random.unsigned64()}, denominator);
            check_divide({denominator - 1U, random.unsigned64()}, denominator);
        }
    }
}

TEST_CASE("quotient digits whose estimate is one and two too large", "[number][wide]") {
    // A small leading and a large second denominator digit make the estimate from the leading digit worst.
    sampled(samples, [&](Operands& random) {
        const std::uint64_t denominator = (random.bits() & 0x80000003ffffffffU) | 0x80000000fffff000U;
        const std::uint64_t high = denominator - 1U - (random.bits() & 0xfffU);
        check_divide({high, random.unsigned64()}, denominator);
        check_divide({high >> 32, random.unsigned64()}, denominator >> random.between(0, 31));
    });
}

#ifdef NDEBUG
TEST_CASE("a quotient that does not fit is the largest one", "[number][wide]") {
    REQUIRE(divide({5U, 0U}, 5U).quotient == ~std::uint64_t{0});
    REQUIRE(divide({0U, 1U}, 0U).quotient == ~std::uint64_t{0});
}
#endif

TEST_CASE("square roots of all small numbers", "[number][wide]") {
    std::uint64_t root = 0;
    for (std::uint64_t n = 0; n < 300'000; ++n) {
        root += (root + 1U) * (root + 1U) <= n ? 1U : 0U;
        if (square_root(Wide{0U, n}) != root) {
            FAIL_SAMPLE(n, root);
        }
        check_root({0U, n});
    }
}

TEST_CASE("square roots next to squares", "[number][wide]") {
    for (const std::uint64_t a : edges()) {
        if (a > 1) {
            check_roots_at_square(a);
        }
        for (const std::uint64_t b : edges()) {
            check_root({a, b});
        }
    }
    sampled(samples / 8, [&](Operands& random) {
        check_roots_at_square(random.unsigned64() | 2U);
        // The lower half of the root all ones or zeros: the corrections of the last digit
        check_roots_at_square((random.bits() << 32) | 0xffffffffU);
        check_roots_at_square((random.bits() << 32) | 2U);
    });
    static_assert(square_root(Wide{~0ULL, ~0ULL}) == ~0ULL);
    static_assert(square_root_rounded(Wide{0U, 6U}) == 2U && square_root_rounded(Wide{0U, 7U}) == 3U);
}

TEST_CASE("square roots of random numbers", "[number][wide]") {
    sampled(samples, [&](Operands& random) { check_root({random.unsigned64(), random.unsigned64()}); });
}

TEST_CASE("the root of the upper half is exact over the whole table", "[number][wide]") {
    // Both ends and the squares of each of 49152 intervals: the corrections by one in both directions are needed here.
    for (std::uint64_t leading = 0x4000; leading < 0x10000; ++leading) {
        for (const std::uint64_t rest : {std::uint64_t{0}, ~std::uint64_t{0} >> 16}) {
            const std::uint64_t n = (leading << 48) | rest;
            const std::uint64_t root = detail::normalised_root(n);
            for (const std::uint64_t m : {n, root * root, root * root - (root > 0x80000000U ? 1U : 0U)}) {
                const std::uint64_t r = detail::normalised_root(m);
                if (r > 0xffffffffU || r * r > m || m - r * r > 2 * r) {
                    FAIL_SAMPLE(m, r);
                }
            }
        }
    }
}
