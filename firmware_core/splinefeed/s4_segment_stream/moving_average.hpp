// SPDX-License-Identifier: MIT
// MovingAverage: the mean of the last positions along a path, in integers, so it does not drift.
#pragma once

#include "splinefeed/number/path_position.hpp"

#include <span>

namespace splinefeed {

/// The mean of N + f positions; the oldest counts with the weight f. So the length of the average need not be a whole
/// number. Only the distances to the newest position are summed, in 128 bits, because the path may have no end. A
/// position that is less than the previous one is replaced by the previous one.
/// @pre the positions are less than 2^23 mm apart
class MovingAverage {
public:
    static constexpr int fraction_bits = 8;
    [[nodiscard]] static constexpr std::size_t places_for(std::uint32_t duration_q8) noexcept {
        return static_cast<std::size_t>(duration_q8 >> fraction_bits) + 1;
    }

    /// @param storage  owned by the caller, at least places_for() the longest duration
    explicit MovingAverage(std::span<PathPosition> storage) noexcept : storage_(storage) {}

    /// Sets all positions to one place. @param duration_q8  N + f, in 1/256; at least 256
    void reset(PathPosition place, std::uint32_t duration_q8) noexcept;
    /// Adds the newest position. Cost: three sums, two products and a division of 96 bits.
    void push(PathPosition newest) noexcept;
    [[nodiscard]] PathPosition value() const noexcept { return mean_; }
    [[nodiscard]] std::uint32_t duration_q8() const noexcept { return duration_q8_; }
    /// Number of positions that the average reaches over.
    [[nodiscard]] std::uint32_t reach() const noexcept {
        return (duration_q8_ + (1U << fraction_bits) - 1U) >> fraction_bits;
    }

private:
    std::span<PathPosition> storage_;
    Wide behind_{};         // sum of the distances of the N newest to the newest
    std::size_t whole_ = 0; // N
    std::size_t next_ = 0;  // index of the position before the N newest
    PathPosition newest_{};
    PathPosition mean_{};
    std::uint32_t duration_q8_ = 0;
};

} // namespace splinefeed
