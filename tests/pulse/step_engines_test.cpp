// SPDX-License-Identifier: MIT
// The engines against the crossings of the cubics, computed in long double.
#include "ideal_motion.hpp"
#include "random_segments.hpp"
#include "splinefeed/s5_pulse_train/fixed_rate.hpp"
#include "splinefeed/s5_pulse_train/interpolated_steps.hpp"
#include "splinefeed/s5_pulse_train/step_intervals.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

template <StepEngine E>
std::vector<Step> steps_of(E engine, const std::vector<FeedSegment>& segments) {
    std::vector<Step> steps;
    Step step;
    for (const FeedSegment& segment : segments) {
        engine.take(segment);
        while (engine.next(step)) {
            steps.push_back(step);
        }
    }
    engine.finish();
    while (engine.next(step)) {
        steps.push_back(step);
    }
    return steps;
}

struct Check {
    Real tolerance_ticks;
    Real blur;                   // counts
    std::int64_t step_ticks = 1; // instants come in multiples
};

struct Found {
    Real worst_ticks = 0.0L;
    std::size_t touches = 0;
};

/// At any instant the axis stands within half a step of the plan, and what the plan moves in the tolerance: none is
/// missing.
void require_near(const std::vector<Step>& own, const IdealMotion& motion, std::int64_t count, const Check& check) {
    constexpr int samples = 500;
    std::size_t next = 0;
    for (int i = 0; i <= samples; ++i) {
        const Real tick = static_cast<Real>(motion.end_tick()) * i / samples;
        for (; next < own.size() && static_cast<Real>(own[next].tick) <= tick; ++next) {
            count += own[next].up ? 1 : -1;
        }
        // Somewhere in the tolerance the plan is as near; looked for closely only where its ends and middle are not.
        const auto nearest = [&](int places) {
            Real most = 1e9L;
            for (int j = -places; j <= places; ++j) {
                const Real at = tick + check.tolerance_ticks * j / places;
                most = std::min(most, std::fabs(motion.beyond(count * units_per_count, at)));
            }
            return most;
        };
        const Real off = nearest(1) <= 0.5L ? 0.0L : nearest(64);
        CAPTURE(i, static_cast<double>(off), count);
        REQUIRE(off <= 0.5L + check.blur + 1e-4L); // between the 64 places
    }
}

/// Every step is where its crossing is, or one of a pair that a touch made; counts are exact at the end.
Found require_ideal(const std::vector<Step>& steps, const std::vector<FeedSegment>& segments, int axes,
                    const Check& check) {
    Found found;
    std::int64_t last = 0;
    for (const Step& step : steps) {
        REQUIRE(step.tick >= last);
        REQUIRE(step.tick % check.step_ticks == 0);
        last = step.tick;
    }
    for (const unsigned k : indices(axes)) {
        const IdealMotion motion(segments, k);
        std::vector<Step> own;
        std::copy_if(steps.begin(), steps.end(), std::back_inserter(own), [&](const Step& s) { return s.axis == k; });
        std::int64_t count = nearest_step(segments.front().start[k]);
        const Real window = 4.0L * check.tolerance_ticks + 2.0L;
        for (std::size_t i = 0; i < own.size(); ++i) {
            const Step& step = own[i];
            const std::int64_t level = count * units_per_count + (step.up ? 1 : -1) * (units_per_count / 2);
            count += step.up ? 1 : -1;
            Real off = motion.distance(level, step.up, step.tick, check.tolerance_ticks, check.blur);
            if (off >
                check.tolerance_ticks) { // how far it is, then; nearer by there may be other crossings of the level
                off = motion.distance(level, step.up, step.tick, window, check.blur);
            }
            const auto near = [&](const Step& other) {
                return other.up != step.up && static_cast<Real>(std::llabs(other.tick - step.tick)) <= 2.0L * window;
            };
            const bool touch = (i > 0 && near(own[i - 1])) || (i + 1 < own.size() && near(own[i + 1]));
            CAPTURE(k, i, step.tick, step.up, static_cast<double>(off), touch, own.size());
            if (touch) {
                ++found.touches;
            } else {
                REQUIRE(off <= check.tolerance_ticks);
                found.worst_ticks = std::max(found.worst_ticks, off);
            }
        }
        CAPTURE(k);
        REQUIRE(count == nearest_step(segments.back().end[k]));
        require_near(own, motion, nearest_step(segments.front().start[k]), check);
    }
    return found;
}

/// How far the motion is at most from the lines between its places at ticks [counts]: a h^2 / 8, and v h / 4 for a jump
/// of the velocity by v.
Real off_lines(const std::vector<FeedSegment>& segments, int axes, std::uint32_t tick) {
    Real most = 0.0L;
    for (const unsigned k : indices(axes)) {
        Real before = static_cast<Real>(segments.front().start_velocity[k]) / segments.front().duration_ticks;
        Real curved = 0.0L;
        Real jumped = 0.0L;
        for (const FeedSegment& s : segments) {
            const Real v0 = static_cast<Real>(s.start_velocity[k]) / s.duration_ticks;
            const Real v1 = static_cast<Real>(s.end_velocity[k]) / s.duration_ticks;
            const Real mean = static_cast<Real>(s.end[k] - s.start[k]) / s.duration_ticks;
            // Of a cubic the acceleration is largest at an end.
            for (const Real change : {6.0L * mean - 4.0L * v0 - 2.0L * v1, 4.0L * v1 + 2.0L * v0 - 6.0L * mean}) {
                curved = std::max(curved, std::fabs(change) / s.duration_ticks);
            }
            jumped = std::max(jumped, std::fabs(v0 - before));
            before = v1;
        }
        // A tick may see the joints of several short segments.
        const Real joints =
            1.0L + static_cast<Real>(tick) / std::min_element(segments.begin(), segments.end(), [](auto& a, auto& b) {
                                                 return a.duration_ticks < b.duration_ticks;
                                             })->duration_ticks;
        most = std::max(most, curved * tick * tick / 8.0L + joints * jumped * tick / 4.0L);
    }
    return most / units_per_count + 0x1p-29L;
}

} // namespace

TEST_CASE("Steps of smooth motion are where the cubics cross, with each engine") {
    const std::uint64_t seed = random_seed();
    CAPTURE(seed);
    RandomSegments random(seed);
    Real worst = 0.0L;
    Real worst_between = 0.0L;
    std::size_t total = 0;
    int straight = 0;
    for (int round = 0; round < rounds(12) || (total <= 100 && round < 1000); ++round) {
        CAPTURE(round);
        const int axes = 1 + random.below(3);
        const auto tick = static_cast<std::uint32_t>(2 * (1 + random.below(100)));
        const auto duration = static_cast<std::uint32_t>(random.below(2) == 0 ? 8000 : random.decades(400, 40000));
        const double rate = 8e6 / tick * 0.49 * random.decades(0.01, 1.0);
        const auto segments = random.smooth(axes, 100, duration, rate);
        const std::vector<Step> solved = steps_of(StepIntervals(axes), segments);
        const Found found = require_ideal(solved, segments, axes, {1.0L, 0x1p-29L});
        worst = std::max(worst, found.worst_ticks);
        total += solved.size();
        const std::vector<Step> ticked = steps_of(FixedRate(axes, tick), segments);
        require_ideal(ticked, segments, axes, {0.5L * tick, 0x1p-34L, tick});
        const std::uint32_t sampled = tick * static_cast<std::uint32_t>(1 + random.below(14)); // up to 6.9 counts in it
        const Real blur = off_lines(segments, axes, sampled);
        const std::vector<Step> interpolated = steps_of(InterpolatedSteps(axes, sampled), segments);
        worst_between = std::max(worst_between, require_ideal(interpolated, segments, axes, {1.0L, blur}).worst_ticks);
        straight += blur < 0.01L ? 1 : 0;
    }
    CAPTURE(static_cast<double>(worst), static_cast<double>(worst_between), total, straight);
    CHECK(total > 100);
    CHECK(worst > 0.3L); // it is measured
    CHECK(worst_between > 0.1L);
    CHECK(straight > 0); // a bound that says something
}

TEST_CASE("Steps of any chain of cubics are where they cross, with reversals, jumps and changing durations") {
    const std::uint64_t seed = random_seed();
    CAPTURE(seed);
    RandomSegments random(seed);
    std::size_t total = 0;
    std::size_t touches = 0;
    for (int round = 0; round < rounds(40) || (total <= 100 && round < 1000); ++round) {
        CAPTURE(round);
        const int axes = 1 + random.below(3);
        const auto tick = static_cast<std::uint32_t>(2 * (1 + random.below(100)));
        const double rate = 8e6 / tick * 0.49 * random.decades(0.01, 1.0);
        const auto segments = random.rough(axes, 80, 20, static_cast<std::uint32_t>(random.decades(500, 100000)), rate);
        const std::vector<Step> solved = steps_of(StepIntervals(axes), segments);
        touches += require_ideal(solved, segments, axes, {1.0L, 0x1p-29L}).touches;
        total += solved.size();
        const std::vector<Step> ticked = steps_of(FixedRate(axes, tick), segments);
        require_ideal(ticked, segments, axes, {0.5L * tick, 0x1p-34L, tick});
        const std::uint32_t sampled = tick * static_cast<std::uint32_t>(1 + random.below(14));
        require_ideal(steps_of(InterpolatedSteps(axes, sampled), segments), segments, axes,
                      {1.0L, off_lines(segments, axes, sampled)});
    }
    CAPTURE(total, touches);
    CHECK(total > 100);
    CHECK(touches * 20 < total);
}
