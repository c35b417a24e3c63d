// SPDX-License-Identifier: MIT
#include "splinefeed/s5_pulse_train/crossing.hpp"

#include "random_segments.hpp"
#include "splinefeed/s5_pulse_train/monotone_parts.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

/// Horner in long double, units below 2^63 exact.
long double position(const AxisCubic& cubic, long double u) {
    return ((static_cast<long double>(cubic.third) * u + static_cast<long double>(cubic.second)) * u +
            static_cast<long double>(cubic.first)) *
           u;
}

/// (u - a)^3 + a^3, or with less than the cube a slope that stays: a standstill in the middle, in `size` units.
AxisCubic plateau(double a, double size, double slope) {
    return {static_cast<std::int64_t>(size * (3.0 * a * a + slope)), static_cast<std::int64_t>(-3.0 * a * size),
            static_cast<std::int64_t>(size)};
}

void require_crossing(const AxisCubic& cubic, std::int64_t units, std::uint32_t near, std::uint32_t guess) {
    const std::uint32_t u = find_crossing(cubic, {units, 0, 0xffffffffU, guess, near});
    const long double at = static_cast<long double>(u) * 0x1p-32L;
    const long double slack = (0.5L * near + 2.0L) * 0x1p-32L; // half the bracket, or the last step of Newton
    CAPTURE(cubic.first, cubic.second, cubic.third, units, near, guess, u);
    // The position is passed within half of `near`, but for the rounding of at().
    REQUIRE(position(cubic, at - slack) <= static_cast<long double>(units) + 4.0L);
    REQUIRE(position(cubic, at + slack) >= static_cast<long double>(units) - 4.0L);
}

} // namespace

TEST_CASE("A crossing is found from any guess, through standstills and inflections") {
    const std::uint64_t seed = random_seed();
    CAPTURE(seed);
    RandomSegments random(seed);
    for (int round = 0; round < rounds(20'000); ++round) {
        const double size = random.decades(1e3, 0x1p46);
        const double slope = random.below(3) == 0 ? 0.0 : random.decades(1e-9, 1.0);
        const AxisCubic cubic = plateau(random.between(-0.2, 1.2), size, slope);
        const auto end = static_cast<double>(cubic.at(0xffffffffU));
        // Also right at the standstill.
        const double part = random.below(2) == 0 ? random.between(0.0, 1.0) : 0.5 + 1e-9 * random.between(-1.0, 1.0);
        const auto near = static_cast<std::uint32_t>(random.decades(2.0, 1e6));
        require_crossing(cubic, static_cast<std::int64_t>(end * part), near,
                         static_cast<std::uint32_t>(random.between(0.0, 4294967295.0)));
    }
}

TEST_CASE("The velocity's zeros cut a segment where the way turns") {
    const std::uint64_t seed = random_seed();
    CAPTURE(seed);
    RandomSegments random(seed);
    int turns[3] = {};
    for (int round = 0; round < rounds(5'000); ++round) {
        const double size = random.decades(1e6, 0x1p44);
        const auto coefficient = [&] {
            return static_cast<std::int64_t>(size * random.between(-1.0, 1.0));
        };
        AxisCubic cubic{coefficient(), coefficient(), coefficient()};
        if (random.below(4) == 0) {
            cubic.first = 0; // from rest
        }
        const std::int64_t way = cubic.first + cubic.second + cubic.third;
        const MonotoneParts parts(cubic, way);
        CAPTURE(cubic.first, cubic.second, cubic.third);
        REQUIRE(parts.size() >= 1);
        REQUIRE(parts[parts.size() - 1].units == way);
        ++turns[parts.size() - 1];
        std::uint32_t begin = 0;
        for (unsigned i = 0; i < parts.size(); ++i) {
            REQUIRE(parts[i].end >= begin);
            REQUIRE((i == 0 || parts[i].rising != parts[i - 1].rising));
            long double last = position(cubic, begin * 0x1p-32L);
            for (int j = 1; j <= 16; ++j) {
                const long double u = (begin + (static_cast<long double>(parts[i].end) - begin) * j / 16.0L) * 0x1p-32L;
                const long double now = position(cubic, u);
                REQUIRE((parts[i].rising ? now - last : last - now) >= -4.0L); // the zero is rounded
                last = now;
            }
            begin = parts[i].end;
        }
        REQUIRE(begin == 0xffffffffU);
    }
    CHECK(turns[0] > 0);
    CHECK(turns[1] > 0);
    CHECK(turns[2] > 0);
}
