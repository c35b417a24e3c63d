// SPDX-License-Identifier: MIT
// StraightMove: from rest to rest along a straight line in the least time, with limited speed, acceleration and jerk.
#pragma once

#include <array>
#include <cstddef>

namespace splinefeed {

struct MoveLimits {
    double speed_mm_s = 0.0;
    double acceleration_mm_s2 = 0.0;
    double jerk_mm_s3 = 0.0;
};

/// A part of the move with constant jerk.
struct JerkPhase {
    double duration_s = 0.0;
    double jerk_mm_s3 = 0.0;
};

/// State along the line.
struct MoveState {
    double position_mm = 0.0;
    double speed_mm_s = 0.0;
    double acceleration_mm_s2 = 0.0;

    [[nodiscard]] MoveState after(double time_s, double jerk_mm_s3) const noexcept;
};

/// Seven phases, some of them empty: the acceleration rises to its limit, stays there and falls, the speed stays, and
/// all that backward. Cost: up to two roots and a handful of divisions.
class StraightMove {
public:
    StraightMove() noexcept = default;
    /// @pre all positive
    StraightMove(double length_mm, const MoveLimits& limits) noexcept;

    static constexpr std::size_t phases = 7;
    [[nodiscard]] const JerkPhase& phase(std::size_t i) const noexcept { return phase_[i]; }
    [[nodiscard]] double duration_s() const noexcept;

private:
    std::array<JerkPhase, phases> phase_{};
};

/// x^(2/3) for x > 0.
[[nodiscard]] double power_two_thirds(double x) noexcept;

} // namespace splinefeed
