// SPDX-License-Identifier: MIT
#include "splinefeed/s3_feed_plan/acceleration/speed_caps.hpp"

#include "splinefeed/number/division_by.hpp"
#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"
#include "splinefeed/s3_feed_plan/limits/axis_velocity.hpp"
#include "splinefeed/s3_feed_plan/limits/feed_share.hpp"

namespace splinefeed {

namespace {

// Beyond this change of |dq/ds|, of its mean, the tangent of its reciprocal's square would lie too low at the faster
// end.
constexpr double steepest = 0.5;

} // namespace

// At slowest_sq the acceleration of an axis is less than its smallest limit for any curvature below 1e5 /mm.
template <Scalar S>
CapLine<S> SpeedCaps<S>::cap(const Cell<S>& cell) const noexcept {
    const S speed = fastest_speed(cell);
    const S most_sq = smaller(speed * speed, bends_sq(cell));
    CapLine<S> cap{most_sq, most_sq};
    for (const unsigned k : indices(limits_.axes)) {
        const S velocity = axis_velocity(cell, limits_, k);
        if (speed * cell.tangent_max[k] > velocity) {
            cap = cap.limited_to(velocity_line(cell, k, velocity));
        }
    }
    return cap.raised_to(literal<S>(slowest_sq));
}

template <Scalar S>
S SpeedCaps<S>::bent_cap_sq(const Cell<S>& cell) const noexcept {
    S speed = fastest_speed(cell);
    for (const unsigned k : indices(limits_.axes)) {
        const S velocity = axis_velocity(cell, limits_, k);
        const bool by_itself = cell.degree > 1 && velocity == limits_.velocity_mm_s[k];
        if (!by_itself && speed * cell.tangent_max[k] > velocity) {
            speed = velocity / lengthened<S>(cell.tangent_max[k]);
        }
    }
    return larger(smaller(speed * speed, bends_sq(cell)), literal<S>(slowest_sq));
}

// By the feeds and rounding. The block's own maximum limits the feed, whatever is programmed and overridden.
template <Scalar S>
S SpeedCaps<S>::fastest_speed(const Cell<S>& cell) const noexcept {
    const S fastest = fastest_feed(cell);
    const S most = cell.max_feed_mm_s > S{} ? smaller(limits_.usable_feed(cell.max_feed_mm_s), fastest) : fastest;
    return smaller(path_speed(cell, most), cell.steady_mm_s);
}

// By the curvature.
template <Scalar S>
S SpeedCaps<S>::bends_sq(const Cell<S>& cell) const noexcept {
    S cap = largest<S>();
    const S twice = cell.length_mm + cell.length_mm;
    for (const unsigned k : indices(limits_.axes)) {
        if (twice * cell.curvature_max[k] > literal<S>(Cell<S>::sharp_turn)) {
            const S limit = smaller(limits_.acceleration_mm_s2[k], limits_.braking_mm_s2[k]);
            cap = smaller(cap, scale2(limit, -1) / cell.curvature_max[k]);
        }
    }
    if (limits_.centripetal_mm_s2 > S{} || limits_.chord_mm_s2 > S{}) {
        const S curvature = norm(cell.curvature_max, limits_.axes);
        if (limits_.centripetal_mm_s2 > S{}) {
            cap = smaller(cap, quotient_or_max(limits_.centripetal_mm_s2, curvature));
        }
        if (limits_.chord_mm_s2 > S{}) {
            cap = smaller(cap, quotient_or_max(limits_.chord_mm_s2, curvature));
        }
    }
    return cap;
}

// |q'| <= U, linear between the ends: the chord, higher by what the Bezier points of q' exceed it, of which a cubic has
// 3/4 at most, and by what q' differs from that cubic: its error in 2 L q'' adds up from the nearer end. V^2 / U^2 is
// convex, so its tangent in the middle of the cell lies below it. Where the largest |q'| is no more than U there, it
// allows more.
template <Scalar S>
CapLine<S> SpeedCaps<S>::velocity_line(const Cell<S>& cell, unsigned axis, S velocity) noexcept {
    using R = Ratio<S>;
    const AxisShape<S>& shape = cell.shape[axis];
    const R sixth = literal<R>(1.0 / 6.0);
    const R first = absolute(shape.tangent[0]);
    const R last = absolute(shape.tangent[1]);
    const R rise = last - first;
    const R third = sixth * (rise + rise);
    const R above = larger(absolute(shape.tangent[0] + sixth * shape.bend[0]) - (first + third),
                           absolute(shape.tangent[1] - sixth * shape.bend[2]) - (last - third));
    const R more = literal<R>(0.75) * larger(above, R{}) + scale2(shape.error_bound, -2);
    const R middle = half(first) + half(last) + more;
    if (!(middle < cell.tangent_max[axis]) || !(absolute(rise) < literal<R>(steepest) * middle)) {
        const S speed = velocity / lengthened<S>(cell.tangent_max[axis]);
        return {speed * speed, speed * speed};
    }
    const DivisionBy<S> by_middle(lengthened<S>(middle));
    const S speed = velocity / by_middle;
    const S speed_sq = speed * speed;
    const S change = speed_sq * (lengthened<S>(rise) / by_middle);
    return {speed_sq + change, speed_sq - change};
}

// The feed counts the linear axes; the others follow as fast as their own limits allow.
template <Scalar S>
S SpeedCaps<S>::path_speed(const Cell<S>& cell, S feed) const noexcept {
    return limits_.mixed ? smaller(quotient_or_max(feed, feed_share(cell, limits_)), limits_.path_mm_s) : feed;
}

template <Scalar S>
S SpeedCaps<S>::fastest_feed(const Cell<S>& cell) const noexcept {
    const bool turns = limits_.turning_mm_s > limits_.feed_mm_s && !(cell.feed_mm_s > S{}) && !cell.feed_along_path &&
                       !feed_is_linear(cell, limits_);
    return cell.feed_along_path ? limits_.path_mm_s : turns ? limits_.turning_mm_s : limits_.feed_mm_s;
}

template <Scalar S>
CapLine<S> SpeedCaps<S>::wanted(const Cell<S>& cell, const CapLine<S>& cap, const FeedWish<S>& wish) const noexcept {
    const S programmed = cell.feed_mm_s;
    const S fastest = fastest_feed(cell);
    CapLine<S> out = cap;
    S feed = fastest;
    if (programmed < S{}) { // a rapid
        if (wish.rapids < from_integer<S>(1)) {
            const S share = wish.rapids * wish.rapids;
            out = CapLine<S>{cap.entry_sq * share, cap.exit_sq * share}.raised_to(literal<S>(slowest_sq));
        }
    } else {
        feed = programmed > S{} ? limits_.usable_feed(programmed * wish.ratio) : feed * wish.ratio;
    }
    if (wish.most_mm_s < feed && feed_is_linear(cell, limits_)) {
        feed = limits_.usable_feed(wish.most_mm_s);
    }
    if (!(feed < fastest)) {
        return out;
    }
    const S speed = path_speed(cell, feed);
    return out.limited_to(speed * speed).raised_to(literal<S>(slowest_sq));
}

SPLINEFEED_INSTANTIATE_CLASS(SpeedCaps)

} // namespace splinefeed
