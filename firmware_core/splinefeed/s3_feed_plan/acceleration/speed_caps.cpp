// SPDX-License-Identifier: MIT
#include "splinefeed/s3_feed_plan/acceleration/speed_caps.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"
#include "splinefeed/s3_feed_plan/limits/axis_velocity.hpp"
#include "splinefeed/s3_feed_plan/limits/feed_share.hpp"

namespace splinefeed {

// At slowest_sq the acceleration of an axis is less than its smallest limit for any curvature below 1e5 /mm.
template <Scalar S>
S SpeedCaps<S>::cap_sq(const Cell<S>& cell, bool turns) const noexcept {
    // The block's own maximum limits the feed, whatever is programmed and overridden.
    const S fastest = fastest_feed(cell);
    const S most = cell.max_feed_mm_s > S{} ? smaller(limits_.usable_feed(cell.max_feed_mm_s), fastest) : fastest;
    S speed = path_speed(cell, most);
    for (const unsigned k : indices(limits_.axes)) {
        const S velocity = axis_velocity(cell, limits_, k);
        if (!(turns && velocity == limits_.velocity_mm_s[k]) && speed * cell.tangent_max[k] > velocity) {
            speed = velocity / lengthened<S>(cell.tangent_max[k]);
        }
    }
    speed = smaller(speed, cell.steady_mm_s);
    S cap = speed * speed;
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
    return larger(cap, literal<S>(slowest_sq));
}

// The feed counts the linear axes; the others follow as fast as their own limits allow.
template <Scalar S>
S SpeedCaps<S>::path_speed(const Cell<S>& cell, S feed) const noexcept {
    return limits_.mixed ? smaller(quotient_or_max(feed, feed_share(cell, limits_)), limits_.path_mm_s) : feed;
}

template <Scalar S>
S SpeedCaps<S>::fastest_feed(const Cell<S>& cell) const noexcept {
    return cell.feed_along_path ? limits_.path_mm_s : limits_.feed_mm_s;
}

template <Scalar S>
S SpeedCaps<S>::wanted_sq(const Cell<S>& cell, S cap_sq, const FeedWish<S>& wish) const noexcept {
    const S programmed = cell.feed_mm_s;
    const S fastest = fastest_feed(cell);
    S feed = fastest;
    if (programmed < S{}) { // a rapid
        const S slower = larger(cap_sq * (wish.rapids * wish.rapids), literal<S>(slowest_sq));
        cap_sq = wish.rapids < from_integer<S>(1) ? slower : cap_sq;
    } else {
        feed = programmed > S{} ? limits_.usable_feed(programmed * wish.ratio) : feed * wish.ratio;
    }
    if (wish.most_mm_s < feed && feed_is_linear(cell, limits_)) {
        feed = limits_.usable_feed(wish.most_mm_s);
    }
    if (!(feed < fastest)) {
        return cap_sq;
    }
    const S speed = path_speed(cell, feed);
    return larger(smaller(cap_sq, speed * speed), literal<S>(slowest_sq));
}

SPLINEFEED_INSTANTIATE_CLASS(SpeedCaps)

} // namespace splinefeed
