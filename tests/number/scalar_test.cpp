// SPDX-License-Identifier: MIT
//
// The functions every Scalar offers: measured errors against the bounds their comments state.
#include "splinefeed/number/scalar.hpp"

#include "splinefeed/number/vector.hpp"

#include "random_operands.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

/// round(sqrt(n)) in exact integers: (r - 1/2)^2 < n < (r + 1/2)^2
bool is_nearest_root(Uint128 r, Uint128 n) {
    return n <= r * r + r && (n == 0 ? r == 0 : n > r * r - r);
}

/// Random numbers whose squares stay in the range of S.
template <class S>
S random_real(Operands& random) {
    return static_cast<S>(random.real(-40, 40));
}

} // namespace

TEST_CASE("which types are Scalars", "[number][scalar]") {
    static_assert(Scalar<double> && Scalar<float> && Scalar<Fixed>);
    static_assert(!Scalar<int> && !Scalar<long double>);
    REQUIRE(std::strcmp(scalar_name<double>(), "double") == 0);
    REQUIRE(std::strcmp(scalar_name<float>(), "float") == 0);
    REQUIRE(std::strcmp(scalar_name<Fixed>(), "fixed") == 0);
}

// ---- square roots

TEST_CASE("Fixed square roots are the nearest numbers", "[number][scalar]") {
    const auto check = [](std::int64_t raw) {
        const auto root = static_cast<Uint128>(square_root(Fixed::from_raw(raw)).raw());
        if (!is_nearest_root(root, static_cast<Uint128>(raw) << 32)) {
            FAIL_SAMPLE(raw, static_cast<std::uint64_t>(root));
        }
    };
    for (std::int64_t raw = 0; raw < 100'000; ++raw) {
        check(raw);
        check(std::numeric_limits<std::int64_t>::max() - raw);
    }
    sampled(samples, [&](Operands& random) { check(static_cast<std::int64_t>(random.unsigned64() >> 1)); });
    static_assert(square_root(Fixed{144}) == Fixed{12});
}

TEST_CASE("Fixed reciprocal square roots are the nearest numbers", "[number][scalar]") {
    const auto check = [](std::int64_t raw) {
        // |2^48/sqrt(raw) - r| <= 1/2  <=>  (2r-1)^2 raw <= 2^98 <= (2r+1)^2 raw
        const auto r = static_cast<Uint128>(reciprocal_square_root(Fixed::from_raw(raw)).raw());
        const Uint128 target = Uint128{1} << 98;
        if ((2 * r - 1) * (2 * r - 1) * static_cast<Uint128>(raw) > target ||
            (2 * r + 1) * (2 * r + 1) * static_cast<Uint128>(raw) < target) {
            FAIL_SAMPLE(raw, static_cast<std::uint64_t>(r));
        }
    };
    for (std::int64_t raw = 1; raw < 100'000; ++raw) {
        check(raw);
        check(std::numeric_limits<std::int64_t>::max() - raw);
    }
    sampled(samples, [&](Operands& random) { check(static_cast<std::int64_t>((random.unsigned64() >> 1) | 1U)); });
    REQUIRE(reciprocal_square_root(Fixed::resolution()) == Fixed{1 << 16});
    static_assert(reciprocal_square_root(Fixed{4}) == Fixed::from_raw(std::int64_t{1} << 31));
}

TEST_CASE("square roots of float and double are the nearest numbers, with and without the instruction",
          "[number][scalar]") {
    const auto check = [](auto value) {
        const auto expected = std::sqrt(value); // correctly rounded by IEEE 754
        if (square_root(value) != expected || detail::square_root_by_integers(value) != expected) {
            FAIL_SAMPLE(value, square_root(value), detail::square_root_by_integers(value), expected);
        }
    };
    sampled(samples, [&](Operands& random) {
        const std::uint64_t bits = random.bits(); // any exponent, subnormals included
        const auto x = std::bit_cast<double>((bits >> 1) % 0x7ff0000000000000U);
        const auto y = std::bit_cast<float>(static_cast<std::uint32_t>(bits >> 33) % 0x7f800000U);
        check(x);
        check(y);
        check(std::bit_cast<double>(bits >> random.between(12, 63)));
        check(std::bit_cast<float>(static_cast<std::uint32_t>(bits >> random.between(41, 63))));
    });
    for (int k = 0; k < 100'000; ++k) {
        check(static_cast<float>(k) * static_cast<float>(k));
        check(std::nextafter(static_cast<float>(k) * static_cast<float>(k), 1e30F));
        check(1.0F - static_cast<float>(k) * 0x1p-24F); // roots that round up to the next power of two
        check(1.0 - k * 0x1p-53);
    }
    check(std::numeric_limits<float>::max());
    check(std::numeric_limits<double>::max());
    check(std::numeric_limits<float>::infinity());
    static_assert(square_root(2.25) == 1.5 && square_root(2.25F) == 1.5F && square_root(0.0) == 0.0);
}

TEMPLATE_TEST_CASE("reciprocal square roots of float and double", "[number][scalar]", float, double) {
    Operands random;
    double worst = 0;
    for (int i = 0; i < samples / 2; ++i) {
        const TestType x = std::fabs(random_real<TestType>(random));
        worst = std::max(worst, error_in_ulp(reciprocal_square_root(x), 1.0L / std::sqrt(static_cast<long double>(x))));
    }
    CAPTURE(seed, worst);
    REQUIRE(worst < 1.5);
    REQUIRE(worst > 1.4); // the bound is not generous
    REQUIRE(reciprocal_square_root(TestType{16}) == TestType{0.25});
}

// ---- norm

TEST_CASE("Fixed norms are the nearest numbers", "[number][scalar]") {
    sampled(samples, [&](Operands& random) {
        std::array<Fixed, 6> v;
        const int n = random.between(0, 6);
        const int bits = random.between(1, 62);
        Uint128 sum = 0;
        for (int k = 0; k < n; ++k) {
            v[static_cast<std::size_t>(k)] = Fixed::from_raw(random.signed_below(bits));
            const Uint128 size = size_of(v[static_cast<std::size_t>(k)].raw());
            sum += size * size;
        }
        const Fixed length = norm(v, n);
        const bool saturates = sum > (Uint128{1} << 126) - (Uint128{1} << 63); // from (2^63 - 1/2)^2 on
        if (saturates ? length != Fixed::max() : !is_nearest_root(static_cast<Uint128>(length.raw()), sum)) {
            FAIL_SAMPLE(n, v[0].raw(), v[1].raw(), v[2].raw(), v[3].raw(), v[4].raw(), v[5].raw(), length.raw());
        }
    });
}

TEST_CASE("Fixed norms at the limits", "[number][scalar]") {
    constexpr std::int64_t top = (std::int64_t{1} << 62) - 1;
    std::array<Fixed, 6> v;
    v.fill(Fixed::from_raw(-top));
    REQUIRE(norm(v, 0) == Fixed{});
    REQUIRE(norm(v, 1).raw() == top);
    REQUIRE(norm(v, 4).raw() == 2 * top);
    REQUIRE(norm(v, 5) == Fixed::max());
    REQUIRE(norm(v, 6) == Fixed::max());
    v = {Fixed{3}, Fixed{-4}, Fixed{12}, Fixed{}, Fixed{}, Fixed{84}};
    REQUIRE(norm(v, 3) == Fixed{13});
    REQUIRE(norm(v, 6) == Fixed{85});
}

TEMPLATE_TEST_CASE("norms of float and double", "[number][scalar]", float, double) {
    Operands random;
    std::array<double, 7> worst{};
    for (int i = 0; i < samples / 2; ++i) {
        std::array<TestType, 6> v{};
        const int n = random.between(1, 6);
        const int exponent = random.between(-40, 40);
        long double sum = 0;
        for (int k = 0; k < n; ++k) {
            auto& component = v[static_cast<std::size_t>(k)];
            const double size = (random.bits() & 7U) == 0 ? 0.0 : random.real(exponent - 3, exponent);
            component = static_cast<TestType>(size);
            sum += static_cast<long double>(component) * static_cast<long double>(component);
        }
        if (sum > 0) {
            double& most = worst[static_cast<std::size_t>(n)];
            most = std::max(most, error_in_ulp(norm(v, n), std::sqrt(sum)));
        }
    }
    for (int n = 1; n <= 6; ++n) {
        CAPTURE(seed, n, worst[static_cast<std::size_t>(n)]);
        REQUIRE(worst[static_cast<std::size_t>(n)] <= 0.5 * (n + 1));
    }
    REQUIRE(worst[3] > 0.7);
    const std::array<TestType, 3> v{TestType{-3}, TestType{4}, TestType{12}};
    REQUIRE(norm(v, 3) == TestType{13});
    REQUIRE(norm(v, 0) == TestType{0});
}

// ---- exact operations

TEST_CASE("Fixed times a power of two", "[number][scalar]") {
    REQUIRE(scale2(Fixed{3}, 4) == Fixed{48});
    REQUIRE(scale2(Fixed{48}, -4) == Fixed{3});
    REQUIRE(scale2(Fixed::from_raw(3), -1) == Fixed::from_raw(2));
    REQUIRE(scale2(Fixed::from_raw(-3), -1) == Fixed::from_raw(-2));
    REQUIRE(scale2(Fixed::from_raw(5), -2) == Fixed::from_raw(1));
    REQUIRE(scale2(Fixed{-1}, 31) == Fixed::lowest());
    REQUIRE(scale2(Fixed{1}, 31) == Fixed::max());
    REQUIRE(scale2(Fixed{-1}, 32) == Fixed::lowest());
    REQUIRE(scale2(Fixed::max(), -64) == Fixed{});
    REQUIRE(scale2(Fixed::lowest(), -64) == Fixed::from_raw(-1));
    REQUIRE(scale2(Fixed{}, 1000) == Fixed{});
    REQUIRE(scale2(Fixed::max(), std::numeric_limits<int>::min()) == Fixed{});
    REQUIRE(scale2(Fixed::max(), std::numeric_limits<int>::max()) == Fixed::max());
}

TEMPLATE_TEST_CASE("float and double times a power of two", "[number][scalar]", float, double) {
    Operands random;
    for (int exponent = -100; exponent <= 100; ++exponent) {
        for (int i = 0; i < 200; ++i) {
            const auto x = static_cast<TestType>(random.real(-20, 20));
            if (scale2(x, exponent) != std::ldexp(x, exponent)) {
                FAIL_SAMPLE(x, exponent);
            }
        }
    }
}

TEMPLATE_TEST_CASE("absolute value, smaller and larger", "[number][scalar]", float, double, Fixed) {
    const TestType a = from_integer<TestType>(-7);
    const TestType b = from_integer<TestType>(5);
    REQUIRE((absolute(a) == from_integer<TestType>(7)));
    REQUIRE((absolute(b) == b));
    REQUIRE((absolute(TestType{}) == TestType{}));
    REQUIRE((smaller(a, b) == a));
    REQUIRE((smaller(b, a) == a));
    REQUIRE((larger(a, b) == b));
    REQUIRE((larger(b, a) == b));
}

// ---- quotient_or_max

TEST_CASE("Fixed quotients that do not fit are the largest number", "[number][scalar]") {
    sampled(samples, [&](Operands& random) {
        const auto a = static_cast<std::int64_t>(random.unsigned64() >> 1);
        const auto b = static_cast<std::int64_t>(random.unsigned64() >> 1);
        const std::int64_t expected =
            b == 0 ? std::numeric_limits<std::int64_t>::max()
                   : clamped(rounded_quotient(static_cast<Int128>(a) << 32, static_cast<Uint128>(b)));
        if (quotient_or_max(Fixed::from_raw(a), Fixed::from_raw(b)).raw() != expected) {
            FAIL_SAMPLE(a, b);
        }
    });
    REQUIRE(quotient_or_max(Fixed{}, Fixed{}) == Fixed::max());
    REQUIRE(quotient_or_max(Fixed{6}, Fixed{4}) == Fixed::from_double(1.5));
}

TEMPLATE_TEST_CASE("quotients of float and double are never infinite", "[number][scalar]", float, double) {
    using Limits = std::numeric_limits<TestType>;
    using Bits = std::conditional_t<sizeof(TestType) == 4, std::uint32_t, std::uint64_t>;
    Operands random;
    constexpr Bits infinity = std::bit_cast<Bits>(Limits::infinity());
    const auto check = [](TestType a, TestType b) {
        const TestType plain = a / b;
        const TestType expected = plain <= Limits::max() ? plain : Limits::max(); // NaN compares false
        const TestType actual = quotient_or_max(a, b);
        if (actual != expected && !(actual == Limits::max() && expected == std::nextafter(actual, TestType{0}))) {
            FAIL_SAMPLE(a, b, actual, expected);
        }
    };
    for (int i = 0; i < samples; ++i) {
        const auto b = std::bit_cast<TestType>(static_cast<Bits>(static_cast<Bits>(random.bits()) % infinity));
        check(std::bit_cast<TestType>(static_cast<Bits>(static_cast<Bits>(random.bits()) % infinity)), b);
        // dividends next to the limit of overflow
        const TestType limit = b < TestType{1} ? b * Limits::max() : Limits::max();
        check(std::nextafter(limit, TestType{0}), b);
        check(limit, b);
        check(std::min(Limits::max(), std::nextafter(limit, Limits::infinity())), b);
    }
    check(TestType{0}, TestType{0});
    check(TestType{1}, TestType{0});
    check(TestType{1}, Limits::denorm_min());
    check(Limits::max(), Limits::max());
    static_assert(quotient_or_max(TestType{1}, TestType{0}) == Limits::max());
    static_assert(quotient_or_max(TestType{0}, TestType{0}) == Limits::max());
    static_assert(quotient_or_max(TestType{6}, TestType{4}) == TestType{1.5});
}

// ---- conversions

TEMPLATE_TEST_CASE("conversions of whole numbers and constants", "[number][scalar]", float, double, Fixed) {
    sampled(10'000, [&](Operands& random) {
        const auto k = static_cast<std::int32_t>(random.signed_below(24));
        if (to_double(from_integer<TestType>(k)) != k || from_double<TestType>(k) != from_integer<TestType>(k)) {
            FAIL_SAMPLE(k);
        }
    });
    REQUIRE((to_double(from_integer<TestType>(std::numeric_limits<std::int32_t>::min())) == -2147483648.0));
    constexpr TestType eighth = literal<TestType>(0.125);
    static_assert(to_double(eighth) == 0.125);
    REQUIRE((eighth * from_integer<TestType>(8) == from_integer<TestType>(1)));
    REQUIRE((largest<TestType>() > from_integer<TestType>(std::numeric_limits<std::int32_t>::max() - 127)));
}

TEST_CASE("a constant is the nearest number", "[number][scalar]") {
    REQUIRE(literal<double>(0.1) == 0.1);
    REQUIRE(literal<float>(0.1) == 0.1F);
    REQUIRE(literal<Fixed>(0.1).raw() == 429496730); // 429496729.6
    REQUIRE(literal<Fixed>(-0.1).raw() == -429496730);
}
