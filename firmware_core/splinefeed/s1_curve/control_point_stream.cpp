// SPDX-License-Identifier: MIT
//
// Control point d_i is the blossom f(t_{i-1}, t_i, t_{i+1}) of the cubic pieces around knot i. At the clamped ends of a
// run t_{a-1} = t_a, so d_a is the first inner Bezier point. With spans h_i = t_{i+1} - t_i (0 outside the run):
//
//   before knot i: f(t_{i-1}, t_i, t_i) = lambda d_{i-1} + (1 - lambda) d_i, lambda = h_i / (h_{i-2} + h_{i-1} + h_i)
//   after knot i:  f(t_i, t_i, t_{i+1}) = (1 - mu) d_i + mu d_{i+1},         mu = h_{i-1} / (h_{i-1} + h_i + h_{i+1})
//   at knot i:     f(t_i, t_i, t_i) = P_i = (1 - omega) before + omega after, omega = h_{i-1} / (h_{i-1} + h_i)
//
// The last line, read as an equation for the d, is the interpolation condition: a tridiagonal, totally positive system.
// Written with the offsets delta_i = d_i - P_i it contains only differences of waypoints, a = (1-omega) lambda, c =
// omega mu:
//
//   a delta_{i-1} + (1 - a - c) delta_i + c delta_{i+1} = a (P_i - P_{i-1}) - c (P_{i+1} - P_i)
//
// So the result does not depend on the origin, and single precision is enough far from it. Natural start (b0 - 2 b1 +
// b2 = 0): (1 + f) delta_a - f delta_{a+1} = f e_a, f = h_a / (h_a + h_{a+1}); the end in the same way.
//
// Weighted joints: h_i in lambda (before knot i) and h_{i-1} in mu (after it) are multiplied by gamma_i, the outer
// spans by the gamma of their knots; omega does not change. All weights stay in [0, 1] for 0 < gamma <= 1, so the
// system stays totally positive. g2_bezier_test measures that such a joint satisfies r'' = beta1^2 q'' + beta2 q'.
//
// Streaming: rows are eliminated once, in order (delta_i = rho_i - gamma_i delta_{i+1}). A control point is committed
// by back-substitution from the newest row, which is closed by delta_{R+1} = delta_R. The influence of this guess falls
// by a factor of 0.268 per knot for even spacing (measured: 2e-8 mm also at spacings of 1000:1). Row i+1 never depends
// on committed offsets, so the error does not accumulate.
//
// By tangents (float): d_i lies up to a third of a span from P_i, and its offset is rounded by u = 2^-24 of that.
// Beside a span of 10 mm, 2e-7 mm would be left of it in legs of 0.01 mm: a curvature of 2e-3 / mm. The derivative t_i
// by the parameter of the piece before knot i is rounded relative to that piece. With e_i = P_{i+1} - P_i, beta1_i =
// h_i / h_{i-1} and r = 1 / beta1_i (derived in g2_bezier.cpp; here omega' = 1 - omega):
//
//   omega' beta1_{i-1} t_{i-1} + (2 + beta2 r omega / 2) t_i + omega r t_{i+1} = 3 (omega' e_{i-1} + omega r e_i)
//   t_i = rho_i - gamma_i t_{i+1}, closed by t_{R+1} = beta1_R t_R
//
// Over their spans the rows are diagonally dominant: a tangent keeps its 24 bits for any ratio of the spans. The curve
// passes through its waypoints, and the limited look-ahead changes curvatures, by a factor of 0.268 per knot for even
// spacing, 0.5 at most. Of 14 knots this is less than what 24 bits leave of a curvature.
#include "splinefeed/s1_curve/control_point_stream.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

// Row i of the tangents. It is known whether knot i + 1 is a corner.
template <Scalar S, class Joints>
void ControlPointStream<S, Joints>::eliminate_tangent(std::uint64_t i) noexcept {
    const S one = from_integer<S>(1);
    const S three = from_integer<S>(3);
    Row& here = row(i);
    const Knot<S>& knot = this->knot(i);
    here.mu = one;
    if (i == first_) {
        const bool given = tangents_.has_start && i == 0;
        here.gamma = given ? S{} : literal<S>(0.5);
        here.rho = given ? tangents_.start : knot.chord;
        scale(here.rho, given ? knot.length : literal<S>(1.5), this->axes());
        return;
    }
    const Row& previous = row(i - 1);
    const Knot<S>& knot_before = this->knot(i - 1);
    S before_weight = previous.mu;
    S chord_weight = three;
    S after_weight{};
    S diagonal = from_integer<S>(2);
    if (knot.breaks) { // the end of the run
        if (tangents_.has_end && this->finished_ && i + 1 == this->known_) {
            here.gamma = S{};
            here.rho = tangents_.end;
            scale(here.rho, knot_before.length, this->axes());
            return;
        }
    } else {
        const S whole = knot_before.span + knot.span;
        const S others = knot.span / whole;
        const S r = knot_before.span / knot.span;
        after_weight = r * (knot_before.span / whole);
        diagonal += joints_.tension(after_weight);
        before_weight = others * previous.mu;
        chord_weight = three * others;
        here.mu = knot.span / knot_before.span;
    }
    const S inverse = one / (diagonal - before_weight * previous.gamma);
    here.gamma = after_weight * inverse;
    for (const unsigned k : indices(this->axes())) {
        here.rho[k] = (chord_weight * knot_before.chord[k] + three * after_weight * knot.chord[k] -
                       before_weight * previous.rho[k]) *
                      inverse;
    }
}

template <Scalar S, class Joints>
bool ControlPointStream<S, Joints>::eliminate_row(std::uint64_t i) noexcept {
    const auto axes_u = static_cast<unsigned>(this->axes());
    const S one = from_integer<S>(1);
    if (!this->decided(i)) {
        return false;
    }
    Row& here = row(i);
    const Knot<S>& knot = this->knot(i);
    const bool ends = i > first_ && knot.breaks;
    if (!ends && !this->decided(i + 1)) {
        return false;
    }
    if (by_tangents()) {
        eliminate_tangent(i);
        return true;
    }
    if (ends) { // the end of the run
        const Row& before = row(i - 1);
        const Knot<S>& knot_before = this->knot(i - 1);
        const S two_before = i - 1 > first_ ? this->knot(i - 2).span : S{};
        const SpansAround<S> spans = joints_.around(two_before, knot_before.span, S{}, S{});
        const S g = spans.before / (spans.before + spans.outer_before);
        const bool given = tangents_.has_end && this->finished_ && i + 1 == this->known_;
        const S inverse = one / (one + g + g * before.gamma);
        for (unsigned k = 0; k < axes_u; ++k) {
            here.rho[k] = given ? -tangents_.end[k] * knot_before.length / from_integer<S>(3)
                                : (g * before.rho[k] - g * knot_before.chord[k]) * inverse;
        }
        here.gamma = here.lambda = here.mu = here.omega = S{};
        return true;
    }
    const S two_after = this->knot(i + 1).breaks ? S{} : this->knot(i + 1).span;
    if (i == first_) {
        const SpansAround<S> spans = joints_.around(S{}, S{}, knot.span, two_after);
        const S f = spans.after / (spans.after + spans.outer_after);
        const S weight = f / (one + f);
        const bool given = tangents_.has_start && i == 0;
        for (unsigned k = 0; k < axes_u; ++k) {
            here.rho[k] = given ? tangents_.start[k] * knot.length / from_integer<S>(3) : weight * knot.chord[k];
        }
        here.gamma = given ? S{} : -weight;
        here.lambda = here.mu = here.omega = S{};
        return true;
    }
    const Knot<S>& knot_before = this->knot(i - 1);
    const S two_before = i - 1 > first_ ? this->knot(i - 2).span : S{};
    const auto [outer_before, before, after, outer_after, gamma] =
        joints_.around(two_before, knot_before.span, knot.span, two_after);
    S inner_before = before; // the part of the leg after knot i
    S inner_after = after;   // the part of the leg before knot i
    if constexpr (Joints::weighted) {
        inner_before = gamma * before;
        inner_after = gamma * after;
    }
    here.lambda = inner_after / (outer_before + before + inner_after);
    here.mu = inner_before / (inner_before + after + outer_after);
    here.omega = before / (before + after);
    const S others = after / (before + after); // 1 - omega, with all its bits even if the spans differ a lot
    const S a = others * here.lambda;
    const S b = others * ((outer_before + before) / (outer_before + before + inner_after)) +
                here.omega * ((after + outer_after) / (inner_before + after + outer_after));
    const S c = here.omega * here.mu;
    const Row& previous = row(i - 1);
    const S inverse = one / (b - a * previous.gamma);
    here.gamma = c * inverse;
    for (unsigned k = 0; k < axes_u; ++k) {
        here.rho[k] = (a * (knot_before.chord[k] - previous.rho[k]) - c * knot.chord[k]) * inverse;
    }
    return true;
}

// Commits the offsets of the control points up to the end, by back-substitution from the newest eliminated row.
template <Scalar S, class Joints>
void ControlPointStream<S, Joints>::commit(std::uint64_t end) noexcept {
    if (committed_ == end) {
        return;
    }
    const auto axes_u = static_cast<unsigned>(this->axes());
    const std::uint64_t newest = rows_end_ - 1;
    const bool run_ended = newest > first_ && this->knot(newest).breaks;
    S of_next = row(newest).gamma;
    if (by_tangents()) {
        of_next = of_next * row(newest).mu;
    }
    const S closing = run_ended ? S{} : from_integer<S>(1) / (from_integer<S>(1) + of_next);
    const auto behind = static_cast<unsigned>(rows_end_ - end); // rows that nothing is committed of yet
    const auto rows = static_cast<unsigned>(rows_end_ - committed_);
    for (unsigned k = 0; k < axes_u; ++k) {
        S delta = run_ended ? row(newest).rho[k] : row(newest).rho[k] * closing;
        for (unsigned back = 0;;) {
            if (back >= behind) {
                row(newest - back).delta[k] = delta;
            }
            if (++back == rows) {
                break;
            }
            const Row& before = row(newest - back);
            delta = before.rho[k] - before.gamma * delta;
        }
    }
    while (committed_ < end) {
        close_seam(committed_++);
    }
}

// A closed curve must meet itself exactly: the three offsets around the seam are stored when they are first committed,
// and used again when the path comes back to them.
template <Scalar S, class Joints>
void ControlPointStream<S, Joints>::close_seam(std::uint64_t i) noexcept {
    const auto role = [this](std::uint64_t j) {
        return this->knot(j).role;
    };
    for (unsigned slot = 0; slot < 3; ++slot) { // i is the knot before (0), at (1), after (2) the seam
        const std::uint64_t seam = i + 1 - slot;
        const bool beyond_run = slot == 0 && i > first_ && this->knot(i).breaks;
        if (seam == 0 || seam < first_ || beyond_run || seam + 1 >= this->known_) {
            continue;
        }
        const bool opens = seam > first_ && role(seam - 1) == Role::lead_in && role(seam) == Role::path;
        const bool closes = role(seam) == Role::path && role(seam + 1) == Role::lead_out;
        if (closes && seam_known_) {
            row(i).delta = seam_[slot];
        } else if (opens && !this->knot(seam).breaks) {
            seam_[slot] = row(i).delta;
            seam_known_ = slot == 2;
        }
    }
}

template <Scalar S, class Joints>
void ControlPointStream<S, Joints>::emit(std::uint64_t i, CurveSegment<S>& out) noexcept {
    this->describe_segment(i, 3, out);
    const Row& from = row(i);
    const Row& to = row(i + 1);
    const Knot<S>& knot = this->knot(i);
    const Knot<S>& knot_to = this->knot(i + 1);
    PerAxis<PerDegree<S>> offsets{};
    if (by_tangents()) {
        const S third = literal<S>(1.0 / 3.0);
        for (const unsigned k : indices(this->axes())) {
            offsets[k][1] = third * from.mu * from.delta[k];
            offsets[k][2] = knot.chord[k] - third * to.delta[k];
            offsets[k][3] = knot.chord[k];
        }
        out.assign(offsets);
        return;
    }
    for (const unsigned k : indices(this->axes())) {
        const S end = knot.chord[k]; // P_{i+1} seen from P_i
        const S next = end + to.delta[k];
        const S step = next - from.delta[k]; // d_{i+1} - d_i
        offsets[k][0] = joint_[k];
        offsets[k][1] = from.delta[k] + from.mu * step;
        offsets[k][2] = next - to.lambda * step;
        if (knot_to.breaks) {
            joint_[k] = S{};
        } else {
            const S beyond = knot_to.chord[k] + row(i + 2).delta[k] - to.delta[k]; // d_{i+2} - d_{i+1}
            const S after = to.delta[k] + to.mu * beyond;
            const S before = to.delta[k] - to.lambda * step;
            joint_[k] = before + to.omega * (after - before);
        }
        offsets[k][3] = end + joint_[k];
    }
    out.assign(offsets);
}

template <Scalar S, class Joints>
Pull ControlPointStream<S, Joints>::next(CurveSegment<S>& out) noexcept {
    for (;;) {
        const std::uint64_t i = next_;
        if (i + 1 >= this->known_) {
            return this->finished_ ? Pull::finished : Pull::starved;
        }
        // Row i + 15 needs knot i + 17: 16 waypoints after the end of segment i.
        const auto ended = [this] {
            return rows_end_ > first_ + 1 && this->knot(rows_end_ - 1).breaks;
        };
        while (!ended() && rows_end_ < i + look_ahead && eliminate_row(rows_end_)) {
            ++rows_end_;
        }
        if (!ended() && rows_end_ < i + look_ahead) {
            return Pull::starved;
        }
        // Its ends are shaped by their tangents, or by the control points up to the one behind it.
        commit(larger(committed_, smaller(i + (by_tangents() ? 2U : 3U), rows_end_)));
        emit(i, out);
        const bool wanted = this->travelled(i);
        next_ = i + 1;
        this->oldest_ = i > 1 ? i - 1 : 0;
        if (this->knot(i + 1).breaks) {
            first_ = rows_end_ = committed_ = i + 1;
        }
        if (wanted) {
            return Pull::item;
        }
    }
}

template <Scalar S>
Status BetaJoints<S>::check() const noexcept {
    if (!(beta1 > S{})) {
        return Error::beta1_not_positive;
    }
    if (!(beta2 >= S{} && beta2 <= from_integer<S>(1000))) {
        return Error::beta2_out_of_range;
    }
    if (span_ratio) {
        return {};
    }
    if (beta1 < literal<S>(0.125) || beta1 > from_integer<S>(8)) {
        return Error::beta1_out_of_range;
    }
    const S one = from_integer<S>(1);
    const S square = beta1 * beta1;
    const S room = scale2(square + beta1, 1) + scale2(beta2, -1);
    return beta1 * square + one <= room ? Status{} : Status{Error::beta1_out_of_range};
}

// 1 / (1 + (beta2 / 2) omega h_{i-1} / h_i)
template <Scalar S>
S BetaJoints<S>::gamma(S span, S next) const noexcept {
    const S one = from_integer<S>(1);
    return one / (one + scale2(beta2, -1) * (span / (span + next)) * (span / next));
}

template <Scalar S>
SpansAround<S> BetaJoints<S>::around(S outer_before, S before, S after, S outer_after) const noexcept {
    const bool from_before = before > S{};
    const bool from_after = after > S{};
    if (!span_ratio) { // as ratios, which stay in range for any number of joints
        const S one = from_integer<S>(1);
        outer_before = outer_before > S{} ? one / beta1 : S{};
        outer_after = outer_after > S{} ? beta1 * beta1 : S{};
        before = from_before ? one : S{};
        after = from_after ? beta1 : S{};
    }
    SpansAround<S> out{outer_before, before, after, outer_after, from_integer<S>(1)};
    if (outer_before > S{}) {
        out.outer_before = gamma(outer_before, before) * outer_before;
    }
    if (outer_after > S{}) {
        out.outer_after = gamma(after, outer_after) * outer_after;
    }
    if (from_before && from_after) {
        out.gamma = gamma(before, after);
    }
    return out;
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template struct BetaJoints<S>;                                                                                     \
    template class ControlPointStream<S, PlainJoints<S>>;                                                              \
    template class ControlPointStream<S, BetaJoints<S>>;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
