// SPDX-License-Identifier: MIT
//
// Quotients by one divisor against exact arithmetic of 128 bits.
#include "splinefeed/number/division_by.hpp"

#include "random_operands.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

void check_quotient(std::int32_t a, std::int32_t b) {
    if (b <= 0) {
        return;
    }
    const Int128 exact = rounded_quotient(static_cast<Int128>(a) << 30, static_cast<Uint128>(b));
    const std::int32_t actual = (ShortFixed::from_raw(a) / DivisionBy(ShortFixed::from_raw(b))).raw();
    constexpr std::int32_t high = std::numeric_limits<std::int32_t>::max();
    constexpr std::int32_t low = std::numeric_limits<std::int32_t>::min();
    const bool right = exact > high ? actual == high : exact <= -high ? actual <= -high : actual == exact;
    if (!right || (exact < low && actual > -high)) {
        FAIL_SAMPLE(a, b);
    }
}

void check_up(std::int64_t a, std::int32_t b) {
    if (a < 0 || b <= 0) {
        return;
    }
    const Int128 numerator = static_cast<Int128>(a) << 32;
    const Int128 up = (numerator + b - 1) / b;
    const std::int64_t actual = quotient_by_quarter(Fixed::from_raw(a), ShortFixed::from_raw(b)).raw();
    if (actual != clamped(up)) {
        FAIL_SAMPLE(a, b);
    }
}

std::int32_t random_word(Operands& random) {
    return static_cast<std::int32_t>(random.signed_below(31)) >> random.between(0, 20);
}

} // namespace

TEST_CASE("division by a number of one word is rounded to nearest or saturates", "[number][division]") {
    for (int a = -300; a <= 300; ++a) {
        for (int b = 1; b <= 300; ++b) {
            check_quotient(a * 65536, b * 65536);
        }
    }
    Operands random;
    for (int i = 0; i < samples; ++i) {
        const std::int32_t a = random_word(random);
        const std::int32_t b = random_word(random);
        check_quotient(a, b);
        check_quotient(a, std::numeric_limits<std::int32_t>::max() - (b & 15));
        check_quotient(std::numeric_limits<std::int32_t>::min() + (b & 15), a);
    }
}

TEST_CASE("a quotient of Fixed by a quarter of a number of one word is rounded up", "[number][division]") {
    for (const std::int64_t a : signed_edges()) {
        for (unsigned k = 0; k < 31; ++k) {
            for (const int below : {0, 1}) {
                check_up(a, (std::int32_t{1} << k) - below);
                check_up(a, std::numeric_limits<std::int32_t>::max() - (1 << k) + below);
            }
        }
    }
    Operands random;
    for (int i = 0; i < samples; ++i) {
        check_up(random.signed64(), random_word(random));
    }
}

TEST_CASE("a divisor of Fixed gives the quotients that the operator gives", "[number][division]") {
    sampled(samples, [&](Operands& random) {
        const Fixed a = Fixed::from_raw(random.signed64());
        const Fixed b = Fixed::from_raw(std::max<std::int64_t>(1, random.signed64()));
        if ((a / DivisionBy(b)).raw() != detail::quotient(a.raw(), b.raw())) {
            FAIL_SAMPLE(a.raw(), b.raw());
        }
    });
    CHECK(Fixed{3} / DivisionBy<Fixed>() == Fixed{3});
}

TEST_CASE("a number type with quotients of its own divides by them", "[number][division]") {
    CHECK(3.0 / DivisionBy(7.0) == 3.0 / 7.0);
    CHECK(Fixed{3} / DivisionBy(Fixed{7}) == Fixed{3} / Fixed{7});
    CHECK(quotient_by_quarter(3.0, 0.375) == 32.0);
    CHECK(quarter_product(3.0, 0.5) == 0.375);
}
