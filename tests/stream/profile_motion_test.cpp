// SPDX-License-Identifier: MIT
//
// The motion along a profile segment against the integral of ds / v, by Simpson's rule in long double.
#include "splinefeed/s4_segment_stream/profile_motion.hpp"

#include "support/bezier_paths.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

/// v^2 over the segment, as Bezier points.
struct SpeedSquare {
    Real entry = 0.0L;
    Real middle = 0.0L;
    Real exit = 0.0L;

    [[nodiscard]] Real at(Real x) const { return (1.0L - x) * ((1.0L - x) * entry + 2.0L * x * middle) + x * x * exit; }

    /// The time to the fraction x of a segment of length 1. With x sin^2 z as the fraction, the integrand is smooth
    /// where an end is slow.
    [[nodiscard]] Real time_to(Real x) const {
        constexpr int steps = 2000;
        const Real step = std::acos(-1.0L) / 2.0L / steps;
        Real sum = 0.0L;
        for (int i = 0; i <= steps; ++i) {
            const Real sine = std::sin(static_cast<Real>(i) * step);
            const Real way = 2.0L * x * sine * std::cos(static_cast<Real>(i) * step);
            const Real weight = i == 0 || i == steps ? 1.0L : i % 2 == 1 ? 4.0L : 2.0L;
            sum += weight * way / std::sqrt(at(x * sine * sine));
        }
        return sum * step / 3.0L;
    }
};

} // namespace

TEMPLATE_TEST_CASE("a parabola of v^2 takes the integral of ds / v, to each of its places", "[stream][motion]", double,
                   float, Fixed) {
    using S = TestType;
    constexpr std::uint32_t seed = 4402;
    Random random(seed);
    const Real close = std::same_as<S, double> ? 1e-9L : std::same_as<S, float> ? 1e-3L : 1e-6L;
    for (int round = 0; round < 200; ++round) {
        ProfileSegment<S> segment;
        segment.shape = SpeedShape::parabola;
        segment.entry_sq = from_double<S>(random.decades(1.0, 1e4));
        segment.exit_sq = from_double<S>(random.decades(1.0, 1e4));
        const S most = scale2(smaller(segment.entry_sq, segment.exit_sq), 3);
        segment.middle_sq = random.chance(0.1) ? S{} : smaller(from_double<S>(random.decades(1.0, 1e4)), most);
        const S length = from_double<S>(random.decades(1e-2, 10.0));
        const SpeedSquare square{exact(segment.entry_sq), exact(segment.middle_sq), exact(segment.exit_sq)};
        CAPTURE(seed, round, to_double(segment.entry_sq), to_double(segment.middle_sq), to_double(segment.exit_sq));
        const ProfileMotion<S> motion(segment, length, from_integer<S>(1000));
        const Real duration = 1000.0L * exact(length) * square.time_to(1.0L);
        REQUIRE(std::fabs(exact(motion.duration()) / duration - 1.0L) < close);
        for (const double share : {0.1, 0.5, 0.9}) {
            const Real place = exact(motion.at(from_double<S>(share)));
            const Real time = 1000.0L * exact(length) * square.time_to(place);
            CAPTURE(share, static_cast<double>(place));
            REQUIRE(std::fabs(time / duration - exact(from_double<S>(share))) < close);
        }
    }
}

TEMPLATE_TEST_CASE("a length of 0 takes no time, and neither does one without digits for its speeds",
                   "[stream][motion]", double, float, Fixed) {
    using S = TestType;
    const S one = from_integer<S>(1);
    const auto duration = [&](S from, S entry_sq, S exit_sq) {
        const ProfileSegment<S> segment{{from, one}, entry_sq, exit_sq};
        return ProfileMotion<S>(segment, one, from_integer<S>(1000)).duration();
    };
    for (const S entry_sq : {S{}, one}) {
        for (const S exit_sq : {S{}, one}) {
            REQUIRE(duration(one, entry_sq, exit_sq) == S{});
        }
    }
    REQUIRE(duration(S{}, S{}, S{}) == S{});
    REQUIRE(duration(S{}, one, one) == from_integer<S>(1000));
}
