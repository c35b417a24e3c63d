// SPDX-License-Identifier: MIT
// MonotoneParts: an axis's segment cut where its velocity passes zero.
#pragma once

#include "splinefeed/s5_pulse_train/axis_cubic.hpp"

#include <array>
#include <cstdint>

namespace splinefeed {

/// The motion up to some instant of the segment goes one way.
struct MonotonePart {
    std::uint32_t end = 0;  ///< instant [2^-32 of the duration]; the last part's is 2^32 - 1
    std::int64_t units = 0; ///< way from the segment's start to there; the last part's is exact
    bool rising = true;
};

/// One to three parts, in order of time. Cost: three comparisons where the Bezier points of the velocity have one sign,
/// which is nearly always; else about a hundred products.
class MonotoneParts {
public:
    constexpr MonotoneParts() noexcept = default;
    /// @param way  of the axis in the whole segment [units]
    MonotoneParts(const AxisCubic& cubic, std::int64_t way) noexcept;

    [[nodiscard]] unsigned size() const noexcept { return size_; }
    [[nodiscard]] const MonotonePart& operator[](unsigned i) const noexcept { return part_[i]; }

private:
    void cut(const AxisCubic& cubic, std::int64_t way, std::int64_t middle, std::int64_t last) noexcept;

    std::array<MonotonePart, 3> part_{};
    unsigned size_ = 0;
};

} // namespace splinefeed
