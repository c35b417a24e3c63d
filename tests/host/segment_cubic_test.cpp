// SPDX-License-Identifier: MIT
//
// Positions against the Hermite basis in exact fractions; derivatives against differences of positions.
#include "host_sim/machine/segment_cubic.hpp"

#include "support/catch.hpp"

#include <random>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

FeedSegment one_axis(std::int64_t start, std::int64_t end, std::int64_t start_velocity, std::int64_t end_velocity) {
    FeedSegment segment;
    segment.duration_ticks = 8000;
    segment.start[0] = start;
    segment.end[0] = end;
    segment.start_velocity[0] = start_velocity;
    segment.end_velocity[0] = end_velocity;
    return segment;
}

// Whether p is the integer nearest to the Hermite cubic at j / n, ties upwards.
bool is_nearest(const FeedSegment& s, int j, int n, std::int64_t p) {
    const Wide128 n3 = Wide128{n} * n * n;
    const Wide128 i = n - j;
    const Wide128 exact = (Wide128{n} + 2 * j) * i * i * s.start[0] + i * i * j * s.start_velocity[0] +
                          Wide128{j} * j * (3 * Wide128{n} - 2 * j) * s.end[0] - Wide128{j} * j * i * s.end_velocity[0];
    const Wide128 off = 2 * (exact - n3 * p);
    return off >= -n3 && off < n3;
}

} // namespace

TEST_CASE("positions at ticks are the nearest units") {
    std::mt19937_64 random(7);
    const int n = GENERATE(1, 2, 3, 7, 8, 10, 1000, 1024);
    for (int bits : {3, 20, 40, 58}) {
        std::uniform_int_distribution<std::int64_t> number(-(std::int64_t{1} << bits), std::int64_t{1} << bits);
        for (int i = 0; i < 200; ++i) {
            const FeedSegment segment = one_axis(number(random), number(random), number(random), number(random));
            const SegmentCubic cubic(segment, 0, 1.0, 1.0);
            REQUIRE(cubic.travelled(0, n) == 0);
            REQUIRE(segment.start[0] + cubic.travelled(n, n) == segment.end[0]);
            for (int j = 0; j <= n; j += 1 + n / 16) {
                REQUIRE(is_nearest(segment, j, n, segment.start[0] + cubic.travelled(j, n)));
            }
        }
    }
}

TEST_CASE("velocity, acceleration and jerk are the derivatives, in mm and s") {
    // 10 units a mm, 0.5 s: 3 mm in all, from 2 mm/s to 8 mm/s
    const SegmentCubic cubic(one_axis(5, 35, 10, 40), 0, 10.0, 0.5);
    CHECK(cubic.velocity(0.0) == Approx(2.0));
    CHECK(cubic.velocity(1.0) == Approx(8.0));
    // Simpson's rule is exact for a parabola, the mean for a line
    CHECK((cubic.velocity(0.0) + 4.0 * cubic.velocity(0.5) + cubic.velocity(1.0)) / 6.0 * 0.5 == Approx(3.0));
    CHECK((cubic.acceleration(0.0) + cubic.acceleration(1.0)) / 2.0 * 0.5 == Approx(6.0));
    CHECK((cubic.acceleration(1.0) - cubic.acceleration(0.0)) / 0.5 == Approx(cubic.jerk()));
}

TEST_CASE("the velocity's extreme is found inside only") {
    CHECK(SegmentCubic(one_axis(0, 100, 0, 0), 0, 1.0, 1.0).peak_u() == 0.5);
    CHECK(SegmentCubic(one_axis(0, 100, 0, 75), 0, 1.0, 1.0).peak_u() == Approx(0.6));
    CHECK(SegmentCubic(one_axis(0, 100, 100, 100), 0, 1.0, 1.0).peak_u() == -1.0); // constant
    CHECK(SegmentCubic(one_axis(0, 100, 50, 150), 0, 1.0, 1.0).peak_u() == -1.0);  // linear
    CHECK(SegmentCubic(one_axis(0, 100, 0, 150), 0, 1.0, 1.0).peak_u() == -1.0);   // at 1
    CHECK(SegmentCubic(one_axis(0, 0, 0, 0), 0, 1.0, 1.0).peak_u() == -1.0);
}

TEST_CASE("whole counts are the nearest, ties upwards, over all of the range") {
    constexpr std::int64_t half = units_per_count / 2;
    CHECK(nearest_count(0) == 0);
    CHECK(nearest_count(half - 1) == 0);
    CHECK(nearest_count(half) == 1);
    CHECK(nearest_count(-half) == 0);
    CHECK(nearest_count(-half - 1) == -1);
    CHECK(nearest_count(-units_per_count) == -1);
    CHECK(nearest_count(units_per_count * 1000 - half) == 1000);
    for (const std::int64_t units :
         {std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min()}) {
        const Wide128 off = 2 * (static_cast<Wide128>(nearest_count(units)) * units_per_count - units);
        CHECK((off <= units_per_count && off > -units_per_count));
    }
}
