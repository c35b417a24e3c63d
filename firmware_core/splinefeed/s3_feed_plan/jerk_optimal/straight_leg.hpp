// SPDX-License-Identifier: MIT
// StraightLeg: the straight leg at the front of a window, travelled as one move in closed form.
#pragma once

#include "splinefeed/s3_feed_plan/jerk_optimal/jerk_window.hpp"
#include "splinefeed/s3_feed_plan/jerk_optimal/line_travel.hpp"

namespace splinefeed {

/// From the front cell to the next stop; of Travel::rest_to_rest the front cell alone.
template <Scalar S>
class StraightLeg {
public:
    /// One move can take them: no bend up to the largest override, and one cap.
    [[nodiscard]] static bool is_straight(std::span<const JerkNode> nodes) noexcept;

    /// From rest. @pre the front node's travel is not Travel::curve
    explicit StraightLeg(JerkWindow<S>& window) noexcept;
    /// In motion. @param limits  those that the move began with
    StraightLeg(JerkWindow<S>& window, const MoveLimits& limits) noexcept;

    /// Whatever is steered, no limit of an axis is exceeded within them; a motion that keeps them has to be changed
    /// within the same ones: with less jerk, what is accelerated up to the largest speed would be carried beyond it.
    [[nodiscard]] const MoveLimits& limits() const noexcept { return limits_; }
    [[nodiscard]] SCurveProfile from_rest() const noexcept;
    /// To the nearest rest, from where the machine is in the front cell: a cell is cut there, the last of cells().
    /// false: that is the leg's end anyway, or there is no room. @pre window.forget_travelled()
    bool to_rest(double from, const SpeedState& state) noexcept;
    /// To its end, with the caps that are wanted. false: it is too near.
    bool to_end(double from, const SpeedState& state) noexcept;

    /// What to_rest() and to_end() found.
    [[nodiscard]] const SCurveProfile& move() const noexcept { return move_; }
    [[nodiscard]] std::size_t cells() const noexcept { return cells_; }

private:
    [[nodiscard]] double length_mm() const noexcept;
    [[nodiscard]] MoveLimits capped() const noexcept;
    void find_cells() noexcept;

    JerkWindow<S>* window_;
    std::size_t cells_ = 1;
    MoveLimits limits_;
    SCurveProfile move_{};
};

} // namespace splinefeed
