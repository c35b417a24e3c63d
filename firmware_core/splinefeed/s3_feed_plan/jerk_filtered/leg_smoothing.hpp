// SPDX-License-Identifier: MIT
// LegSmoothing: the time that a leg, a part of the path from standstill to standstill, is averaged over.
// Derivation: leg_smoothing.cpp.
#pragma once

#include "splinefeed/s3_feed_plan/jerk_filtered/path_derivative_bounds.hpp"

namespace splinefeed {

/// Takes the cells of a leg one by one. Cost of a cell: a root, a division, and the join of its bounds.
template <Scalar S>
class LegSmoothing {
public:
    explicit LegSmoothing(const MotionLimits<S>& limits) noexcept : limits_(&limits) {}

    /// The next cell. @param bound_sq  upper bound of v^2 in it
    void add(const PathDerivativeBounds<S>& own, S length_mm, S bound_sq) noexcept;
    /// The leg ends after the last cell. Without this call it may go on.
    void end_here() noexcept { ends_ = true; }
    /// The longest time that is allowed, in 1/256 of a tick.
    /// @param in_view  whether it is as long as the limits allow, although the leg may go on
    [[nodiscard]] std::uint32_t longest_q8(bool& in_view) const noexcept;
    /// Whether the end of a leg may lengthen its time: what is known of it has mild bends.
    [[nodiscard]] bool gains_by_end() const noexcept { return !ends_ && mild(); }

private:
    [[nodiscard]] bool mild() const noexcept;

    const MotionLimits<S>* limits_;
    PathDerivativeBounds<S> all_;
    S length_{};     // [mm]
    S ticks_{};      // least time of the cells
    S fastest_sq_{}; // largest bound of v^2
    bool ends_ = false;
};

} // namespace splinefeed
