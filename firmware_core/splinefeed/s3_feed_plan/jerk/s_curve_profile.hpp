// SPDX-License-Identifier: MIT
// SCurveProfile: the time-optimal motion along a straight line to standstill, with limited speed, acceleration and
// jerk.
#pragma once

#include "splinefeed/number/floating.hpp"

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

/// Seven phases, some of which may be empty: the acceleration rises to its limit, stays there and falls; the speed
/// stays; then the same in reverse.
class SCurveProfile {
public:
    SCurveProfile() noexcept = default;
    /// From standstill. Cost: up to two roots and a handful of divisions. @pre all positive
    SCurveProfile(double length_mm, const MoveLimits& limits) noexcept;
    /// To the nearest standstill. @pre start.speed_mm_s >= 0; its acceleration can be brought to 0 before the speed is
    /// 0
    [[nodiscard]] static SCurveProfile to_rest(const MoveState& start, const MoveLimits& limits) noexcept;
    /// To standstill at a distance. If the distance is too short, length_mm() is that of the nearest standstill. A
    /// speed above the limit is reduced first. Cost: about fifty times that of to_rest(), unless the speed limit is
    /// reached.
    [[nodiscard]] static SCurveProfile to_length(const MoveState& start, double length_mm,
                                                 const MoveLimits& limits) noexcept;

    [[nodiscard]] const MoveState& start() const noexcept { return start_; }
    /// The length of all phases together.
    [[nodiscard]] double length_mm() const noexcept;

    static constexpr std::size_t phases = 7;
    [[nodiscard]] const JerkPhase& phase(std::size_t i) const noexcept { return phase_[i]; }
    [[nodiscard]] double duration_s() const noexcept;

private:
    void ramp(std::size_t first, const MoveState& from, double to_mm_s, const MoveLimits& limits) noexcept;
    void pass(const MoveState& start, double peak_mm_s, const MoveLimits& limits) noexcept;

    MoveState start_{};
    std::array<JerkPhase, phases> phase_{};
};

/// x^(2/3) for x > 0.
template <Floating R>
[[nodiscard]] R power_two_thirds(R x) noexcept;

} // namespace splinefeed
