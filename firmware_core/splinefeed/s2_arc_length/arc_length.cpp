// SPDX-License-Identifier: MIT
#include "splinefeed/s2_arc_length/arc_length.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"
#include "splinefeed/s2_arc_length/control_rounding.hpp"

namespace splinefeed {

namespace {

// Below this, halving adds more rounding to a float than it removes error: the piece is accepted as it is.
template <Scalar S>
constexpr S finest = S{};
template <>
constexpr float finest<float> = 16.0F;

// A segment is passed slowly if v^2 = A r, r its mean radius, is below a quarter of feed^2 = 14.6 A grades: a radius of
// 3.6 grades.
constexpr double slow_grades = 3.6;

constexpr double long_mm = 64.0; // of a piece that hardly bends

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
    for (const unsigned k : indices(current().axes)) {
        if (m_.length_mm * absolute(m_.first[1][k]) > refinement_.longest_mm[k]) {
            return true;
        }
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

// Whether the jerk that the error e of the shape stands for, e v^3 / L^2, is too large a part of a limit, at the speed
// at which the path could be travelled there. A piece is not cut for that below a hundredth of the way in which the
// jerk changes that speed by itself, sqrt(v^3 / J): nothing has to change so fast.
template <Scalar S>
bool ArcLength<S>::errs_too_much() const noexcept {
    if (current().degree == 1 || m_.length_mm > literal<S>(long_mm)) {
        return false;
    }
    S speed_sq = feed_mm_s_ * feed_mm_s_;
    for (const unsigned k : indices(current().axes)) {
        const S bend = lengthened<S>(PieceMeasure<S>::bound(m_.second, k));
        speed_sq = smaller(speed_sq, quotient_or_max(refinement_.bend_mm_s2[k] * m_.length_mm, bend));
    }
    const S speed = square_root(speed_sq);
    for (const unsigned k : indices(current().axes)) {
        const S reach = square_root(quotient_or_max(refinement_.error_mm_s3[k], speed)) * m_.length_mm;
        if (reach > literal<S>(shortest_reach) * speed &&
            reach < square_root(lengthened<S>(m_.shape(k).error_bound)) * speed) {
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
    Ratio<S> turn{};
    for (const unsigned k : indices(axes)) {
        turn = larger(turn, absolute(m_.first[2][k] - m_.first[0][k]));
    }
    if (turn > refinement_.turn) {
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

template <Scalar S>
void ArcLength<S>::fill_common(bool at_end, Cell<S>& out) noexcept {
    const CurveSegment<S>& segment = current();
    out.axes = segment.axes;
    out.measured_mm = out.length_mm;
    out.unit_log2 = segment.unit_log2;
    out.feed_mm_s = segment.feed_mm_s;
    out.max_feed_mm_s = segment.max_feed_mm_s;
    out.feed_along_path = segment.feed_along_path;
    out.waypoint = segment.waypoint;
    out.stop_at_end = at_end && stop_after_;
    out.end = segment.end;
    const Position length = displaced(Position{}, out.length_mm, 0);
    travelled_ = add(travelled_, Wide{0U, static_cast<std::uint64_t>(length.raw)});
}

template <Scalar S>
void ArcLength<S>::fill(const Piece<S>& piece, Cell<S>& out) noexcept {
    const auto n = static_cast<unsigned>(current().degree);
    out.length_mm = m_.length_mm;
    out.degree = current().degree;
    out.stop_before = after_cusp_;
    fill_common(piece.at_end, out);
    for (const unsigned k : indices(current().axes)) {
        // The origin moves to the start of the cell, so that offsets stay as small as the cell.
        const Position origin = piece.origin(current(), k);
        out.origin[k] = displaced(origin, piece.control[k][0], current().unit_log2);
        out.power[k][0] = piece.control[k][0] - distance<S>(origin, out.origin[k], current().unit_log2);
    }
    // In units of 2^-12: otherwise Fixed would lose the digits of a small error. Each estimate is 0 somewhere: the two
    // lengths are the same where sigma is a quadratic, and that is so on a straight cubic.
    using R = Ratio<S>;
    const R estimate = larger(m_.length_error, times(2, m_.slope_error()));
    const R error = m_.shape_error + m_.by_length(scale2(estimate, 9));
    const R ripple = scale2(times(40, scale2(error, -6)), -6);
    for (const unsigned k : indices(current().axes)) {
        PerDegree<S>& power = out.power[k]; // the differences of the control points, without power[0]
        for (unsigned j = n; j >= 1; --j) {
            power[j] = piece.control[k][j] - piece.control[k][j - 1];
        }
        for (unsigned i = 2; i <= n; ++i) {
            for (unsigned j = n; j >= i; --j) {
                power[j] = power[j] - power[j - 1];
            }
        }
        for (unsigned i = 1, binomial = 1; i <= n; ++i) {
            binomial = binomial * (n - i + 1) / i;
            power[i] = times(static_cast<int>(binomial), power[i]);
        }
        out.tangent_max[k] = smaller(PieceMeasure<S>::bound(m_.first, k), from_integer<R>(1));
    }
    const DivisionBy<S> by_length(out.length_mm);
    const ControlRounding<S> rounded =
        ControlRounding<S>::of(current(), piece.level, m_.in_segment(m_.slowest), out.tangent_max);
    for (const unsigned k : indices(current().axes)) {
        // The remaining error of the inverse is about c x^3 (1-x)^3 (x-1/2). With the slope e in the middle its second
        // derivative reaches 8 e, an acceleration of 8 e v^2 / L along the tangent; 10 e is allowed for. Of the other
        // estimates of e, which are of the right order only, it is 40 e. Rounding of the control points bends the
        // curve.
        const R rounding = out.tangent_max[k] * ripple + shortened<R>(rounded.bend[k]) + half(AxisShape<S>::rounding);
        const R bend = PieceMeasure<S>::bound(m_.second, k) + rounding;
        out.curvature_max[k] = smaller(lengthened<S>(bend) / by_length, from_integer<S>(PieceMeasure<S>::sharpest));
        out.shape[k] = shape_of(k, bend, rounding, out);
    }
    if (piece.at_end || counts_from_own_start<S>) {
        arrive(out);
    }
    for (unsigned i = 0; i < m_.inverse.size(); ++i) {
        out.inverse[i] = times(4, i == 0 ? m_.inverse[0] - from_integer<R>(1) : m_.inverse[i]);
    }
    out.steady_mm_s = rounded.steady_speed(refinement_.jump_mm_s, out.axes);
}

// Where a piece on the stack ends: where the piece below it begins, or where the next segment begins.
template <Scalar S>
Position ArcLength<S>::end_of(int piece, unsigned axis) const noexcept {
    if constexpr (counts_from_own_start<S>) {
        if (piece > 0) {
            return stack_[static_cast<unsigned>(piece - 1)].start[axis];
        }
    }
    return stop_after_ ? current().end[axis] : slots_[1 - current_].start(axis);
}

// Rounded control points move the end of their piece. To avoid a step of the path there, the cell ends where the next
// one begins. steady_speed() allows for the change of its slope.
template <Scalar S>
void ArcLength<S>::arrive(Cell<S>& cell) const noexcept {
    for (const unsigned k : indices(cell.axes)) {
        S rest = distance<S>(cell.origin[k], end_of(depth_ - 1, k), cell.unit_log2);
        for (unsigned i = 0; i <= static_cast<unsigned>(cell.degree); ++i) {
            rest = rest - cell.power[k][i];
        }
        cell.power[k][1] = cell.power[k][1] + rest;
    }
}

// The shape of an axis without curvature, with the largest slope that it has anywhere in the cell.
template <Scalar S>
AxisShape<S> ArcLength<S>::largest_shape(unsigned axis, const Cell<S>& cell) const noexcept {
    const Ratio<S> tangent = cell.tangent_max[axis];
    return {{tangent, tangent}, {}, {}};
}

// A piece that was accepted as it is may turn by more than normal cells. Then the largest values are used for the whole
// cell. To prevent an overflow in Fixed, the plan also limits its speed (SpeedCaps). `bend`: largest length |d2q/ds2|.
template <Scalar S>
AxisShape<S> ArcLength<S>::shape_of(unsigned axis, Ratio<S> bend, Ratio<S> rounding,
                                    const Cell<S>& cell) const noexcept {
    const bool sharp = bend > literal<Ratio<S>>(Cell<S>::sharp_turn / 2.0);
    AxisShape<S> shape = sharp ? largest_shape(axis, cell) : m_.shape(axis);
    shape.error_bound =
        sharp ? smaller(times(2, bend), from_integer<Ratio<S>>(2)) : shape.error_bound + times(2, rounding);
    return shape;
}

// Adds a piece to the cusp that is being passed.
template <Scalar S>
void ArcLength<S>::extend_cusp(const Piece<S>& piece) noexcept {
    for (const unsigned k : indices(current().axes)) {
        const Position origin = piece.origin(current(), k);
        const PerDegree<S>& control = piece.control[k];
        cusp_from_[k] = in_cusp_ ? cusp_from_[k] : displaced(origin, control[0], current().unit_log2);
        cusp_to_[k] = displaced(origin, control[static_cast<unsigned>(current().degree)], current().unit_log2);
    }
    in_cusp_ = true;
}

// The rest of a cusp, or a piece that a float cannot halve any more: its chord, from stop to stop.
template <Scalar S>
void ArcLength<S>::fill_chord(bool at_end, Cell<S>& out) noexcept {
    PerAxis<S> chord{};
    for (const unsigned k : indices(current().axes)) {
        chord[k] = distance<S>(cusp_from_[k], cusp_to_[k], current().unit_log2);
        out.power[k][0] = S{};
        out.power[k][1] = chord[k];
        out.tangent_max[k] = from_integer<Ratio<S>>(1);
        out.curvature_max[k] = S{};
        out.shape[k] = largest_shape(k, out);
    }
    // Not zero, so that time passes.
    out.length_mm = larger(scale2(norm(chord, current().axes), current().unit_log2), literal<S>(1e-8));
    out.inverse = {};
    out.steady_mm_s = largest<S>();
    out.degree = 1;
    out.stop_before = true;
    out.origin = cusp_from_;
    fill_common(at_end, out);
    in_cusp_ = false;
    after_cusp_ = true;
}

// Makes the next segment current. Unless it stops, it waits for the one after it: a stop at its end shapes its cells.
template <Scalar S>
Pull ArcLength<S>::load() noexcept {
    if (!has_current_) {
        const Pull pull = has_ahead_ ? Pull::item : source_.next(slots_[current_]);
        has_current_ = pull == Pull::item;
        if (!has_current_ || !has_ahead_) { // the first segment of all: the one after it is another step
            return pull;
        }
        has_ahead_ = false;
    }
    CurveSegment<S>& ahead = slots_[1 - current_];
    const Pull pull = source_.next(ahead);
    if (pull == Pull::starved && !current().stop_at_end) {
        return Pull::starved;
    }
    has_ahead_ = pull == Pull::item;
    stop_after_ = current().stop_at_end || !has_ahead_ || direction_jumps(current(), ahead, refinement_.direction_jump);
    if (counts_from_own_start<S> && stop_after_ && has_ahead_) {
        // From where it stands: a long segment's rounding would be a step
        for (const unsigned k : indices(ahead.axes)) {
            ahead.origin[k].raw += current().end[k].raw - ahead.start(k).raw;
        }
    }
    const S block = current().block_feed_mm_s();
    const S feed = block > S{} ? smaller(block, refinement_.max_feed_mm_s) : refinement_.max_feed_mm_s;
    // Below 2e-8 mm Fixed has no digits for a length; a cell of 2 nm still has some.
    nothing_ = larger(negligible_units<S>, scale2(literal<S>(2e-8), -current().unit_log2));
    feed_mm_s_ = feed;
    grade_mm_ = larger(feed * feed * refinement_.grade_per_feed_sq, literal<S>(2e-6));
    slow_ = slow_after_;
    slow_after_ = has_ahead_ && !stop_after_ && turns_within(ahead, literal<S>(slow_grades) * grade_mm_);
    if constexpr (!counts_from_own_start<S>) { // in float a direction has too few digits to tell
        current().straighten();
    }
    stack_[0].control = current().control;
    if constexpr (counts_from_own_start<S>) {
        for (const unsigned k : indices(current().axes)) {
            stack_[0].start[k] = current().origin[k];
            stack_[0].begin_at_start(k, current().degree, current().unit_log2);
        }
    }
    stack_[0].level = 0;
    stack_[0].at_start = stack_[0].at_end = true;
    depth_ = 1;
    ++segments_;
    return Pull::item;
}

// Replaces the piece on top of the stack by its halves, with the earlier one on top.
template <Scalar S>
void ArcLength<S>::split() noexcept {
    Piece<S>& right = top();
    ++depth_;
    Piece<S>& left = top();
    ++right.level;
    left.level = right.level;
    left.at_start = right.at_start;
    left.at_end = right.at_start = false;
    right.halve(current().axes, current().degree, left.control, right.control);
    if constexpr (counts_from_own_start<S>) {
        left.start = right.start;
        for (const unsigned k : indices(current().axes)) {
            const Position end = end_of(depth_ - 2, k);
            right.begin_at_start(k, current().degree, current().unit_log2);
            right.lead_to(end, k, current().degree, current().unit_log2);
        }
    }
}

template <Scalar S>
Pull ArcLength<S>::next(Cell<S>& out, WorkBudget& work) noexcept {
    while (depth_ == 0) {
        const Pull pull = work.take(segment_steps) ? load() : Pull::busy;
        if (pull != Pull::item) {
            return pull;
        }
    }
    while (work.take(piece_steps)) {
        if (const Verdict verdict = judge(top()); verdict == Verdict::coarse) {
            split();
        } else if (verdict == Verdict::fine) {
            if (in_cusp_) {
                fill_chord(false, out); // it comes first; this piece is judged again
                return Pull::item;
            }
            fill(top(), out);
            after_cusp_ = false;
            leave();
            return Pull::item;
        } else {
            extend_cusp(top());
            if (top().at_end) {
                fill_chord(true, out);
                leave();
                return Pull::item;
            }
            --depth_;
        }
    }
    return Pull::busy;
}

// Removes the delivered piece from the stack, and the segment if it was its last piece.
template <Scalar S>
void ArcLength<S>::leave() noexcept {
    --depth_;
    if (depth_ == 0) {
        stop_before_ = stop_after_;
        slow_before_ = slow_;
        current_ ^= 1U;
        has_current_ = false;
    }
}

SPLINEFEED_INSTANTIATE_CLASS(ArcLength)

} // namespace splinefeed
