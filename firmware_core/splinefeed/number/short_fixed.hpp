// SPDX-License-Identifier: MIT
//
// Fixed-point numbers in one word, for quantities that are known to be small: a product costs a quarter of one of
// Fixed.
#pragma once

#include "splinefeed/number/fixed.hpp"
#include "splinefeed/number/wide_root.hpp"

namespace splinefeed {

namespace detail {

/// a * b by digits of 16 bits, of which the upper ones are signed.
[[nodiscard]] constexpr std::int64_t signed_product_of_halves(std::int32_t a, std::int32_t b) noexcept {
    const std::uint32_t a0 = static_cast<std::uint32_t>(a) & 0xffffU;
    const std::uint32_t b0 = static_cast<std::uint32_t>(b) & 0xffffU;
    const std::int32_t a1 = a >> 16;
    const std::int32_t b1 = b >> 16;
    // An upper digit is at most 2^15 - 1: its product leaves room for one more lower digit.
    const std::uint32_t bottom = a0 * b0;
    const std::int32_t middle = a1 * static_cast<std::int32_t>(b0) + static_cast<std::int32_t>(bottom >> 16);
    const std::int32_t cross = static_cast<std::int32_t>(a0) * b1 + (middle & 0xffff);
    const std::int32_t top = a1 * b1 + (middle >> 16) + (cross >> 16);
    return static_cast<std::int64_t>((static_cast<std::uint64_t>(static_cast<std::uint32_t>(top)) << 32) |
                                     ((static_cast<std::uint32_t>(cross) << 16) | (bottom & 0xffffU)));
}

/// a * b, exact.
[[nodiscard]] constexpr std::int64_t signed_product(std::int32_t a, std::int32_t b) noexcept {
#ifdef SPLINEFEED_SHORT_PRODUCTS
    return signed_product_of_halves(a, b);
#else
    return static_cast<std::int64_t>(a) * b;
#endif
}

/// The nearest word.
[[nodiscard, gnu::always_inline]] constexpr std::int32_t saturated_word(std::int64_t value) noexcept {
    const auto word = static_cast<std::int32_t>(lower_word(value));
    const std::int32_t upper = upper_word(value);
    return upper == word >> 31 ? word : (upper >> 31) ^ std::numeric_limits<std::int32_t>::max();
}

/// value / 2^count rounded to nearest, ties away from zero, 1 <= count <= 63; |value| <= 2^62.
[[nodiscard, gnu::always_inline]] constexpr std::int64_t rounded_down(std::int64_t value, int count) noexcept {
    return (value + (std::int64_t{1} << (count - 1)) + (value >> 63)) >> count;
}

/// word / 2^count rounded to nearest, ties away from zero, 1 <= count <= 31.
[[nodiscard, gnu::always_inline]] constexpr std::int32_t halved_word(std::int32_t word, int count) noexcept {
    const std::uint32_t lost = static_cast<std::uint32_t>(word) & ((1U << count) - 1U);
    // Less by one last bit for negative values: a tie is rounded down.
    const std::uint32_t up = (lost + (1U << (count - 1)) + static_cast<std::uint32_t>(word >> 31)) >> count;
    return (word >> count) + static_cast<std::int32_t>(up);
}

/// a * b / 2^count rounded to nearest, ties away from zero, as the nearest word, 1 <= count <= 63.
#ifdef SPLINEFEED_SHORT_PRODUCTS
[[gnu::noinline]]
#else
[[gnu::always_inline]]
#endif
[[nodiscard]] constexpr std::int32_t
rounded_product(std::int32_t a, std::int32_t b, int count) noexcept {
    return saturated_word(rounded_down(signed_product(a, b), count));
}

/// value * 2^exponent rounded to nearest, ties away from zero, exponent >= -31. @pre it fits
[[nodiscard, gnu::always_inline]] constexpr std::int32_t fitting_word(std::int64_t value, int exponent) noexcept {
    return static_cast<std::int32_t>(exponent >= 0 ? lower_word(value) << exponent
                                                   : lower_word(halved(value, -exponent)));
}

/// value * word / 2^32 rounded down. It always fits.
[[nodiscard]] constexpr std::int64_t word_product(std::int64_t value, std::int32_t word) noexcept {
#ifdef __SIZEOF_INT128__
    __extension__ using Signed = __int128;
    return static_cast<std::int64_t>((static_cast<Signed>(value) * word) >> 32);
#else
    const std::uint32_t lower = lower_word(value);
    // With the sign of the word, which was taken for one larger by 2^32.
    const std::uint32_t below =
        static_cast<std::uint32_t>(long_product(lower, static_cast<std::uint32_t>(word)) >> 32) -
        (lower & static_cast<std::uint32_t>(word >> 31));
    return signed_product(upper_word(value), word) + static_cast<std::int32_t>(below);
#endif
}

/// value * 2^exponent rounded to nearest, ties away from zero, as the nearest word. Any exponent is allowed.
[[nodiscard, gnu::always_inline]] constexpr std::int32_t word_of(std::int64_t value, int exponent) noexcept {
    return saturated_word(shifted(value, exponent));
}

} // namespace detail

/// The number raw * 2^-30, from -2 to 2 - 2^-30. One ulp is 2^-30, about 9.3e-10.
///
/// Sums are exact; products and quotients are rounded to nearest, ties away from zero: error <= 1/2 ulp. Unlike Fixed
/// it may overflow: the result is then the largest or lowest number, depending on the sign.
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

    [[nodiscard, gnu::always_inline]] constexpr ShortFixed operator-() const noexcept { return ShortFixed{} - *this; }

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
        return from_raw(detail::rounded_product(a.raw_, b.raw_, fraction_bits));
    }

    [[gnu::always_inline]] constexpr ShortFixed& operator+=(ShortFixed other) noexcept { return *this = *this + other; }

    [[nodiscard]] friend constexpr bool operator==(ShortFixed a, ShortFixed b) noexcept = default;
    // One by one, as of Fixed.
    [[nodiscard]] friend constexpr bool operator<(ShortFixed a, ShortFixed b) noexcept { return a.raw_ < b.raw_; }
    [[nodiscard]] friend constexpr bool operator>(ShortFixed a, ShortFixed b) noexcept { return a.raw_ > b.raw_; }
    [[nodiscard]] friend constexpr bool operator<=(ShortFixed a, ShortFixed b) noexcept { return a.raw_ <= b.raw_; }
    [[nodiscard]] friend constexpr bool operator>=(ShortFixed a, ShortFixed b) noexcept { return a.raw_ >= b.raw_; }

private:
    [[nodiscard, gnu::always_inline]] static constexpr ShortFixed limit(ShortFixed side) noexcept {
        return side.raw_ < 0 ? lowest() : max();
    }

    std::int32_t raw_ = 0;
};

/// a * b rounded to nearest, halves up; within 4 of the limits of Fixed it may saturate. Cost: two 32x32->64
/// multiplies.
[[nodiscard]] constexpr Fixed operator*(Fixed a, ShortFixed b) noexcept {
    constexpr int bits = ShortFixed::fraction_bits;
    const std::uint32_t lower = detail::lower_word(a.raw());
    // With the sign of b: its word was taken for one larger by 2^32.
    const auto below = static_cast<std::int64_t>(
        detail::long_product(lower, static_cast<std::uint32_t>(b.raw())) -
        (static_cast<std::uint64_t>(lower & static_cast<std::uint32_t>(b.raw() >> 31)) << 32));
    const std::int64_t above = detail::signed_product(detail::upper_word(a.raw()), b.raw());
    const std::int64_t rounded = (below + (std::int64_t{1} << (bits - 1))) >> bits;
    if ((static_cast<std::uint32_t>(detail::upper_word(above)) + 0x1000'0000U) >> 29 != 0) [[unlikely]] {
        return Fixed::from_raw(detail::sum(detail::any_shift(above, 32 - bits), rounded));
    }
    return Fixed::from_raw((above << (32 - bits)) + rounded);
}

/// a * b / 4 rounded down. It always fits. Cost: two 32x32->64 multiplies.
[[nodiscard, gnu::always_inline]] constexpr Fixed quarter_product(Fixed a, ShortFixed b) noexcept {
    return Fixed::from_raw(detail::word_product(a.raw(), b.raw()));
}

/// factor * x, exact; saturates.
[[nodiscard, gnu::always_inline]] constexpr ShortFixed times(int factor, ShortFixed x) noexcept {
    return ShortFixed::from_raw(detail::saturated_word(detail::signed_product(factor, x.raw())));
}

/// x * 2^exponent rounded to nearest, ties away from zero; saturates.
[[nodiscard, gnu::always_inline]] constexpr ShortFixed scale2(ShortFixed x, int exponent) noexcept {
    return ShortFixed::from_raw(exponent < 0 && exponent >= -31 ? detail::halved_word(x.raw(), -exponent)
                                                                : detail::word_of(x.raw(), exponent));
}

/// (a + b) / 2 rounded to nearest, ties to even, where a + b does not overflow. Half of all sums are ties: rounded away
/// from zero, means of means would be too large by half an ulp on average, and by as much in every cell.
[[nodiscard, gnu::always_inline]] constexpr ShortFixed mean(ShortFixed a, ShortFixed b) noexcept {
    const std::int32_t sum = (a + b).raw();
    const std::int32_t down = sum >> 1;
    return ShortFixed::from_raw(down + (sum & down & 1));
}

[[nodiscard, gnu::always_inline]] constexpr ShortFixed absolute(ShortFixed x) noexcept {
    return x.raw() < 0 ? -x : x;
}

/// Length of the vector v[0] ... v[n-1], 0 <= n <= 9, rounded to nearest; saturates. Cost: a multiply per component and
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
