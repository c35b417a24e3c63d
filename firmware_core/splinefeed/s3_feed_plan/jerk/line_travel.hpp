// SPDX-License-Identifier: MIT
// LineTravel: travels a straight move piece by piece. A piece ends where a phase of constant jerk or a cell ends.
#pragma once

#include "splinefeed/s3_feed_plan/jerk/s_curve_profile.hpp"

namespace splinefeed {

/// A part of a straight move, with constant jerk.
struct LinePiece {
    double length_mm = 0.0;
    double duration_s = 0.0;
    double linear = 0.0; ///< part of its length after the fraction y of its time: linear y + quadratic y^2 + ...
    double quadratic = 0.0;
    double entry_mm_s = 0.0;
    double exit_mm_s = 0.0;
};

class LineTravel {
public:
    LineTravel() noexcept = default;
    explicit LineTravel(const SCurveProfile& move) noexcept
        : move_(move), state_{0.0, move.start().speed_mm_s, move.start().acceleration_mm_s2}, phase_(0) {}

    [[nodiscard]] bool done() const noexcept { return phase_ >= SCurveProfile::phases; }
    /// The motion at the end of the last piece.
    [[nodiscard]] const MoveState& reached() const noexcept { return state_; }
    /// The next piece, not longer than at_most_mm. @pre not done. Cost: a division, and a dozen more if it does not end
    /// with a phase.
    LinePiece next(double at_most_mm) noexcept;
    /// The next piece, to the end of its phase: for the cell in which the move ends.
    LinePiece next() noexcept;

private:
    [[nodiscard]] double time_to(double length_mm, double longest_s, double jerk_mm_s3) const noexcept;

    SCurveProfile move_{};
    MoveState state_{}; // position from the start of the piece: always 0
    std::size_t phase_ = SCurveProfile::phases;
    double in_phase_s_ = 0.0;
};

} // namespace splinefeed
