// SPDX-License-Identifier: MIT
//
// g is what the acceleration allows, less what a bend (q''') and a start or a stop (b = (4.5 J)^(2/3) s^(4/3) / 4) take
// of the jerk. The curvature |b''| that the jerk allows is c = J / (|q'| sqrt(g)). With W'' = c two envelopes keep it:
//
//   1. f = W + the lower envelope of the lines g_y - W_y - W'_y (s - s_y), at each cell y: b'' <= c, below g;
//   2. the lower convex hull of f + W, minus W: b'' >= -c.
//
// This is the double envelope of Lasry and Lions (1986), there with a constant c. Both are found in one pass, by a
// stack of corners, because slopes and places are sorted.
//
// W itself is never computed: it would be large beside f, and float would lose f. From one corner p to the next one, q,
// its increase beyond the tangent is D = W_q - W_p - W'_p d, and that of its slope C = W'_q - W'_p: sums of positive
// numbers, also where corners between them are left out (Way). Lines cross (g_q - g_p - D) / C behind q.
//
// The envelope E is a value at the middle of a cell; the Bezier point there is E - L^2 E'' / 8.
#include "splinefeed/s3_feed_plan/jerk/leg_guess.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/scalar.hpp"
#include "splinefeed/s3_feed_plan/jerk/s_curve_profile.hpp"

namespace splinefeed {

namespace {

constexpr double of_acceleration = 0.9; // of the likely speed
constexpr double of_bend = 0.7;         // of the jerk: what a bend may take
constexpr double of_rest = 0.5;         // of b of a start with all of the jerk
constexpr double of_curvature = 1.0;    // of 2 J / (|q'| sqrt(b)), half of it
constexpr double of_envelope = 0.9;
constexpr double least_envelope = 1e-3; // of g
constexpr double least_tangent = 1e-3;
constexpr double least_start = 0.02; // of b at a moving start
constexpr double free_again = 4.0;   // a motion from the start that is so much faster binds no more
constexpr double least_middle = 0.3; // of the envelope
constexpr double of_cap = 0.9;
constexpr double of_cap_in_motion = 0.95;
constexpr double below_cap = 0.9999; // the plan in force may be as close to it

/// From the middle of a cell to that of a later one.
template <Floating R>
struct Way {
    R length{};
    R turn{}; // C
    R rise{}; // D
};

template <Floating R>
Way<R> operator+(const Way<R>& one, const Way<R>& next) noexcept {
    return {one.length + next.length, one.turn + next.turn, one.rise + one.turn * next.length + next.rise};
}

// The members of a node that hold its part of the envelopes meanwhile.
template <Floating R>
struct Envelope {
    std::span<LegNode<R>> node;

    [[nodiscard]] R& bound(std::size_t i) const noexcept { return node[i].excess; }        // g
    [[nodiscard]] R& below(std::size_t i) const noexcept { return node[i].per_cap_slack; } // f
    [[nodiscard]] R& bend(std::size_t i) const noexcept { return node[i].cap_multiplier; } // c
    /// The half cells from the middle of a cell to that of the next one, or back.
    [[nodiscard]] Way<R> step(std::size_t from, std::size_t to) const noexcept {
        const auto half = [&](std::size_t i) {
            const R length = R(0.5) * node[i].length_mm;
            return Way<R>{length, bend(i) * length, R(0.5) * bend(i) * length * length};
        };
        return half(from) + half(to);
    }
    // The stack
    [[nodiscard]] std::size_t& corner(std::size_t k) const noexcept { return node[k].corner; }
    [[nodiscard]] Way<R> way_to(std::size_t k) const noexcept { // from the corner before
        return {node[k].gain[0], node[k].gain[1], node[k].gain[2]};
    }
    void push(std::size_t k, std::size_t cell, const Way<R>& way) const noexcept {
        corner(k) = cell;
        node[k].gain = {way.length, way.turn, way.rise};
    }
};

template <Floating R>
R curvature_bound(const LegNode<R>& node, const AxisLimits<R>& limits, R b) noexcept {
    R most{};
    for (const unsigned k : indices(limits.axes)) {
        most = larger(most, larger(absolute(node.axis[k].first), R(least_tangent)) / limits.jerk_mm_s3[k]);
    }
    return R(of_curvature) / (most * detail::hardware_square_root(b));
}

template <Floating R>
R speed_bound(const LegNode<R>& node, const LegNode<R>& next, const AxisLimits<R>& limits) noexcept {
    const R g = R(of_acceleration) * smaller(node.likely_sq, node.cap_sq);
    R third{};
    for (const unsigned k : indices(limits.axes)) {
        const R most = larger(absolute(R(node.axis[k].third[1])), absolute(R(next.axis[k].third[0])));
        third = larger(third, most / limits.jerk_mm_s3[k]);
    }
    if (!(third * g * detail::hardware_square_root(g) > R(of_bend))) {
        return g;
    }
    return power_two_thirds(R(of_bend) / third);
}

template <Floating R>
void measure(const Envelope<R>& e, std::size_t n, const AxisLimits<R>& limits, bool rests) noexcept {
    R jerk = limits.jerk_mm_s3[0];
    for (const unsigned k : indices(limits.axes)) {
        jerk = smaller(jerk, limits.jerk_mm_s3[k]);
    }
    const R rest = R(of_rest) * power_two_thirds(R(4.5) * jerk);
    const auto from_rest = [&](std::size_t i, R& place) {
        const R way = power_two_thirds(place + R(0.5) * e.node[i].length_mm);
        place += e.node[i].length_mm;
        e.bound(i) = smaller(e.bound(i), rest * way * way);
    };
    R place{};
    for (std::size_t i = 0; i < n; ++i) {
        e.bound(i) = speed_bound(e.node[i], e.node[i + 1], limits);
        if (rests) {
            from_rest(i, place);
        }
    }
    place = R(0);
    for (std::size_t i = n; i-- > 0;) {
        from_rest(i, place);
        e.bend(i) = curvature_bound(e.node[i], limits, e.bound(i));
    }
}

template <Floating R>
void round_peaks(const Envelope<R>& e, std::size_t n) noexcept {
    // Where the lines of two corners cross, behind the second one.
    const auto crossing = [&](std::size_t from, std::size_t to, const Way<R>& way) {
        return (e.bound(to) - e.bound(from) - way.rise) / way.turn;
    };
    std::size_t corners = 0;
    for (std::size_t y = 0; y < n; ++y) {
        Way<R> way = y > 0 ? e.step(y - 1, y) : Way<R>{};
        while (corners > 1) {
            const std::size_t last = e.corner(corners - 1);
            if (crossing(e.corner(corners - 2), last, e.way_to(corners - 1)) < way.length + crossing(last, y, way)) {
                break;
            }
            way = e.way_to(--corners) + way;
        }
        e.push(corners++, y, way);
        e.below(y) = e.bound(y);
    }
    for (std::size_t k = 0; k < corners; ++k) { // the line of a corner is the lowest between its crossings
        const std::size_t y = e.corner(k);
        const auto lower = [&](std::size_t i, const Way<R>& way) {
            e.below(i) = smaller(e.below(i), e.bound(y) + way.rise);
        };
        if (k + 1 < corners) {
            const Way<R> next = e.way_to(k + 1);
            const R end = next.length + crossing(y, e.corner(k + 1), next);
            Way<R> way;
            for (std::size_t i = y + 1; i < n && (way = way + e.step(i - 1, i)).length <= end; ++i) {
                lower(i, way);
            }
        } else {
            Way<R> way;
            for (std::size_t i = y + 1; i < n; ++i) {
                lower(i, way = way + e.step(i - 1, i));
            }
        }
        const R start = k > 0 ? -crossing(e.corner(k - 1), y, e.way_to(k)) : largest<R>();
        Way<R> way;
        for (std::size_t i = y; i-- > 0 && (way = way + e.step(i + 1, i)).length <= start;) {
            lower(i, way);
        }
    }
}

// Not above a motion from the start with all of the jerk, until that is much faster.
template <Floating R>
void follow_start(const Envelope<R>& e, std::size_t n, const AxisLimits<R>& limits) noexcept {
    R b = e.node[0].b;
    R slope = e.node[0].slope;
    const R least = R(least_start) * b;
    for (std::size_t i = 0; i < n; ++i) {
        const LegNode<R>& node = e.node[i];
        const R u = curvature_bound(node, limits, b);
        const R middle = larger(b + R(0.5) * slope * node.length_mm, least);
        e.below(i) = smaller(e.below(i), middle);
        if (middle > R(free_again) * e.below(i)) {
            return;
        }
        b = larger(middle + R(0.5) * node.length_mm * (slope + u * node.length_mm), least);
        slope += u * node.length_mm;
    }
}

template <Floating R>
void round_dips(const Envelope<R>& e, std::size_t n) noexcept {
    const auto rise = [&](std::size_t from, std::size_t to, const Way<R>& way) { // beyond the tangent of W
        return e.below(to) - e.below(from) + way.rise;
    };
    std::size_t corners = 0;
    for (std::size_t y = 0; y < n; ++y) {
        Way<R> way = y > 0 ? e.step(y - 1, y) : Way<R>{};
        while (corners > 1) {
            const std::size_t last = e.corner(corners - 1);
            const Way<R> before = e.way_to(corners - 1);
            if (rise(e.corner(corners - 2), last, before) * way.length <
                (rise(last, y, way) + before.turn * way.length) * before.length) {
                break;
            }
            way = before + way;
            --corners;
        }
        e.push(corners++, y, way);
    }
    for (std::size_t k = 1; k < corners; ++k) {
        const std::size_t p = e.corner(k - 1);
        const std::size_t q = e.corner(k);
        const Way<R> whole = e.way_to(k);
        const R slope = rise(p, q, whole) / whole.length;
        Way<R> way;
        for (std::size_t i = p; i < q || (i == q && k + 1 == corners); ++i) {
            const R value = R(of_envelope) * (e.below(p) + slope * way.length - way.rise);
            e.node[i].middle_sq = larger(value, R(least_envelope) * e.bound(i));
            way = way + (i + 1 < n ? e.step(i, i + 1) : Way<R>{});
        }
    }
}

// Second derivative of values at the middles of three cells.
template <Floating R, class ValueAt>
R bend_at(std::span<const LegNode<R>> nodes, std::size_t i, ValueAt&& value_at) noexcept {
    const R before = R(0.5) * (nodes[i - 1].length_mm + nodes[i].length_mm);
    const R behind = R(0.5) * (nodes[i].length_mm + nodes[i + 1].length_mm);
    return R(2) * ((value_at(i + 1) - value_at(i)) / behind - (value_at(i) - value_at(i - 1)) / before) /
           (before + behind);
}

} // namespace

template <Floating R>
void guess_leg(std::span<LegNode<R>> nodes, const AxisLimits<R>& limits, bool rests) noexcept {
    const std::size_t n = nodes.size() - 1;
    const Envelope<R> e{nodes};
    const R start = nodes[0].middle_sq;
    measure(e, n, limits, rests);
    round_peaks(e, n);
    if (!rests) {
        follow_start(e, n, limits);
    }
    round_dips(e, n);
    R before = nodes[0].middle_sq; // the envelope, overwritten from the front
    for (std::size_t i = 1; i + 1 < n; ++i) {
        LegNode<R>& node = nodes[i];
        const R here = node.middle_sq;
        const R bend = bend_at<R>(nodes, i, [&](std::size_t k) { return k < i ? before : nodes[k].middle_sq; });
        const R middle = larger(here - R(0.125) * node.length_mm * node.length_mm * bend, R(least_middle) * here);
        node.middle_sq = smaller(middle, R(of_cap) * node.cap_sq);
        before = here;
    }
    nodes[0].middle_sq = rests ? R(0) : start;
    nodes[n - 1].middle_sq = R(0);
}

template <Floating R>
void lead_over(std::span<LegNode<R>> nodes, std::size_t known, R from) noexcept {
    const std::size_t n = nodes.size() - 1;
    R total{};
    for (std::size_t i = 0; i < known; ++i) {
        total += nodes[i].length_mm;
    }
    const R start = from * total;
    const R way = total - start;
    // Beyond the old plan it stands, almost.
    const auto known_sq = [&](std::size_t i) {
        return i + 1 < known ? nodes[i].known_sq : R(1e-3) * nodes[i].likely_sq;
    };
    R s = nodes[0].length_mm;
    R before = nodes[0].middle_sq;
    for (std::size_t i = 1; i + 1 < n; ++i) {
        LegNode<R>& node = nodes[i];
        const R half = R(0.5) * node.length_mm;
        const R x = (s + half - start) / way;
        const bool within = x > R(0) && x < R(1);
        const R theta = x > R(0) ? (x < R(1) ? x * x * (R(3) - R(2) * x) : R(1)) : R(0);
        const R here = node.middle_sq;
        const R difference = here - known_sq(i);
        R middle = known_sq(i) + theta * difference;
        if (within) {
            const R rise = (nodes[i + 1].middle_sq - known_sq(i + 1) - before + known_sq(i - 1)) /
                           (R(0.5) * (nodes[i - 1].length_mm + nodes[i + 1].length_mm) + node.length_mm);
            const R theta1 = R(6) * x * (R(1) - x) / way;
            const R theta2 = (R(6) - R(12) * x) / (way * way);
            const R bend = theta2 * difference + R(2) * theta1 * rise;
            middle = larger(middle - R(0.5) * half * half * bend, R(least_middle) * middle);
        }
        const R in_force = smaller(known_sq(i), R(below_cap) * node.cap_sq);
        node.middle_sq = smaller(middle, larger(R(of_cap_in_motion) * node.cap_sq, in_force));
        before = here;
        s += node.length_mm;
    }
}

#define SPLINEFEED_INSTANTIATE(R)                                                                                      \
    template void guess_leg(std::span<LegNode<R>>, const AxisLimits<R>&, bool) noexcept;                               \
    template void lead_over(std::span<LegNode<R>>, std::size_t, R) noexcept;
SPLINEFEED_EACH_JERK_REAL(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
