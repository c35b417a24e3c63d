// SPDX-License-Identifier: MIT
// leg_rows: the limits of one axis at one node, in a step of LegSolver. Derivation: leg_solver.cpp.
#pragma once

#include "splinefeed/number/scalar.hpp"
#include "splinefeed/s3_feed_plan/jerk/leg_node.hpp"

namespace splinefeed::detail {

inline constexpr double most_multiplier = 20.0; // of its value on the central path
inline constexpr double least_multiplier = 0.1; // of its last value
inline constexpr double per_way = 1.0 / 0.9;    // a step goes 0.9 of the way to the next limit

/// A number of this size, with the sign of another.
template <Floating R>
[[gnu::always_inline]] inline R with_sign(R size, R other) noexcept {
    return other < R(0) ? -size : size;
}

/// What the rows of a node depend on.
template <Floating R>
struct LegRow {
    R b;
    R slope;
    R root; // b^(-1/2)
    R per_b;
    R pull;               // mu tau
    R excess;             // phi r
    R wider;              // 1 + phi r
    R acceleration_share; // of the limit
    Pair<R> share;        // of the limit of the jerk, in the cell before and behind
    Pair<R> curvature;
};

/// Second and first derivatives of the model by db, dslope and du of the cells before and behind.
template <Floating R>
struct LegTerms {
    R bb{}, bs{}, ss{}, b{}, s{};                                   // of the acceleration
    Pair<R> jbb{}, jbs{}, jss{}, jb{}, js{}, ub{}, us{}, uu{}, u{}; // of the jerk
    Pair<R> limit_curvature{};
    R gap{};
    Pair<R> jerk_gap{};
};

/// The part of its limits that the axis uses at the node, at most. @param moves  the acceleration can be changed
template <Floating R>
R use_of_node(const LegAxis<R>& axis, R acceleration, R jerk, const LegRow<R>& row, bool moves) noexcept {
    const R by_u = R(0.5) * axis.first;
    R use{};
    if (moves) {
        use = absolute(axis.second * row.b + by_u * row.slope) /
              (acceleration * row.acceleration_share - larger_of<R>(axis.second_spread) * row.b);
    }
    const Pair<R> limit = jerk * row.root - axis.third_spread * row.b;
    const Pair<R> p = axis.third * row.b + R(1.5) * axis.second * row.slope + by_u * row.curvature;
    return larger(use, larger_of<R>(magnitude_of<R>(p / (limit * row.share))));
}

template <Floating R>
inline void add_acceleration(LegAxis<R>& axis, R most, const LegRow<R>& row, LegTerms<R>& terms) noexcept {
    const R by_slope = R(0.5) * axis.first;
    const R p = axis.second * row.b + by_slope * row.slope;
    const R spread = larger_of<R>(axis.second_spread);
    const R limit = most * row.acceleration_share - spread * row.b;
    const R wide = row.wider * limit;
    const R size = absolute(p);
    const R near = wide - size;
    const R far = wide + size;
    const R inverse = R(1) / (near * far);
    const R per_near = far * inverse;
    const R per_far = near * inverse;
    const R central = row.pull * per_near;
    R multiplier = axis.acceleration_multiplier * p > R(0) ? absolute(axis.acceleration_multiplier) : central;
    multiplier = smaller(multiplier, R(most_multiplier) * central);
    axis.acceleration_multiplier = with_sign(multiplier, p);
    axis.per_acceleration_slack = per_near;
    terms.gap += near * multiplier;
    const R stiff = multiplier * per_near;
    const R second = stiff + row.pull * per_far * per_far;
    const R first = with_sign(absolute(row.pull * (per_near - per_far) + stiff * row.excess * limit), p);
    const R by_b = axis.second + with_sign(row.wider * spread, p);
    const R of_b = second * by_b;
    const R of_slope = second * by_slope;
    terms.bb += of_b * by_b;
    terms.bs += of_b * by_slope;
    terms.ss += of_slope * by_slope;
    terms.b += first * by_b;
    terms.s += first * by_slope;
}

template <Floating R>
inline void add_jerk(LegAxis<R>& axis, R most, const LegRow<R>& row, LegTerms<R>& terms) noexcept {
    const R by_slope = R(1.5) * axis.second;
    const R by_u = R(0.5) * axis.first;
    const R at_root = most * row.root;
    const Pair<R> limit = at_root - axis.third_spread * row.b;
    const Pair<R> fall = R(0.5) * at_root * row.per_b + axis.third_spread; // -dh/db
    const Pair<R> p = axis.third * row.b + by_slope * row.slope + by_u * row.curvature;
    const Pair<R> share = row.share * row.wider;
    const Pair<R> wide = limit * share;
    const Pair<R> size = magnitude_of<R>(p);
    const Pair<R> near = wide - size;
    const Pair<R> far = wide + size;
    const Pair<R> inverse = R(1) / (near * far);
    const Pair<R> per_near = far * inverse;
    const Pair<R> per_far = near * inverse;
    const Pair<R> central = row.pull * per_near;
    Pair<R> multiplier = axis.jerk_multiplier * p > R(0) ? magnitude_of<R>(axis.jerk_multiplier) : central;
    const Pair<R> highest = R(most_multiplier) * central;
    multiplier = multiplier < highest ? multiplier : highest;
    axis.jerk_multiplier = with_sign_of<R>(multiplier, p);
    axis.per_jerk_slack = per_near;
    terms.jerk_gap += near * multiplier;
    const Pair<R> own_limit = limit * row.share;
    terms.limit_curvature += multiplier * own_limit;
    const Pair<R> stiff = multiplier * per_near;
    const Pair<R> second = stiff + row.pull * per_far * per_far;
    const Pair<R> first = with_sign_of<R>(row.pull * (per_near - per_far) + stiff * (row.excess * own_limit), p);
    const Pair<R> by_b = axis.third + with_sign_of<R>(fall * share, p);
    const Pair<R> of_b = second * by_b;
    const Pair<R> of_slope = second * by_slope;
    const Pair<R> of_u = second * by_u;
    terms.jbb += of_b * by_b;
    terms.jbs += of_b * by_slope;
    terms.jss += of_slope * by_slope;
    terms.jb += first * by_b;
    terms.js += first * by_slope;
    terms.ub += of_u * by_b;
    terms.us += of_u * by_slope;
    terms.uu += of_u * by_u;
    terms.u += first * by_u;
}

/// A step of the node: changes of b, db/ds, and of the curvature in the cells before and behind.
template <Floating R>
struct LegStep {
    R b;
    R slope;
    Pair<R> curvature;
};

/// The multiplier after the step. Raises `inverse` to the inverse of the part of the step that stays within the limit.
template <Floating R>
inline void follow_acceleration(LegAxis<R>& axis, R most, const LegRow<R>& row, const LegStep<R>& step,
                                R& inverse) noexcept {
    const R spread = larger_of<R>(axis.second_spread);
    const R limit = most * row.acceleration_share - spread * row.b;
    const R along = axis.second * step.b + R(0.5) * axis.first * step.slope;
    const R outward = axis.acceleration_multiplier < R(0) ? -along : along;
    const R change = -spread * step.b;
    const R dh = (change > R(0) ? R(1) : row.wider) * change - row.excess * limit;
    const R dz = dh - outward;
    const R size = absolute(axis.acceleration_multiplier);
    inverse = larger(inverse, -dz * axis.per_acceleration_slack * R(per_way));
    const R far = -(dh + outward) * R(per_way);
    if (far > inverse * row.wider * limit) {
        inverse = larger(inverse, far / (R(2) * row.wider * limit - R(1) / axis.per_acceleration_slack));
    }
    const R next = (row.pull - size * dz) * axis.per_acceleration_slack;
    axis.acceleration_multiplier = with_sign(larger(R(least_multiplier) * size, next), axis.acceleration_multiplier);
}

/// The same for the jerk.
template <Floating R>
inline void follow_jerk(LegAxis<R>& axis, R most, const LegRow<R>& row, const LegStep<R>& step,
                        Pair<R>& inverse) noexcept {
    const R at_root = most * row.root;
    const Pair<R> change = -(R(0.5) * at_root * row.per_b + axis.third_spread) * step.b * row.share;
    const Pair<R> limit = (at_root - axis.third_spread * row.b) * row.share;
    const Pair<R> along =
        axis.third * step.b + R(1.5) * axis.second * step.slope + R(0.5) * axis.first * step.curvature;
    const Pair<R> outward = with_sign_of<R>(along, axis.jerk_multiplier);
    const Pair<R> dh = (change > R(0) ? change : row.wider * change) - row.excess * limit;
    const Pair<R> dz = dh - outward;
    const Pair<R> size = magnitude_of<R>(axis.jerk_multiplier);
    const Pair<R> part = -dz * axis.per_jerk_slack * R(per_way);
    inverse = part > inverse ? part : inverse;
    const Pair<R> far = -(dh + outward) * R(per_way);
    const Pair<R> wide = row.wider * limit;
    if (far[0] > inverse[0] * wide[0] || far[1] > inverse[1] * wide[1]) {
        const Pair<R> other = far / (R(2) * wide - R(1) / axis.per_jerk_slack);
        inverse = other > inverse ? other : inverse;
    }
    const Pair<R> next = (row.pull - size * dz) * axis.per_jerk_slack;
    const Pair<R> lowest = R(least_multiplier) * size;
    axis.jerk_multiplier = with_sign_of<R>(next > lowest ? next : lowest, axis.jerk_multiplier);
}

} // namespace splinefeed::detail
