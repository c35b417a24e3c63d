// SPDX-License-Identifier: MIT
//
// Steering from an interrupt: here from another thread, which is the harder case. tests/modbus/tsan_runs.sh runs it
// under the thread sanitizer, too.
#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/s1_curve/g2_spline.hpp"
#include "splinefeed/trajectory.hpp"
#include "support/catch.hpp"

#include <atomic>
#include <thread>

using namespace splinefeed;

TEMPLATE_TEST_CASE("requests from an interrupt while the main loop plans lose nothing of the path", "[steering]", float,
                   Fixed) {
    using S = TestType;
    MachineSettings machine;
    machine.axes = 3;
    const auto limits = MotionLimits<S>::make(machine);
    REQUIRE(limits.has_value());
    constexpr int waypoints = 300;
    CurveOptions<S> options;
    options.axes = 3;
    G2Spline<S> curve(options);
    std::array<PlannedCell<S>, 32> window{};
    AccelerationPlanner<S> planner(window);
    auto made = Trajectory<S>::make(curve, *limits, planner);
    REQUIRE(made.has_value());
    Trajectory<S>& trajectory = *made;

    std::atomic<bool> over{false};
    std::atomic<int> requests{0};
    std::thread interrupt([&] {
        std::uint32_t random = 1;
        while (!over) {
            random = random * 1664525U + 1013904223U;
            switch (random >> 30) {
            case 0: trajectory.hold(); break;
            case 1: trajectory.override_feed(from_integer<S>(static_cast<std::int32_t>(random >> 16 & 3U))); break;
            default: trajectory.resume(); break;
            }
            ++requests;
            std::this_thread::yield();
        }
    });
    const auto position_of = [](int i, unsigned k) {
        return position_from_um(i * 400 + (i % 7) * 150 * static_cast<int>(k));
    };
    FeedSegment segment;
    PerAxis<std::int64_t> at{};
    int pushed = 0;
    std::int64_t segments = 0;
    std::int64_t gaps = 0;
    Pull pull = Pull::starved;
    while (pull != Pull::finished && segments < 10'000'000) {
        pull = trajectory.next(segment, UnderrunPolicy::wait, 8);
        if (pull == Pull::item) {
            for (unsigned k = 0; k < 3; ++k) {
                gaps += segments > 0 && segment.start[k] != at[k] ? 1 : 0;
                at[k] = segment.end[k];
            }
            ++segments;
            if (segments % 32 == 0) { // on a busy host, too, the two alternate
                for (const int before = requests; requests == before;) {
                    std::this_thread::yield();
                }
            }
        } else if (pull == Pull::starved) {
            for (; pushed < waypoints && curve.has_room(); ++pushed) {
                Waypoint<S> waypoint;
                for (unsigned k = 0; k < 3; ++k) {
                    waypoint.position[k] = position_of(pushed, k);
                }
                REQUIRE(curve.push(waypoint).ok());
            }
            if (pushed == waypoints) {
                REQUIRE(curve.finish().ok());
                ++pushed;
            }
        } else if (pull == Pull::held) {
            std::this_thread::yield();
        }
    }
    over = true;
    interrupt.join();
    CHECK(pull == Pull::finished);
    CHECK(gaps == 0);
    CHECK(requests >= segments / 32);
    CHECK(segments > 1000);
    for (unsigned k = 0; k < 3; ++k) { // in 2^-29 / 6 counts
        CHECK(at[k] == 6 * scaled(position_of(waypoints - 1, k), limits->steps_per_mm_q32[k],
                                  Position::fraction_bits + 32 - 29));
        CHECK(segment.end_velocity[k] == 0);
    }
}
