// SPDX-License-Identifier: MIT
//
// The family of blends between two moves that meet in a vertex, l the way on each of them, w from 0 to 1:
//     C0, C0 + a T, C0 + b T + 5/4 a^2 K, and the same from the other end,  a = (0.6 - 0.2 w) l,  b = (0.9 - 0.1 w) l.
// w = 0 between lines is the cubic C0, V, V, C3 with its degree raised. Its distance from the vertex is
//     e = l sin(phi/2) (1/4 + w/8),
// so a tolerance P allows l = 4 P / sin(phi/2), and on a shorter way w = 8 (P / (l sin(phi/2)) - 1/4), at most 1, or 2
// where only accelerations are limited: there it is as far from the vertex as the parabola of a constant acceleration,
// and takes 8 to 12 % less time at 90 degrees. w = 1 in one direction is Hermite's quintic over the way 2 l. Between
// curvatures K0 and K1 its distance from the moves is 0.0107 |K1 - K0| l^2.
#include "splinefeed/s1_blended_path/joint.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

namespace {

constexpr double reversal_half_cosine = 0.00436; // cos(179.5 degrees / 2)
constexpr double corner_jump = 0.0174;     // of the direction: just below a degree. An exact path rounds smaller ones
constexpr double tangent_jump = 1e-4;      // a smaller one is no corner: the tolerance is that of tangents
constexpr double least_way = 0.04;         // 1e-5 mm: a shorter blend is no faster than a stop
constexpr double least_tolerance = 0.0164; // 4e-6 mm: a plan takes longer for a blend within less than for a stop
constexpr double curvature_share = 0.011;
constexpr double bent_share = 0.88; // of the way where a bent move may turn as the corner does
constexpr int measured_places = 11;
constexpr double measured_share = 0.97; // of the tolerance: the distance is that of a parabola through three places
constexpr int shortenings = 6;
constexpr double far_off = 1.0 / 16.0; // of the tolerance: the way is made shorter by all of it

template <Scalar S>
S distance_between(const PerAxis<S>& a, const PerAxis<S>& b, int axes) noexcept {
    return norm(difference(a, b, axes), axes);
}

template <Scalar S>
PerAxis<S> point_at(const Blend<S>& blend, S u, int axes) noexcept {
    PerAxis<S> point{};
    for (const unsigned k : indices(axes)) {
        PerDegree<S> row = blend.points[k];
        reduce(row, blend.degree, 0, u);
        point[k] = row[0];
    }
    return point;
}

// The largest value of the parabola through three values at even distances, the middle one of which is the largest.
template <Scalar S>
S peak(S before, S middle, S after) noexcept {
    const S rise = middle - before;
    const S fall = middle - after;
    if (!(rise >= S{} && fall >= S{} && rise + fall > S{})) {
        return middle;
    }
    return middle + scale2((rise - fall) * ((rise - fall) / (rise + fall)), -3);
}

// Largest distance between the blend and the moves, from some places, and of the vertex from the blend.
template <Scalar S>
S measured_deviation(const Blend<S>& blend, const PathMove<S>& before, const PathMove<S>& after, int axes) noexcept {
    S largest_yet{};
    S vertex = largest<S>();
    std::array<S, 3> last{}; // distances; at the ends it is 0
    for (int i = 1; i <= measured_places + 1; ++i) {
        last = {last[1], last[2], S{}};
        if (i <= measured_places) {
            const S u = from_integer<S>(i) / from_integer<S>(measured_places + 1);
            const PerAxis<S> point = point_at(blend, u, axes);
            last[2] = smaller(before.distance_near(true, point), after.distance_near(false, point));
            vertex = smaller(vertex, norm(point, axes));
        }
        largest_yet = larger(largest_yet, peak(last[0], last[1], last[2]));
    }
    return larger(largest_yet, vertex);
}

template <Scalar S>
void draw(const PathMove<S>& before, const PathMove<S>& after, S way, S w, int axes, Blend<S>& out) noexcept {
    PathState<S> from;
    PathState<S> to;
    before.before_end(way, from);
    after.behind_start(way, to);
    out.way = way;
    out.degree = 3;
    if (before.straight() && after.straight() && !(w > S{})) {
        for (const unsigned k : indices(axes)) {
            out.points[k][0] = from.offset[k];
            out.points[k][1] = out.points[k][2] = S{};
            out.points[k][3] = to.offset[k];
        }
        return;
    }
    out.degree = 5;
    quintic_between(from, to, (literal<S>(0.6) - literal<S>(0.2) * w) * way,
                    (literal<S>(0.9) - literal<S>(0.1) * w) * way, axes, out.points);
}

// Whether a plan passes the jumps of direction and curvature at the highest speed that it may have there.
template <Scalar S>
bool passes(const PassedKink<S>& kink, const PathState<S>& in, const PathState<S>& out, int axes) noexcept {
    if (!(kink.fastest_mm_s > S{})) {
        return false;
    }
    constexpr int per_mm = -bend_log2 - chord_unit_log2;
    S speed_sq = kink.fastest_mm_s * kink.fastest_mm_s;
    for (const unsigned k : indices(axes)) {
        const S bend = scale2(larger(absolute(in.bend[k]), absolute(out.bend[k])), per_mm);
        speed_sq = smaller(speed_sq, quotient_or_max(kink.acceleration_mm_s2[k], bend));
    }
    const S speed = square_root(speed_sq);
    for (const unsigned k : indices(axes)) {
        const S turn = absolute(out.tangent[k] - in.tangent[k]);
        const S bend = scale2(absolute(out.bend[k] - in.bend[k]), per_mm);
        if (turn > kink.sharpest || !((turn + bend * speed * kink.bend_s) * speed <= kink.turn_mm_s[k])) {
            return false;
        }
    }
    return true;
}

// The curvature in the middle of the cubic, (8/3) sin(phi/2) / (l cos^2(phi/2)).
template <Scalar S>
bool too_sharp(const Joint<S>& joint, S way) noexcept {
    const S sine = joint.half_sine;
    const S square = from_integer<S>(1) - sine * sine;
    return joint.sharpest > S{} && sine > literal<S>(0.5 * corner_jump) &&
           quotient_or_max(literal<S>(0x1p20 * 8.0 / 3.0) * sine, joint.sharpest) > way * square;
}

} // namespace

template <Scalar S>
Joint<S> decide_joint(const PathMove<S>& before, const PathMove<S>& after, PathMode mode,
                      const JointTolerances<S>& tolerances, int axes) noexcept {
    PathState<S> in;
    PathState<S> out;
    before.before_end(S{}, in);
    after.behind_start(S{}, out);
    Joint<S> joint;
    const S jump = distance_between(in.tangent, out.tangent, axes);
    joint.half_sine = scale2(jump, -1);
    const PerAxis<S> both = plus(in.tangent, out.tangent, axes);
    const bool reverses = scale2(norm(both, axes), -1) < literal<S>(reversal_half_cosine);
    const bool exact = mode == PathMode::exact_path || !(tolerances.corner > S{});
    if (mode == PathMode::exact_stop || reverses || (exact && jump > literal<S>(corner_jump))) {
        return joint;
    }
    const bool lines = before.straight() && after.straight();
    joint.tolerance = exact ? tolerances.exact : tolerances.corner;
    if (!lines && jump < literal<S>(tangent_jump)) {
        joint.tolerance = smaller(joint.tolerance, literal<S>(0.01 * 4096.0));
    }
    const S bend = distance_between(in.bend, out.bend, axes);
    const S rounding = in.bend_error + out.bend_error;
    const bool bends = !lines && bend > tolerances.smooth.bend_1_mm + rounding && (tolerances.curvature || !exact);
    const bool exactly = !(joint.tolerance > literal<S>(least_tolerance));
    if (exactly && jump > literal<S>(corner_jump)) {
        return joint;
    }
    if (exactly || (!(jump > tolerances.smooth.jump) && !bends) || passes(tolerances.kink, in, out, axes)) {
        joint.kind = JointKind::through;
        return joint;
    }
    joint.kind = JointKind::blend;
    const S fades = from_integer<S>(1) - tolerances.sharpest.fading * (joint.half_sine * joint.half_sine);
    joint.sharpest = fades < literal<S>(0.15) || joint.half_sine < tolerances.sharpest.half_sine
                         ? S{}
                         : quotient_or_max(tolerances.sharpest.curvature_1_mm, fades * fades);
    joint.way = quotient_or_max(scale2(joint.tolerance, 2), joint.half_sine);
    if (!lines) {
        // |K1 - K0| is in units of 2^-bend_log2.
        const S curvature = literal<S>(curvature_share) * bend;
        const S square = quotient_or_max(joint.tolerance, curvature);
        joint.way = smaller(literal<S>(bent_share) * joint.way, scale2(square_root(square), bend_log2 / 2));
    }
    for (const PathState<S>* state : {&in, &out}) { // l |K| is at most 1/2
        joint.way = smaller(joint.way, quotient_or_max(literal<S>(0x1p19), norm(state->bend, axes)));
    }
    joint.way = smaller(joint.way, smaller(before.longest_way(), after.longest_way()));
    return joint;
}

template <Scalar S>
bool fit_blend(const Joint<S>& joint, const PathMove<S>& before, const PathMove<S>& after, S room, int axes,
               Blend<S>& out, S roundest) noexcept {
    S way = smaller(joint.way, room);
    const bool lines = before.straight() && after.straight();
    const bool tangent = !lines && joint.half_sine < literal<S>(0.5 * corner_jump);
    const S most = literal<S>(measured_share) * joint.tolerance;
    S aim = lines ? joint.tolerance : most;
    for (int attempt = 0; attempt <= shortenings && way > literal<S>(least_way); ++attempt) {
        const S used = quotient_or_max(aim, way * joint.half_sine);
        const S w = tangent ? from_integer<S>(1) : larger(S{}, smaller(roundest, scale2(used - literal<S>(0.25), 3)));
        draw(before, after, way, w, axes, out);
        if (too_sharp(joint, way)) {
            return false;
        }
        if (lines) {
            return true;
        }
        const S deviation = measured_deviation(out, before, after, axes);
        if (deviation <= most) {
            return true;
        }
        // Where only the curvature jumps the deviation grows with the square of the way at least.
        const S ratio = literal<S>(0.95) * most / deviation;
        const S less = tangent && ratio > literal<S>(far_off) ? square_root(ratio) : ratio;
        way = way * less;
        aim = aim * less;
    }
    return false;
}

#if SPLINEFEED_MAX_DEGREE >= 5
#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template Joint<S> decide_joint(const PathMove<S>&, const PathMove<S>&, PathMode, const JointTolerances<S>&,        \
                                   int) noexcept;                                                                      \
    template bool fit_blend(const Joint<S>&, const PathMove<S>&, const PathMove<S>&, S, int, Blend<S>&, S) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE
#endif

} // namespace splinefeed
