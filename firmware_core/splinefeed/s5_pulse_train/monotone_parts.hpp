// SPDX-License-Identifier: MIT
// MonotoneParts: divides an axis's segment where its velocity passes zero.
#pragma once

#include "splinefeed/s5_pulse_train/axis_cubic.hpp"

#include <array>
#include <cstdint>

namespace splinefeed {

/// Up to `end` the axis moves in one direction.
struct MonotonePart {
    std::uint32_t end = 0;  ///< instant [2^-32 of the duration]; 2^32 - 1 in the last part
    std::int64_t units = 0; ///< distance from the segment's start to that instant; exact in the last part
    bool rising = true;
};

/// One to three parts, in order of time. Cost: usually three comparisons, if all Bezier points of the velocity have the
/// same sign; otherwise about a hundred products.
class MonotoneParts {
public:
    constexpr MonotoneParts() noexcept = default;
    /// @param way  distance of the axis in the whole segment [units]
    MonotoneParts(const AxisCubic& cubic, std::int64_t way) noexcept;

    [[nodiscard]] unsigned size() const noexcept { return size_; }
    [[nodiscard]] const MonotonePart& operator[](unsigned i) const noexcept { return part_[i]; }

private:
    void cut(const AxisCubic& cubic, std::int64_t way, std::int64_t middle, std::int64_t last) noexcept;

    std::array<MonotonePart, 3> part_{};
    unsigned size_ = 0;
};

} // namespace splinefeed
