// SPDX-License-Identifier: MIT
#include "splinefeed/s1_blended_path/chain_fit.hpp"

#include "splinefeed/number/exponent.hpp"
#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"
#include "splinefeed/s1_blended_path/chain_state.hpp"

namespace splinefeed {

namespace {

constexpr int places = 8;                             // of a line
constexpr double bend_factor = 1.15;                  // of the largest curvature of the points
constexpr double bend_more = 0x1p20 * 0.001 / 4096.0; // and 0.001 / mm
constexpr double most_end_turn = 0x1p20 * 8.0; // of a fifth of the way, at an end: beyond it a point lies far off
constexpr int size_log2 = 16;                  // the quintic is computed in a unit in which it is not longer

} // namespace

// The length of each smoothed line, longer by the bow of the path, phi^2 / 24 of it; and the largest curvature.
template <Scalar S>
void ChainFit<S>::measure_way(std::uint64_t to) noexcept {
    way_ = bend_ = S{};
    PerAxis<S> before{};
    S length_before{};
    S turn_before{};
    for (std::uint64_t i = from_ + 1; i <= to; ++i) {
        PerAxis<S> chord{};
        points_.smoothed(i - 1, i, chord);
        const S length = norm(chord, points_.axes());
        divide(chord, length, points_.axes());
        const S turn = i > from_ + 1 ? norm(difference(chord, before, points_.axes()), points_.axes()) : S{};
        bend_ = larger(bend_, quotient_or_max(scale2(turn, bend_log2 + 1), length + length_before));
        // The line turns by the half of what its ends do; the first and the last one have one inner end.
        const S half = i > from_ + 1 ? turn : S{};
        if (i > from_ + 1) {
            ChainPoint<S>& last = points_[i - 1];
            const S angle = i > from_ + 2 ? scale2(turn_before + half, -1) : half;
            const S more = last.arc * (angle * angle * literal<S>(1.0 / 24.0));
            last.arc = last.arc + more;
            way_ += more;
        }
        points_[i].arc = length;
        way_ += length;
        turn_before = half;
        length_before = length;
        before = chord;
    }
    const S more = points_[to].arc * (turn_before * turn_before * literal<S>(1.0 / 24.0));
    points_[to].arc = points_[to].arc + more;
    way_ += more;
}

// To powers of u, by differences; in a unit in which sums of 32 times ten fit.
template <Scalar S>
void ChainFit<S>::expand() noexcept {
    unit_ = exponent_of(way_) - size_log2;
    unit_ = unit_ > 0 ? unit_ : 0;
    constexpr std::array<std::int32_t, 6> binomial{1, 5, 10, 10, 5, 1};
    for (const unsigned k : indices(points_.axes())) {
        PerDegree<S>& a = power_[k];
        for (unsigned i = 0; i <= 5; ++i) {
            a[i] = scale2(quintic_[k][i], -unit_);
        }
        for (unsigned i = 1; i <= 5; ++i) {
            for (unsigned j = 5; j >= i; --j) {
                a[j] = a[j] - a[j - 1];
            }
        }
        for (unsigned i = 1; i <= 5; ++i) {
            a[i] = from_integer<S>(binomial[i]) * a[i];
        }
    }
}

template <Scalar S>
void ChainFit<S>::line(std::uint64_t end, Line& out) const noexcept {
    const ChainPoint<S>& point = points_[end];
    PerAxis<S> chord{};
    points_.programmed(from_, end - 1, out.start);
    points_.programmed(end - 1, end, chord);
    out.length = scale2(point.chord, -unit_);
    for (const unsigned k : indices(points_.axes())) {
        out.start[k] = scale2(out.start[k] - points_[from_].moved[k], -unit_);
        out.direction[k] = chord[k] / point.chord;
    }
}

template <Scalar S>
void ChainFit<S>::place(S u, PerAxis<S>& out) const noexcept {
    for (const unsigned k : indices(points_.axes())) {
        const PerDegree<S>& a = power_[k];
        out[k] = a[0] + u * (a[1] + u * (a[2] + u * (a[3] + u * (a[4] + u * a[5]))));
    }
}

template <Scalar S>
void ChainFit<S>::derivatives(S u, PerAxis<S>& first, PerAxis<S>& second) const noexcept {
    for (const unsigned k : indices(points_.axes())) {
        const PerDegree<S>& a = power_[k];
        first[k] = a[1] + u * (times(2, a[2]) + u * (times(3, a[3]) + u * (times(4, a[4]) + u * times(5, a[5]))));
        second[k] = times(2, a[2]) + u * (times(6, a[3]) + u * (times(12, a[4]) + u * times(20, a[5])));
    }
}

template <Scalar S>
bool ChainFit<S>::near(const PerAxis<S>& place, const Line& line, S limit) const noexcept {
    PerAxis<S> apart = difference(place, line.start, points_.axes());
    const S along = larger(S{}, smaller(dot(apart, line.direction, points_.axes()), line.length));
    S sum{};
    for (const unsigned k : indices(points_.axes())) {
        apart[k] = apart[k] - along * line.direction[k];
        sum += absolute(apart[k]);
    }
    return sum <= limit || norm(apart, points_.axes()) <= limit; // the sum saves a root
}

// The distance from any place of the quintic is not below the distance from it: after a step of Newton it is near.
template <Scalar S>
bool ChainFit<S>::near_point(const PerAxis<S>& point, S u, S limit, bool bends) const noexcept {
    PerAxis<S> at{};
    PerAxis<S> first{};
    PerAxis<S> second{};
    derivatives(u, first, second);
    place(u, at);
    const S speed = scale2(way_, -unit_);
    const int axes = points_.axes();
    divide(first, speed, axes);
    divide(second, speed, axes);
    const S step = dot(difference(point, at, axes), first, axes) / speed;
    subtract(second, dot(first, second, axes), first, axes);
    place(larger(S{}, smaller(from_integer<S>(1), u + step)), at);
    const S bend = scale2(norm(second, axes), bend_log2 - unit_) / speed;
    return norm(difference(point, at, axes), axes) <= limit &&
           (!bends || bend <= literal<S>(bend_factor) * bend_ + literal<S>(bend_more));
}

template <Scalar S>
bool ChainFit<S>::reaches(std::uint64_t to, S limit) noexcept {
    measure_way(to);
    chain_state(points_, to, end_);
    points_.smoothed(from_, to, end_.offset);
    const S first = literal<S>(0.2) * way_;
    const S sharpest = quotient_or_max(literal<S>(most_end_turn), first);
    if (norm(state_.bend, points_.axes()) > sharpest || norm(end_.bend, points_.axes()) > sharpest) {
        return false;
    }
    quintic_between(state_, end_, first, literal<S>(0.4) * way_, points_.axes(), quintic_);
    end_.offset = {};
    expand();
    const S within = scale2(limit, -unit_);
    std::array<Line, 3> lines{}; // the one before, the one that is measured, the one behind
    const bool before = from_ > points_.oldest();
    line(before ? from_ : from_ + 1, lines[0]);
    line(from_ + 1, lines[1]);
    S way{};
    const S eighth = from_integer<S>(1) / from_integer<S>(places);
    for (std::uint64_t i = from_ + 1; i <= to; ++i) {
        line(i < points_.last() ? i + 1 : i, lines[2]);
        const S part = points_[i].arc / way_;
        for (int n = 0; n < places; ++n) {
            PerAxis<S> at{};
            place(way + part * (from_integer<S>(n) * eighth + scale2(eighth, -1)), at);
            if (!near(at, lines[1], within) && !near(at, lines[0], within) && !near(at, lines[2], within)) {
                return false;
            }
        }
        way += part;
        if (i < points_.last() && !near_point(lines[2].start, way, within, i < to)) {
            return false;
        }
        lines[0] = lines[1];
        lines[1] = lines[2];
    }
    return true;
}

#if SPLINEFEED_MAX_DEGREE >= 5
SPLINEFEED_INSTANTIATE_CLASS(ChainFit)
#endif

} // namespace splinefeed
