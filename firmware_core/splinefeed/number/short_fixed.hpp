// SPDX-License-Identifier: MIT
//
// Fixed-point numbers in one word, for quantities that are known to be small: a product costs a quarter of one of Fixed.
#pragma once

#include "splinefeed/number/fixed.hpp"
#include "splinefeed/number/wide_root.hpp"

namespace splinefeed {

namespace detail {

/// a * b, exact.
[[nodiscard]] constexpr std::int64_t signed_product(std::int32_t a, std::int32_t b) noexcept {
#ifdef SPLINEFEED_SHORT_PRODUCTS
    const auto a0 = static_cast<std::uint32_t>(a);
    const auto b0 = static_cast<std::uint32_t>(b);
    // A negative word was taken for one larger by 2^32.
    const std::uint32_t excess = (b0 & static_cast<std::uint32_t>(a >> 31)) + (a0 & static_cast<std::uint32_t>(b >> 31));
    return static_cast<std::int64_t>(product_of_halves(a0, b0) - (static_cast<std::uint64_t>(excess) << 32));
#else
    return static_cast<std::int64_t>(a) * b;
#endif
}

/// The nearest word.
[[nodiscard]] constexpr std::int32_t saturated_word(std::int64_t value) noexcept {
    const auto word = static_cast<std::int32_t>(lower_word(value));
    const std::int32_t upper = upper_word(value);
    return upper == word >> 31 ? word : (upper >> 31) ^ std::numeric_limits<std::int32_t>::max();
}

/// value / 2^count rounded to nearest, ties away from zero, 1 <= count <= 63; |value| <= 2^62.
[[nodiscard, gnu::always_inline]] constexpr std::int64_t rounded_down(std::int64_t value, int count) noexcept {
    return (value + (std::int64_t{1} << (count - 1)) + (value >> 63)) >> count;
}

/// value * 2^exponent rounded to nearest, ties away from zero, as the nearest word. Any exponent is allowed.
[[nodiscard, gnu::always_inline]] constexpr std::int32_t word_of(std::int64_t value, int exponent) noexcept {
    return saturated_word(shifted(value, exponent));
}

} // namespace detail

/// The number raw * 2^-30, from -2 to 2 - 2^-30. One ulp is 2^-30, about 9.3e-10.
///
/// Sums are exact; products and quotients are rounded to nearest, ties away from zero: error <= 1/2 ulp. Unlike Fixed it
/// may overflow: the result is then the largest or lowest number, depending on the sign.
class ShortFixed {
public:
    static constexpr int fraction_bits = 30;

    /// Zero.
    constexpr ShortFixed() noexcept = default;

    [[nodiscard, gnu::always_inline]] static constexpr ShortFixed from_raw(std::int32_t raw) noexcept {
        ShortFixed result;
        result.raw_ = raw;
        return result;
    }

    [[nodiscard, gnu::always_inline]] constexpr std::int32_t raw() const noexcept { return raw_; }

    [[nodiscard]] static constexpr ShortFixed max() noexcept {
        return from_raw(std::numeric_limits<std::int32_t>::max());
    }

    [[nodiscard]] static constexpr ShortFixed lowest() noexcept {
        return from_raw(std::numeric_limits<std::int32_t>::min());
    }

    /// The nearest one, ties away from zero.
    [[nodiscard]] static constexpr ShortFixed from_double(double value) noexcept {
        const double scaled = value * static_cast<double>(std::int64_t{1} << fraction_bits);
        if (!(scaled > -2147483648.0 && scaled < 2147483647.0)) {
            return scaled > 0.0 ? max() : scaled < 0.0 ? lowest() : ShortFixed{};
        }
        return from_raw(static_cast<std::int32_t>(scaled < 0.0 ? scaled - 0.5 : scaled + 0.5));
    }

    [[nodiscard]] constexpr double to_double() const noexcept {
        return static_cast<double>(raw_) / static_cast<double>(std::int64_t{1} << fraction_bits);
    }

    [[nodiscard, gnu::always_inline]] constexpr ShortFixed operator-() const noexcept {
        return ShortFixed{} - *this;
    }

    [[nodiscard, gnu::always_inline]] friend constexpr ShortFixed operator+(ShortFixed a, ShortFixed b) noexcept {
        std::int32_t sum = 0;
        return __builtin_add_overflow(a.raw_, b.raw_, &sum) ? limit(a) : from_raw(sum);
    }

    [[nodiscard, gnu::always_inline]] friend constexpr ShortFixed operator-(ShortFixed a, ShortFixed b) noexcept {
        std::int32_t difference = 0;
        // From zero, only the lowest number overflows, and upwards.
        return __builtin_sub_overflow(a.raw_, b.raw_, &difference) ? limit(a) : from_raw(difference);
    }

    /// Cost: one 32x32->64 multiply.
    [[nodiscard, gnu::always_inline]] friend constexpr ShortFixed operator*(ShortFixed a, ShortFixed b) noexcept {
        return from_raw(detail::saturated_word(detail::rounded_down(detail::signed_product(a.raw_, b.raw_), fraction_bits)));
    }

    [[gnu::always_inline]] constexpr ShortFixed& operator+=(ShortFixed other) noexcept { return *this = *this + other; }

    [[nodiscard]] friend constexpr bool operator==(ShortFixed a, ShortFixed b) noexcept = default;
    [[nodiscard]] friend constexpr auto operator<=>(ShortFixed a, ShortFixed b) noexcept = default;

private:
    [[nodiscard, gnu::always_inline]] static constexpr ShortFixed limit(ShortFixed side) noexcept {
        return side.raw_ < 0 ? lowest() : max();
    }

    std::int32_t raw_ = 0;
};

/// a * b rounded to nearest, halves up; within 4 of the limits of Fixed it may saturate. Cost: two 32x32->64 multiplies.
[[nodiscard]] constexpr Fixed operator*(Fixed a, ShortFixed b) noexcept {
    constexpr int bits = ShortFixed::fraction_bits;
    const std::uint32_t lower = detail::lower_word(a.raw());
    const auto word = static_cast<std::uint32_t>(b.raw());
    // With the sign of b: its word was taken for one larger by 2^32.
    const auto product = static_cast<std::int64_t>(
        detail::long_product(lower, word) -
        (static_cast<std::uint64_t>(lower & static_cast<std::uint32_t>(b.raw() >> 31)) << 32));
    return Fixed::from_raw(
        detail::sum(detail::shifted(detail::signed_product(detail::upper_word(a.raw()), b.raw()), 32 - bits),
                    (product + (std::int64_t{1} << (bits - 1))) >> bits));
}

/// factor * x, exact; saturates.
[[nodiscard, gnu::always_inline]] constexpr ShortFixed times(int factor, ShortFixed x) noexcept {
    return ShortFixed::from_raw(detail::saturated_word(detail::signed_product(factor, x.raw())));
}

/// x * 2^exponent rounded to nearest, ties away from zero; saturates.
[[nodiscard, gnu::always_inline]] constexpr ShortFixed scale2(ShortFixed x, int exponent) noexcept {
    return ShortFixed::from_raw(detail::word_of(x.raw(), exponent));
}

[[nodiscard]] constexpr ShortFixed absolute(ShortFixed x) noexcept {
    return x.raw() < 0 ? -x : x;
}

/// Length of the vector v[0] ... v[n-1], 0 <= n <= 6, rounded to nearest; saturates. Cost: a multiply per component and
/// a root of 64 bits.
[[nodiscard]] constexpr ShortFixed norm(const ShortFixed* v, int n) noexcept {
    std::uint64_t sum = 0;
    for (int i = 0; i < n; ++i) {
        sum += static_cast<std::uint64_t>(detail::signed_product(v[i].raw(), v[i].raw()));
        if ((sum >> 62) != 0) {
            return ShortFixed::max(); // a root of 2^31 at least
        }
    }
    return ShortFixed::from_raw(detail::saturated_word(static_cast<std::int64_t>(square_root_rounded(sum))));
}

} // namespace splinefeed
