// SPDX-License-Identifier: MIT
//
// The S-curve of a straight move is the average of a trapezoid of v with the acceleration J T, over
//
//   T = min(A / J, (L / (2 J))^(1/3), (V / J)^(1/2)).
//
// A straight leg has exactly this T. A leg with bends has at most MotionLimits::smoothing_q8: a longer average mixes a
// bend with more of the path beside it. Where the steepest bend of the leg allows almost the speed of the fastest cell,
// there is nothing to mix. The time of such a leg is at most A / J, as on a straight one. That is known with its end,
// so the choice waits for that until the motion is at the leg.
//
// A straight leg that is longer than the known path is taken for as long as that. T is at most a third of the least
// time of the known cells, so that enough of the path is known.
#include "splinefeed/s3_feed_plan/jerk_filtered/leg_smoothing.hpp"

#include "splinefeed/s3_feed_plan/jerk_filtered/filtered_limits.hpp"

namespace splinefeed {

namespace {

constexpr double straight = 1e-4;  // largest bend of a straight leg, as a part of the acceleration
constexpr double mild_part = 0.25; // least v^2 of a leg whose bends are mild, as a part of its largest v^2

} // namespace

template <Scalar S>
void LegSmoothing<S>::add(const PathDerivativeBounds<S>& own, S length_mm, S bound_sq) noexcept {
    length_ = smaller(length_ + length_mm, literal<S>(1e6));
    ticks_ =
        smaller(ticks_ + quotient_or_max(length_mm * limits_->segments_per_s, square_root(bound_sq)), literal<S>(1e6));
    fastest_sq_ = larger(fastest_sq_, bound_sq);
    all_.join(own, limits_->axes);
}

// Whether the whole leg could be travelled at one speed, not much below that of its fastest cell.
template <Scalar S>
bool LegSmoothing<S>::mild() const noexcept {
    const Smoothing<S> longest(limits_->most_smoothing_q8, *limits_);
    return !all_.beyond &&
           !(FilteredLimits<S>(all_, *limits_, longest).max_steady(fastest_sq_) < fastest_sq_ * literal<S>(mild_part));
}

// By bisection.
template <Scalar S>
std::uint32_t LegSmoothing<S>::longest_q8(bool& in_view) const noexcept {
    bool bends = all_.beyond;
    S jerk = literal<S>(1e9);
    S acceleration = largest<S>();
    for (const unsigned k : indices(limits_->axes)) {
        const AxisDemand<S>& axis = all_.axis[k];
        const S limit = smaller(limits_->acceleration_mm_s2[k], limits_->braking_mm_s2[k]);
        jerk = smaller(jerk, quotient_or_max(limits_->jerk_mm_s3[k], axis.first));
        acceleration = smaller(acceleration, quotient_or_max(limit, axis.first));
        bends = bends || quotient_or_max(limit * literal<S>(straight), axis.second) < all_.cap_sq;
    }
    const S segment = from_integer<S>(1) / scale2(limits_->segments_per_s, Smoothing<S>::fraction_bits);
    const auto seen = [&](std::uint32_t q8) {
        const S duration = from_integer<S>(static_cast<std::int32_t>(q8));
        return ends_ || literal<S>(3.0) * scale2(duration, -Smoothing<S>::fraction_bits) <= ticks_;
    };
    const auto allowed = [&](std::uint32_t q8) {
        const S duration = from_integer<S>(static_cast<std::int32_t>(q8));
        const S t = segment * duration;
        // No acceleration or speed of a path is above 1e7; T is up to 100 s.
        const S a = smaller(jerk, quotient_or_max(literal<S>(1e7), t)) * t;
        const S v = smaller(a * t, literal<S>(1e7));
        return seen(q8) && (!ends_ || v * t <= scale2(length_, -1)) && a <= acceleration &&
               (bends || smaller(v, literal<S>(4e4)) * smaller(v, literal<S>(4e4)) <= all_.cap_sq);
    };
    std::uint32_t low = 1U << Smoothing<S>::fraction_bits;
    std::uint32_t high = bends && !(ends_ && mild()) ? limits_->smoothing_q8 : limits_->most_smoothing_q8;
    if (allowed(high)) {
        in_view = true;
        return high;
    }
    while (low + 1 < high) {
        const std::uint32_t middle = (low + high) / 2;
        (allowed(middle) ? low : high) = middle;
    }
    in_view = seen(low + 1);
    return low;
}

template class LegSmoothing<double>;
template class LegSmoothing<float>;
template class LegSmoothing<Fixed>;

} // namespace splinefeed
