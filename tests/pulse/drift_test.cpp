// SPDX-License-Identifier: MIT
// Counts after many steps: nothing is summed but integers.
#include "splinefeed/s5_pulse_train/fixed_rate.hpp"
#include "splinefeed/s5_pulse_train/interpolated_steps.hpp"
#include "splinefeed/s5_pulse_train/step_intervals.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <vector>

using namespace splinefeed;

namespace {

/// Constant velocity, as many units a segment; from rest at once, which the engines do not mind.
FeedSegment running(std::int64_t start, std::int64_t way) {
    FeedSegment segment;
    segment.duration_ticks = 8000;
    segment.start[0] = start;
    segment.end[0] = start + way;
    segment.start_velocity[0] = segment.end_velocity[0] = way;
    return segment;
}

/// Steps on the way; the last of them and whether all go one way.
struct Ran {
    std::int64_t steps = 0;
    std::int64_t last_tick = 0;
    bool one_way = true;
};

template <StepEngine E>
Ran run(E& engine, std::int64_t start, std::int64_t way, std::int64_t segments) {
    Ran ran;
    Step step;
    const auto drain = [&] {
        while (engine.next(step)) {
            ++ran.steps;
            ran.last_tick = step.tick;
            ran.one_way = ran.one_way && step.up == (way > 0);
        }
    };
    for (std::int64_t i = 0; i < segments; ++i) {
        engine.take(running(start + i * way, way));
        drain();
    }
    engine.finish();
    drain();
    return ran;
}

} // namespace

TEST_CASE("After any number of steps the count is exact and the last step is where it was to be") {
    // 99.7 counts a segment, and so odd a number of units that no sum of fractions could be exact by chance; from one
    // end of the range towards the other.
    const std::int64_t segments = splinefeed_test::rounds(5'000, 5'050'000);
    constexpr std::int64_t way = 321155798201;
    const std::int64_t start = -1'000'000'000 * units_per_count - 7;
    const std::int64_t steps = nearest_step(start + segments * way) - nearest_step(start);
    REQUIRE(steps >= (segments > 1'000'000 ? 500'000'000 : 400'000) / (splinefeed_test::sanitized ? 4 : 1));
    // The last crossing lies at this part of the whole way.
    const long double part =
        (static_cast<long double>((nearest_step(start) + steps) * units_per_count - units_per_count / 2 - start)) / way;
    const long double tick = part * 8000.0L;
    StepIntervals intervals(1);
    const Ran solved = run(intervals, start, way, segments);
    CHECK(solved.steps == steps);
    CHECK(solved.one_way);
    CHECK(std::fabs(static_cast<long double>(solved.last_tick) - tick) <= 1.0L);
    FixedRate fixed(1, 24);
    const Ran ticked = run(fixed, start, way, segments);
    CHECK(ticked.steps == steps);
    CHECK(ticked.one_way);
    CHECK(std::fabs(static_cast<long double>(ticked.last_tick) - tick) <= 12.0L);
    InterpolatedSteps interpolated(1, 320);
    const Ran between = run(interpolated, start, way, segments);
    CHECK(between.steps == steps);
    CHECK(between.one_way);
    CHECK(std::fabs(static_cast<long double>(between.last_tick) - tick) <= 1.0L);
}

TEST_CASE("Steps are the same wherever the machine stands") {
    constexpr std::int64_t way = -123456789012;
    for (const std::int64_t counts : {std::int64_t{1}, std::int64_t{1'000'000'000}, std::int64_t{-2'000'000'000}}) {
        const std::int64_t away = counts * units_per_count;
        StepIntervals here(1);
        StepIntervals there(1);
        FixedRate ticked_here(1, 80);
        FixedRate ticked_there(1, 80);
        InterpolatedSteps between_here(1, 320);
        InterpolatedSteps between_there(1, 320);
        Step a;
        Step b;
        const auto compare = [&](auto& one, auto& other) {
            while (one.next(a)) {
                REQUIRE(other.next(b));
                REQUIRE(a.tick == b.tick);
                REQUIRE(a.up == b.up);
            }
            REQUIRE_FALSE(other.next(b));
        };
        for (int i = 0; i < 50; ++i) {
            here.take(running(5 + i * way, way));
            there.take(running(5 + i * way + away, way));
            compare(here, there);
            ticked_here.take(running(5 + i * way, way));
            ticked_there.take(running(5 + i * way + away, way));
            compare(ticked_here, ticked_there);
            between_here.take(running(5 + i * way, way));
            between_there.take(running(5 + i * way + away, way));
            compare(between_here, between_there);
        }
    }
}

TEST_CASE("A segment shorter than a tick, and one that is no multiple of it, move no step") {
    // 0.9 us segments under ticks of 10 us: samples lie in every eleventh or twelfth of them.
    FixedRate engine(1, 80);
    Step step;
    std::vector<std::int64_t> ticks;
    constexpr std::int64_t way = units_per_count / 200;
    std::int64_t at = 0;
    for (int i = 0; i < 4000; ++i) {
        FeedSegment segment = running(at, way);
        segment.duration_ticks = 7;
        engine.take(segment);
        at += way;
        while (engine.next(step)) {
            ticks.push_back(step.tick);
        }
    }
    REQUIRE(ticks.size() == 20);
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        const double crossing = 1400.0 * (static_cast<double>(i) + 0.5);
        CHECK(ticks[i] % 80 == 0);
        CHECK(std::fabs(static_cast<double>(ticks[i]) - crossing) <= 40.5);
    }
}
