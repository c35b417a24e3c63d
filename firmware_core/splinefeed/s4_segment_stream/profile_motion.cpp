// SPDX-License-Identifier: MIT
//
// Line: with constant acceleration the mean speed is (v0 + v1) / 2, so T = 2 L / (v0 + v1) (ds / v is not integrated).
// After the time y T the distance is L y (l + (1 - l) y), l = 2 v0 / (v0 + v1). A length of 0 takes no time, whatever
// the speeds; neither does one that is so short that both speeds have no digits (FeedPlan::forward_step).
//
// Parabola: lengths are in units of the profile segment's length L, speeds in units of V, times in units of L / V. With
// v^2 = e^2 + 2 p s + c s^2 the motion satisfies s'' = p + c s, s(0) = 0, s'(0) = e. The solution is
//
//   s(t) = e t S(c t^2) + p t^2 C(c t^2),   S(z) = sum z^k / (2k+1)!,   C(z) = sum z^k / (2k+2)!
//
// (hyperbolic for c > 0, trigonometric for c < 0). The time for s = 1 is found by Newton's method, with s'(t) = v. V is
// the speed in the middle, limited so that no number is larger than 8: V^2 >= entry_sq / 4, middle_sq / 2, exit_sq / 4.
#include "splinefeed/s4_segment_stream/profile_motion.hpp"

#include "splinefeed/number/instantiate.hpp"

#include <array>

namespace splinefeed {

namespace {

constexpr int most_steps = 60;
constexpr int most_halvings = 6;

// Relative error of a time that is accurate enough.
template <Scalar S>
constexpr double closest = std::same_as<S, float>    ? 0x1p-22
                           : std::same_as<S, double> ? 0x1p-51
                                                     : 0x1p-31;

template <Scalar S>
struct Series {
    S sine;   // S(z)
    S cosine; // C(z)
};

template <Scalar S>
constexpr int terms = std::same_as<S, float> ? 5 : 8; // enough for |z| <= 2

// 1 / n for n = 0 ... 2 terms + 2.
template <Scalar S>
constexpr auto reciprocals = [] {
    std::array<S, 2 * terms<S> + 3> out{};
    for (std::size_t n = 1; n < out.size(); ++n) {
        out[n] = from_double<S>(1.0 / static_cast<double>(n));
    }
    return out;
}();

// By Horner's rule: S(z) = 1 + z/(2 3) (1 + z/(4 5) (...)), C(z) = 1/2 (1 + z/(3 4) (1 + z/(5 6) (...))).
template <Scalar S>
Series<S> series_of(S z) noexcept {
    const S one = from_integer<S>(1);
    Series<S> out{one, one};
    for (auto n = static_cast<unsigned>(2 * terms<S>); n > 0 && !(z == S{}); n -= 2) {
        const auto& inverse = reciprocals<S>;
        out.sine = one + z * inverse[n] * inverse[n + 1] * out.sine;
        out.cosine = one + z * inverse[n + 1] * inverse[n + 2] * out.cosine;
    }
    out.cosine = scale2(out.cosine, -1);
    return out;
}

} // namespace

template <Scalar S>
ProfileMotion<S>::ProfileMotion(const ProfileSegment<S>& profile_segment, S cell_length_mm, S per_s) noexcept
    : shape_(profile_segment.shape) {
    const S one = from_integer<S>(1);
    if (shape_ == SpeedShape::cubic) {
        duration_ = profile_segment.duration_ms * (per_s / from_integer<S>(1000)); // in s Fixed would lose digits
        by_duration_ = DivisionBy<S>(duration_);
        linear_ = profile_segment.linear;
        quadratic_ = profile_segment.quadratic;
        return;
    }
    const S length =
        profile_segment.stretch.whole() ? cell_length_mm : cell_length_mm * profile_segment.stretch.length();
    const S v0 = square_root(profile_segment.entry_sq);
    const S v1 = square_root(profile_segment.exit_sq);
    if (shape_ == SpeedShape::line) {
        const S sum = v0 + v1;
        if (!(length > S{}) || !(sum > S{})) {
            return;
        }
        duration_ = quotient_or_max((length + length) * per_s, sum);
        by_duration_ = DivisionBy<S>(duration_);
        linear_ = quotient_or_max(v0 + v0, sum);
        quadratic_ = one - linear_;
        return;
    }
    const S middle = scale2(
        scale2(profile_segment.entry_sq, -1) + profile_segment.middle_sq + scale2(profile_segment.exit_sq, -1), -1);
    const S unit = square_root(middle);
    linear_ = v0 / unit;
    quadratic_ = (profile_segment.middle_sq - profile_segment.entry_sq) / middle;
    curvature_ =
        (profile_segment.entry_sq - profile_segment.middle_sq + (profile_segment.exit_sq - profile_segment.middle_sq)) /
        middle;
    const S exit = v1 / unit;
    time_ = from_integer<S>(2) / (one + scale2(linear_ + exit, -1));
    // Newton's method, with bisection where it leaves the known range of the time.
    S low{};
    S high{};
    for (int i = 0; i < most_steps; ++i) {
        const S beyond = travelled(time_) - one;
        (beyond > S{} ? high : low) = time_;
        const S s = one + beyond;
        const S square = linear_ * linear_ + s * (scale2(quadratic_, 1) + s * curvature_);
        const S speed = square > S{} ? square_root(square) : S{};
        const S step = quotient_or_max(absolute(beyond), speed);
        if (step <= time_ * literal<S>(closest<S>)) {
            break;
        }
        S next = beyond > S{} ? time_ - step : time_ + smaller(step, time_);
        if (!(next > low) || (high > S{} && !(next < high))) {
            next = high > S{} ? scale2(low + high, -1) : scale2(time_, 1);
        }
        time_ = next;
    }
    duration_ = time_ * length * per_s / unit;
    by_duration_ = DivisionBy<S>(duration_);
}

// The time is halved until the series converges fast, and the result doubled again: with s = t S, x = t^2 C: s(2 t) = 2
// s (1 + c x), x(2 t) = 2 s^2.
template <Scalar S>
S ProfileMotion<S>::travelled(S time) const noexcept {
    S part = time;
    S z = curvature_ * time * time;
    int halvings = 0;
    while (absolute(z) > from_integer<S>(2) && halvings < most_halvings) {
        part = scale2(part, -1);
        z = scale2(z, -2);
        ++halvings;
    }
    const Series<S> series = series_of<S>(z);
    S sine = part * series.sine;
    S cosine = part * part * series.cosine;
    for (; halvings > 0; --halvings) {
        const S square = sine * sine;
        sine = scale2(sine * (from_integer<S>(1) + curvature_ * cosine), 1);
        cosine = scale2(square, 1);
    }
    return linear_ * sine + quadratic_ * cosine;
}

template <Scalar S>
S ProfileMotion<S>::at(S y) const noexcept {
    switch (shape_) {
    case SpeedShape::line: return y * (linear_ + quadratic_ * y);
    case SpeedShape::parabola: return travelled(y * time_);
    case SpeedShape::cubic: return y * (linear_ + y * (quadratic_ + y * (from_integer<S>(1) - linear_ - quadratic_)));
    }
    return y;
}

SPLINEFEED_INSTANTIATE_CLASS(ProfileMotion)

} // namespace splinefeed
