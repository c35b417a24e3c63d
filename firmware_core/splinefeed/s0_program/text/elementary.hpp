// SPDX-License-Identifier: MIT
// elementary: functions of numbers of a program, by integers: the same digits on every target.
#pragma once

#include "splinefeed/s0_program/text/decimal.hpp"
#include "splinefeed/s0_program/text/program_errors.hpp"

namespace splinefeed {

/// Fraction bits of a sine or a cosine.
inline constexpr int sine_bits = 62;
inline constexpr std::int64_t sine_one = std::int64_t{1} << sine_bits;

/// Both in units of 2^-62; error below 2^-58.
struct SineCosine {
    std::int64_t sine = 0;
    std::int64_t cosine = 0;
};

/// Of an angle in degrees; multiples of 90 and of 30 degrees give exact halves and ones to 2^-58. Cost: about 20
/// wide products.
[[nodiscard]] SineCosine sine_cosine(Decimal degrees) noexcept;

/// An angle in radians, in units of 2^-32, rounded to nearest. @pre |degrees| is at most 4e6
[[nodiscard]] std::int64_t radians_q32(Decimal degrees) noexcept;

/// value * factor / 2^62, rounded to nearest. @pre |factor| <= 2^62
[[nodiscard]] Decimal turned(Decimal value, std::int64_t factor) noexcept;

/// The angle of (x, y) in degrees, -180 to 180; 0 for (0, 0). Error below 1e-9.
[[nodiscard]] Decimal angle_of(Decimal x, Decimal y) noexcept;

/// sqrt(value) rounded to nearest, for value >= 0.
[[nodiscard]] Decimal square_root(Decimal value) noexcept;

/// e^value; relative error below 1e-15, at least 1e-9. Error: result_out_of_range.
[[nodiscard]] ProgramResult<Decimal> exponential(Decimal value) noexcept;

/// ln(value) for value > 0. Error below 1e-9.
[[nodiscard]] Decimal logarithm(Decimal value) noexcept;

/// base^exponent. A negative base needs an integer as exponent. Errors: power_invalid, division_by_zero (a negative
/// power of 0), result_out_of_range.
[[nodiscard]] ProgramResult<Decimal> power(Decimal base, Decimal exponent) noexcept;

/// sqrt(x^2 + y^2) rounded to nearest. @pre both within +-1e18 (raw)
[[nodiscard]] Decimal hypotenuse(Decimal x, Decimal y) noexcept;

} // namespace splinefeed
