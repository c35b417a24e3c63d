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
// The envelope E is a value at the middle of a cell; the Bezier point there is E - L^2 E'' / 8.
#include "splinefeed/s3_feed_plan/jerk/leg_guess.hpp"

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

// The members of a node that hold its part of the envelopes meanwhile.
template <Floating R>
struct Envelope {
    std::span<LegNode<R>> node;

    [[nodiscard]] R& place(std::size_t i) const noexcept { return node[i].step_sq; }
    [[nodiscard]] R& bound(std::size_t i) const noexcept { return node[i].excess; } // g
    [[nodiscard]] R& wave(std::size_t i) const noexcept { return node[i].gain[0]; } // W
    [[nodiscard]] R& wave_slope(std::size_t i) const noexcept { return node[i].gain[1]; }
    [[nodiscard]] R& below(std::size_t i) const noexcept { return node[i].gain[2]; } // f
    [[nodiscard]] std::size_t& corner(std::size_t i) const noexcept { return node[i].corner; }
    [[nodiscard]] R hull(std::size_t i) const noexcept { return below(i) + wave(i); }
    [[nodiscard]] R line(std::size_t y) const noexcept { return bound(y) - wave(y) + wave_slope(y) * place(y); }
};

template <Floating R>
R curvature_bound(const LegNode<R>& node, const AxisLimits<R>& limits, R b) noexcept {
    R most{};
    for (const unsigned k : indices(static_cast<int>(limits.axes))) {
        most = larger(most, larger(absolute(node.axis[k].first), R(least_tangent)) / limits.jerk_mm_s3[k]);
    }
    return R(of_curvature) / (most * detail::hardware_square_root(b));
}

template <Floating R>
R speed_bound(const LegNode<R>& node, const LegNode<R>& next, const AxisLimits<R>& limits) noexcept {
    const R g = R(of_acceleration) * smaller(node.likely_sq, node.cap_sq);
    R third{};
    for (const unsigned k : indices(static_cast<int>(limits.axes))) {
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
    R total{};
    for (const unsigned k : indices(static_cast<int>(limits.axes))) {
        jerk = smaller(jerk, limits.jerk_mm_s3[k]);
    }
    for (std::size_t i = 0; i < n; ++i) {
        total += e.node[i].length_mm;
    }
    const R rest = R(of_rest) * power_two_thirds(R(4.5) * jerk);
    R s{};
    R wave{};
    R slope{};
    for (std::size_t i = 0; i < n; ++i) {
        const R half = R(0.5) * e.node[i].length_mm;
        const R place = s + half;
        const R end = rests ? smaller(place, total - place) : total - place;
        const R way = power_two_thirds(end);
        const R g = smaller(speed_bound(e.node[i], e.node[i + 1], limits), rest * way * way);
        const R c = curvature_bound(e.node[i], limits, g);
        const auto half_on = [&] {
            wave += slope * half + R(0.5) * c * half * half;
            slope += c * half;
        };
        half_on();
        e.place(i) = place;
        e.bound(i) = g;
        e.wave(i) = wave;
        e.wave_slope(i) = slope;
        half_on();
        s += R(2) * half;
    }
}

template <Floating R>
void round_peaks(const Envelope<R>& e, std::size_t n) noexcept {
    std::size_t corners = 0;
    const auto crossing = [&](std::size_t p, std::size_t q) {
        return (e.line(q) - e.line(p)) / (e.wave_slope(q) - e.wave_slope(p));
    };
    for (std::size_t y = 0; y < n; ++y) {
        while (corners > 1 &&
               crossing(e.corner(corners - 2), e.corner(corners - 1)) >= crossing(e.corner(corners - 1), y)) {
            --corners;
        }
        e.corner(corners++) = y;
    }
    const auto at = [&](std::size_t k, R x) {
        const std::size_t y = e.corner(k);
        return e.bound(y) - e.wave(y) - e.wave_slope(y) * (x - e.place(y));
    };
    std::size_t k = 0;
    for (std::size_t i = 0; i < n; ++i) {
        while (k + 1 < corners && at(k + 1, e.place(i)) <= at(k, e.place(i))) {
            ++k;
        }
        e.below(i) = e.wave(i) + at(k, e.place(i));
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
    std::size_t corners = 0;
    const auto outside = [&](std::size_t p, std::size_t q, std::size_t y) {
        return (e.hull(q) - e.hull(p)) * (e.place(y) - e.place(q)) >=
               (e.hull(y) - e.hull(q)) * (e.place(q) - e.place(p));
    };
    for (std::size_t y = 0; y < n; ++y) {
        while (corners > 1 && outside(e.corner(corners - 2), e.corner(corners - 1), y)) {
            --corners;
        }
        e.corner(corners++) = y;
    }
    for (std::size_t k = 0; k + 1 < corners; ++k) {
        const std::size_t p = e.corner(k);
        const std::size_t q = e.corner(k + 1);
        const R per = R(1) / (e.place(q) - e.place(p));
        const R from = e.hull(p);
        const R to = e.hull(q);
        for (std::size_t i = p; i < q || (i == q && k + 2 == corners); ++i) {
            const R share = (e.place(i) - e.place(p)) * per;
            const R value = R(of_envelope) * (from + share * (to - from) - e.wave(i));
            e.node[i].middle_sq = larger(value, R(least_envelope) * e.bound(i));
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
        node.middle_sq = smaller(middle, R(0.95) * node.cap_sq);
        before = here;
        s += node.length_mm;
    }
}

template void guess_leg(std::span<LegNode<double>>, const AxisLimits<double>&, bool) noexcept;
template void lead_over(std::span<LegNode<double>>, std::size_t, double) noexcept;

} // namespace splinefeed
