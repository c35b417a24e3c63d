// SPDX-License-Identifier: MIT
#include "splinefeed/s2_arc_length/arc_length.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"
#include "splinefeed/s2_arc_length/control_rounding.hpp"

namespace splinefeed {

namespace {

// A segment is passed slowly if v^2 = A r, r its mean radius, is below a quarter of feed^2 = 14.6 A grades: a radius of
// 3.6 grades.
constexpr double slow_grades = 3.6;

} // namespace

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
    out.stop_before = cusp_ == Cusp::behind;
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
        cusp_from_[k] = cusp_ == Cusp::in ? cusp_from_[k] : displaced(origin, control[0], current().unit_log2);
        cusp_to_[k] = displaced(origin, control[static_cast<unsigned>(current().degree)], current().unit_log2);
    }
    cusp_ = Cusp::in;
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
    cusp_ = Cusp::behind;
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
            if (cusp_ == Cusp::in) {
                fill_chord(false, out); // it comes first; this piece is judged again
                return Pull::item;
            }
            fill(top(), out);
            cusp_ = Cusp::none;
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
