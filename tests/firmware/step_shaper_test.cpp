// SPDX-License-Identifier: MIT
#include "step_shaper.hpp"

#include "splinefeed/s5_pulse_train/pulse_train.hpp"

#include "pulse/random_segments.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

using namespace splinefeed;

namespace {

constexpr unsigned axes = 3;
constexpr std::uint32_t tick = 400;

struct Change {
    std::int64_t tick = 0;
    unsigned axis = 0;
    Line line = Line::step;
    bool level = false;
    bool operator==(const Change&) const = default;
};

/// What the lines of a firmware show, shifted back by the shaper's delay.
std::vector<Change> shaped(const std::vector<FeedSegment>& segments) {
    DdaLoader loader(axes, tick);
    TickDda<axes> dda;
    firmware::StepShaper<axes> shaper;
    firmware::Pins before;
    std::vector<Change> changes;
    std::int64_t at = -std::int64_t{firmware::StepShaper<axes>::delay};
    const auto show = [&](StepBits steps) {
        const firmware::Pins lines = shaper.next(steps);
        for (unsigned k = 0; k < axes; ++k) {
            if (((lines.up ^ before.up) >> k & 1U) != 0) {
                changes.push_back({at * tick, k, Line::direction, (lines.up >> k & 1U) != 0});
            }
            if (((lines.step ^ before.step) >> k & 1U) != 0) {
                changes.push_back({at * tick, k, Line::step, (lines.step >> k & 1U) != 0});
            }
        }
        before = lines;
        ++at;
    };
    bool first = true;
    for (const FeedSegment& segment : segments) {
        loader.take(segment);
        if (first) {
            dda.stand(loader.start_count());
            first = false;
        }
        TickPart part;
        while (loader.next(part)) {
            show(dda.begin(part));
            while (dda.left() > 0) {
                show(dda.tick());
            }
        }
    }
    show(dda.finish(loader.end_count()));
    while (!shaper.empty() || before.step != 0) {
        show({});
    }
    return changes;
}

/// What the core makes of them, with all four times at one tick.
std::vector<Change> sequenced(const std::vector<FeedSegment>& segments) {
    StepTiming timing;
    timing.grid = timing.high = timing.low = timing.setup = timing.hold = tick;
    PulseTrain<FixedRate> train(FixedRate(axes, tick), StepDirSequencer(axes, timing));
    std::vector<Change> changes;
    Edge edge;
    const auto drain = [&] {
        while (train.next(edge)) {
            changes.push_back({edge.tick, edge.axis, edge.line, edge.level});
        }
    };
    for (const FeedSegment& segment : segments) {
        train.take(segment);
        drain();
    }
    train.finish();
    drain();
    return changes;
}

void sort(std::vector<Change>& changes) {
    std::sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) {
        return std::tuple(a.tick, a.axis, a.line) < std::tuple(b.tick, b.axis, b.line);
    });
}

} // namespace

TEST_CASE("Step shaper: the edges of the core's sequencer with all times at one tick, delayed", "[shaper]") {
    std::size_t edges = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        CAPTURE(seed);
        splinefeed_test::RandomSegments random(seed);
        // Below half a count a tick: 10,000 counts/s.
        const std::vector<FeedSegment> segments = random.smooth(axes, 300, 8000, random.decades(50.0, 9500.0));
        std::vector<Change> here = shaped(segments);
        std::vector<Change> there = sequenced(segments);
        sort(here);
        sort(there);
        edges += there.size();
        REQUIRE(here == there);
    }
    CHECK(edges > 10'000);
}

TEST_CASE("Step shaper: a step and the step back within three ticks are left out", "[shaper]") {
    for (unsigned gap = 1; gap <= 5; ++gap) {
        CAPTURE(gap);
        firmware::StepShaper<1> shaper;
        unsigned pulses = 0;
        bool high = false;
        for (unsigned i = 0; i < 12; ++i) {
            const firmware::Pins lines = shaper.next({i == 0 ? 1U : i == gap ? 3U : 0U});
            pulses += (lines.step & 1U) != 0 && !high ? 1U : 0U;
            high = (lines.step & 1U) != 0;
        }
        CHECK(pulses == (gap < 3 ? 0U : 2U));
    }
}
