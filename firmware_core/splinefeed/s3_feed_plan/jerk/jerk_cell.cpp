// SPDX-License-Identifier: MIT
//
// An axis q(s) that is travelled with b(s) = v^2 has the acceleration q' b'/2 + q'' b and the jerk
//
//   sqrt(b) ( q' b''/2 + 3/2 q'' b' + q''' b ).
//
// In a cell b is a parabola with constant u = b'': b1 = b0 + b0' L + u L^2 / 2, b1' = b0' + u L.
//
// In a cell with standstill at one end b cannot be a parabola: with constant jerk j along the path, s = j t^3 / 6, b is
// proportional to s^(4/3). At the moving end v = j t^2 / 2, t = 3 L / v, j = 2 v^3 / (9 L^2), a = 2 v^2 / (3 L), b' = 4
// b / (3 L). The jerk of an axis is then j (q' + 9 q'' s + 9/2 q''' s^2), a cubic of s: its Bezier points bound it. Its
// acceleration is j t (q' + 3/2 q'' s), at most that of the moving end times the largest value of another cubic.
#include "splinefeed/s3_feed_plan/jerk/jerk_cell.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/scalar.hpp"

namespace splinefeed {

namespace {

constexpr double nothing = 1e-4; // of a limit: a smaller bend takes no part of it

/// Largest derivatives of an axis in a cell.
template <Floating R>
struct Steepness {
    R first{};
    R second{};
    R third{};
};

template <Floating R>
Steepness<R> steepness(const JerkCell<R>& cell, unsigned axis) noexcept {
    Steepness<R> s;
    for (const auto& end : cell.end) {
        const AxisEnd<R>& at = end[axis];
        s.first = larger(s.first, absolute(at.first));
        s.second = larger(s.second, absolute(at.second) + at.second_spread);
        s.third = larger(s.third, absolute(at.third) + at.third_spread);
    }
    return s;
}

} // namespace

// |q'| <= U, linear between the ends: the chord, higher by what the Bezier points of q' exceed it, of which a cubic has
// 3/4 at most. V^2 / U^2 is convex, so its tangent in the middle of the cell lies below it.
template <Floating R>
void JerkCell<R>::limit_velocity(unsigned axis, R spread) noexcept {
    const AxisEnd<R>& from = end[0][axis];
    const AxisEnd<R>& to = end[1][axis];
    const R third = R(1.0 / 3.0) * length_mm;
    const R inner[] = {absolute(from.first + third * from.second), absolute(to.first - third * to.second)};
    R first = absolute(from.first);
    R last = absolute(to.first);
    const R above =
        larger(inner[0] - (first + first + last) * R(1.0 / 3.0), inner[1] - (first + last + last) * R(1.0 / 3.0));
    const R more = R(0.75) * larger(above, R(0)) + spread;
    first += more;
    last += more;
    const R velocity = limits.velocity_mm_s[axis];
    const R fastest = larger(first, last);
    if (!(fastest * fastest * cap_sq > velocity * velocity)) {
        return;
    }
    const R middle = R(0.5) * (first + last);
    const R part = (last - first) / middle;
    if (absolute(part) > R(0.5)) { // its tangent would be lower than the square at the faster end
        const R least = velocity / fastest;
        most_sq = {smaller(most_sq[0], least * least), smaller(most_sq[1], least * least)};
        return;
    }
    const R speed = velocity / middle;
    most_sq[0] = smaller(most_sq[0], speed * speed * (R(1) + part));
    most_sq[1] = smaller(most_sq[1], speed * speed * (R(1) - part));
}

template <Floating R>
R JerkCell<R>::largest_from_rest(unsigned moving) const noexcept {
    R largest_b = smaller(cap_sq, most_sq[moving]); // b is convex from standstill
    const R l = length_mm;
    for (const unsigned k : indices(limits.axes)) {
        const AxisEnd<R>& rest = end[1 - moving][k];
        const AxisEnd<R>& at = end[moving][k];
        const R direction = moving == 1 ? R(1.0) : -R(1.0);
        const R first[] = {direction * rest.first, direction * rest.first + l * rest.second / R(3.0),
                           direction * at.first - l * at.second / R(3.0), direction * at.first};
        const R middle = R(3.0) * (first[2] - first[1]) / l; // from the Bezier points of d2q/ds2
        const R third[] = {R(2.0) * (middle - rest.second) / l, R(2.0) * (at.second - middle) / l};
        const R point[] = {first[0], first[1] + R(3.0) * l * rest.second,
                           first[2] + R(6.0) * l * middle + R(1.5) * l * l * third[0],
                           first[3] + R(9.0) * l * at.second + R(4.5) * l * l * third[1]};
        const R along[] = {first[0], first[1] + R(0.5) * l * rest.second, first[2] + l * middle,
                           first[3] + R(1.5) * l * at.second};
        R max_path_acceleration = R(0.0);
        for (const R acceleration : along) {
            max_path_acceleration = larger(max_path_acceleration, absolute(acceleration));
        }
        max_path_acceleration += R(1.5) * l * larger(rest.second_spread, at.second_spread);
        largest_b = smaller(largest_b,
                            quotient_or_max(R(1.5) * l * share * limits.acceleration_mm_s2[k], max_path_acceleration));
        R per_power = R(0.0);
        for (const R jerk : point) {
            per_power = larger(per_power, absolute(jerk) * R(2.0) / (R(9.0) * l * l) + at.third_spread);
        }
        // per_power b^(3/2) <= J
        if (per_power * largest_b * square_root(largest_b) > share * limits.jerk_mm_s3[k]) {
            largest_b = smaller(largest_b, power_two_thirds(share * limits.jerk_mm_s3[k] / per_power));
        }
    }
    return largest_b;
}

// |q'| a + |q''| v^2 <= A and |q'| j + 3 |q''| v a + |q'''| v^3 <= J: bends get at most half of A and two thirds of J.
template <Floating R>
MoveLimits JerkCell<R>::move_limits(R at_most_sq) const noexcept {
    R v_sq = smaller(at_most_sq, smaller(most_sq[0], most_sq[1]));
    for (const unsigned k : indices(limits.axes)) {
        const Steepness<R> s = steepness(*this, k);
        v_sq = smaller(v_sq, quotient_or_max(R(0.5) * share * limits.acceleration_mm_s2[k], s.second));
        if (R(3.0) * s.third * v_sq * square_root(v_sq) > share * limits.jerk_mm_s3[k]) {
            v_sq = smaller(v_sq, power_two_thirds(share * limits.jerk_mm_s3[k] / (R(3.0) * s.third)));
        }
    }
    const R v = square_root(v_sq);
    auto a = largest<R>();
    for (const unsigned k : indices(limits.axes)) {
        const Steepness<R> s = steepness(*this, k);
        a = smaller(a, quotient_or_max(share * limits.acceleration_mm_s2[k] - s.second * v_sq, s.first));
        a = smaller(a, quotient_or_max(share * limits.jerk_mm_s3[k], R(9.0) * s.second * v));
    }
    auto j = largest<R>();
    for (const unsigned k : indices(limits.axes)) {
        const Steepness<R> s = steepness(*this, k);
        j = smaller(
            j, quotient_or_max(share * limits.jerk_mm_s3[k] - (R(3.0) * s.second * a + s.third * v_sq) * v, s.first));
    }
    return {to_double(v), to_double(a), to_double(j)};
}

template <Floating R>
bool JerkCell<R>::straight(R at_most_sq) const noexcept {
    const R v = square_root(at_most_sq);
    auto a = largest<R>(); // along the path
    for (const unsigned k : indices(limits.axes)) {
        a = smaller(a, quotient_or_max(share * limits.acceleration_mm_s2[k], steepness(*this, k).first));
    }
    for (const unsigned k : indices(limits.axes)) {
        const Steepness<R> s = steepness(*this, k);
        if (s.second * at_most_sq > R(nothing) * share * limits.acceleration_mm_s2[k] ||
            (R(3.0) * s.second * a + s.third * at_most_sq) * v > R(nothing) * share * limits.jerk_mm_s3[k]) {
            return false;
        }
    }
    return true;
}

#define SPLINEFEED_INSTANTIATE(R) template struct JerkCell<R>;
SPLINEFEED_EACH_JERK_REAL(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
