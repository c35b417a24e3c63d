// SPDX-License-Identifier: MIT
//
// A run of 10^9 mm, 10^10 segments and 2^32 waypoints is that of the first millimetres: the counters start where it
// would have taken them.
#include "support/catch.hpp"
#include "support/counter_seam.hpp"
#include "support/programs.hpp"

#include "splinefeed/number/path_position.hpp"

#include <limits>

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr std::uint32_t last_waypoints = std::numeric_limits<std::uint32_t>::max() - 20;
constexpr std::uint64_t many_segments = 10'000'000'000;
// 10^9 mm and what is missing until the lower half of the sum is full: 8 mm.
constexpr Wide far{59, std::numeric_limits<std::uint64_t>::max() - (std::uint64_t{8} << Position::fraction_bits)};

struct Run {
    std::vector<FeedSegment> segments;
    Wide travelled{};
    std::uint64_t curve_segments = 0;
};

/// A hundred short moves with corners between some of them. @param old  it comes after many others
template <Scalar S>
Run run(const MachineSettings& machine, bool old) {
    const auto limits = MotionLimits<S>::make(machine).value();
    G2Spline<S> curve(CurveOptions<S>{.axes = 2});
    AnyTrajectory<S> any(curve, limits, 256);
    Trajectory<S>& trajectory = any.trajectory();
    if (old) {
        CounterSeam::travelled(trajectory, far, many_segments, many_segments - 7);
        CounterSeam::pushed(curve, last_waypoints);
    }
    Run out;
    FeedSegment segment;
    for (int i = 0; trajectory.state() != Pull::finished;) {
        if (trajectory.next(segment) == Pull::item) {
            out.segments.push_back(segment);
        } else if (i < 100) {
            const double x = 0.5 * i;
            const double y = i % 7 == 0 ? 0.6 : 0.1 * (i % 3);
            REQUIRE(curve.push({.position = {position_from_mm(x), position_from_mm(y)}}).ok());
            ++i;
        } else if (trajectory.state() == Pull::starved) {
            REQUIRE(curve.finish().ok());
        }
    }
    out.travelled = trajectory.arc_length().travelled();
    out.curve_segments = trajectory.arc_length().segments();
    return out;
}

} // namespace

TEMPLATE_TEST_CASE("the first and the ten thousand millionth segment are planned alike", "[stream][endless]", double,
                   float, Fixed) {
    const bool jerk_limited = GENERATE(false, true);
    if (jerk_limited && std::same_as<TestType, float>) {
        return; // float plans no jerk
    }
    const MachineSettings machine = with_jerk(machine_of(2, 100.0, 1000.0, 100.0), jerk_limited ? 30000.0 : 0.0);
    const Run fresh = run<TestType>(machine, false);
    const Run old = run<TestType>(machine, true);
    CAPTURE(jerk_limited);
    REQUIRE(fresh.segments.size() > 100);
    REQUIRE(old.segments.size() == fresh.segments.size());
    for (std::size_t i = 0; i < fresh.segments.size(); ++i) {
        const FeedSegment& a = fresh.segments[i];
        const FeedSegment& b = old.segments[i];
        REQUIRE(b.index == a.index + many_segments - 7);
        REQUIRE(b.waypoint == a.waypoint + last_waypoints); // modulo 2^32
        REQUIRE(b.duration_ticks == a.duration_ticks);
        for (unsigned k = 0; k < 2; ++k) {
            REQUIRE(b.start[k] == a.start[k]);
            REQUIRE(b.end[k] == a.end[k]);
            REQUIRE(b.start_velocity[k] == a.start_velocity[k]);
            REQUIRE(b.end_velocity[k] == a.end_velocity[k]);
        }
    }
    CHECK(old.segments.back().waypoint < 100); // it did pass the end of its range
    CHECK(old.travelled == add(fresh.travelled, far));
    CHECK(old.travelled.high == far.high + 1);
    CHECK(old.curve_segments == fresh.curve_segments + many_segments);
    CHECK(length_to_mm(old.travelled) - length_to_mm(far) == Approx(length_to_mm(fresh.travelled)).epsilon(1e-8));
}

TEST_CASE("positions along the path are compared where their range ends", "[stream][endless]") {
    for (const std::uint64_t raw : {std::uint64_t{0}, std::uint64_t{1} << 63, ~std::uint64_t{0} - 3}) {
        const PathPosition here{raw - 5};
        const PathPosition there = displaced(here, Fixed::from_raw(std::int64_t{1} << 32), 0); // 1 mm on
        CHECK(units_between(here, there) == std::int64_t{1} << Position::fraction_bits);
        CHECK(units_between(there, here) == -(std::int64_t{1} << Position::fraction_bits));
        CHECK(distance<double>(here, there, 0) == 1.0);
        CHECK(distance<float>(there, here, -12) == -4096.0F);
        CHECK(displaced(there, -1.0, 0) == here);
    }
}
