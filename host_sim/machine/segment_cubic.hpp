// SPDX-License-Identifier: MIT
// SegmentCubic: the motion of one axis over one feed segment, u = 0 to 1: positions in integers, derivatives in double.
#pragma once

#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <cstdint>

namespace splinefeed::host {

__extension__ using Wide128 = __int128;

/// The whole count nearest to a position, ties upwards. Exact for every position.
[[nodiscard]] std::int64_t nearest_count(std::int64_t units) noexcept;

/// Largest |acceleration| [mm/s^2] in the direction of the velocity (including starts from standstill), and against it.
struct Accelerations {
    double speeding = 0.0;
    double braking = 0.0;
};

class SegmentCubic {
public:
    SegmentCubic() = default; ///< not usable until assigned
    /// Exact for every segment; derivatives within 1e-15 of their largest term.
    SegmentCubic(const FeedSegment& segment, unsigned axis, double units_per_mm, double duration_s) noexcept;

    /// Units from the start to u = j / n, rounded once to nearest, ties upwards; exact at j = n.
    /// @pre 0 <= j <= n <= 1024, and the result fits in 64 bits
    [[nodiscard]] std::int64_t travelled(int j, int n) const noexcept;

    [[nodiscard]] double velocity(double u) const noexcept { return b1_ + u * (b2_ + u * b3_); }
    [[nodiscard]] double acceleration(double u) const noexcept { return (b2_ + 2.0 * u * b3_) * per_duration_; }
    [[nodiscard]] double jerk() const noexcept { return 2.0 * b3_ * per_duration_ * per_duration_; }
    /// The largest accelerations between two places, 0 <= from <= to <= 1.
    [[nodiscard]] Accelerations accelerations(double from, double to) const noexcept;
    /// Where the velocity has its extremum strictly inside the segment; -1: nowhere.
    [[nodiscard]] double peak_u() const noexcept { return peak_u_; }

private:
    Wide128 a1_, a2_, a3_; // position a1 u + a2 u^2 + a3 u^3 [units]
    double b1_, b2_, b3_;  // velocity b1 + b2 u + b3 u^2 [mm/s]
    double per_duration_;  // [1/s]
    double peak_u_;
};

} // namespace splinefeed::host
