// SPDX-License-Identifier: MIT
//
// In a part of a cell, b = v^2 from b0 at its start to b1 at its end is allowed if (b0, b1) is in the polygon of the
// part (acceleration_bound.cpp). What is allowed on a cell is allowed on its parts: their Bezier points are convex
// combinations of the cell's. So the profile segment on which a machine is stays allowed from any place on it. Because
// (0, 0) is allowed, too, so is every slower start with some exit that is not faster.
//
// The hardest change: b1 is as far from b0 as the polygon allows. The profile segment ends where the line from b0 to b1
// reaches the wanted speed. A cell can be a thousand braking distances long. b1 may then be far below zero (it is only
// the slope of a line that ends earlier) or above all caps, and Fixed has no range for such values. So b1 is limited to
// twice the wanted change. If it could go further, half of the part is used instead, and so on.
#include "splinefeed/s3_feed_plan/acceleration/steered_segment.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

namespace {

// A machine that brakes for a hold slows down in steps of this part of a cell: b need not be linear over the whole
// cell. Where the path leaves an axis almost no room for braking, a slightly lower speed soon means a much shorter
// time.
constexpr double step = 0.25;

// 2^-28 of the longest cell is 6e-8 mm.
constexpr int most_halvings = 28;

// If the rest of a cell is shorter than this fraction of it, the profile segment before it includes it: its length
// would have few digits. A stop counts from where the machine is: else one that begins in that rest would coast to the
// end.
constexpr double negligible_part = 1.0 / 1024.0;

template <Scalar S>
struct Change {
    ProfileSegment<S> profile_segment{};
    bool reached = false; ///< the goal is reached within the cell
};

template <Scalar S>
Change<S> hardest_change(const Cell<S>& cell, const MotionLimits<S>& limits, const SteeringTarget<S>& aim,
                         S goal_sq) noexcept {
    const bool faster = goal_sq > aim.entry_sq;
    const S beyond = goal_sq + goal_sq - aim.entry_sq;
    ProfileSegment<S> profile_segment{{aim.from}, aim.entry_sq, {}, false};
    S at_most = aim.known_sq < S{} ? aim.most_sq : aim.known_sq;
    S& to = profile_segment.stretch.to;
    if (aim.rest && aim.from + literal<S>(step + negligible_part) < to) {
        to = aim.from + literal<S>(step);
        at_most = larger(at_most, aim.entry_sq);
    }
    S exit{};
    for (int halvings = 0;; ++halvings) {
        const AccelerationBound<S> bound(cell, limits, profile_segment.stretch);
        exit = faster ? bound.largest_exit(aim.entry_sq, beyond)
                      : bound.smallest_exit(aim.entry_sq, beyond, larger(at_most, beyond));
        if (halvings == most_halvings || (faster ? exit < beyond : exit > beyond)) {
            break;
        }
        to = aim.from + scale2(profile_segment.stretch.length(), -1);
        at_most = goal_sq; // it was passed in the middle of twice this part
    }
    profile_segment.exit_sq = exit;
    if (faster ? exit < goal_sq : exit > goal_sq) {
        return {profile_segment, false};
    }
    profile_segment.exit_sq = goal_sq;
    if (!(exit == goal_sq)) {
        to = aim.from + profile_segment.stretch.length() * ((goal_sq - aim.entry_sq) / (exit - aim.entry_sq));
    }
    return {profile_segment, true};
}

} // namespace

template <Scalar S>
ProfileSegment<S> steered_segment(const Cell<S>& cell, const MotionLimits<S>& limits,
                                  const SteeringTarget<S>& aim) noexcept {
    const S one = from_integer<S>(1);
    const S last = one - literal<S>(negligible_part);
    if (aim.rest || aim.entry_sq > aim.max_steady_sq) {
        Change<S> change = hardest_change(cell, limits, aim, aim.rest ? S{} : aim.max_steady_sq);
        const S last_stop = aim.rest ? one - (one - aim.from) * literal<S>(negligible_part) : last;
        if (change.reached && change.profile_segment.stretch.to < last_stop) {
            change.profile_segment.stops = aim.rest;
            return change.profile_segment;
        }
        if (aim.rest && change.profile_segment.stretch.to < last) {
            return change.profile_segment;
        }
        if (aim.rest) {
            const S exit = change.reached ? S{} : smaller(change.profile_segment.exit_sq, aim.most_sq);
            return {{aim.from}, aim.entry_sq, exit, !(exit > S{})};
        }
    } else if (aim.entry_sq < aim.exit_sq && !(aim.exit_sq > aim.level_sq)) {
        const Change<S> change = hardest_change(cell, limits, aim, aim.exit_sq);
        if (change.reached && change.profile_segment.stretch.to < last) {
            // From there on at this speed, if neither less nor more is wanted.
            const AccelerationBound<S> rest(cell, limits, {change.profile_segment.stretch.to});
            if (!(rest.largest_exit(aim.exit_sq, aim.exit_sq) < aim.exit_sq) &&
                !(rest.smallest_exit(aim.exit_sq, aim.exit_sq, aim.exit_sq + aim.exit_sq) > aim.exit_sq)) {
                return change.profile_segment;
            }
        }
    }
    const AccelerationBound<S> bound(cell, limits, {aim.from});
    const S at_most = aim.known_sq < S{} ? aim.most_sq : larger(aim.known_sq, aim.exit_sq);
    S exit = bound.smallest_exit(aim.entry_sq, aim.exit_sq, at_most);
    if (!(exit > aim.exit_sq)) {
        exit = larger(bound.largest_exit(aim.entry_sq, aim.exit_sq), smaller(aim.known_sq, aim.exit_sq));
    }
    return {{aim.from}, aim.entry_sq, smaller(exit, aim.most_sq), false};
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template ProfileSegment<S> steered_segment(const Cell<S>&, const MotionLimits<S>&,                                 \
                                               const SteeringTarget<S>&) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
