// SPDX-License-Identifier: MIT
// FilteredLimits: which speeds and accelerations of a motion keep every axis within its acceleration and its jerk once
// that motion is averaged over a time. Derivation: filtered_limits.cpp.
#pragma once

#include "splinefeed/s3_feed_plan/jerk_filtered/path_derivative_bounds.hpp"
#include "splinefeed/s3_feed_plan/jerk_filtered/smoothing.hpp"

namespace splinefeed {

/// What a part of the path allows. It is monotone: what is allowed is allowed with less speed and less acceleration,
/// too. Cost of a function: eleven products an axis where its first guess is allowed, at most eight times that.
template <Scalar S>
class FilteredLimits {
public:
    FilteredLimits(const PathDerivativeBounds<S>& demand, const MotionLimits<S>& limits,
                   const Smoothing<S>& smoothing) noexcept
        : demand_(&demand), limits_(&limits), smoothing_(&smoothing) {}

    /// Largest v^2 up to at_most that may be kept up.
    [[nodiscard]] S max_steady(S at_most) const noexcept;
    /// Largest acceleration along the path, at rest.
    [[nodiscard]] S max_path_acceleration() const noexcept;
    /// Largest exit_sq from entry_sq to at_most over a length, accelerated evenly. @param max_path_acceleration  of
    /// this bound
    /// @pre entry_sq may be kept up
    [[nodiscard]] S largest_exit(S entry_sq, S at_most, S length_mm, S max_path_acceleration) const noexcept;
    /// Largest entry_sq from exit_sq to at_most over a length, braked evenly. @pre exit_sq may be kept up
    [[nodiscard]] S largest_entry(S exit_sq, S at_most, S length_mm, S max_path_acceleration) const noexcept;
    /// Largest acceleration up to a v^2, largest braking from it on. @pre speed_sq may be kept up
    [[nodiscard]] S acceleration(S speed_sq, S max_path_acceleration) const noexcept;
    [[nodiscard]] S braking(S speed_sq, S max_path_acceleration) const noexcept;

private:
    [[nodiscard]] S jerk(unsigned axis) const noexcept;
    template <bool Braking>
    [[nodiscard]] S excess(S speed_sq, S acceleration) const noexcept;
    template <bool Braking>
    [[nodiscard]] S faster_end(S slower_sq, S at_most, S length_mm, S max_path_acceleration) const noexcept;

    const PathDerivativeBounds<S>* demand_;
    const MotionLimits<S>* limits_;
    const Smoothing<S>* smoothing_;
};

} // namespace splinefeed
