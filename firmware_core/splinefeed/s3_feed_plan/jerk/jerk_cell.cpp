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

#include "splinefeed/number/scalar.hpp"

namespace splinefeed {

namespace {

constexpr double nothing = 1e-4; // of a limit: a smaller bend takes no part of it

/// Largest derivatives of an axis in a cell.
struct Steepness {
    double first = 0.0;
    double second = 0.0;
    double third = 0.0;
};

Steepness steepness(const JerkCell& cell, unsigned axis) noexcept {
    Steepness s;
    for (const auto& end : cell.end) {
        const AxisEnd& at = end[axis];
        s.first = larger(s.first, absolute(at.first));
        s.second = larger(s.second, absolute(at.second) + at.second_spread);
        s.third = larger(s.third, absolute(at.third) + at.third_spread);
    }
    return s;
}

double least_acceleration(const JerkCell& cell, unsigned axis) noexcept {
    auto least = largest<double>();
    for (const auto& end : cell.end) {
        least = smaller(least, smaller(end[axis].most_forward, end[axis].most_backward));
    }
    return least;
}

} // namespace

double JerkCell::largest_from_rest(unsigned moving) const noexcept {
    double largest_b = cap_sq;
    const double l = length_mm;
    for (const unsigned k : indices(axes)) {
        const AxisEnd& rest = end[1 - moving][k];
        const AxisEnd& at = end[moving][k];
        const double direction = moving == 1 ? 1.0 : -1.0;
        const double first[] = {direction * rest.first, direction * rest.first + l * rest.second / 3.0,
                                direction * at.first - l * at.second / 3.0, direction * at.first};
        const double middle = 3.0 * (first[2] - first[1]) / l; // from the Bezier points of d2q/ds2
        const double third[] = {2.0 * (middle - rest.second) / l, 2.0 * (at.second - middle) / l};
        const double point[] = {first[0], first[1] + 3.0 * l * rest.second,
                                first[2] + 6.0 * l * middle + 1.5 * l * l * third[0],
                                first[3] + 9.0 * l * at.second + 4.5 * l * l * third[1]};
        const double share[] = {first[0], first[1] + 0.5 * l * rest.second, first[2] + l * middle,
                                first[3] + 1.5 * l * at.second};
        double max_path_acceleration = 0.0;
        for (const double acceleration : share) {
            max_path_acceleration = larger(max_path_acceleration, absolute(acceleration));
        }
        max_path_acceleration += 1.5 * l * larger(rest.second_spread, at.second_spread);
        largest_b = smaller(largest_b, quotient_or_max(1.5 * l * least_acceleration(*this, k), max_path_acceleration));
        double per_power = 0.0;
        for (const double jerk : point) {
            per_power = larger(per_power, absolute(jerk) * 2.0 / (9.0 * l * l) + at.third_spread);
        }
        // per_power b^(3/2) <= J
        if (per_power * largest_b * square_root(largest_b) > jerk_mm_s3[k]) {
            largest_b = smaller(largest_b, power_two_thirds(jerk_mm_s3[k] / per_power));
        }
    }
    return largest_b;
}

// |q'| a + |q''| v^2 <= A and |q'| j + 3 |q''| v a + |q'''| v^3 <= J: bends get at most half of A and two thirds of J.
MoveLimits JerkCell::move_limits(double most_sq) const noexcept {
    double v_sq = most_sq;
    for (const unsigned k : indices(axes)) {
        const Steepness s = steepness(*this, k);
        v_sq = smaller(v_sq, quotient_or_max(0.5 * least_acceleration(*this, k), s.second));
        if (3.0 * s.third * v_sq * square_root(v_sq) > jerk_mm_s3[k]) {
            v_sq = smaller(v_sq, power_two_thirds(jerk_mm_s3[k] / (3.0 * s.third)));
        }
    }
    const double v = square_root(v_sq);
    auto a = largest<double>();
    for (const unsigned k : indices(axes)) {
        const Steepness s = steepness(*this, k);
        a = smaller(a, quotient_or_max(least_acceleration(*this, k) - s.second * v_sq, s.first));
        a = smaller(a, quotient_or_max(jerk_mm_s3[k], 9.0 * s.second * v));
    }
    auto j = largest<double>();
    for (const unsigned k : indices(axes)) {
        const Steepness s = steepness(*this, k);
        j = smaller(j, quotient_or_max(jerk_mm_s3[k] - (3.0 * s.second * a + s.third * v_sq) * v, s.first));
    }
    return {v, a, j};
}

bool JerkCell::straight(double most_sq) const noexcept {
    const double v = square_root(most_sq);
    auto a = largest<double>(); // along the path
    for (const unsigned k : indices(axes)) {
        a = smaller(a, quotient_or_max(least_acceleration(*this, k), steepness(*this, k).first));
    }
    for (const unsigned k : indices(axes)) {
        const Steepness s = steepness(*this, k);
        if (s.second * most_sq > nothing * least_acceleration(*this, k) ||
            (3.0 * s.second * a + s.third * most_sq) * v > nothing * jerk_mm_s3[k]) {
            return false;
        }
    }
    return true;
}

} // namespace splinefeed
