// SPDX-License-Identifier: MIT
//
// A motion s(t) with constant acceleration a along the path in every cell is averaged over T:
//
//   s_f(t) = mean of s over [t - T/2, t + T/2],  v_f and a_f the means of v and a,
//   j_f = (a(t + T/2) - a(t - T/2)) / T.
//
// The machine is at q(s_f(t)). Let Q1, Q2, Q3 be the largest |q'|, |q''|, |q'''| of an axis over all places where s_f
// can be while s is in a cell, plus or minus T/2 (SmoothWindow finds that part of the path). If in every cell, with v
// at its faster end and w = v + |a| T/2,
//
//   Q1 |a| + Q2 v^2 <= A                                              (1)
//   Q1 |a| / T + max(Q3 w^3, 3 Q2 w |a| + Q3s w^3) <= J               (2)
//
// and if a changes its sign only after a time T with a = 0, then the axis keeps A and J:
//
// (1) For every instant of the average |q'| |a| + |q''| v^2 <= A with q' and q'' at s_f. So it holds for the means, and
// v_f^2 is at most the mean of v^2.
// (2) All accelerations of the average have one sign or are 0. So |j_f| <= M / T with M the largest |a| among them, and
// |a_f| <= M. In the cell of that M, v_f <= v + M T/2 = w. Where q'' a and q''' have the same sign, the two parts of 3
// q'' v a + q''' v^3 add up, and Q3s is the largest |q'''| of such places: where q'' and q''' have the same sign for a
// > 0, and opposite signs for a < 0. Elsewhere the larger of both parts counts.
//
// Both left sides are convex in v^2 if v^2 at the other end is given, and in a if v is given. Between a point that is
// allowed and one that is not, the chord lies above them and meets the limit at a point that is allowed. With the
// Illinois rule a few such steps come within a thousandth, once both points are not too far apart. (2) is multiplied by
// T: it is then an acceleration like (1).
#include "splinefeed/s3_feed_plan/jerk_filtered/filtered_limits.hpp"

#include "splinefeed/number/division_by.hpp"

#include <bit>

namespace splinefeed {

namespace {

constexpr int steps = 4;
constexpr int level_steps = 8;           // of a cell's max_steady_sq, which is computed once
constexpr double nearly = 1.0 - 0x1p-14; // of the distance to the point where a chord meets the limit, so that rounding
                                         // does not exceed it
constexpr int most_shrinks = 14;         // by 8, if far too large: v down to 1e-6 of a first guess

// The largest x from low to high with excess(x) <= 0, up to the tolerance of the steps. @pre excess(low) <= 0
template <Scalar S, class Excess>
S largest_allowed(S low, S high, S close, Excess&& excess, int most_steps = steps) noexcept {
    S above = excess(high);
    if (!(above > S{})) {
        return high;
    }
    S below = excess(low);
    for (int i = 0; i < most_shrinks && above > scale2(-below, 2); ++i) {
        const S x = low + scale2(high - low, -3);
        const S e = excess(x);
        if (!(e > S{})) {
            low = x;
            below = e;
            break;
        }
        high = x;
        above = e;
    }
    bool rose = false;
    for (int i = 0; i < most_steps && below < -close; ++i) {
        const S met = low + (high - low) * (-below / (above - below) * literal<S>(nearly));
        const S x = met < high ? met : scale2(low + high, -1); // in Fixed it may be rounded to what is not allowed
        const S e = excess(x);
        if (e > S{}) {
            high = x;
            above = e;
            rose = false;
        } else {
            low = x;
            below = e;
            above = rose ? scale2(above, -1) : above;
            rose = true;
        }
    }
    return low;
}

// The first twelve digits of x >= 0. So cells with almost the same limits get the same speed. A motion that brakes by a
// ten-thousandth may not accelerate again for as long as the average lasts.
template <Scalar S>
S truncated(S x) noexcept {
    constexpr int digits = 12;
    if constexpr (std::same_as<S, Fixed>) {
        const auto raw = static_cast<std::uint64_t>(x.raw());
        const int excess = 64 - std::countl_zero(raw) - digits;
        return excess > 0 ? Fixed::from_raw(static_cast<std::int64_t>(raw >> excess << excess)) : x;
    } else if constexpr (std::same_as<S, float>) {
        return std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) & (~std::uint32_t{} << (24 - digits)));
    } else {
        return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & (~std::uint64_t{} << (53 - digits)));
    }
}

} // namespace

// The largest change of an axis's acceleration within T. If |q'''| is above the range of the scalar, its value is not
// known. There the speed is the crawling speed, at which q''' needs less than half of the jerk
// (detail::sharpest_curvature): the other half is left for the known part.
template <Scalar S>
S FilteredLimits<S>::change(unsigned axis) const noexcept {
    return demand_->beyond ? scale2(smoothing_->change_mm_s2[axis], -1) : smoothing_->change_mm_s2[axis];
}

// How far the worst axis exceeds its acceleration, or T times its jerk; `speed` is the root of speed_sq.
template <Scalar S>
template <bool Braking>
S FilteredLimits<S>::excess(S speed_sq, S speed, S acceleration) const noexcept {
    const S t = smoothing_->seconds;
    const S w = speed + acceleration * smoothing_->half_s;
    const S w_t = w * t;
    if (!(w < from_integer<S>(1 << 15))) { // no path is that fast, and in Fixed its square does not fit
        return from_integer<S>(1 << 29);
    }
    const S w_sq = w * w;
    const S thrice = from_integer<S>(3) * acceleration * t;
    const bool steady = acceleration == S{};
    S most = -largest<S>();
    for (const unsigned k : indices(limits_->axes)) {
        const AxisDemand<S>& at = demand_->axis[k];
        const auto cubed = [&](S third) {
            return bounded_product(bounded_product(third, w_t), w_sq);
        };
        const S limit = smaller(limits_->acceleration_mm_s2[k], limits_->braking_mm_s2[k]);
        const S across = bounded_product(at.second, speed_sq) - limit;
        const S steepest = larger(at.third_with, at.third_against);
        if (steady) {
            most = larger(most, larger(across, cubed(steepest) - change(k)));
            continue;
        }
        const S along = at.first * acceleration;
        const S third = Braking ? at.third_against : at.third_with;
        S bend = bounded_product(bounded_product(at.second, w), thrice) + cubed(third);
        if (third < steepest) {
            bend = larger(bend, cubed(steepest));
        }
        most = larger(most, along + larger(across, bend - change(k)));
    }
    return most;
}

template <Scalar S>
S FilteredLimits<S>::max_steady(S at_most) const noexcept {
    const S level = largest_allowed(
        S{}, at_most, smoothing_->close_mm_s2,
        [&](S speed_sq) { return excess<false>(speed_sq, square_root(speed_sq), S{}); }, level_steps);
    return level < at_most ? truncated(level) : level;
}

template <Scalar S>
S FilteredLimits<S>::max_path_acceleration() const noexcept {
    S most = scale2(from_integer<S>(1), 22); // more than the limits of six axes together
    for (const unsigned k : indices(limits_->axes)) {
        const S limit = smaller(smaller(limits_->acceleration_mm_s2[k], limits_->braking_mm_s2[k]), change(k));
        most = smaller(most, quotient_or_max(limit, demand_->axis[k].first));
    }
    return most;
}

template <Scalar S>
template <bool Braking>
S FilteredLimits<S>::faster_end(S slower_sq, S at_most, S length_mm, S max_path_acceleration) const noexcept {
    if (!(at_most > slower_sq)) {
        return at_most;
    }
    const S twice = length_mm + length_mm;
    // The steepest line is allowed if nothing bends; a steeper one never is.
    const DivisionBy<S> by_twice(twice);
    const auto steepness = [&](S change) {
        return twice > S{} ? smaller(change / by_twice, max_path_acceleration) : max_path_acceleration;
    };
    const S change = at_most - slower_sq;
    const S high = steepness(change) < max_path_acceleration ? at_most : slower_sq + twice * max_path_acceleration;
    return largest_allowed(slower_sq, smaller(high, at_most), smoothing_->close_mm_s2, [&](S speed_sq) {
        return excess<Braking>(speed_sq, square_root(speed_sq), steepness(speed_sq - slower_sq));
    });
}

template <Scalar S>
S FilteredLimits<S>::largest_exit(S entry_sq, S at_most, S length_mm, S max_path_acceleration) const noexcept {
    return faster_end<false>(entry_sq, at_most, length_mm, max_path_acceleration);
}

template <Scalar S>
S FilteredLimits<S>::largest_entry(S exit_sq, S at_most, S length_mm, S max_path_acceleration) const noexcept {
    return faster_end<true>(exit_sq, at_most, length_mm, max_path_acceleration);
}

template <Scalar S>
S FilteredLimits<S>::acceleration(S speed_sq, S max_path_acceleration) const noexcept {
    const S speed = square_root(speed_sq);
    return largest_allowed(S{}, max_path_acceleration, smoothing_->close_mm_s2,
                           [&](S a) { return excess<false>(speed_sq, speed, a); });
}

template <Scalar S>
S FilteredLimits<S>::braking(S speed_sq, S max_path_acceleration) const noexcept {
    const S speed = square_root(speed_sq);
    return largest_allowed(S{}, max_path_acceleration, smoothing_->close_mm_s2,
                           [&](S a) { return excess<true>(speed_sq, speed, a); });
}

template class FilteredLimits<double>;
template class FilteredLimits<float>;
template class FilteredLimits<Fixed>;

} // namespace splinefeed
