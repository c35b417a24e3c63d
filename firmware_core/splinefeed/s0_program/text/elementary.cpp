// SPDX-License-Identifier: MIT
//
// Q62 numbers are integers in units of 2^-62. Series in them have rounding errors of a few 2^-62 and end where a term
// is below that; a Decimal has 2^-29.9, so results are the nearest or next to it.
#include "splinefeed/s0_program/text/elementary.hpp"

#include "splinefeed/number/wide_root.hpp"

#include <array>

namespace splinefeed {

namespace {

constexpr std::int64_t one_q62 = std::int64_t{1} << 62;
constexpr std::int64_t quarter_turn = 90 * Decimal::one;
// pi/180 * 1e-9 * 2^62 * 2^28, and the same for the angle in a Decimal.
constexpr std::uint64_t radian_of_unit = 21606129627797837;         // Q90 per 1e-9 degrees
constexpr std::int64_t degrees_of_radian_q56 = 4128596020240314225; // 180/pi in Q56
constexpr std::int64_t ln2_q62 = 3196577161300663915;
constexpr std::int64_t root2_q62 = 6521908912666391106; // sqrt(2)

// a * b / 2^62
std::int64_t product(std::int64_t a, std::int64_t b) noexcept {
    const Wide wide = add(multiply(detail::magnitude(a), detail::magnitude(b)), Wide{0U, std::uint64_t{1} << 61});
    return detail::with_sign((wide.high << 2) | (wide.low >> 62), (a ^ b) < 0).raw;
}

// a * 1e9 / 2^bits
std::int64_t decimal_of(std::int64_t a, int bits) noexcept {
    const Wide wide = multiply(detail::magnitude(a), static_cast<std::uint64_t>(Decimal::one));
    return detail::with_sign(shift_right(add(wide, shift_left(Wide{0U, 1U}, bits - 1)), bits).low, a < 0).raw;
}

// Taylor: x - x^3/3! + ..., and 1 - x^2/2! + ...; |x| <= pi/4.
SineCosine series(std::int64_t x) noexcept {
    const std::int64_t square = product(x, x);
    std::int64_t sine = one_q62;
    std::int64_t cosine = one_q62;
    for (std::int64_t k = 9; k > 0; --k) {
        sine = one_q62 - product(square, sine) / (2 * k * (2 * k + 1));
        cosine = one_q62 - product(square, cosine) / (2 * k * (2 * k - 1));
    }
    return {product(x, sine), cosine};
}

// atan(t) = t - t^3/3 + ... for |t| <= 1/16
std::int64_t small_arc_tangent(std::int64_t t) noexcept {
    const std::int64_t square = product(t, t);
    std::int64_t sum = 0;
    for (std::int64_t k = 15; k > 0; k -= 2) {
        sum = one_q62 / k - product(square, sum);
    }
    return product(t, sum);
}

// atan(k/8) in Q62
constexpr std::array<std::int64_t, 9> arc_tangents{0,
                                                   573486189672913778,
                                                   1129764675555192497,
                                                   1654537683908620430,
                                                   2138197195906305897,
                                                   2576084652473018343,
                                                   2967625066264511049,
                                                   3315018258881210269,
                                                   3622009729038561421};

// ln(m) = 2 atanh((m - 1) / (m + 1)) for m in [1/sqrt(2), sqrt(2)]
std::int64_t mantissa_logarithm(std::int64_t m) noexcept {
    const std::int64_t s = product_quotient(m - one_q62, one_q62, static_cast<std::uint64_t>(m) + one_q62).raw;
    const std::int64_t square = product(s, s);
    std::int64_t sum = 0;
    for (std::int64_t k = 23; k > 0; k -= 2) {
        sum = one_q62 / k + product(square, sum);
    }
    return 2 * product(s, sum);
}

/// exponent * ln(2) + rest, with rest in Q62, |rest| < 0.35
struct BinaryLogarithm {
    std::int64_t exponent = 0;
    std::int64_t rest = 0;
};

BinaryLogarithm binary_logarithm(std::uint64_t value) noexcept {
    const int zeros = std::countl_zero(value);
    std::uint64_t mantissa = value << zeros; // [2^63, 2^64): 1 to 2 in units of 2^-63
    std::int64_t exponent = 63 - zeros;
    mantissa = (mantissa >> 1) + (mantissa & 1U);
    if (mantissa > static_cast<std::uint64_t>(root2_q62)) {
        mantissa = (mantissa >> 1) + (mantissa & 1U);
        ++exponent;
    }
    return {exponent, mantissa_logarithm(static_cast<std::int64_t>(mantissa))};
}

constexpr std::int64_t unit_logarithm_q56 = 1493268676818745395; // ln(1e9): a Decimal counts in units of 1e-9

// e^x of a Q56 number, as a Decimal
ProgramResult<Decimal> exponential_q56(std::int64_t x) noexcept {
    constexpr std::int64_t ln2_q56 = ln2_q62 >> 6;
    if (x > 24 * (std::int64_t{1} << 56)) {
        return ProgramError::result_out_of_range;
    }
    if (x < -24 * (std::int64_t{1} << 56)) {
        return Decimal{};
    }
    const std::int64_t half = x < 0 ? -(ln2_q56 / 2) : ln2_q56 / 2;
    const std::int64_t power = (x + half) / ln2_q56;
    // The rest needs ln(2) to 2^-62.
    const auto rest = static_cast<std::int64_t>(
        (static_cast<std::uint64_t>(x) << 6) - static_cast<std::uint64_t>(power) * static_cast<std::uint64_t>(ln2_q62));
    std::int64_t sum = one_q62;
    for (std::int64_t k = 18; k > 0; --k) {
        sum = one_q62 + product(rest, sum) / k;
    }
    // sum * 2^power * 1e9 / 2^62
    const Wide wide = multiply(static_cast<std::uint64_t>(sum), static_cast<std::uint64_t>(Decimal::one));
    const int shift = static_cast<int>(62 - power);
    const Wide rounded = shift_right(add(wide, shift_left(Wide{0U, 1U}, shift - 1)), shift);
    if (rounded.high != 0 || (rounded.low >> 63) != 0) {
        return ProgramError::result_out_of_range;
    }
    return Decimal{static_cast<std::int64_t>(rounded.low)};
}

} // namespace

SineCosine sine_cosine(Decimal degrees) noexcept {
    std::int64_t angle = degrees.raw % Decimal::full_turn;
    angle += angle < 0 ? Decimal::full_turn : 0;
    const std::int64_t quarter = (angle + quarter_turn / 2) / quarter_turn;
    const std::int64_t rest = angle - quarter * quarter_turn; // -45 to 45 degrees
    const Wide scaled = multiply(detail::magnitude(rest), radian_of_unit);
    const auto radians = static_cast<std::int64_t>(shift_right(add(scaled, Wide{0U, 1U << 27}), 28).low);
    const SineCosine at = series(rest < 0 ? -radians : radians);
    switch (quarter & 3) {
    case 0: return at;
    case 1: return {at.cosine, -at.sine};
    case 2: return {-at.sine, -at.cosine};
    default: return {-at.cosine, at.sine};
    }
}

std::int64_t radians_q32(Decimal degrees) noexcept {
    const Wide scaled = add(multiply(detail::magnitude(degrees.raw), radian_of_unit), Wide{0U, std::uint64_t{1} << 57});
    return detail::with_sign(shift_right(scaled, 58).low, degrees.raw < 0).raw;
}

Decimal turned(Decimal value, std::int64_t factor) noexcept {
    return {product(value.raw, factor)};
}

Decimal angle_of(Decimal x, Decimal y) noexcept {
    const std::uint64_t across = detail::magnitude(y.raw);
    const std::uint64_t along = detail::magnitude(x.raw);
    if (across == 0 && along == 0) {
        return {};
    }
    const bool steep = across > along;
    const std::uint64_t small = steep ? along : across;
    const std::uint64_t large = steep ? across : along;
    const std::int64_t t = product_quotient(static_cast<std::int64_t>(small), one_q62, large).raw;
    // atan(t) = atan(c) + atan((t - c) / (1 + t c)), c the nearest eighth
    const std::int64_t eighth = (t + one_q62 / 16) >> 59;
    const std::int64_t c = eighth << 59;
    const std::uint64_t divisor = static_cast<std::uint64_t>(one_q62) + static_cast<std::uint64_t>(product(t, c));
    const std::int64_t radians = arc_tangents[static_cast<std::size_t>(eighth)] +
                                 small_arc_tangent(product_quotient(t - c, one_q62, divisor).raw);
    // radians / 2^62 * 180/pi * 1e9: 2^118 = 2^62 * 2^56
    Decimal degrees{decimal_of(product(radians, degrees_of_radian_q56), 56)};
    if (steep) {
        degrees.raw = quarter_turn - degrees.raw;
    }
    if (x.raw < 0) {
        degrees.raw = 2 * quarter_turn - degrees.raw;
    }
    return y.raw < 0 ? -degrees : degrees;
}

Decimal square_root(Decimal value) noexcept {
    const Wide wide = multiply(detail::magnitude(value.raw), static_cast<std::uint64_t>(Decimal::one));
    return {static_cast<std::int64_t>(square_root_rounded(wide))};
}

Decimal hypotenuse(Decimal x, Decimal y) noexcept {
    const std::uint64_t a = detail::magnitude(x.raw);
    const std::uint64_t b = detail::magnitude(y.raw);
    return {static_cast<std::int64_t>(square_root_rounded(add(multiply(a, a), multiply(b, b))))};
}

ProgramResult<Decimal> exponential(Decimal value) noexcept {
    constexpr std::int64_t most = 60 * Decimal::one;
    if (value.raw > most || value.raw < -most) {
        return value.raw > 0 ? ProgramResult<Decimal>(ProgramError::result_out_of_range)
                             : ProgramResult<Decimal>(Decimal{});
    }
    return exponential_q56(
        product_quotient(value.raw, std::int64_t{1} << 56, static_cast<std::uint64_t>(Decimal::one)).raw);
}

namespace {

// ln(value) in Q56: below 2^5 in size.
std::int64_t logarithm_q56(std::uint64_t raw) noexcept {
    const BinaryLogarithm of = binary_logarithm(raw);
    const std::int64_t whole = product_quotient(of.exponent, ln2_q62, 64).raw;
    return whole + (of.rest + (of.rest < 0 ? -32 : 32)) / 64 - unit_logarithm_q56;
}

} // namespace

Decimal logarithm(Decimal value) noexcept {
    const std::int64_t q56 = logarithm_q56(detail::magnitude(value.raw));
    return {decimal_of(q56, 56)};
}

ProgramResult<Decimal> power(Decimal base, Decimal exponent) noexcept {
    if (exponent.raw == 0) {
        return Decimal{Decimal::one};
    }
    if (base.raw == 0) {
        return exponent.raw < 0 ? ProgramResult<Decimal>(ProgramError::division_by_zero)
                                : ProgramResult<Decimal>(Decimal{});
    }
    if (base.raw < 0 && exponent.raw % Decimal::one != 0) {
        return ProgramError::power_invalid;
    }
    constexpr std::int64_t most_products = 63;
    if (base.raw % Decimal::one == 0 && exponent.raw % Decimal::one == 0 && exponent.raw > 0 &&
        exponent.raw <= most_products * Decimal::one) { // whole powers of whole numbers are exact
        detail::Checked product{Decimal::one, true};
        for (std::int64_t i = 0; i < exponent.raw / Decimal::one && product.fits; ++i) {
            product = product_quotient(product.raw, base.raw, static_cast<std::uint64_t>(Decimal::one));
        }
        return product.fits ? ProgramResult<Decimal>(Decimal{product.raw})
                            : ProgramResult<Decimal>(ProgramError::result_out_of_range);
    }
    const detail::Checked q56 = product_quotient(logarithm_q56(detail::magnitude(base.raw)), exponent.raw,
                                                 static_cast<std::uint64_t>(Decimal::one));
    if (!q56.fits) {
        return q56.raw > 0 ? ProgramResult<Decimal>(ProgramError::result_out_of_range)
                           : ProgramResult<Decimal>(Decimal{});
    }
    const ProgramResult<Decimal> size = exponential_q56(q56.raw);
    const bool negative = base.raw < 0 && (exponent.raw / Decimal::one) % 2 != 0;
    return size.has_value() && negative ? ProgramResult<Decimal>(-*size) : size;
}

} // namespace splinefeed
