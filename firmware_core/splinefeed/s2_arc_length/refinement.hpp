// SPDX-License-Identifier: MIT
// Refinement: how fine the cells are, and where segments may lead.
#pragma once

#include "splinefeed/s2_arc_length/piece.hpp"

#include <limits>

namespace splinefeed {

/// Range of positions of an axis.
struct PositionRange {
    Position low{std::numeric_limits<std::int64_t>::min()};
    Position high{std::numeric_limits<std::int64_t>::max()};
};

/// Which lines are cut only where they must be: the plan speeds up and brakes within a cell.
enum class WholeLines : std::uint8_t { none, between_stops, all };

/// How fine the cells are. The thresholds are deliberately not round numbers: no exact input lies on one, so all scalar
/// types decide alike and their traces stay comparable.
template <Scalar S>
struct Refinement {
    PerAxis<S> longest_mm{}; ///< longest way of an axis in a cell: by the resolution of its parameter
    S max_feed_mm_s{};       ///< feed of segments without a programmed feed
    S grade_per_feed_sq{}; ///< a cell next to a joint is at most feed^2 times this: a fraction of the braking distance
    int finest_grade_log2 = 0; ///< next to a stop it is 2^-this of that length: jerk-limited motion starts
                               ///< slowly
    WholeLines whole_lines = WholeLines::none;
    int axes = 0;                       ///< number of axes that a segment must have; 0: any
    PerAxis<PositionRange> countable{}; ///< range in which the control points of a segment must be
    PerAxis<PositionRange> open{};      ///< range in which an axis may move at full speed; outside it is near the ends
                                        ///< of its travel
    S end_piece_mm{};                   ///< longest cell across a border of `open`; 0: no axis has one
    PerAxis<S> bend_mm_s2{};            ///< with a jerk limit: no axis bends the path with more, about
    PerAxis<S> error_mm_s3{}; ///< with a jerk limit: largest jerk by which the shape of a cell may be off, per
                              ///< AxisShape::error_bound v^3 / L^2; 0: any
    PerAxis<S> jump_mm_s{};   ///< largest jump of an axis's speed at a joint of cells that rounding may cause
    S direction_jump{};       ///< a larger change of dq/ds at a joint is a corner: the machine stops
    Ratio<S> turn = literal<Ratio<S>>(0.0613); ///< largest change of direction within a cell [rad]
    Ratio<S> curvature_change =
        literal<Ratio<S>>(0.0127); ///< largest change of curvature times length within a cell [rad]
    Ratio<S> curvature_bend = literal<Ratio<S>>(0.0037); ///< the same for the second difference of curvature
    Ratio<S> metric_ratio = literal<Ratio<S>>(1.2173);   ///< largest ratio of two |dr/dw| within a cell
    /// largest |d2q/ds2| of an axis [1/mm]; a piece that bends more is passed as a cusp
    S sharpest = from_integer<S>(PieceMeasure<S>::sharpest);
    /// largest relative difference of a 4th and a 6th order length; float cannot resolve less
    Ratio<S> metric_error = literal<Ratio<S>>(std::same_as<S, float> ? 1.13e-5 : 1.13e-6);
    /// largest relative error of the inverse's slope in the middle of a cell: it bounds the fluctuation of the feed
    Ratio<S> inverse_error = literal<Ratio<S>>(std::same_as<S, float> ? 3.1e-5 : 3.1e-6);
};

} // namespace splinefeed
