// SPDX-License-Identifier: MIT
//
// Products and quotients by digits of 32 bits, for processors without wider ones. A quotient is multiplied from the
// reciprocal of its divisor, and exact: N. Moeller, T. Granlund, "Improved division by invariant integers", IEEE
// Transactions on Computers 60 (2011); their algorithms 3, 5 and 6.
#pragma once

#include "splinefeed/base/assertion.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

/// Defined for processors that keep only the lower half of a product of two words and do not divide: Cortex-M0, M0+.
#if defined(__ARM_ARCH_6M__)
#define SPLINEFEED_SHORT_PRODUCTS
#endif

namespace splinefeed::detail {

inline constexpr std::uint64_t low_half = 0xffffffffU;

/// a * b, by digits of 16 bits.
[[nodiscard]] constexpr std::uint64_t product_of_halves(std::uint32_t a, std::uint32_t b) noexcept {
    const std::uint32_t a0 = a & 0xffffU;
    const std::uint32_t a1 = a >> 16;
    const std::uint32_t b0 = b & 0xffffU;
    const std::uint32_t b1 = b >> 16;
    // The product of two digits leaves room for two more digits.
    const std::uint32_t bottom = a0 * b0;
    const std::uint32_t middle = a1 * b0 + (bottom >> 16);
    const std::uint32_t cross = a0 * b1 + (middle & 0xffffU);
    const std::uint32_t top = a1 * b1 + (middle >> 16) + (cross >> 16);
    return (static_cast<std::uint64_t>(top) << 32) | ((cross << 16) | (bottom & 0xffffU));
}

/// a * b, exact.
[[nodiscard]] constexpr std::uint64_t long_product(std::uint32_t a, std::uint32_t b) noexcept {
#ifdef SPLINEFEED_SHORT_PRODUCTS
    return product_of_halves(a, b);
#else
    return static_cast<std::uint64_t>(a) * b;
#endif
}

/// The first 15 bits of a reciprocal, from the first 10 bits of a normalised divisor.
[[nodiscard]] constexpr std::uint32_t short_reciprocal(std::uint32_t first_bits) noexcept {
    return ((1U << 24) - (1U << 14) + (1U << 9)) / first_bits;
}

consteval std::array<std::uint16_t, 512> make_short_reciprocals() {
    std::array<std::uint16_t, 512> table{};
    for (std::uint32_t i = 0; i < table.size(); ++i) {
        table[i] = static_cast<std::uint16_t>(short_reciprocal(512 + i));
    }
    return table;
}

inline constexpr std::array<std::uint16_t, 512> short_reciprocals = make_short_reciprocals();

/// floor((2^64 - 1) / word) - 2^32 for a normalised word (its top bit is set).
[[nodiscard]] constexpr std::uint32_t word_reciprocal(std::uint32_t word) noexcept {
#ifdef SPLINEFEED_SHORT_PRODUCTS
    const std::uint32_t v0 = short_reciprocals[(word >> 22) - 512U];
#else
    const std::uint32_t v0 = short_reciprocal(word >> 22);
#endif
    const auto upper = [](std::uint64_t product) {
        return static_cast<std::uint32_t>(product >> 32);
    };
    const std::uint32_t v1 = (v0 << 4) - upper(long_product(v0 * v0, (word >> 11) + 1U)) - 1U;
    const std::uint32_t odd = word & 1U;
    const std::uint32_t error = (v1 >> 1 & (0U - odd)) - v1 * ((word >> 1) + odd);
    const std::uint32_t v2 = (v1 << 15) + (upper(long_product(v1, error)) >> 1);
    const std::uint64_t check = long_product(v2, word) + word;
    return v2 - (upper(check) + word);
}

/// What a division needs to know of its divisor: it serves every quotient by the same number.
class Divisor {
public:
    /// @pre value > 0
    constexpr explicit Divisor(std::uint64_t value) noexcept
        : normalised_(value << std::countl_zero(value)), shift_(std::countl_zero(value)) {
        const auto upper = static_cast<std::uint32_t>(normalised_ >> 32);
        const auto lower = static_cast<std::uint32_t>(normalised_);
        reciprocal_ = word_reciprocal(upper);
        std::uint32_t rest = upper * reciprocal_ + lower;
        if (rest < lower) {
            --reciprocal_;
            if (rest >= upper) {
                --reciprocal_;
                rest -= upper;
            }
            rest -= upper;
        }
        const std::uint64_t more = long_product(reciprocal_, lower);
        const auto carried = static_cast<std::uint32_t>(more >> 32);
        rest += carried;
        if (rest < carried) {
            --reciprocal_;
            if (((static_cast<std::uint64_t>(rest) << 32) | (more & low_half)) >= normalised_) {
                --reciprocal_;
            }
        }
    }

    /// The divisor times 2^shift(); its top bit is set.
    [[nodiscard]] constexpr std::uint64_t normalised() const noexcept { return normalised_; }
    [[nodiscard]] constexpr int shift() const noexcept { return shift_; }

    /// (rest * 2^32 + digit) / normalised(): returns the quotient and updates the rest. @pre rest < normalised()
    constexpr std::uint32_t divide(std::uint64_t& rest, std::uint32_t digit) const noexcept {
        const auto upper = static_cast<std::uint32_t>(normalised_ >> 32);
        const std::uint64_t estimate = long_product(reciprocal_, static_cast<std::uint32_t>(rest >> 32)) + rest;
        auto quotient = static_cast<std::uint32_t>(estimate >> 32);
        const std::uint32_t top = static_cast<std::uint32_t>(rest) - quotient * upper;
        std::uint64_t left = ((static_cast<std::uint64_t>(top) << 32) | digit) -
                             long_product(quotient, static_cast<std::uint32_t>(normalised_)) - normalised_;
        ++quotient;
        if (static_cast<std::uint32_t>(left >> 32) >= static_cast<std::uint32_t>(estimate)) {
            --quotient;
            left += normalised_;
        }
        if (left >= normalised_) [[unlikely]] {
            ++quotient;
            left -= normalised_;
        }
        rest = left;
        return quotient;
    }

private:
    std::uint64_t normalised_;
    std::uint32_t reciprocal_ = 0;
    int shift_;
};

} // namespace splinefeed::detail
