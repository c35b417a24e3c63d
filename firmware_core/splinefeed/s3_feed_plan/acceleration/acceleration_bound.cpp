// SPDX-License-Identifier: MIT
//
// b = v^2 is linear in s over a cell of length L, from b0 to b1; a = (b1 - b0) / (2 L). With x = s / L, the
// acceleration of an axis is f = q' a + q'' b. q'' is taken as the parabola through its values at x = 0, 1/2, 1, and q'
// as the cubic through its values and slopes at both ends. Then 2 L f = q' (b1 - b0) + 2 L q'' b is a cubic in x. The
// Bezier points of q' are t0, t1 = t0 + c0 / 6, t2 = t3 - c2 / 6, t3, where c0, c1, c2 are those of 2 L q''. The Bezier
// points of its product with b, as a cubic, are c0 b0, (2 c1 b0 + c0 b1) / 3, (c2 b0 + 2 c1 b1) / 3, c2 b1. So the
// Bezier points of 2 L f are entry_j b0 + exit_j b1:
//
//   j        0          1                2                3
//   entry    c0 - t0    2 c1 / 3 - t1    c2 / 3 - t2      -t3
//   exit     t0         c0 / 3 + t1      2 c1 / 3 + t2    c2 + t3
//
// A polynomial stays between its Bezier points, so
//
//   | entry_j b0 + exit_j b1 | + e (b0 + b1) <= 2 L A        j = 0 ... 3, every axis
//
// keeps A at every point of the cell. The error bound e covers the errors of the polynomials of q' and q''. j = 0 and 3
// are the two ends of the cell (the interpolation scheme of TOPP-RA: H. Pham, Q.-C. Pham, IEEE T-RO 34 (2018)); 1 and 2
// cover the points between them. If the axis does not turn round, one sign of f is braking, and its A is the braking
// limit. The signs matter where an axis turns round: there the bound |q'| |a| + |q''| b would cost several per cent of
// the time.
//
// The polygon P of these half-planes is convex and contains (0, 0). Hence
// - the entries from which an exit up to K can be reached are all those from 0 to a largest one. That one is a concave
//   function of K; it rises up to the peak of P and is constant after it;
// - below the peak only those half-planes matter that bound the entry from above: those that bound it from below hold
//   on the line from (0, 0) to the peak and to the right of it.
//
// Peak: for an entry b0 the allowed exits are those from low(b0) to high(b0), with low convex, high concave and low(0)
// <= high(0). The peak is the root of low - high, found from above by Newton's steps from one pair of half-planes to
// the next. Each step is a cut that holds for every point of P, so the steps end when no pair is violated; usually no
// step is needed.
#include "splinefeed/s3_feed_plan/acceleration/acceleration_bound.hpp"

namespace splinefeed {

namespace {

// Each Newton step eliminates one half-plane, of which there are eight per axis. For six axes at most nine steps were
// measured.
constexpr int most_steps = 8 * max_axes + 64;

// The amount by which the entry is reduced if rounding hides the next step; it is doubled as often as needed.
template <Scalar S>
constexpr int least_step_log2 = std::same_as<S, double>  ? -50
                                : std::same_as<S, float> ? -22
                                                         : -30;

} // namespace

// The eight half-planes of an axis: for each of the four points one against accelerations > 0 and one against those <
// 0.
template <Scalar S>
auto AccelerationBound<S>::rows_of(unsigned k) const noexcept -> AxisRows {
    const AxisShape<S>& shape = cell_.shape[k];
    const S third = literal<S>(1.0 / 3.0);
    AxisRows out;
    S length = cell_.length_mm;
    S e = shape.error_bound;
    std::array<S, 3> bend = shape.bend;
    S c0 = third * bend[0];
    S c2 = third * bend[2];
    std::array<S, 4> t{shape.tangent[0], shape.tangent[0] + scale2(c0, -1), shape.tangent[1] - scale2(c2, -1),
                       shape.tangent[1]};
    if (!stretch_.whole()) {
        const S share = stretch_.length();
        length = length * share;
        e = e * share;
        t = points_on(stretch_, t);
        bend = points_on(stretch_, bend);
        for (S& b : bend) {
            b = b * share; // 2 L q'' of the shorter length
        }
        c0 = third * bend[0];
        c2 = third * bend[2];
    }
    const S c1 = third * (bend[1] + bend[1]);
    out.entry = {bend[0] - t[0], c1 - t[1], c2 - t[2], -t[3]};
    out.exit = {t[0], t[1] + c0, t[2] + c1, t[3] + bend[2]};
    out.e = e;
    const S twice = length + length;
    const auto scaled = [&](S acceleration) {
        return smaller(scale2(twice * acceleration, limits_.refinement.shape_log2),
                       from_integer<S>(1 << 30)); // never reached
    };
    const S speeding = scaled(limits_.acceleration_mm_s2[k]);
    out.limit = {speeding, speeding};
    if (!(limits_.braking_mm_s2[k] == limits_.acceleration_mm_s2[k])) {
        const S braking = scaled(limits_.braking_mm_s2[k]);
        const int way = speeding == braking ? 1 : cell_.heading[k];
        out.limit[0] = way == 1 ? speeding : way == -1 ? braking : smaller(speeding, braking);
        out.limit[1] = way == 1 ? braking : way == -1 ? speeding : out.limit[0];
    }
    return out;
}

// A violated half-plane reduces the end that is wanted: the quotient stays below it, whatever the divisor.
template <Scalar S>
template <auto Given, auto Asked>
S AccelerationBound<S>::lowered(S given_sq, S at_most) const noexcept {
    S best = at_most;
    for (unsigned k = 0; k < static_cast<unsigned>(cell_.axes); ++k) {
        const AxisRows axis = rows_of(k);
        for (unsigned i = 0; i < 8; ++i) {
            const Row row = axis[i];
            if (!(row.*Asked > S{})) {
                continue;
            }
            const S asked = row.*Asked * best;
            const S excess = row.*Given * given_sq + asked - row.limit;
            if (excess > S{}) {
                best = excess < asked ? best - excess / row.*Asked : S{};
            }
        }
    }
    return best;
}

template <Scalar S>
S AccelerationBound<S>::largest_exit(S entry_sq, S at_most) const noexcept {
    return lowered<&Row::entry, &Row::exit>(entry_sq, at_most);
}

template <Scalar S>
S AccelerationBound<S>::largest_entry(S exit_sq, S at_most) const noexcept {
    return lowered<&Row::exit, &Row::entry>(exit_sq, at_most);
}

// A violated half-plane increases the exit. The error bound is proportional to |v^2|: below zero it acts on the other
// side, as in the half-plane against the opposite acceleration.
template <Scalar S>
S AccelerationBound<S>::lifted(S entry_sq, S exit_sq, S at_most) const noexcept {
    const bool below_zero = exit_sq < S{};
    S best = exit_sq;
    for (unsigned k = 0; k < static_cast<unsigned>(cell_.axes); ++k) {
        const AxisRows axis = rows_of(k);
        for (unsigned i = 0; i < 8; ++i) {
            const Row row = axis[i];
            const S exit = below_zero ? -axis.exit_of(i ^ 1U) : row.exit;
            if (!(exit < S{})) {
                continue;
            }
            const S excess = row.entry * entry_sq + exit * best - row.limit;
            if (excess > S{}) {
                best = best + smaller(quotient_or_max(excess, -exit), at_most - best);
            }
        }
    }
    return best;
}

template <Scalar S>
S AccelerationBound<S>::smallest_exit(S entry_sq, S at_least, S at_most) const noexcept {
    const S best = lifted(entry_sq, at_least, at_most);
    return at_least < S{} && best > S{} ? lifted(entry_sq, S{}, larger(at_most, S{})) : best;
}

template <Scalar S>
S AccelerationBound<S>::reach_from_standstill(S at_most) const noexcept {
    S reach = at_most;
    const S twice = cell_.length_mm + cell_.length_mm;
    for (unsigned k = 0; k < static_cast<unsigned>(limits_.axes); ++k) {
        const S limit = smaller(limits_.acceleration_mm_s2[k], limits_.braking_mm_s2[k]);
        reach = smaller(reach, quotient_or_max(twice * limit, cell_.tangent_max[k] + twice * cell_.curvature_max[k]));
    }
    return reach;
}

// The entry where two half-planes meet; their exits cancel with the weight 0 ... 1 of the second.
template <Scalar S>
S AccelerationBound<S>::crossing_of(const Row& first, const Row& second, S weight) noexcept {
    const S entry = first.entry + second.entry * weight;
    return entry > S{} ? quotient_or_max(first.limit + second.limit * weight, entry) : largest<S>();
}

template <Scalar S>
PeakSpeeds<S> AccelerationBound<S>::peak(S cap_sq) const noexcept {
    const S one = from_integer<S>(1);
    const S beyond = cap_sq + cap_sq; // larger than every exit
    const auto axes = static_cast<unsigned>(cell_.axes);
    PerAxis<AxisRows> rows;
    for (unsigned k = 0; k < axes; ++k) {
        rows[k] = rows_of(k);
    }
    S entry = cap_sq;
    S back = larger(scale2(cap_sq, least_step_log2<S>), literal<S>(0x1p-32));
    for (int step = 0; step < most_steps; ++step) {
        Row above{S{}, one, cap_sq}; // exit <= cap
        Row below{S{}, -one, S{}};   // exit >= 0
        S high = cap_sq;
        S low{};
        for (unsigned k = 0; k < axes; ++k) {
            for (unsigned i = 0; i < 8; ++i) {
                const Row row = rows[k][i];
                if (row.exit > S{}) {
                    const S excess = row.entry * entry + row.exit * high - row.limit;
                    if (excess > S{} && high > -cap_sq) {
                        high = high - smaller(quotient_or_max(excess, row.exit), high + cap_sq);
                        above = row;
                    }
                } else {
                    const S excess = row.entry * entry + row.exit * low - row.limit;
                    if (excess > S{} && low < beyond) {
                        low = smaller(low + smaller(quotient_or_max(excess, -row.exit), beyond), beyond);
                        below = row;
                    }
                }
            }
        }
        if (low <= high) {
            return {entry, low, high};
        }
        const S crossing = -below.exit < above.exit ? crossing_of(below, above, -below.exit / above.exit)
                                                    : crossing_of(above, below, above.exit / -below.exit);
        if (!(crossing < entry)) { // the same pair again: rounding, which nearly parallel lines magnify
            entry = larger(entry - back, S{});
            back += back;
            continue;
        }
        entry = crossing;
    }
    return {}; // not reached
}

template class AccelerationBound<double>;
template class AccelerationBound<float>;
template class AccelerationBound<Fixed>;

} // namespace splinefeed
