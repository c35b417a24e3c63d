// SPDX-License-Identifier: MIT
#include "splinefeed/s1_curve/waypoint_curve.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

namespace {

// 0.1 um in units of 2^-40 mm: nearer waypoints are merged. The time of a move of this length still has digits in
// Fixed.
constexpr std::int64_t merge_raw = (std::int64_t{1} << Position::fraction_bits) / 10000;
// 2^20 mm: positions outside are refused where they enter.
constexpr std::int64_t farthest_raw = std::int64_t{1} << (Position::fraction_bits + 20);

} // namespace

template <Scalar S>
S WaypointCurve<S>::span_of(S length) const noexcept {
    switch (options_.parameterization) {
    case Parameterization::uniform: return from_integer<S>(4096);
    case Parameterization::chordal: return length;
    case Parameterization::centripetal: return square_root(length);
    }
    return length;
}

template <Scalar S>
Status WaypointCurve<S>::push(const Waypoint<S>& waypoint, Role role) noexcept {
    if (finished_) {
        return Error::input_finished;
    }
    if (!has_room()) {
        return Error::no_room;
    }
    const auto axes_u = static_cast<unsigned>(axes());
    const std::int64_t longest_raw = std::int64_t{options_.longest_move_mm} << Position::fraction_bits;
    for (unsigned k = 0; k < axes_u; ++k) {
        const std::int64_t raw = waypoint.position[k].raw;
        if (raw > farthest_raw || raw < -farthest_raw) {
            return Error::position_out_of_range;
        }
    }
    const std::uint32_t index = pushed_;
    if (known_ > 0) {
        Knot<S>& last = knot(known_ - 1);
        bool merged = true;
        for (unsigned k = 0; k < axes_u; ++k) {
            const std::int64_t move = waypoint.position[k].raw - last.position[k].raw;
            if (move > longest_raw || move < -longest_raw) {
                return Error::move_too_long;
            }
            merged = merged && move < merge_raw && move > -merge_raw;
        }
        ++pushed_;
        if (merged) {
            if (last.role == Role::lead_in) {
                last.role = role;
            }
            if (waypoint.corner != Corner::automatic) {
                last.corner = waypoint.corner;
            }
            return {};
        }
        for (unsigned k = 0; k < axes_u; ++k) {
            last.chord[k] = distance<S>(last.position[k], waypoint.position[k], chord_unit_log2);
        }
        last.length = norm(last.chord, axes());
        last.span = span_of(last.length);
        if (known_ > 1) {
            decide_corner(known_ - 1);
        } else {
            last.breaks = true;
        }
    } else {
        ++pushed_;
    }
    Knot<S>& fresh = knot(known_);
    fresh.position = waypoint.position;
    fresh.feed_mm_s = waypoint.feed_mm_s;
    fresh.max_feed_mm_s = waypoint.max_feed_mm_s;
    fresh.corner = waypoint.corner;
    fresh.role = role;
    fresh.breaks = false;
    fresh.waypoint = index;
    fresh.span = S{};
    ++known_;
    return {};
}

template <Scalar S>
Status WaypointCurve<S>::finish() noexcept {
    finished_ = true;
    if (known_ < 2) {
        return Error::too_few_waypoints;
    }
    knot(known_ - 1).breaks = true;
    return {};
}

// Compares the turn angle between the chords at knot i with the corner angle; the corner column of the file overrides
// it. A move that is a million times longer than its neighbour always makes a corner: in Fixed the pivots of a spline
// over both would have no bits left, and the short move is invisible at the scale of the long one.
template <Scalar S>
void WaypointCurve<S>::decide_corner(std::uint64_t i) noexcept {
    Knot<S>& here = knot(i);
    const Knot<S>& before = knot(i - 1);
    if (here.length < scale2(before.length, -20) || before.length < scale2(here.length, -20)) {
        here.breaks = true;
        return;
    }
    if (here.corner != Corner::automatic) {
        here.breaks = here.corner == Corner::forced;
        return;
    }
    PerAxis<S> in = before.chord;
    PerAxis<S> out = here.chord;
    divide(in, before.length, axes());
    divide(out, here.length, axes());
    const S cosine = dot(in, out, axes());
    // The tolerance prevents that rounding decides about an exact 60-degree turn.
    here.breaks = cosine < options_.corner_cosine - literal<S>(1e-6);
}

template <Scalar S>
void WaypointCurve<S>::describe_segment(std::uint64_t i, int degree, CurveSegment<S>& out) const noexcept {
    const Knot<S>& to = knot(i + 1);
    out.axes = axes();
    out.degree = degree;
    out.origin = knot(i).position;
    out.end = to.position;
    out.feed_mm_s = to.feed_mm_s;
    out.max_feed_mm_s = to.max_feed_mm_s;
    out.stop_at_end = to.breaks;
    out.waypoint = to.waypoint;
}

SPLINEFEED_INSTANTIATE_CLASS(WaypointCurve)

} // namespace splinefeed
