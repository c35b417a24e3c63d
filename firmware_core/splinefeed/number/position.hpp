// SPDX-License-Identifier: MIT
//
// Positions of an axis as integers in units of 2^-40 mm. They are the same integers for every Scalar. The difference of
// two positions therefore does not depend on where on the axis they are, and sums do not drift.
#pragma once

#include "splinefeed/number/scalar.hpp"

namespace splinefeed {

/// A position in units of 2^-40 mm, about 1e-12 mm. Machine coordinates have |position| <= 2^20 mm (1 km).
struct Position {
    static constexpr int fraction_bits = 40;
    std::int64_t raw = 0;

    friend constexpr bool operator==(const Position&, const Position&) noexcept = default;
    friend constexpr auto operator<=>(const Position&, const Position&) noexcept = default;
};

/// to - from in units of 2^unit_log2 mm, |unit_log2| <= 60. The difference is exact and the result is rounded to
/// nearest once: error <= 1/2 ulp of S. Ties go away from zero in Fixed and to even in float and double; Fixed
/// saturates.
template <Scalar S>
[[nodiscard]] constexpr S distance(Position from, Position to, int unit_log2) noexcept {
    SPLINEFEED_ASSERT(unit_log2 >= -60 && unit_log2 <= 60);
    const detail::Checked difference = detail::checked_difference(to.raw, from.raw);
    SPLINEFEED_ASSERT(difference.fits);
    if constexpr (std::same_as<S, Fixed>) {
        return Fixed::from_raw(
            detail::shifted(difference.raw, detail::fixed_fraction_bits - Position::fraction_bits - unit_log2));
    } else {
        return detail::from_integer_scaled<S>(difference.raw, -unit_log2 - Position::fraction_bits);
    }
}

/// origin + offset * 2^unit_log2 mm, |unit_log2| <= 60. The offset is rounded to the nearest 2^-40 mm, ties away from
/// zero. If the position does not fit in 64 bits, or the offset is not finite, the result is the limit with that sign.
/// Such a position is far outside every machine.
template <Scalar S>
[[nodiscard]] constexpr Position displaced(Position origin, S offset, int unit_log2) noexcept {
    SPLINEFEED_ASSERT(unit_log2 >= -60 && unit_log2 <= 60);
    detail::Checked step;
    if constexpr (std::same_as<S, Fixed>) {
        step = detail::checked_shift(offset.raw(), unit_log2 + Position::fraction_bits - detail::fixed_fraction_bits);
    } else {
        step = detail::checked_integer(offset, unit_log2 + Position::fraction_bits);
    }
    return {detail::checked_sum(origin.raw, step.raw).raw};
}

/// round(position * factor / 2^shift), ties away from zero, 0 <= shift <= 127; saturates. With the factor in steps per
/// mm as Q32.32 and shift = 72, the result is in steps. Cost: four 32x32->64 multiplies.
[[nodiscard]] constexpr std::int64_t scaled(Position position, std::uint64_t factor_q32, int shift) noexcept {
    SPLINEFEED_ASSERT(shift >= 0 && shift <= 127);
    Wide product = multiply(detail::magnitude(position.raw), factor_q32);
    if (shift > 0) {
        // One half is at most 2^126 and the product is below 2^127: the sum does not overflow.
        product = shift_right(add(product, shift_left(Wide{0U, 1U}, shift - 1)), shift);
    }
    const bool negative = position.raw < 0;
    return product.high != 0 ? detail::saturated(negative).raw : detail::with_sign(product.low, negative).raw;
}

/// Whether a coordinate is within +-2^20 mm. NaN is not.
[[nodiscard]] constexpr bool position_representable(double mm) noexcept {
    return mm >= -1048576.0 && mm <= 1048576.0;
}

/// From whole micrometres, without arithmetic in double, for microcontrollers. Rounded towards zero; the error is less
/// than 2^-40 mm. @pre |um| is less than 2^23 mm
[[nodiscard]] constexpr Position position_from_um(std::int64_t um) noexcept {
    constexpr std::int64_t mm = std::int64_t{1} << Position::fraction_bits;
    return Position{um / 1000 * mm + um % 1000 * mm / 1000};
}

/// The nearest position, ties away from zero, for the host. Precondition: position_representable(mm).
[[nodiscard]] constexpr Position position_from_mm(double mm) noexcept {
    SPLINEFEED_ASSERT(position_representable(mm));
    return displaced(Position{}, mm, 0);
}

/// The coordinate in mm, for the host: exact for |position| < 2^21 mm, otherwise rounded to nearest.
[[nodiscard]] constexpr double to_mm(Position position) noexcept {
    return detail::from_integer_scaled<double>(position.raw, -Position::fraction_bits);
}

} // namespace splinefeed
