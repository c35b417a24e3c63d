// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/profile/field_codec.hpp"

#include "splinefeed/number/wide.hpp"

namespace splinefeed::hal::modbus {

namespace {

constexpr std::uint64_t largest_magnitude = std::uint64_t{1} << 63U;

std::uint64_t magnitude(std::int64_t value) noexcept {
    return value < 0 ? std::uint64_t{0} - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
}

// +-(numerator / denominator) rounded to nearest, ties upwards, saturated. @pre denominator below 2^63 unless it
// divides
std::int64_t nearest(Wide numerator, std::uint64_t denominator, bool negative) noexcept {
    constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
    constexpr std::int64_t highest = std::numeric_limits<std::int64_t>::max();
    if (numerator.high >= denominator) {
        return negative ? lowest : highest;
    }
    const WideQuotient parts = divide(numerator, denominator);
    std::uint64_t quotient = parts.quotient;
    const std::uint64_t rest_to_next = denominator - parts.remainder;
    // Upwards means away from zero for a positive value, towards it for a negative one.
    if (parts.remainder > rest_to_next || (parts.remainder == rest_to_next && !negative)) {
        quotient = quotient + 1 == 0 ? quotient : quotient + 1;
    }
    if (quotient >= largest_magnitude) {
        return negative ? lowest : highest;
    }
    return negative ? -static_cast<std::int64_t>(quotient) : static_cast<std::int64_t>(quotient);
}

// value * 2^shift * factor / divisor, where value * factor may have 128 bits; two divisions, rounded once by the last.
std::int64_t scaled_by_ratio(std::int64_t value, std::int64_t factor, std::int64_t divisor, int shift) noexcept {
    const bool negative = (value < 0) != (factor < 0) && value != 0;
    const Wide product = multiply(magnitude(value), magnitude(factor));
    const std::uint64_t denominator = magnitude(divisor);
    if (shift >= 0) {
        return leading_zeros(product) < shift
                   ? (negative ? std::numeric_limits<std::int64_t>::min() : std::numeric_limits<std::int64_t>::max())
                   : nearest(shift_left(product, shift), denominator, negative);
    }
    if (leading_zeros(Wide{0, denominator}) - 64 >= -shift) {
        return nearest(product, denominator << static_cast<unsigned>(-shift), negative);
    }
    // The divisor has too few leading zeros for the shift: the last bits of the product only decide ties.
    const Wide high = shift_right(product, -shift);
    const bool odd = shift_left(high, -shift) != product;
    return nearest(add(shift_left(high, 1), Wide{0, odd ? 1U : 0U}), denominator << 1U, negative);
}

} // namespace

RawValue raw_of(const RegisterField& field, std::int64_t physical_q16) noexcept {
    std::int64_t raw = 0;
    if (!field.inverse) {
        raw = scaled_by_ratio(physical_q16, field.scale_numerator, field.scale_denominator, -physical_bits);
    } else if (physical_q16 == 0) {
        raw = field.scale_numerator < 0 ? std::numeric_limits<std::int64_t>::min()
                                        : std::numeric_limits<std::int64_t>::max();
    } else {
        // numerator 2^16 / (denominator physical). The divisor may have more than 64 bits; the quotient is then 0 or
        // +-1.
        const Wide divisor = multiply(magnitude(physical_q16), magnitude(field.scale_denominator));
        const bool negative = (physical_q16 < 0) != (field.scale_numerator < 0);
        const Wide dividend = shift_left(Wide{0, magnitude(field.scale_numerator)}, physical_bits);
        if (divisor.high == 0) {
            raw = nearest(dividend, divisor.low, negative);
        } else {
            const Wide twice = shift_left(dividend, 1);
            raw = twice > divisor || (twice == divisor && !negative) ? (negative ? -1 : 1) : 0;
        }
    }
    if (raw < field.lowest) {
        return {field.lowest, true};
    }
    return raw > field.highest ? RawValue{field.highest, true} : RawValue{raw, false};
}

std::int64_t physical_of(const RegisterField& field, std::int64_t raw) noexcept {
    if (!field.inverse) {
        const bool flip = field.scale_numerator < 0;
        return scaled_by_ratio(raw, flip ? -field.scale_denominator : field.scale_denominator,
                               flip ? -field.scale_numerator : field.scale_numerator, physical_bits);
    }
    if (raw == 0) {
        return field.scale_numerator < 0 ? std::numeric_limits<std::int64_t>::min()
                                         : std::numeric_limits<std::int64_t>::max();
    }
    const bool negative = (raw < 0) != (field.scale_numerator < 0);
    const Wide divisor = multiply(magnitude(raw), magnitude(field.scale_denominator));
    const Wide dividend = shift_left(Wide{0, magnitude(field.scale_numerator)}, physical_bits);
    if (divisor.high != 0) {
        const Wide twice = shift_left(dividend, 1);
        return twice > divisor || (twice == divisor && !negative) ? (negative ? -1 : 1) : 0;
    }
    return nearest(dividend, divisor.low, negative);
}

void put_raw(const RegisterField& field, std::int64_t raw, std::span<std::uint16_t> out) noexcept {
    auto bits = static_cast<std::uint64_t>(raw);
    const std::size_t count = field.registers();
    for (std::size_t i = 0; i < count; ++i) { // the least significant first
        const auto word = static_cast<std::uint16_t>(bits & 0xFFFFU);
        bits >>= 16U;
        const auto swapped = static_cast<std::uint16_t>((word >> 8U) | (word << 8U));
        out[field.word_order == Significance::low_first ? i : count - 1 - i] =
            field.byte_order == Significance::low_first ? swapped : word;
    }
}

std::int64_t take_raw(const RegisterField& field, std::span<const std::uint16_t> in) noexcept {
    std::uint64_t bits = 0;
    const std::size_t count = field.registers();
    for (std::size_t i = 0; i < count; ++i) { // the most significant first
        const std::uint16_t word = in[field.word_order == Significance::low_first ? count - 1 - i : i];
        const auto swapped = static_cast<std::uint16_t>((word >> 8U) | (word << 8U));
        bits = bits << 16U | (field.byte_order == Significance::low_first ? swapped : word);
    }
    if (field.is_signed && field.width_bits < 64) {
        const std::uint64_t sign = std::uint64_t{1} << (field.width_bits - 1U);
        return static_cast<std::int64_t>((bits ^ sign) - sign);
    }
    return static_cast<std::int64_t>(bits);
}

} // namespace splinefeed::hal::modbus
