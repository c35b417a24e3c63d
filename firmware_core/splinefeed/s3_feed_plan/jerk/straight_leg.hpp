// SPDX-License-Identifier: MIT
// StraightLeg: travels the straight leg at the front of a window as one move in closed form.
#pragma once

#include "splinefeed/s3_feed_plan/jerk/jerk_window.hpp"
#include "splinefeed/s3_feed_plan/jerk/line_travel.hpp"

namespace splinefeed {

/// The leg goes from the front cell to the next stop. With Travel::rest_to_rest it is the front cell alone.
template <Scalar S, Floating R>
class StraightLeg {
public:
    /// Whether one move can travel cells `first` to `end`: no bend up to the largest override, and one cap.
    [[nodiscard]] static bool is_straight(const JerkWindow<S, R>& window, std::size_t first, std::size_t end) noexcept;

    /// From standstill. @pre the front node's travel is not Travel::curve
    explicit StraightLeg(JerkWindow<S, R>& window) noexcept;
    /// In motion. @param limits  the limits with which the move began
    StraightLeg(JerkWindow<S, R>& window, const MoveLimits& limits) noexcept;

    /// Within these limits no axis exceeds a limit, whatever the steering. A motion that keeps them has to be changed
    /// within the same limits: with a smaller jerk, a motion that accelerates to the largest speed would exceed that
    /// speed.
    [[nodiscard]] const MoveLimits& limits() const noexcept { return limits_; }
    [[nodiscard]] SCurveProfile from_rest() const noexcept;
    /// To the nearest standstill, from where the machine is in the front cell. Splits a cell there: the last of
    /// cells(). false: the standstill is the leg's end anyway, or there is no room. @pre window.forget_travelled()
    bool to_rest(double from, const SpeedState& state) noexcept;
    /// To the end of the leg, with the caps that are wanted. false: the end is too near.
    bool to_end(double from, const SpeedState& state) noexcept;

    /// The result of to_rest() or to_end().
    [[nodiscard]] const SCurveProfile& move() const noexcept { return move_; }
    [[nodiscard]] std::size_t cells() const noexcept { return cells_; }

private:
    [[nodiscard]] double length_mm() const noexcept;
    [[nodiscard]] MoveLimits capped() const noexcept;
    void find_cells() noexcept;

    JerkWindow<S, R>* window_;
    std::size_t cells_ = 1;
    MoveLimits limits_;
    SCurveProfile move_{};
};

} // namespace splinefeed
