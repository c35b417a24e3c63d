// SPDX-License-Identifier: MIT
// Decimal: the numbers of a G-code program, exact as they are written.
#pragma once

#include "splinefeed/number/position.hpp"

namespace splinefeed {

/// The number raw * 1e-9. A program writes decimals, so these are exact: 0.1 is 0.1, an inch is 25.4 mm, and sums of
/// incremental moves do not drift. As a coordinate it is in mm or degrees, with a resolution of 1e-9 mm.
struct Decimal {
    static constexpr int digits = 9;
    static constexpr std::int64_t one = 1'000'000'000;
    static constexpr std::int64_t full_turn = 360 * one;             ///< of an angle in degrees
    static constexpr std::int64_t largest_raw = 9'200'000'000 * one; ///< of what is computed
    std::int64_t raw = 0;

    [[nodiscard]] static constexpr Decimal from_integer(std::int32_t value) noexcept { return {value * one}; }
    [[nodiscard]] constexpr Decimal operator-() const noexcept { return {-raw}; }
    /// Sums of words never overflow: the reader limits them to +-1e8. @pre the result is within +-largest_raw
    friend constexpr Decimal operator+(Decimal a, Decimal b) noexcept { return {a.raw + b.raw}; }
    friend constexpr Decimal operator-(Decimal a, Decimal b) noexcept { return {a.raw - b.raw}; }
    constexpr Decimal& operator+=(Decimal other) noexcept { return *this = *this + other; }
    constexpr Decimal& operator-=(Decimal other) noexcept { return *this = *this - other; }
    friend constexpr bool operator==(const Decimal&, const Decimal&) noexcept = default;
    friend constexpr auto operator<=>(const Decimal&, const Decimal&) noexcept = default;
};

/// a * b / c, rounded to nearest, ties away from zero; saturates, and c = 0 saturates, too. Cost: a wide product and a
/// division.
[[nodiscard]] detail::Checked product_quotient(std::int64_t a, std::int64_t b, std::uint64_t c) noexcept;

/// Of a coordinate of the machine, and of offsets: sums of them and of a place do not overflow. [mm or degrees]
inline constexpr Decimal largest_position = Decimal::from_integer(1 << 20);
[[nodiscard]] constexpr bool is_position(Decimal value) noexcept {
    return value <= largest_position && value >= -largest_position;
}

/// The nearest position. @pre is_position(value)
[[nodiscard]] Position to_position(Decimal value) noexcept;
/// The nearest Decimal.
[[nodiscard]] Decimal to_decimal(Position position) noexcept;

/// value / divisor as a number of S, by integers: rounded to 2^-32, then to S. @pre the result is below 2^31
template <Scalar S>
[[nodiscard]] S to_scalar(Decimal value, std::uint32_t divisor = 1) noexcept {
    const detail::Checked q32 =
        product_quotient(value.raw, std::int64_t{1} << 32, static_cast<std::uint64_t>(Decimal::one) * divisor);
    if constexpr (std::same_as<S, Fixed>) {
        return Fixed::from_raw(q32.raw);
    } else {
        return detail::from_integer_scaled<S>(q32.raw, -32);
    }
}

} // namespace splinefeed
