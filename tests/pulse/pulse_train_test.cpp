// SPDX-License-Identifier: MIT
// Edges of random motion under random timings, as a drive sees them.
#include "edge_checker.hpp"
#include "random_segments.hpp"
#include "splinefeed/s5_pulse_train/pulse_train.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

/// Bounds of velocity and acceleration over all of the segments, from the Bezier points of the velocity.
StepDemand demand_of(const std::vector<FeedSegment>& segments, int axes) {
    StepDemand demand;
    for (const FeedSegment& s : segments) {
        const double per_s = 8e6 / s.duration_ticks;
        for (const unsigned k : indices(axes)) {
            const auto v0 = static_cast<double>(s.start_velocity[k]) / units_per_count;
            const auto v2 = static_cast<double>(s.end_velocity[k]) / units_per_count;
            const double v1 = 3.0 * static_cast<double>(s.end[k] - s.start[k]) / units_per_count - v0 - v2;
            for (const double v : {v0, v1, v2}) {
                demand.steps_per_s = std::max(demand.steps_per_s, std::fabs(v) * per_s);
            }
            const double change = 2.0 * std::max(std::fabs(v1 - v0), std::fabs(v2 - v1));
            demand.steps_per_s2 = std::max(demand.steps_per_s2, change * per_s * per_s);
        }
    }
    return demand;
}

template <StepEngine E>
std::vector<Step> steps_of(E engine, const std::vector<FeedSegment>& segments) {
    std::vector<Step> steps;
    Step step;
    const auto drain = [&] {
        while (engine.next(step)) {
            steps.push_back(step);
        }
    };
    for (const FeedSegment& segment : segments) {
        engine.take(segment);
        drain();
    }
    engine.finish();
    drain();
    return steps;
}

struct Tally {
    std::size_t runs = 0;
    std::size_t steps = 0;
    std::size_t left_out = 0;
};

template <StepEngine E>
void require_train(const E& engine, const StepTiming& timing, const std::vector<FeedSegment>& segments, int axes,
                   Tally& tally) {
    PulseTrain<E> train(engine, StepDirSequencer(axes, timing));
    std::vector<EdgeChecker> drive(static_cast<std::size_t>(axes), EdgeChecker(timing));
    Edge edge;
    std::int64_t last = std::numeric_limits<std::int64_t>::min();
    const auto drain = [&] {
        while (train.next(edge)) {
            REQUIRE(edge.tick >= last);
            last = edge.tick;
            CAPTURE(edge.tick, int(edge.axis), int(edge.line), edge.level);
            REQUIRE(drive[edge.axis].see(edge).empty());
        }
    };
    for (const FeedSegment& segment : segments) {
        train.take(segment);
        drain();
    }
    train.finish();
    drain();
    // Each step that the engine made is there, at its instant, but for pairs that cancel.
    const std::vector<Step> all = steps_of(engine, segments);
    std::size_t seen = 0;
    for (const unsigned k : indices(axes)) {
        CHECK(drive[k].at_rest());
        const std::vector<SeenStep>& made = drive[k].steps;
        std::size_t i = 0;
        std::vector<Step> missing;
        for (const Step& step : all) {
            if (step.axis != k) {
                continue;
            }
            if (i < made.size() && made[i].tick == step.tick && made[i].up == step.up && missing.size() % 2 == 0) {
                ++i;
            } else {
                missing.push_back(step);
            }
        }
        CAPTURE(k, made.size(), missing.size());
        REQUIRE(i == made.size());
        REQUIRE(missing.size() % 2 == 0);
        for (std::size_t j = 0; j < missing.size(); j += 2) {
            REQUIRE(missing[j].up != missing[j + 1].up);
            REQUIRE(missing[j + 1].tick - missing[j].tick < timing.turn_gap());
        }
        seen += made.size();
        tally.left_out += missing.size();
    }
    REQUIRE(seen + train.lines().left_out() == all.size());
    ++tally.runs;
    tally.steps += seen;
}

enum class Kind { intervals, fixed_rate, interpolated };

StepSettings random_settings(RandomSegments& random, Kind kind) {
    StepSettings settings;
    settings.interpolated = kind == Kind::interpolated;
    settings.tick_us = kind == Kind::fixed_rate     ? 0.25 * (1 + random.below(80))
                       : kind == Kind::interpolated ? 0.25 * (1 + random.below(200))
                                                    : 0.0;
    settings.step_length_us = random.decades(0.2, 20.0);
    settings.step_space_us = random.decades(0.2, 20.0);
    settings.direction_setup_us = random.below(5) == 0 ? 0.0 : random.decades(0.2, 60.0);
    settings.direction_hold_us = random.below(5) == 0 ? 0.0 : random.decades(0.2, 60.0);
    settings.step_on_edge = random.below(3) == 0;
    return settings;
}

} // namespace

TEST_CASE("Edges keep every time, and every step that they make is the engine's, at its instant") {
    const std::uint64_t seed = random_seed();
    CAPTURE(seed);
    RandomSegments random(seed);
    Tally tally;
    const auto few = [&] {
        return tally.runs <= 8 || tally.steps <= 1000;
    };
    for (int round = 0; round < rounds(50) || (few() && round < 1000); ++round) {
        CAPTURE(round);
        const int axes = 1 + random.below(4);
        const auto kind = static_cast<Kind>(random.below(3));
        const StepSettings settings = random_settings(random, kind);
        const Result<StepTiming> timing = StepTiming::make(settings);
        REQUIRE(timing.has_value());
        const double rate = timing->most_steps_per_s() * random.decades(0.02, 0.9);
        const auto segments = random.smooth(axes, 100, 8000, rate);
        if (!timing->allows(demand_of(segments, axes)).ok()) {
            continue;
        }
        if (kind == Kind::fixed_rate) {
            require_train(FixedRate(axes, timing->grid), *timing, segments, axes, tally);
        } else if (kind == Kind::interpolated) {
            require_train(InterpolatedSteps(axes, timing->tick), *timing, segments, axes, tally);
        } else {
            require_train(StepIntervals(axes), *timing, segments, axes, tally);
        }
    }
    CAPTURE(tally.runs, tally.steps, tally.left_out);
    CHECK(tally.runs > 8);
    CHECK(tally.steps > 1000);
}

// The motion turns 2e-7 count behind a crossing, at a hundred such places: out and back take 20 us of the 100 that a
// change of direction needs.
TEST_CASE("A reversal that barely touches a crossing makes no step") {
    std::vector<FeedSegment> segments;
    constexpr std::int64_t half = units_per_count / 2;
    std::int64_t at = 0;
    for (int i = 0; i < 100; ++i) {
        for (const std::int64_t to : {half + 600, std::int64_t{0}}) {
            FeedSegment s;
            s.duration_ticks = 80000;
            s.start[0] = at;
            s.end[0] = at = to;
            segments.push_back(s);
        }
    }
    StepSettings settings;
    settings.direction_setup_us = 60.0;
    settings.direction_hold_us = 38.0;
    Tally tally;
    require_train(StepIntervals(1), *StepTiming::make(settings), segments, 1, tally);
    CHECK(tally.steps == 0);
    CHECK(tally.left_out == 200);
    // 0.01 count behind it, there is time.
    for (FeedSegment& s : segments) {
        s.end[0] += s.end[0] != 0 ? units_per_count / 100 : 0;
        s.start[0] += s.start[0] != 0 ? units_per_count / 100 : 0;
    }
    require_train(StepIntervals(1), *StepTiming::make(settings), segments, 1, tally);
    CHECK(tally.steps == 200);
    CHECK(tally.left_out == 200);
}
