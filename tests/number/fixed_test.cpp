// SPDX-License-Identifier: MIT
//
// Fixed against exact 128 bit arithmetic: rounding to nearest with ties away from zero, symmetry and saturation.
#include "splinefeed/number/fixed.hpp"

#include "random_operands.hpp"

#include <type_traits>

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr std::int64_t highest = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min();

constexpr Int128 shifted(std::int64_t value, int count) {
    return static_cast<Int128>(value) * (Int128{1} << count);
}

bool matches(detail::Checked result, Int128 exact) {
    return result.raw == clamped(exact) && result.fits == (clamped(exact) == exact);
}

void check_sum(std::int64_t a, std::int64_t b) {
    const Int128 sum = static_cast<Int128>(a) + b;
    const Int128 difference = static_cast<Int128>(a) - b;
    if (!matches(detail::checked_sum(a, b), sum) || !matches(detail::checked_difference(a, b), difference)) {
        FAIL_SAMPLE(a, b);
    }
    if (clamped(sum) == sum && (Fixed::from_raw(a) + Fixed::from_raw(b)).raw() != sum) {
        FAIL_SAMPLE(a, b);
    }
    if (clamped(difference) == difference && (Fixed::from_raw(a) - Fixed::from_raw(b)).raw() != difference) {
        FAIL_SAMPLE(a, b);
    }
}

void check_product(std::int64_t a, std::int64_t b) {
    const Int128 exact = rounded_quotient(static_cast<Int128>(a) * b, Uint128{1} << 32);
    if (!matches(detail::checked_product(a, b), exact)) {
        FAIL_SAMPLE(a, b);
    }
    if (clamped(exact) == exact && (Fixed::from_raw(a) * Fixed::from_raw(b)).raw() != exact) {
        FAIL_SAMPLE(a, b);
    }
}

void check_quotient(std::int64_t a, std::int64_t b) {
    if (b == 0) {
        return;
    }
    const Int128 exact = rounded_quotient(b < 0 ? -shifted(a, 32) : shifted(a, 32), size_of(b));
    if (!matches(detail::checked_quotient(a, b), exact)) {
        FAIL_SAMPLE(a, b);
    }
    if (clamped(exact) == exact && (Fixed::from_raw(a) / Fixed::from_raw(b)).raw() != exact) {
        FAIL_SAMPLE(a, b);
    }
}

} // namespace

TEST_CASE("the range of Fixed", "[number][fixed]") {
    REQUIRE(Fixed{}.raw() == 0);
    REQUIRE(Fixed{3}.raw() == std::int64_t{3} << 32);
    REQUIRE(Fixed{std::numeric_limits<std::int32_t>::min()} == Fixed::lowest());
    REQUIRE(Fixed{std::numeric_limits<std::int32_t>::max()} + (Fixed{1} - Fixed::resolution()) == Fixed::max());
    REQUIRE(Fixed::max().raw() == highest);
    REQUIRE(Fixed::lowest().raw() == lowest);
    REQUIRE(Fixed::resolution().raw() == 1);
    static_assert(Fixed{3} * Fixed{4} == Fixed{12} && Fixed{12} / Fixed{-4} == Fixed{-3});
    static_assert(Fixed{-1} < Fixed{} && Fixed{} < Fixed::resolution() && Fixed{2} >= Fixed{2});
    static_assert(!std::is_constructible_v<Fixed, double> && !std::is_convertible_v<std::int32_t, Fixed>);
}

TEST_CASE("sums are exact or saturate", "[number][fixed]") {
    each_pair(signed_edges(), check_sum);
    sampled(samples, [&](Operands& random) { check_sum(random.signed64(), random.signed64()); });
    REQUIRE(-Fixed{5} == Fixed{-5});
    REQUIRE(-Fixed::max() == Fixed::lowest() + Fixed::resolution());
}

TEST_CASE("products are rounded to nearest or saturate", "[number][fixed]") {
    each_pair(signed_edges(), check_product);
    sampled(samples, [&](Operands& random) {
        check_product(random.signed64(), random.signed64());
        check_product(random.signed_below(48), random.signed_below(47)); // mostly without overflow
    });
}

TEST_CASE("products of small operands: every tie", "[number][fixed]") {
    for (std::int64_t a = -300; a <= 300; ++a) {
        for (std::int64_t b = -300; b <= 300; ++b) {
            check_product(a * (1 << 16), b * (1 << 15)); // a b / 2
            check_product(a * (1 << 16), b * (1 << 14)); // a b / 4
        }
    }
    const Fixed half = Fixed::from_raw(std::int64_t{1} << 31);
    REQUIRE(half * Fixed::from_raw(1) == Fixed::from_raw(1));
    REQUIRE(half * Fixed::from_raw(-1) == Fixed::from_raw(-1));
    REQUIRE(half * Fixed::from_raw(5) == Fixed::from_raw(3));
    REQUIRE(half * Fixed::from_raw(-5) == Fixed::from_raw(-3));
    REQUIRE(Fixed::from_raw((std::int64_t{1} << 31) - 1) * Fixed::from_raw(1) == Fixed{});
}

TEST_CASE("quotients are rounded to nearest or saturate", "[number][fixed]") {
    each_pair(signed_edges(), check_quotient);
    sampled(samples, [&](Operands& random) {
        check_quotient(random.signed64(), random.signed64());
        check_quotient(random.signed_below(50), random.signed_below(48));
    });
}

TEST_CASE("quotients of small operands: every tie", "[number][fixed]") {
    for (std::int64_t a = -200; a <= 200; ++a) {
        for (std::int64_t b = -200; b <= 200; ++b) {
            check_quotient(a, b * (std::int64_t{1} << 32)); // a / b
            check_quotient(a, b * (std::int64_t{1} << 33)); // a / 2b
            check_quotient(a, b);                           // 2^32 a / b
        }
    }
    REQUIRE(Fixed::from_raw(1) / Fixed{2} == Fixed::from_raw(1));
    REQUIRE(Fixed::from_raw(-1) / Fixed{2} == Fixed::from_raw(-1));
    REQUIRE(Fixed::from_raw(1) / Fixed{3} == Fixed{});
}

TEST_CASE("rounding is the same on both sides of zero", "[number][fixed]") {
    sampled(samples / 4, [&](Operands& random) {
        const Fixed a = Fixed::from_raw(random.signed_below(47));
        const Fixed b = Fixed::from_raw(random.signed_below(47));
        if (-a * b != -(a * b) || a * -b != -(a * b)) {
            FAIL_SAMPLE(a.raw(), b.raw());
        }
        if (b != Fixed{} && detail::checked_quotient(a.raw(), b.raw()).fits &&
            (-a / b != -(a / b) || a / -b != -(a / b))) {
            FAIL_SAMPLE(a.raw(), b.raw());
        }
    });
}

TEST_CASE("division by zero is the limit on the side of the numerator", "[number][fixed]") {
    for (const std::int64_t a : signed_edges()) {
        const detail::Checked result = detail::checked_quotient(a, 0);
        REQUIRE(result.raw == (a < 0 ? lowest : highest));
        REQUIRE_FALSE(result.fits);
    }
}

TEST_CASE("assignment operators", "[number][fixed]") {
    Fixed a{7};
    a += Fixed{5};
    REQUIRE(a == Fixed{12});
    a -= Fixed{2};
    REQUIRE(a == Fixed{10});
    a *= Fixed{-3};
    REQUIRE(a == Fixed{-30});
    a /= Fixed{4};
    REQUIRE(a == Fixed::from_double(-7.5));
    REQUIRE(+a == a);
}

#ifdef NDEBUG
TEST_CASE("in a release build the operators saturate", "[number][fixed]") {
    REQUIRE(Fixed::max() + Fixed::resolution() == Fixed::max());
    REQUIRE(Fixed::lowest() - Fixed::resolution() == Fixed::lowest());
    REQUIRE(-Fixed::lowest() == Fixed::max());
    REQUIRE(Fixed{1 << 16} * Fixed{1 << 15} == Fixed::max());
    REQUIRE(Fixed{1 << 16} * Fixed{-(1 << 16)} == Fixed::lowest());
    REQUIRE(Fixed{1 << 16} / Fixed::from_double(1e-6) == Fixed::max());
    REQUIRE(Fixed{-1} / Fixed{} == Fixed::lowest());
    REQUIRE(Fixed::from_double(1e30) == Fixed::max());
    REQUIRE(Fixed::from_double(-1e30) == Fixed::lowest());
    REQUIRE(Fixed::from_double(std::numeric_limits<double>::quiet_NaN()) == Fixed{});
}
#endif

TEST_CASE("which doubles are representable", "[number][fixed]") {
    const double limit = 2147483648.0;
    const double infinity = std::numeric_limits<double>::infinity();
    REQUIRE(Fixed::representable(std::nextafter(limit, 0.0)));
    REQUIRE_FALSE(Fixed::representable(limit));
    REQUIRE(Fixed::representable(-limit));
    REQUIRE_FALSE(Fixed::representable(std::nextafter(-limit, -infinity)));
    REQUIRE_FALSE(Fixed::representable(infinity));
    REQUIRE_FALSE(Fixed::representable(-infinity));
    REQUIRE_FALSE(Fixed::representable(std::numeric_limits<double>::quiet_NaN()));
    REQUIRE(Fixed::from_double(-limit) == Fixed::lowest());
    REQUIRE(Fixed::from_double(std::nextafter(limit, 0.0)).raw() == highest - 1023);
}

TEST_CASE("doubles are rounded to the nearest Fixed, ties away from zero", "[number][fixed]") {
    sampled(samples, [&](Operands& random) {
        // std::round has the same rule, and scaling by 2^32 is exact
        const double value = random.real(-36, 30);
        if (Fixed::from_double(value).raw() != static_cast<std::int64_t>(std::round(value * 4294967296.0))) {
            FAIL_SAMPLE(value);
        }
    });
    for (int k = -1000; k <= 1000; ++k) {
        REQUIRE(Fixed::from_double(std::ldexp(k, -34)).raw() == std::lround(k / 4.0));
    }
}

TEST_CASE("Fixed to double is exact below 2^21 and nearest above", "[number][fixed]") {
    Operands random;
    for (int i = 0; i < samples; ++i) {
        const std::int64_t raw = random.signed64();
        const double value = Fixed::from_raw(raw).to_double();
        if (value != static_cast<double>(std::ldexp(static_cast<long double>(raw), -32))) {
            FAIL_SAMPLE(raw, value);
        }
        if (size_of(raw) < (Uint128{1} << 53) && Fixed::from_double(value).raw() != raw) {
            FAIL_SAMPLE(raw, value);
        }
    }
}

TEST_CASE("shifting by every count", "[number][fixed]") {
    Operands random;
    std::vector<std::int64_t> values = signed_edges();
    for (int i = 0; i < 2000; ++i) {
        values.push_back(random.signed64());
    }
    for (const std::int64_t value : values) {
        for (int exponent = -130; exponent <= 130; ++exponent) {
            const Int128 exact = exponent >= 64   ? ((value > 0) - (value < 0)) * (Int128{1} << 70)
                                 : exponent >= 0  ? shifted(value, exponent)
                                 : exponent > -80 ? rounded_quotient(value, Uint128{1} << -exponent)
                                                  : 0;
            if (!matches(detail::checked_shift(value, exponent), exact)) {
                FAIL_SAMPLE(value, exponent);
            }
        }
    }
}
