// SPDX-License-Identifier: MIT
//
// Newton's method with a bracket. A step that would leave the bracket is replaced by the middle of the bracket, and
// from the twelfth round on every step is: then 32 more are enough. Where Newton's method converges slowly, at a
// standstill (a double or triple zero), a step is at least half as long as all later steps together: the result is
// within two of the last step, which is below `near` / 2.
#include "splinefeed/s5_pulse_train/crossing.hpp"

#include <bit>

namespace splinefeed {

namespace {

/// a / b * 2^32 to about 15 bits, at most 2^32 - 1. One 32-bit division: small processors have no other.
std::uint32_t quotient_q32(std::uint64_t a, std::uint64_t b) noexcept {
    if (a == 0) {
        return 0;
    }
    if (b == 0) {
        return 0xffffffffU;
    }
    const int shift_a = std::countl_zero(a);
    const int shift_b = std::countl_zero(b);
    const auto numerator = static_cast<std::uint32_t>((a << shift_a) >> 32);
    const auto denominator = static_cast<std::uint32_t>((b << shift_b) >> 48);
    const std::uint32_t quotient = numerator / denominator; // 2^15 to 2^17
    const int shift = 16 - shift_a + shift_b;
    if (shift > 14) {
        return 0xffffffffU;
    }
    return shift >= 0 ? quotient << shift : shift > -32 ? quotient >> -shift : 0U;
}

std::uint64_t magnitude(std::int64_t a) noexcept {
    return a < 0 ? 0U - static_cast<std::uint64_t>(a) : static_cast<std::uint64_t>(a);
}

} // namespace

std::uint32_t find_crossing(const AxisCubic& cubic, const CrossingSearch& search) noexcept {
    constexpr int newton_rounds = 12;
    std::uint32_t low = search.low;
    std::uint32_t high = search.high;
    std::uint32_t u = search.guess;
    for (int round = 0; high - low > search.near; ++round) {
        const std::int64_t missing = search.units - cubic.at(u);
        const bool before = missing > 0;
        (before ? low : high) = u;
        const std::uint32_t step = quotient_q32(magnitude(missing), magnitude(cubic.slope(u)));
        const bool inside = before ? step < high - u : step < u - low;
        if (inside && step <= search.near / 2) {
            return before ? u + step : u - step;
        }
        u = inside && round < newton_rounds ? (before ? u + step : u - step) : low + (high - low) / 2;
    }
    return low + (high - low) / 2;
}

} // namespace splinefeed
