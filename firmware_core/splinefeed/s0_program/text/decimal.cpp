// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/text/decimal.hpp"

namespace splinefeed {

namespace {

// A unit of a position, 2^-40 mm, is 5^9 / 2^31 units of a Decimal.
constexpr std::uint64_t five_to_9 = 1953125;
static_assert(Position::fraction_bits == 40 && Decimal::digits == 9);

} // namespace

detail::Checked product_quotient(std::int64_t a, std::int64_t b, std::uint64_t c) noexcept {
    const bool negative = (a ^ b) < 0;
    const Wide product = multiply(detail::magnitude(a), detail::magnitude(b));
    if (product.high >= c) {
        return detail::saturated(negative);
    }
    const WideQuotient result = divide(product, c);
    if (result.quotient >> 63 != 0) {
        return detail::saturated(negative);
    }
    return detail::with_sign(result.quotient + (result.remainder >= c - result.remainder ? 1U : 0U), negative);
}

Position to_position(Decimal value) noexcept {
    // By whole units of 5^9 first: then no step needs more than 64 bits.
    const std::uint64_t size = detail::magnitude(value.raw);
    const std::uint64_t whole = size / five_to_9;
    const std::uint64_t rest = (size - whole * five_to_9) << 31;
    if (whole >> 32 != 0) {
        return {detail::saturated(value.raw < 0).raw};
    }
    return {detail::with_sign((whole << 31) + (rest + five_to_9 / 2) / five_to_9, value.raw < 0).raw};
}

Decimal to_decimal(Position position) noexcept {
    return {product_quotient(position.raw, static_cast<std::int64_t>(five_to_9), std::uint64_t{1} << 31).raw};
}

} // namespace splinefeed
