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
//
// Where an axis has no inertia, as one that has just begun to move, its half-plane bounds the entry, and the exit only
// by its error: an entry that is slower by a thousandth may allow twice the exit. The fastest entry would be a trap. So
// where an exit is bounded by such a steep half-plane, the entry is reduced by Newton's steps as well, to where another
// one bounds the exit. P is cut there; it is convex all the same.
#include "splinefeed/s3_feed_plan/acceleration/acceleration_bound.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

namespace {

// Each Newton step eliminates one half-plane, of which there are eight per axis. For six axes at most nine steps were
// measured. Three of them cost no more than the other parts of a plan; most peaks need one.
constexpr int steps_a_part = 3;

// From this ratio of a half-plane's exit to its entry on, a slower entry makes more of the exit than it costs.
constexpr int steep_log2 = -3;

// The amount by which the entry is reduced if rounding hides the next step; it is doubled as often as needed.
template <Scalar S>
constexpr int least_step_log2 = std::same_as<S, double>  ? -50
                                : std::same_as<S, float> ? -22
                                                         : -30;

// By how much rounding may change the numbers of a half-plane, each the sum of at most four roundings, and a sum of
// four products. In float and double the error bound of a cell covers it.
template <Scalar S>
constexpr Ratio<S> factor_rounding = literal<Ratio<S>>(std::same_as<S, Fixed> ? 3.0 * 0x1p-30 : 0.0);
template <Scalar S>
constexpr S sum_rounding = literal<S>(std::same_as<S, Fixed> ? 4.0 * 0x1p-32 : 0.0);

} // namespace

// The half-planes of the four points of an axis.
template <Scalar S>
auto AccelerationBound<S>::rows_of(unsigned k) const noexcept -> AxisRows {
    const AxisShape<S>& shape = cell_.shape[k];
    const R third = literal<R>(1.0 / 3.0);
    S length = cell_.length_mm;
    R e = shape.error_bound;
    std::array<R, 3> bend = shape.bend;
    R c0 = third * bend[0];
    R c2 = third * bend[2];
    std::array<R, 4> t{shape.tangent[0], shape.tangent[0] + half(c0), shape.tangent[1] - half(c2), shape.tangent[1]};
    if (!stretch_.whole()) {
        const auto share = shortened<R>(stretch_.length());
        length = length * stretch_.length();
        e = e * share;
        t = points_on(stretch_, t);
        bend = points_on(stretch_, bend);
        for (R& b : bend) {
            b = b * share; // 2 L q'' of the shorter length
        }
        c0 = third * bend[0];
        c2 = third * bend[2];
    }
    const R c1 = third * (bend[1] + bend[1]);
    const auto scaled = [&](S acceleration) { // a quarter of 2 L A
        return smaller(larger(half(length * acceleration) - sum_rounding<S>, S{}),
                       from_integer<S>(1 << 29)); // never reached
    };
    const S speeding = scaled(limits_.acceleration_mm_s2[k]);
    S forward = speeding;
    S backward = speeding;
    if (!(limits_.braking_mm_s2[k] == limits_.acceleration_mm_s2[k])) {
        const S braking = scaled(limits_.braking_mm_s2[k]);
        const int way = speeding == braking ? 1 : cell_.heading[k];
        forward = way == 1 ? speeding : way == -1 ? braking : smaller(speeding, braking);
        backward = way == 1 ? braking : way == -1 ? speeding : forward;
    }
    if (e > literal<R>(0.25)) [[unlikely]] { // their sums would not fit in a Ratio: half of all
        const auto halved = [](R x, R y) {
            return half(x) + half(y);
        };
        return {{halved(bend[0], -t[0]), halved(c1, -t[1]), halved(c2, -t[2]), -half(t[3])},
                {half(t[0]), halved(t[1], c0), halved(t[2], c1), halved(t[3], bend[2])},
                half(e) + factor_rounding<S>,
                {half(forward), half(backward)}};
    }
    return {{bend[0] - t[0], c1 - t[1], c2 - t[2], -t[3]},
            {t[0], t[1] + c0, t[2] + c1, t[3] + bend[2]},
            e + factor_rounding<S>,
            {forward, backward}};
}

// A violated half-plane reduces the end that is wanted: the quotient stays below it, whatever the divisor.
template <Scalar S>
template <auto Given, auto Asked>
S AccelerationBound<S>::lowered(S given_sq, S at_most) const noexcept {
    S best = at_most;
    for (const unsigned k : indices(cell_.axes)) {
        const AxisRows axis = rows_of(k);
        const S given_e = quarter_product(given_sq, axis.e);
        S of_e = given_e + quarter_product(best, axis.e);
        for (unsigned j = 0; j < 4; ++j) {
            const R asked = (axis.*Asked)[j];
            const S given = quarter_product(given_sq, (axis.*Given)[j]);
            S of_point = given + quarter_product(best, asked);
            for (unsigned side = 0; side < 2; ++side) {
                const S excess = (side == 0 ? of_e + of_point : of_e - of_point) - axis.limit[side];
                const R divisor = side == 0 ? axis.e + asked : axis.e - asked;
                if (excess > S{} && divisor > R{}) {
                    best = larger(best - quotient_by_quarter(excess, divisor), S{});
                    of_e = given_e + quarter_product(best, axis.e);
                    of_point = given + quarter_product(best, asked);
                }
            }
        }
    }
    return best;
}

template <Scalar S>
S AccelerationBound<S>::largest_exit(S entry_sq, S at_most) const noexcept {
    return lowered<&AxisRows::entry, &AxisRows::exit>(entry_sq, at_most);
}

template <Scalar S>
S AccelerationBound<S>::largest_entry(S exit_sq, S at_most) const noexcept {
    return lowered<&AxisRows::exit, &AxisRows::entry>(exit_sq, at_most);
}

// A violated half-plane increases the exit. The error bound is proportional to |v^2|: below zero it acts on the other
// side, as in the half-plane against the opposite acceleration.
template <Scalar S>
S AccelerationBound<S>::lifted(S entry_sq, S exit_sq, S at_most) const noexcept {
    const bool below_zero = exit_sq < S{};
    S best = exit_sq;
    for (const unsigned k : indices(cell_.axes)) {
        const AxisRows axis = rows_of(k);
        const R exit_e = below_zero ? -axis.e : axis.e;
        const S entry_e = quarter_product(entry_sq, axis.e);
        S of_e = entry_e + quarter_product(best, exit_e);
        for (unsigned j = 0; j < 4; ++j) {
            const R exit = axis.exit[j];
            const S entry = quarter_product(entry_sq, axis.entry[j]);
            S of_point = entry + quarter_product(best, exit);
            for (unsigned side = 0; side < 2; ++side) {
                const S excess = (side == 0 ? of_e + of_point : of_e - of_point) - axis.limit[side];
                const R divisor = side == 0 ? -exit_e - exit : exit - exit_e;
                if (excess > S{} && divisor > R{}) {
                    best = best + smaller(quotient_by_quarter(excess, divisor), at_most - best);
                    of_e = entry_e + quarter_product(best, exit_e);
                    of_point = entry + quarter_product(best, exit);
                }
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

// With |q'| <= t, 2 L |q''| <= c and b <= ends + change: t change + (c + 2 e) (ends + change) <= 2 L A. On a part x of
// the cell L, c, e and the change are x times as large. On a line the sign of q' tells which of the limits it is.
template <Scalar S>
S AccelerationBound<S>::change(bool faster, S ends_sq, S at_most) const noexcept {
    S change = at_most;
    for (unsigned k = 0; k < static_cast<unsigned>(cell_.axes); ++k) {
        const AxisRows axis = rows_of(k);
        const std::array<R, 3>& bend = cell_.shape[k].bend;
        const R bent = larger(absolute(bend[1]), larger(absolute(bend[0]), absolute(bend[2])));
        if (axis.e > literal<R>(0.2) || bent > literal<R>(0.3)) {
            return S{};
        }
        const R by_speed = bent + axis.e + axis.e;
        const R divisor = cell_.tangent_max[k] + by_speed;
        if (divisor > R{}) {
            const bool forward = (axis.exit[0] > R{}) == faster;
            const S limit = bent > R{} ? smaller(axis.limit[0], axis.limit[1]) : axis.limit[forward ? 0 : 1];
            const S room = larger(limit - quarter_product(ends_sq, by_speed), S{});
            change = smaller(change, quotient_by_quarter(room, divisor));
        }
    }
    return change;
}

template <Scalar S>
S AccelerationBound<S>::reach_from_standstill(S at_most) const noexcept {
    S reach = at_most;
    const S twice = cell_.length_mm + cell_.length_mm;
    for (const unsigned k : indices(limits_.axes)) {
        const S limit = smaller(limits_.acceleration_mm_s2[k], limits_.braking_mm_s2[k]);
        reach = smaller(reach, quotient_or_max(twice * limit,
                                               lengthened<S>(cell_.tangent_max[k]) + twice * cell_.curvature_max[k]));
    }
    return reach;
}

// The entry where two half-planes meet: their exits, of which that of the second is not smaller, cancel with the weight
// -1 ... 1 of the second.
template <Scalar S>
S AccelerationBound<S>::crossing_of(const Row& first, const Row& second) noexcept {
    const R share = absolute(first.exit) / DivisionBy<R>(absolute(second.exit));
    const bool alike = first.exit > R{} && second.exit > R{};
    const R weight = alike ? -share : share;
    R entry = half(first.entry) + half(second.entry * weight);
    S limit = half(first.limit) + half(second.limit * weight);
    if (alike && entry < R{}) {
        entry = -entry;
        limit = -limit;
    }
    return entry > R{} ? quotient_by_quarter(limit, entry) : largest<S>();
}

// All exits from an entry up to a cap; none if low > high, and then no more than what shows it.
template <Scalar S>
auto AccelerationBound<S>::exits_from(S entry_sq, S cap_sq, const PerAxis<AxisRows>& rows) const noexcept -> Exits {
    const R one = from_integer<R>(1);
    const S beyond = cap_sq + cap_sq;                       // larger than every exit
    const Row none{R{}, -one, S{}};                         // exit >= 0
    const Row most{R{}, one, quarter_product(cap_sq, one)}; // exit <= cap
    Exits out{S{}, cap_sq, cap_sq, none, most, most};
    for (const unsigned k : indices(cell_.axes)) {
        const AxisRows& axis = rows[k];
        const S entry_e = quarter_product(entry_sq, axis.e);
        for (unsigned i = 0; i < 8; ++i) {
            const unsigned j = i / 2;
            const bool against = i % 2 != 0;
            const S of_entry = quarter_product(entry_sq, axis.entry[j]);
            const S of_point = (against ? entry_e - of_entry : entry_e + of_entry) - axis.limit[i % 2];
            const R exit = against ? axis.e - axis.exit[j] : axis.e + axis.exit[j];
            if (exit > R{}) {
                const R entry = against ? axis.e - axis.entry[j] : axis.e + axis.entry[j];
                const bool steep = exit < scale2(entry, steep_log2);
                S& high = steep ? out.steep : out.high;
                const S excess = of_point + quarter_product(high, exit);
                if (excess > S{} && high > -cap_sq) {
                    high = high - smaller(quotient_by_quarter(excess, exit), high + cap_sq);
                    (steep ? out.beside : out.above) = axis.row(j, i % 2);
                }
                continue;
            }
            const S excess = of_point + quarter_product(out.low, exit);
            if (excess > S{} && out.low < beyond) {
                const S step = exit < R{} ? smaller(quotient_by_quarter(excess, -exit), beyond) : beyond;
                out.low = smaller(out.low + step, beyond);
                out.below = axis.row(j, i % 2);
            }
        }
    }
    return out;
}

template <Scalar S>
PeakSpeeds<S> AccelerationBound<S>::peak(const CapLine<S>& cap) const noexcept {
    auto peak = PeakSpeeds<S>::unknown();
    while (!peak.known()) {
        approach_peak(cap, peak);
    }
    return peak;
}

// While the peak is unknown, its exits hold how far the search is: the next entry, and by how much it is reduced where
// rounding hides the next step.
template <Scalar S>
void AccelerationBound<S>::approach_peak(const CapLine<S>& cap, PeakSpeeds<S>& peak) const noexcept {
    PerAxis<AxisRows> rows;
    for (const unsigned k : indices(cell_.axes)) {
        rows[k] = rows_of(k);
    }
    S& entry = peak.smallest_exit_sq;
    S& back = peak.largest_exit_sq;
    if (!(back > S{})) {
        entry = cap.entry_sq;
        back = larger(scale2(cap.entry_sq, least_step_log2<S>), literal<S>(0x1p-32));
    }
    for (int step = 0; step < steps_a_part; ++step) {
        const Exits exits = exits_from(entry, cap.exit_sq, rows);
        const bool any = exits.low <= smaller(exits.high, exits.steep);
        if (any && exits.high <= exits.steep) {
            peak = {entry, exits.low, exits.high};
            return;
        }
        if (!(entry > S{})) { // rounding: standstill is always allowed
            peak = {};
            return;
        }
        const Row& one = any ? exits.above : exits.below;
        const Row& other = exits.steep < exits.high ? exits.beside : exits.above;
        const S crossing =
            absolute(one.exit) < absolute(other.exit) ? crossing_of(one, other) : crossing_of(other, one);
        if (crossing < entry) {
            entry = larger(crossing, S{});
        } else { // the same pair again: rounding, which nearly parallel lines magnify
            entry = larger(entry - back, S{});
            back += back;
        }
    }
}

SPLINEFEED_INSTANTIATE_CLASS(AccelerationBound)

} // namespace splinefeed
