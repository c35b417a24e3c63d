// SPDX-License-Identifier: MIT
//
// A piece is measured at w = 0, 1/2, 1. With sigma = |dr/dw| and its derivative there, the length is
//
//   L = (7 sigma_0 + 16 sigma_m + 7 sigma_1) / 30 + (sigma_0' - sigma_1') / 60       (error of order 7 in the step)
//
// the integral of the quartic through these five values. Five-point data that the bounds need anyway replace the extra
// evaluations of Gauss-Legendre. The difference to the end-point rule (sigma_0 + sigma_1)/2 + (sigma_0' - sigma_1')/12,
// of order 5, decides whether the piece is halved; the sextic inverse w(s) is two orders better than what is tested. Bounds over the cell are the largest of three samples plus a quarter of their second difference: twice what a
// parabola through them can exceed them by.
#include "splinefeed/s2_arc_length/arc_length.hpp"

namespace splinefeed {

namespace {

// Control points are below 2^16 units; 24 of their roundings enter a second derivative of a cubic, twice that is allowed.
template <Scalar S>
constexpr S control_noise = literal<S>(1e-8);
template <>
constexpr float control_noise<float> = 48.0F * 65536.0F / 16777216.0F;

template <Scalar S>
S half(S x) noexcept {
    return scale2(x, -1);
}

} // namespace

template <Scalar S>
struct ArcLength<S>::Measure {
    std::array<PerAxis<S>, 3> first{};  // dr/dw, then dq/ds
    std::array<PerAxis<S>, 3> second{}; // d2r/dw2, then d2q/ds2 [1/mm]
    std::array<S, 3> sigma{};
    std::array<S, 3> slope{}; // dsigma/dw
    S length{};               // in units of the segment
    S length_mm{};
};

// Halves every axis by de Casteljau at 1/2 (exact but for the last bit) and takes the derivatives on the way.
template <Scalar S>
void ArcLength<S>::measure(const Piece& piece, Measure& m) noexcept {
    const auto n = static_cast<unsigned>(current().degree);
    const S degree = from_integer<S>(static_cast<std::int32_t>(n));
    const S degree2 = from_integer<S>(static_cast<std::int32_t>(n * (n - 1)));
    for (unsigned k = 0; k < static_cast<unsigned>(current().axes); ++k) {
        const PerDegree<S>& b = piece.control[k];
        m.first[0][k] = (b[1] - b[0]) * degree;
        m.first[2][k] = (b[n] - b[n - 1]) * degree;
        if (n > 1) {
            m.second[0][k] = (b[2] - b[1] - (b[1] - b[0])) * degree2;
            m.second[2][k] = (b[n] - b[n - 1] - (b[n - 1] - b[n - 2])) * degree2;
        }
        PerDegree<S>& left = left_[k];
        PerDegree<S>& right = right_[k];
        for (unsigned i = 0; i <= n; ++i) {
            right[i] = b[i];
        }
        left[0] = right[0];
        for (unsigned step = 1; step <= n; ++step) {
            if (step == n - 1 && n > 1) {
                m.second[1][k] = (right[2] - right[1] - (right[1] - right[0])) * degree2;
            }
            if (step == n) {
                m.first[1][k] = (right[1] - right[0]) * degree;
            }
            for (unsigned i = 0; i + step <= n; ++i) {
                right[i] = half(right[i] + right[i + 1]);
            }
            left[step] = right[0];
        }
    }
}

// Turns raw derivatives into dq/ds and d2q/ds2 and decides whether the piece can be one cell.
template <Scalar S>
auto ArcLength<S>::judge(const Piece& piece, Measure& m) const noexcept -> Verdict {
    const int axes = current().axes;
    const auto axes_u = static_cast<unsigned>(axes);
    // Below 2^-8 units of a segment that is 2^15 units long the tangent is rounding noise: a cusp.
    const S vanishing = literal<S>(1.0 / 256.0);
    S fastest{};
    S slowest{};
    for (unsigned p = 0; p < 3; ++p) {
        m.sigma[p] = norm(m.first[p].data(), axes);
        fastest = larger(fastest, m.sigma[p]);
        slowest = p == 0 ? m.sigma[p] : smaller(slowest, m.sigma[p]);
    }
    if (slowest < vanishing || fastest > slowest * refinement_.metric_ratio) {
        return Verdict::cusp;
    }
    for (unsigned p = 0; p < 3; ++p) {
        S slope{};
        for (unsigned k = 0; k < axes_u; ++k) {
            m.first[p][k] = m.first[p][k] / m.sigma[p];
            slope += m.first[p][k] * m.second[p][k];
        }
        m.slope[p] = slope;
    }
    const S ends = m.sigma[0] + m.sigma[2];
    const S bend = m.slope[0] - m.slope[2];
    // Divided, not multiplied by rounded constants: their error would be the same in every cell and add up.
    m.length = (from_integer<S>(7) * ends + from_integer<S>(16) * m.sigma[1] + half(bend)) / from_integer<S>(30);
    m.length_mm = scale2(m.length, current().unit_log2);
    if (m.length_mm > refinement_.longest_mm) {
        return Verdict::coarse;
    }
    // The speed changes near joints, most of all near stops: cells there are a fraction of the braking distance, which
    // halving grades geometrically. Elsewhere three halvings do, lest a slow feed cut every segment into crumbs.
    const bool stops = (piece.at_start && stop_before_) || (piece.at_end && stop_after_);
    const bool coarse = m.length_mm > grade_mm_ && (piece.at_start || piece.at_end);
    if ((coarse && (stops || piece.level < 3)) || (stops && piece.level < 3)) {
        return Verdict::coarse;
    }
    // Rounding of the control points is no reason to halve: halving would make it larger in proportion.
    const S low_order = half(ends) + literal<S>(1.0 / 12.0) * bend;
    if (absolute(m.length - low_order) > refinement_.metric_error * m.length + control_noise<S>) {
        return Verdict::coarse;
    }
    S turn{};
    for (unsigned k = 0; k < axes_u; ++k) {
        turn = larger(turn, absolute(m.first[2][k] - m.first[0][k]));
    }
    if (turn > refinement_.turn) {
        return Verdict::coarse;
    }
    for (unsigned p = 0; p < 3; ++p) {
        const S scale = m.sigma[p] * scale2(m.sigma[p], current().unit_log2);
        for (unsigned k = 0; k < axes_u; ++k) {
            m.second[p][k] = (m.second[p][k] - m.first[p][k] * m.slope[p]) / scale;
        }
    }
    for (unsigned k = 0; k < axes_u; ++k) {
        const S change = absolute(m.second[2][k] - m.second[0][k]) * m.length_mm;
        const S second = absolute(m.second[2][k] - m.second[1][k] - (m.second[1][k] - m.second[0][k])) * m.length_mm;
        // As seen by second / sigma, here too.
        if (change * slowest > refinement_.curvature_change * slowest + control_noise<S> ||
            second * slowest > refinement_.curvature_bend * slowest + control_noise<S>) {
            return Verdict::coarse;
        }
    }
    return Verdict::fine;
}

template <Scalar S>
void ArcLength<S>::fill_common(const Piece& piece, int degree, Cell<S>& out) noexcept {
    const CurveSegment<S>& segment = current();
    out.axes = segment.axes;
    out.degree = degree;
    out.unit_log2 = segment.unit_log2;
    out.feed_mm_s = segment.feed_mm_s;
    out.waypoint = segment.waypoint;
    out.stop_at_end = piece.at_end && stop_after_;
    out.end = segment.end;
    for (unsigned k = 0; k < static_cast<unsigned>(segment.axes); ++k) {
        // The origin moves to the start of the cell, so that offsets stay as small as the cell.
        const S start = piece.control[k][0];
        out.origin[k] = displaced(segment.origin[k], start, segment.unit_log2);
        out.power[k][0] = start - distance<S>(segment.origin[k], out.origin[k], segment.unit_log2);
    }
}

template <Scalar S>
void ArcLength<S>::fill(const Piece& piece, const Measure& m, Cell<S>& out) noexcept {
    const auto n = static_cast<unsigned>(current().degree);
    fill_common(piece, current().degree, out);
    out.length_mm = m.length_mm;
    for (unsigned k = 0; k < static_cast<unsigned>(current().axes); ++k) {
        PerDegree<S> difference = piece.control[k];
        S binomial = from_integer<S>(1);
        for (unsigned i = 1; i <= n; ++i) {
            for (unsigned j = n; j >= i; --j) {
                difference[j] = difference[j] - difference[j - 1];
            }
            binomial = binomial * from_integer<S>(static_cast<std::int32_t>(n - i + 1)) /
                       from_integer<S>(static_cast<std::int32_t>(i));
            out.power[k][i] = binomial * difference[i];
        }
        const auto bound = [k](const std::array<PerAxis<S>, 3>& f) {
            const S second = absolute(f[2][k] - f[1][k] - (f[1][k] - f[0][k]));
            return larger(absolute(f[0][k]), larger(absolute(f[1][k]), absolute(f[2][k]))) + scale2(second, -2);
        };
        out.tangent_max[k] = smaller(bound(m.first), from_integer<S>(1));
        out.curvature_max[k] = bound(m.second);
    }
    // Inverse w(x): the quintic through dw/dx = L / sigma, d2w/dx2 = -(sigma'/sigma) (L / sigma)^2 at both ends, plus
    // c (x (1 - x))^3 so that it also passes through w = 1/2 where the length of the first half says it is.
    const S g0 = m.length / m.sigma[0];
    const S g1 = m.length / m.sigma[2];
    const S h0 = -half(m.slope[0] / m.sigma[0] * g0 * g0);
    const S h1 = -half(m.slope[2] / m.sigma[2] * g1 * g1);
    const auto times = [](int factor, S x) { return from_integer<S>(factor) * x; };
    out.inverse = {g0,
                   h0,
                   from_integer<S>(10) - times(6, g0) - times(4, g1) - times(3, h0) + h1,
                   from_integer<S>(-15) + times(8, g0) + times(7, g1) + times(3, h0) - times(2, h1),
                   from_integer<S>(6) - times(3, g0) - times(3, g1) - h0 + h1,
                   S{}};
    // Half length of the same quartic: L/2 + 5/32 (sigma_0 - sigma_1) + (sigma_0' + sigma_1') / 64.
    const S middle = half(from_integer<S>(1)) + (literal<S>(5.0 / 32.0) * (m.sigma[0] - m.sigma[2]) +
                                                 scale2(m.slope[0] + m.slope[2], -6)) /
                                                    m.length;
    const S hump = middle * (from_integer<S>(1) - middle);
    const S c = (half(from_integer<S>(1)) - out.parameter_at(middle)) / (hump * hump * hump);
    out.inverse[2] += c;
    out.inverse[3] -= times(3, c);
    out.inverse[4] += times(3, c);
    out.inverse[5] = -c;
}

// What is left of a cusp after 22 halvings: its chord.
template <Scalar S>
void ArcLength<S>::fill_chord(const Piece& piece, Cell<S>& out) noexcept {
    const auto n = static_cast<unsigned>(current().degree);
    fill_common(piece, 1, out);
    PerAxis<S> chord{};
    const auto axes_u = static_cast<unsigned>(current().axes);
    for (unsigned k = 0; k < axes_u; ++k) {
        chord[k] = piece.control[k][n] - piece.control[k][0];
        out.power[k][1] = chord[k];
        out.tangent_max[k] = from_integer<S>(1);
        // Worse than any curvature that the feed could use: the machine all but stops here.
        out.curvature_max[k] = from_integer<S>(1 << 24);
    }
    out.length_mm = larger(scale2(norm(chord.data(), current().axes), current().unit_log2), literal<S>(1e-7));
    out.inverse = {from_integer<S>(1), S{}, S{}, S{}, S{}, S{}};
}

// Whether the direction jumps between two segments; also where one of them starts or ends with a vanishing tangent.
template <Scalar S>
bool ArcLength<S>::jumps(const CurveSegment<S>& before, const CurveSegment<S>& after) const noexcept {
    const int axes = before.axes;
    const auto m = static_cast<unsigned>(before.degree);
    PerAxis<S> in{};
    PerAxis<S> out{};
    for (unsigned k = 0; k < static_cast<unsigned>(axes); ++k) {
        in[k] = before.control[k][m] - before.control[k][m - 1];
        out[k] = after.control[k][1] - after.control[k][0];
    }
    const S length_in = norm(in.data(), axes);
    const S length_out = norm(out.data(), axes);
    const S vanishing = literal<S>(1.0 / 256.0);
    if (length_in < vanishing || length_out < vanishing) {
        return true;
    }
    S jump{};
    for (unsigned k = 0; k < static_cast<unsigned>(axes); ++k) {
        jump = larger(jump, absolute(out[k] / length_out - in[k] / length_in));
    }
    return jump > refinement_.direction_jump;
}

// Makes the next segment current. It waits for the segment after it, because a stop at its end shapes its cells.
template <Scalar S>
Pull ArcLength<S>::load() noexcept {
    if (!has_current_) {
        const Pull pull = has_ahead_ ? Pull::item : source_->next(slots_[current_]);
        if (pull != Pull::item) {
            return pull;
        }
        has_current_ = true;
        has_ahead_ = false;
    }
    CurveSegment<S>& ahead = slots_[1 - current_];
    const Pull pull = source_->next(ahead);
    if (pull == Pull::starved) {
        return Pull::starved;
    }
    has_ahead_ = pull == Pull::item;
    stop_after_ = current().stop_at_end || !has_ahead_ || jumps(current(), ahead);
    const S feed = current().feed_mm_s > S{} ? smaller(current().feed_mm_s, refinement_.max_feed_mm_s)
                                             : refinement_.max_feed_mm_s;
    // Not below 0.1 um: from there the time to start is nothing.
    grade_mm_ = larger(feed * feed * refinement_.grade_per_feed_sq, literal<S>(1e-4));
    stack_[0].control = current().control;
    stack_[0].level = 0;
    stack_[0].at_start = stack_[0].at_end = true;
    depth_ = 1;
    ++segments_;
    return Pull::item;
}

template <Scalar S>
Pull ArcLength<S>::next(Cell<S>& out) noexcept {
    if (depth_ == 0) {
        const Pull pull = load();
        if (pull != Pull::item) {
            return pull;
        }
    }
    Measure m;
    for (;;) {
        Piece& piece = stack_[static_cast<unsigned>(depth_ - 1)];
        measure(piece, m);
        const Verdict verdict = judge(piece, m);
        if (verdict == Verdict::fine) {
            fill(piece, m, out);
            break;
        }
        if (piece.level == deepest) {
            fill_chord(piece, out); // a cusp: everything else is fine long before
            break;
        }
        Piece& right = piece;
        Piece& left = stack_[static_cast<unsigned>(depth_)];
        ++depth_;
        ++right.level;
        left.level = right.level;
        left.at_start = right.at_start;
        left.at_end = false;
        right.at_start = false;
        left.control = left_;
        right.control = right_;
    }
    --depth_;
    travelled_ = displaced(travelled_, out.length_mm, 0);
    if (depth_ == 0) {
        stop_before_ = stop_after_;
        current_ = 1 - current_;
        has_current_ = false;
    }
    return Pull::item;
}

template class ArcLength<double>;
template class ArcLength<float>;
template class ArcLength<Fixed>;

} // namespace splinefeed
