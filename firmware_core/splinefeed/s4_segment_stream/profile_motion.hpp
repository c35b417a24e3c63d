// SPDX-License-Identifier: MIT
// ProfileMotion: the distance along a profile segment after a fraction of its time. Derivation: profile_motion.cpp.
#pragma once

#include "splinefeed/number/division_by.hpp"
#include "splinefeed/s3_feed_plan/motion_plan.hpp"

namespace splinefeed {

template <Scalar S>
class ProfileMotion {
public:
    ProfileMotion() noexcept = default;
    /// @param per_s  the unit of duration() is 1 / per_s
    /// @pre the middle_sq of a parabola is at most 8 times as large as either end's, as GradedFeed's parts are by far.
    /// From some 30 times on the search for the duration may begin behind the point where the parabola turns round
    ProfileMotion(const ProfileSegment<S>& profile_segment, S cell_length_mm, S per_s) noexcept;

    [[nodiscard]] S duration() const noexcept { return duration_; }
    /// time / duration()
    [[nodiscard]] S share_of(S time) const noexcept { return time / by_duration_; }
    /// Fraction of the profile segment's length after the fraction y of its time, both 0 to 1. Cost: 2 products; 50 for
    /// a parabola with a rounded top or bottom.
    [[nodiscard]] S at(S y) const noexcept;

private:
    [[nodiscard]] S travelled(S time) const noexcept;

    SpeedShape shape_ = SpeedShape::line;
    S duration_{};
    DivisionBy<S> by_duration_{};
    S linear_{};    // as in ProfileSegment; parabola: the entry speed
    S quadratic_{}; // parabola: the acceleration at the entry
    S curvature_{}; // parabola: half of the curvature of v^2
    S time_{};      // parabola: the duration, in its own units
};

} // namespace splinefeed
