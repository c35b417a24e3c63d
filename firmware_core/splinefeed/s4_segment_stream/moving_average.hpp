// SPDX-License-Identifier: MIT
// MovingAverage: the mean of the last positions along a path, in integers: it does not drift.
#pragma once

#include "splinefeed/number/path_position.hpp"

#include <span>

namespace splinefeed {

/// Of N + f positions, f the part of the oldest: a moving average over a time that need not be whole. Only how far the
/// others are behind the newest is summed, in 128 bits: the path may be endless.
/// Positions that decrease count as the one before. @pre they are less than 2^23 mm apart
class MovingAverage {
public:
    static constexpr int fraction_bits = 8;
    [[nodiscard]] static constexpr std::size_t places_for(std::uint32_t duration_q8) noexcept {
        return static_cast<std::size_t>(duration_q8 >> fraction_bits) + 1;
    }

    /// @param storage  the caller's, at least places_for() the longest duration
    explicit MovingAverage(std::span<PathPosition> storage) noexcept : storage_(storage) {}

    /// All of them are at one place. @param duration_q8  N + f, in 1/256; at least 256
    void reset(PathPosition place, std::uint32_t duration_q8) noexcept;
    /// Takes the newest. Cost: three sums, two products and a division of 96 bits.
    void push(PathPosition newest) noexcept;
    [[nodiscard]] PathPosition value() const noexcept { return mean_; }
    [[nodiscard]] std::uint32_t duration_q8() const noexcept { return duration_q8_; }
    /// Positions that it reaches over.
    [[nodiscard]] std::uint32_t reach() const noexcept {
        return (duration_q8_ + (1U << fraction_bits) - 1U) >> fraction_bits;
    }

private:
    std::span<PathPosition> storage_;
    Wide behind_{};         // how far the N newest are behind the newest, all in all
    std::size_t whole_ = 0; // N
    std::size_t next_ = 0;  // place of the oldest but N
    PathPosition newest_{};
    PathPosition mean_{};
    std::uint32_t duration_q8_ = 0;
};

} // namespace splinefeed
