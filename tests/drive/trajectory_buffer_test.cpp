// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/trajectory_buffer.hpp"

#include "drive/smooth_track.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::hal::modbus;
using splinefeed::test::Circle;

TEST_CASE("Segment track: positions and velocities between and beyond its segments") {
    constexpr int wholes = 777; // the circle starts here, a whole count
    const Circle circle(wholes);
    TrajectoryBuffer track = circle.track();
    CHECK(track.room() == 0);
    CHECK(track.ends_at_rest());
    for (std::uint64_t time_us = 0; time_us < track.end_us(); time_us += 377) {
        const double time_s = static_cast<double>(time_us) / 1e6;
        for (const int k : {0, 1}) {
            const TrajectoryPoint point = track.at(k, time_us);
            const auto expected = circle.at(time_s)[static_cast<std::size_t>(k)];
            REQUIRE(static_cast<double>(point.position_q16) / 65536.0 == Approx(expected).margin(1e-4));
            const double ahead = circle.at(time_s + 1e-5)[static_cast<std::size_t>(k)];
            const double behind = circle.at(time_s - 1e-5)[static_cast<std::size_t>(k)];
            REQUIRE(point.velocity == Approx((ahead - behind) / 2e-5).margin(30.0));
        }
    }
    CHECK(track.at(0, track.end_us() + 5).position_q16 == std::int64_t{wholes} << 16);
    CHECK(track.at(0, track.end_us() + 5).velocity == 0.0);
    const std::int64_t before = track.at(1, 500'000).position_q16;
    track.release(500'000);
    CHECK(track.room() == 500);
    CHECK(track.at(1, 500'000).position_q16 == before);
    track.release(track.end_us() + 1000);
    CHECK(track.at(0, track.end_us()).position_q16 == std::int64_t{wholes} << 16);
    FeedSegment segment;
    segment.duration_ticks = 8000;
    segment.end[0] = 4 * units_per_count; // 4 counts in a millisecond, from rest to rest: 6 D / T^2
    CHECK(track.push(segment));
    CHECK(line_deviation_counts(segment, 0, 500) == Approx(24.0 * 0.25 / 8.0));
    track.reset(4);
    CHECK(track.empty());
}
