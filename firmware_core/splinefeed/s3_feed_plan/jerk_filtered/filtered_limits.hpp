// SPDX-License-Identifier: MIT
// FilteredLimits: the speeds and accelerations of a motion with which every axis keeps its acceleration and its jerk
// after the motion was averaged over a time. Derivation: filtered_limits.cpp.
#pragma once

#include "splinefeed/s3_feed_plan/jerk_filtered/path_derivative_bounds.hpp"
#include "splinefeed/s3_feed_plan/jerk_filtered/smoothing.hpp"

namespace splinefeed {

/// What a part of the path allows. The limits are monotone: if a speed and an acceleration are allowed, smaller ones
/// are allowed too. Cost of a function: six products per axis, or eight, if its first guess is allowed, and some eight
/// times that otherwise.
template <Scalar S>
class FilteredLimits {
public:
    FilteredLimits(const PathDerivativeBounds<S>& demand, const MotionLimits<S>& limits,
                   const Smoothing<S>& smoothing) noexcept
        : demand_(&demand), limits_(&limits), smoothing_(&smoothing) {}

    /// Largest v^2 up to at_most that may be held constant.
    [[nodiscard]] S max_steady(S at_most) const noexcept;
    /// Largest acceleration along the path from standstill.
    [[nodiscard]] S max_path_acceleration() const noexcept;
    /// Largest exit_sq, from entry_sq to at_most, with constant acceleration over a length.
    /// @param max_path_acceleration  the result of max_path_acceleration()
    /// @pre entry_sq may be held constant
    [[nodiscard]] S largest_exit(S entry_sq, S at_most, S length_mm, S max_path_acceleration) const noexcept;
    /// Largest entry_sq, from exit_sq to at_most, with constant braking over a length. @pre exit_sq may be held
    /// constant
    [[nodiscard]] S largest_entry(S exit_sq, S at_most, S length_mm, S max_path_acceleration) const noexcept;
    /// Largest acceleration up to speed_sq, and largest braking from speed_sq. @pre speed_sq may be held constant
    [[nodiscard]] S acceleration(S speed_sq, S max_path_acceleration) const noexcept;
    [[nodiscard]] S braking(S speed_sq, S max_path_acceleration) const noexcept;

private:
    [[nodiscard]] S change(unsigned axis) const noexcept;
    template <bool Braking>
    [[nodiscard]] S excess(S speed_sq, S speed, S acceleration) const noexcept;
    template <bool Braking>
    [[nodiscard]] S faster_end(S slower_sq, S at_most, S length_mm, S max_path_acceleration) const noexcept;

    const PathDerivativeBounds<S>* demand_;
    const MotionLimits<S>* limits_;
    const Smoothing<S>* smoothing_;
};

} // namespace splinefeed
