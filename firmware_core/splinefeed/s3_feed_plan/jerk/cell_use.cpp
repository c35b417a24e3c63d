// SPDX-License-Identifier: MIT
//
// In a cell of length L let q' be the cubic through its values and slopes at both ends; q'' and q''' are its
// derivatives, with bounds s2 and s3 of their errors. The acceleration q' b'/2 + q'' b is a polynomial of degree 4: its
// Bezier points bound it. The jerk divided by sqrt(b) is a cubic, q' b''/2 + 3/2 q'' b' + q''' b; it has to stay below
// J b^(-1/2). That is convex in b, so it lies above its tangents:
//
//   J b^(-1/2) >= J (3/2 r - 1/2 r^3 b)  with r = b_i^(-1/2) at an end i.
//
// Between the ends r is taken as linear: a Bezier point of the cubic against that of J (3/2 r - 1/2 r^3 b).
//
// A cell that fails is halved, by de Casteljau's construction: next to standstill the tangent's chord is too careful.
#include "splinefeed/s3_feed_plan/jerk/cell_use.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/scalar.hpp"

namespace splinefeed {

namespace {

constexpr int most_halvings = 4;
constexpr double beyond = 1e9; // use of a motion that has no limit left

/// One axis in a cell: at both ends, and b as Bezier points.
template <Floating R>
struct Passage {
    R length;
    R b0, middle, b1;
    R slope0, slope1; // of b
    R half_u;         // half of d2b/ds2
    R first[2], second[2], third[2];
    R second_spread, third_spread;
};

template <Floating R>
struct Inner { // Bezier points of q' and of q''
    R first[2];
    R second;
};

template <Floating R>
Inner<R> inner_of(const Passage<R>& p) noexcept {
    const R step = p.length * R(1.0 / 3.0);
    const R a = p.first[0] + step * p.second[0];
    const R b = p.first[1] - step * p.second[1];
    return {{a, b}, R(3) * (b - a) / p.length};
}

template <Floating R>
void take(LimitUse<R>& use, R value, bool at_end) noexcept {
    use.most = larger(use.most, value);
    use.ends = at_end ? larger(use.ends, value) : use.ends;
}

template <Floating R>
LimitUse<R> jerk_use(const Passage<R>& p, const Inner<R>& in, R jerk) noexcept {
    constexpr R third = R(1.0 / 3.0);
    const R r0 = R(1) / detail::hardware_square_root(p.b0);
    const R r1 = R(1) / detail::hardware_square_root(p.b1);
    // J (3/2 r - 1/2 r^3 b) less s3 b: products of linear functions with b
    const R by0 = R(0.5) * r0 * r0 * r0 * jerk + p.third_spread;
    const R by1 = R(0.5) * r1 * r1 * r1 * jerk + p.third_spread;
    const R a0 = R(1.5) * jerk * r0;
    const R a1 = R(1.5) * jerk * r1;
    const auto times_b = [&](R f0, R f1, R(&out)[4]) {
        out[0] = f0 * p.b0;
        out[1] = (R(2) * f0 * p.middle + f1 * p.b0) * third;
        out[2] = (f0 * p.b1 + R(2) * f1 * p.middle) * third;
        out[3] = f1 * p.b1;
    };
    R bend[4];
    R less[4];
    times_b(p.third[0], p.third[1], bend);
    times_b(by0, by1, less);
    const R turn[4] = {R(1.5) * p.second[0] * p.slope0, in.second * p.slope0 + R(0.5) * p.second[0] * p.slope1,
                       in.second * p.slope1 + R(0.5) * p.second[1] * p.slope0, R(1.5) * p.second[1] * p.slope1};
    const R tangent[4] = {p.first[0], in.first[0], in.first[1], p.first[1]};
    const R limit[4] = {a0, (R(2) * a0 + a1) * third, (a0 + R(2) * a1) * third, a1};
    LimitUse<R> use;
    for (unsigned j = 0; j < 4; ++j) {
        const R left = limit[j] - less[j];
        take(use, left > R(0) ? absolute(p.half_u * tangent[j] + turn[j] + bend[j]) / left : R(beyond), j % 3 == 0);
    }
    return use;
}

template <Floating R>
LimitUse<R> acceleration_use(const Passage<R>& p, const Inner<R>& in, R acceleration) noexcept {
    constexpr R sixth = R(1.0 / 6.0);
    const R q0 = p.second[0];
    const R q1 = in.second;
    const R q2 = p.second[1];
    const R m = p.middle;
    const R slope0 = p.slope0;
    const R slope1 = p.slope1;
    const R bend[5] = {q0 * p.b0, R(0.5) * (q0 * m + q1 * p.b0), (q0 * p.b1 + R(4) * q1 * m + q2 * p.b0) * sixth,
                       R(0.5) * (q1 * p.b1 + q2 * m), q2 * p.b1};
    const R along[5] = {p.first[0] * slope0, R(0.25) * p.first[0] * slope1 + R(0.75) * in.first[0] * slope0,
                        R(0.5) * (in.first[0] * slope1 + in.first[1] * slope0),
                        R(0.75) * in.first[1] * slope1 + R(0.25) * p.first[1] * slope0, p.first[1] * slope1};
    const R b[5] = {p.b0, R(0.5) * (p.b0 + m), (p.b0 + R(4) * m + p.b1) * sixth, R(0.5) * (m + p.b1), p.b1};
    LimitUse<R> use;
    const R per = R(1) / acceleration;
    for (unsigned j = 0; j < 5; ++j) {
        take(use, (absolute(R(0.5) * along[j] + bend[j]) + p.second_spread * b[j]) * per, j % 4 == 0);
    }
    return use;
}

template <Floating R>
Passage<R> half_of(const Passage<R>& p, const Inner<R>& in, unsigned which) noexcept {
    Passage<R> out = p;
    const unsigned cut = 1 - which; // end of the half that lies in the middle of the cell
    out.length = R(0.5) * p.length;
    out.first[cut] = R(0.125) * (p.first[0] + R(3) * (in.first[0] + in.first[1]) + p.first[1]);
    out.second[cut] = R(0.25) * (p.second[0] + R(2) * in.second + p.second[1]);
    out.third[cut] = R(0.5) * (p.third[0] + p.third[1]);
    const R at = R(0.25) * (p.b0 + R(2) * p.middle + p.b1);
    (which == 0 ? out.b1 : out.b0) = at;
    out.middle = R(0.5) * (p.middle + (which == 0 ? p.b0 : p.b1));
    (which == 0 ? out.slope1 : out.slope0) = R(0.5) * (p.slope0 + p.slope1);
    return out;
}

template <Floating R>
CellUse<R> use_of(const Passage<R>& whole, R acceleration, R jerk) noexcept {
    Passage<R> rest[most_halvings + 1]; // parts that are still to be looked at, the shortest last
    int halvings[most_halvings + 1];
    std::size_t parts = 1;
    rest[0] = whole;
    halvings[0] = most_halvings;
    CellUse<R> most;
    while (parts > 0) {
        const Passage<R> p = rest[--parts];
        const int more = halvings[parts];
        if (!(p.b0 > R(0) && p.middle > R(0) && p.b1 > R(0))) {
            return {{R(beyond), R(1)}, {R(beyond), R(1)}};
        }
        const Inner<R> in = inner_of(p);
        const CellUse<R> use{acceleration_use(p, in, acceleration), jerk_use(p, in, jerk)};
        if (more == most_halvings) {
            most.acceleration.ends = use.acceleration.ends;
            most.jerk.ends = use.jerk.ends;
        }
        if ((use.acceleration.most > R(1) || use.jerk.most > R(1)) && more > 0) {
            for (unsigned which = 0; which < 2; ++which) {
                rest[parts] = half_of(p, in, which);
                halvings[parts++] = more - 1;
            }
        } else {
            most.acceleration.most = larger(most.acceleration.most, use.acceleration.most);
            most.jerk.most = larger(most.jerk.most, use.jerk.most);
        }
    }
    return most;
}

} // namespace

template <Floating R>
CellUse<R> cell_use(const LegNode<R>& node, const LegNode<R>& next, const AxisLimits<R>& limits) noexcept {
    CellUse<R> most;
    for (const unsigned k : indices(limits.axes)) {
        const LegAxis<R>& from = node.axis[k];
        const LegAxis<R>& to = next.axis[k];
        const Passage<R> passage{node.length_mm,
                                 node.b,
                                 node.middle_sq,
                                 next.b,
                                 node.slope,
                                 next.slope,
                                 R(0.5) * node.curvature,
                                 {from.first, to.first},
                                 {from.second, to.second},
                                 {R(from.third[1]), R(to.third[0])},
                                 larger(R(from.second_spread[1]), R(to.second_spread[0])),
                                 larger(R(from.third_spread[1]), R(to.third_spread[0]))};
        const CellUse<R> use = use_of(passage, limits.acceleration_mm_s2[k], limits.jerk_mm_s3[k]);
        for (const auto limit : {&CellUse<R>::acceleration, &CellUse<R>::jerk}) {
            if ((use.*limit).most > (most.*limit).most) {
                most.*limit = use.*limit;
            }
        }
    }
    const R per_share = R(1) / node.most_share;
    most.acceleration.most *= per_share;
    most.jerk.most *= per_share;
    return most;
}

#define SPLINEFEED_INSTANTIATE(R)                                                                                      \
    template CellUse<R> cell_use(const LegNode<R>&, const LegNode<R>&, const AxisLimits<R>&) noexcept;
SPLINEFEED_EACH_JERK_REAL(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
