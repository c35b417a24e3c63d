// SPDX-License-Identifier: MIT
// Refinement: how fine the cells of arc length are, and where their segments may lead.
#pragma once

#include "splinefeed/s2_arc_length/piece.hpp"

#include <limits>

namespace splinefeed {

/// Where an axis may be.
struct PositionRange {
    Position low{std::numeric_limits<std::int64_t>::min()};
    Position high{std::numeric_limits<std::int64_t>::max()};
};

/// How fine the cells are. Thresholds are odd numbers on purpose: no exact input sits on one, so that all scalars
/// decide alike and their traces stay comparable.
template <Scalar S>
struct Refinement {
    S longest_mm{};        ///< longest cell (the resolution of the parameter w in Fixed and float)
    S max_feed_mm_s{};     ///< feed of segments that program none
    S grade_per_feed_sq{}; ///< cells next to a joint are at most feed^2 times this: a fraction of the braking distance
    int finest_grade_log2 = 0;          ///< next to a stop cells are 2^-this of that: jerk-limited motion starts slowly
    int shape_log2 = 0;                 ///< unit of AxisShape: 2^-shape_log2
    int axes = 0;                       ///< that a segment must have; 0: any number
    PerAxis<PositionRange> countable{}; ///< where the control points of a segment must be
    PerAxis<PositionRange> open{};      ///< where an axis may go at full speed; near the ends of its travel it may not
    S end_piece_mm{};                   ///< longest cell across an end of open travel; 0: no axis has one
    PerAxis<S> jump_mm_s{};             ///< largest jump of an axis's speed that rounding may cause at a joint of cells
    S direction_jump{};                 ///< a larger change of dq/ds at a joint is a corner, and a stop
    S turn = literal<S>(0.0613);        ///< largest change of direction within a cell [rad]
    S curvature_change = literal<S>(0.0127); ///< largest change of curvature times length within a cell [rad]
    S curvature_bend = literal<S>(0.0037);   ///< the same for the second difference of curvature
    S metric_ratio = literal<S>(1.2173);     ///< largest ratio of two |dr/dw| within a cell
    /// largest |d2q/ds2| of an axis [1/mm]: what bends more is passed as a cusp
    S sharpest = from_integer<S>(PieceMeasure<S>::sharpest);
    /// largest relative difference of a 4th and a 6th order length; float cannot tell less
    S metric_error = literal<S>(std::same_as<S, float> ? 1.13e-5 : 1.13e-6);
    /// largest relative error of the inverse's slope in the middle of a cell: a bound of the feed fluctuation
    S inverse_error = literal<S>(std::same_as<S, float> ? 3.1e-5 : 3.1e-6);
};

} // namespace splinefeed
