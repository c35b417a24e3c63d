// SPDX-License-Identifier: MIT
// Edges after thousands of years of motion: instants are counted in 1/8 us, in 63 bits.
#include "random_segments.hpp"
#include "splinefeed/s5_pulse_train/pulse_train.hpp"
#include "support/catch.hpp"
#include "support/counter_seam.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr int axes = 2;

template <StepEngine E>
std::vector<Edge> edges_of(const E& engine, const StepTiming& timing, const std::vector<FeedSegment>& segments) {
    PulseTrain<E> train(engine, StepDirSequencer(axes, timing));
    std::vector<Edge> edges;
    Edge edge;
    const auto drain = [&] {
        while (train.next(edge)) {
            edges.push_back(edge);
        }
    };
    for (const FeedSegment& segment : segments) {
        train.take(segment);
        drain();
    }
    train.finish();
    drain();
    return edges;
}

void require_shifted(const std::vector<Edge>& fresh, const std::vector<Edge>& old, std::int64_t ticks) {
    REQUIRE(fresh.size() > 1000);
    REQUIRE(old.size() == fresh.size());
    for (std::size_t i = 0; i < fresh.size(); ++i) {
        REQUIRE(old[i].tick == fresh[i].tick + ticks);
        REQUIRE(old[i].axis == fresh[i].axis);
        REQUIRE(old[i].line == fresh[i].line);
        REQUIRE(old[i].level == fresh[i].level);
    }
}

} // namespace

TEST_CASE("the edges of a motion are the same after thousands of years") {
    // 2^63 ticks, 36,000 years, less a minute
    constexpr std::int64_t late = std::numeric_limits<std::int64_t>::max() - std::int64_t{8'000'000} * 60;
    RandomSegments random(71);
    const auto segments = random.smooth(axes, 200, 8000, 40000.0);
    {
        const StepTiming timing = StepTiming::make({}).value();
        const StepIntervals fresh(axes);
        StepIntervals old(axes);
        CounterSeam::started(old, late);
        require_shifted(edges_of(fresh, timing, segments), edges_of(old, timing, segments), late);
    }
    {
        const StepTiming timing = StepTiming::make({.tick_us = 40.0, .interpolated = true}).value();
        const InterpolatedSteps fresh(axes, timing.tick);
        InterpolatedSteps old(axes, timing.tick);
        CounterSeam::started(old, late - 2 * timing.tick);
        require_shifted(edges_of(fresh, timing, segments), edges_of(old, timing, segments), late);
    }
    const StepTiming timing = StepTiming::make({.tick_us = 5.0}).value();
    const FixedRate fresh(axes, timing.grid);
    FixedRate old(axes, timing.grid);
    CounterSeam::passed(old, late / timing.grid);
    require_shifted(edges_of(fresh, timing, segments), edges_of(old, timing, segments),
                    late / timing.grid * timing.grid);
}
