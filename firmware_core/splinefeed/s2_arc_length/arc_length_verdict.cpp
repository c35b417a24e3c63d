// SPDX-License-Identifier: MIT
//
// Whether a piece of a segment can be a cell.
#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"
#include "splinefeed/s2_arc_length/arc_length.hpp"

namespace splinefeed {

namespace {

// Below this, halving adds more rounding to a float than it removes error: the piece is accepted as it is.
template <Scalar S>
constexpr S finest = S{};
template <>
constexpr float finest<float> = 16.0F;

constexpr double long_mm = 64.0; // of a piece that hardly bends

constexpr double least_turn = 0.03;           // rad: of a piece in which terms may cancel
constexpr double shortest_reach = 0.01 / 5.9; // of sqrt(J / v) L over v, where J is 5.9^2 Refinement::error_mm_s3

} // namespace

// Within the braking distance of a stop (7.3 grades), or of a segment that is passed slowly, a cell is at most a grade
// or about a third of its distance to it. (Not exactly a third: on straight lines that would be a tie, and rounding
// would decide.)
template <Scalar S>
bool ArcLength<S>::coarse_near(const Piece<S>& piece, bool start, bool end) const noexcept {
    const auto n = static_cast<unsigned>(current().degree);
    const auto distance_mm = [&](unsigned of_piece, unsigned of_segment) {
        PerAxis<S> gap{};
        for (const unsigned k : indices(current().axes)) {
            gap[k] = piece.control[k][of_piece] - current().control[k][of_segment];
            if constexpr (counts_from_own_start<S>) {
                gap[k] += distance<S>(current().origin[k], piece.start[k], current().unit_log2);
            }
        }
        return scale2(norm(gap, current().axes), current().unit_log2);
    };
    const auto coarse = [&](S gap) {
        return gap < literal<S>(9.1) * grade_mm_ && m_.length_mm > gap / literal<S>(2.93);
    };
    return (start && coarse(distance_mm(0, 0))) || (end && coarse(distance_mm(n, n)));
}

// Whether an end of an axis's open travel lies in the hull of the piece.
template <Scalar S>
bool ArcLength<S>::leaves_open_travel(const Piece<S>& piece) const noexcept {
    for (const unsigned k : indices(current().axes)) {
        const auto [low, high] =
            hull(piece.control[k], current().degree, piece.origin(current(), k), current().unit_log2);
        const PositionRange& open = refinement_.open[k];
        if ((low < open.low && high > open.low) || (low < open.high && high > open.high)) {
            return true;
        }
    }
    return false;
}

// The speed changes near joints, and most near stops. Halving makes cells grow geometrically with the distance from a
// stop. If nothing stops, three halvings are enough; otherwise a slow feed would cut every segment into degenerate
// cells. Between two stops there are at least eight cells: room to start and to brake even in the shortest move. A line
// needs none of it where the plan speeds up and brakes within a cell.
template <Scalar S>
bool ArcLength<S>::too_long(const Piece<S>& piece) const noexcept {
    if (for_any(current().axes,
                [&](unsigned k) { return m_.length_mm * absolute(m_.first[1][k]) > refinement_.longest_mm[k]; })) {
        return true;
    }
    if (refinement_.end_piece_mm > S{} && m_.length_mm > refinement_.end_piece_mm && leaves_open_travel(piece)) {
        return true;
    }
    const bool from_rest_to_rest = stop_before_ && stop_after_;
    if (current().degree == 1 && refinement_.whole_lines != WholeLines::none &&
        (from_rest_to_rest || refinement_.whole_lines == WholeLines::all)) {
        return false;
    }
    if (from_rest_to_rest && piece.level < 3) {
        return true;
    }
    if (m_.length_mm > grade_mm_ && (piece.at_start || piece.at_end) && piece.level < 3) {
        return true;
    }
    return (m_.length_mm > grade_mm_ && coarse_near(piece, slow_before_, slow_after_)) ||
           (m_.length_mm > scale2(grade_mm_, -refinement_.finest_grade_log2) &&
            coarse_near(piece, stop_before_, stop_after_));
}

template <Scalar S>
bool ArcLength<S>::bends_too_much() const noexcept {
    for (const unsigned k : indices(current().axes)) {
        const auto& bend = m_.second;
        const Ratio<S> change = absolute(bend[2][k] - bend[0][k]) * m_.slowest;
        const Ratio<S> uneven = absolute(bend[2][k] - bend[1][k] - (bend[1][k] - bend[0][k])) * m_.slowest;
        if (change > refinement_.curvature_change * m_.slowest + m_.noise ||
            uneven > refinement_.curvature_bend * m_.slowest + m_.noise) {
            return true;
        }
    }
    return false;
}

// The largest v^2 in the middle of a piece, whatever the acceleration a along the path is: of two axes a cancels out of
// |q'' v^2 + q' a| <= A.
template <Scalar S>
S ArcLength<S>::largest_sq_in_turn() const noexcept {
    const PerAxis<Ratio<S>>& tangent = m_.first[1];
    const PerAxis<Ratio<S>>& bend = m_.second[1];
    auto most_sq = largest<S>();
    for (const unsigned i : indices(current().axes)) {
        for (unsigned j = 0; j < i; ++j) {
            const S most =
                refinement_.bend_mm_s2[i] * absolute(tangent[j]) + refinement_.bend_mm_s2[j] * absolute(tangent[i]);
            const S across = lengthened<S>(absolute(bend[i] * tangent[j] - bend[j] * tangent[i]));
            most_sq = smaller(most_sq, quotient_or_max(most * m_.length_mm, across));
        }
    }
    return most_sq;
}

// Whether the jerk that the error e of the shape stands for, e v^3 / L^2, is too large a part of a limit, at the speed
// at which the path could be travelled there. A piece is not cut for that below a hundredth of the way in which the
// jerk changes that speed by itself, sqrt(v^3 / J): nothing has to change so fast.
// But in a sharp turn between axes with other limits, terms that are many times a limit cancel, and more speed is
// possible than without an acceleration along the path. There pieces are cut for twice that speed, as long as the error
// is not mere rounding.
template <Scalar S>
bool ArcLength<S>::errs_too_much() const noexcept {
    const bool jerk_limited = refinement_.error_mm_s3[0] > S{};
    if (!jerk_limited || current().degree == 1 || m_.length_mm > literal<S>(long_mm)) {
        return false;
    }
    const S feed_sq = feed_mm_s_ * feed_mm_s_;
    S speed_sq = feed_sq;
    for (const unsigned k : indices(current().axes)) {
        const S bend = lengthened<S>(PieceMeasure<S>::bound(m_.second, k));
        speed_sq = smaller(speed_sq, quotient_or_max(refinement_.bend_mm_s2[k] * m_.length_mm, bend));
    }
    S in_turn_sq{};
    if (m_.sharpest_bend(current().axes) > literal<Ratio<S>>(least_turn)) {
        in_turn_sq = smaller(feed_sq, largest_sq_in_turn());
    }
    const bool cancels = scale2(in_turn_sq, -1) > speed_sq;
    const S speed = cancels ? scale2(square_root(in_turn_sq), 1) : square_root(speed_sq);
    for (const unsigned k : indices(current().axes)) {
        const Ratio<S> error = m_.shape(k).error_bound;
        const S reach = square_root(quotient_or_max(refinement_.error_mm_s3[k], speed)) * m_.length_mm;
        if ((cancels ? error > times(16, m_.noise) : reach > literal<S>(shortest_reach) * speed) &&
            reach < square_root(lengthened<S>(error)) * speed) {
            return true;
        }
    }
    return false;
}

// Measures a piece until it is known whether it can be a cell; if it can, completely.
template <Scalar S>
auto ArcLength<S>::judge(const Piece<S>& piece) noexcept -> Verdict {
    const int axes = current().axes;
    m_.differentiate(piece, current().degree, axes);
    const bool last = piece.level == deepest || m_.in_segment(m_.fastest) < finest<S>; // then it is a cell or a cusp
    if (m_.in_segment(m_.slowest) < nothing_ || m_.fastest > m_.slowest * refinement_.metric_ratio) {
        return last || piece.vanishes(current().axes, current().degree, nothing_) ? Verdict::cusp : Verdict::coarse;
    }
    m_.measure_length(axes, current().unit_log2);
    if (!last && too_long(piece)) {
        return Verdict::coarse;
    }
    if (!last && m_.length_error > times(8, refinement_.metric_error * m_.length + m_.noise)) {
        return Verdict::coarse;
    }
    if (largest_size(difference(m_.first[2], m_.first[0], axes), axes) > refinement_.turn) {
        return last ? Verdict::cusp : Verdict::coarse;
    }
    m_.invert();
    if (!last && (m_.slope_error() > refinement_.inverse_error * m_.length + m_.noise ||
                  m_.shape_error > scale2(refinement_.inverse_error, 14))) {
        return Verdict::coarse;
    }
    m_.measure_curvature(axes, current().unit_log2);
    if (!last && (bends_too_much() || errs_too_much())) {
        return Verdict::coarse;
    }
    // For a piece that bends more, even the slowest speed of a plan is too fast.
    // A long one turns by less than that allows, and the product would not fit.
    const bool flat = m_.length_mm > literal<S>(long_mm) ||
                      lengthened<S>(m_.sharpest_bend(axes)) < refinement_.sharpest * m_.length_mm;
    return flat ? Verdict::fine : Verdict::cusp;
}

#define SPLINEFEED_INSTANTIATE(S) template auto ArcLength<S>::judge(const Piece<S>&) noexcept->Verdict;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
