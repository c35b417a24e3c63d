// SPDX-License-Identifier: MIT
#include "word_lines.hpp"

#include "step_generator.hpp"

#include "splinefeed/s5_pulse_train/pulse_train.hpp"

#include "pulse/random_segments.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <tuple>
#include <vector>

using namespace splinefeed;
using firmware::LineWord;

namespace {

constexpr unsigned axes = 3;
constexpr std::uint32_t cycles_per_us = 125;
constexpr std::uint32_t lead_ticks = 10;

consteval firmware::WordSettings settings_of(double tick_us, double setup_us, double hold_us) {
    const StepSettings step{
        .tick_us = tick_us, .interpolated = true, .direction_setup_us = setup_us, .direction_hold_us = hold_us};
    return {*StepTiming::make(step), cycles_per_us, lead_ticks, 0};
}
template <firmware::WordSettings settings>
using Lines = firmware::WordLines<axes, settings>;

// Pins in no order, one that is inverted, an axis of two motors.
constexpr PerAxis<LineMasks> masks = {
    {{1U << 7, 1U << 2, 0}, {1U << 3 | 1U << 9, 1U << 30, 1U << 9}, {1U, 1U << 4, 1U << 4}}};

struct Change {
    double cycle = 0.0;
    unsigned axis = 0;
    Line line = Line::step;
    bool level = false;
};

/// What the levels say of an axis's line, if all of its motors say the same.
bool level_of(std::uint32_t levels, unsigned axis, Line line) {
    const LineMasks& m = masks[axis];
    const std::uint32_t of_line = line == Line::step ? m.step : m.direction;
    const std::uint32_t on = (levels ^ m.inverted) & of_line;
    REQUIRE((on == 0 || on == of_line));
    return on != 0;
}

/// The changes that the words make; the first word is that before the motion.
std::vector<Change> changes_of(const std::vector<LineWord>& words) {
    std::vector<Change> changes;
    double cycle = 0.0;
    for (std::size_t i = 1; i < words.size(); ++i) {
        REQUIRE(words[i - 1].cycles >= 3);
        cycle += words[i - 1].cycles;
        for (unsigned k = 0; k < axes; ++k) {
            for (const Line line : {Line::direction, Line::step}) {
                const bool level = level_of(words[i].levels, k, line);
                if (level != level_of(words[i - 1].levels, k, line)) {
                    changes.push_back({cycle, k, line, level});
                }
            }
        }
    }
    return changes;
}

template <firmware::WordSettings settings>
std::vector<LineWord> words_of(const std::vector<FeedSegment>& segments) {
    DdaLoader loader(axes, settings.timing.tick, Lines<settings>::samples);
    Lines<settings> lines(masks);
    auto dda = lines.dda();
    std::vector<LineWord> words;
    const auto none = [](unsigned /*axis*/, std::int32_t /*steps*/) {
    };
    const auto tick = [&](auto steps, bool moving = true) {
        lines.show([&](LineWord word) { words.push_back(word); }, none);
        lines.take(steps, moving, none);
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
            tick(dda.begin(part));
            while (dda.left() > 0) {
                tick(dda.tick());
            }
        }
    }
    tick(dda.finish(loader.end_count()));
    while (!lines.empty()) {
        tick(typename decltype(dda)::Steps{}, false);
    }
    return words;
}

/// What the core makes of them, from the begin of the first word.
std::vector<Change> sequenced(const std::vector<FeedSegment>& segments, const StepTiming& timing) {
    PulseTrain<InterpolatedSteps> train(InterpolatedSteps(axes, timing.tick), StepDirSequencer(axes, timing));
    std::vector<Change> changes;
    Edge edge;
    const std::uint32_t late = (lead_ticks + 1) * timing.tick + timing.turn_gap();
    const auto drain = [&] {
        while (train.next(edge)) {
            const double ticks = static_cast<double>(edge.tick) + late;
            changes.push_back({ticks * cycles_per_us / ticks_per_us, edge.axis, edge.line, edge.level});
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
    std::stable_sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.axis < b.axis; });
}

/// A coprocessor, some words behind the processor.
struct Port {
    void operator()(LineWord word) { ahead.push_back(word); }
    void execute(double cycles) {
        for (left -= cycles; left <= 0.0 && !ahead.empty(); left += ahead.front().cycles, ahead.pop_front()) {
            for (unsigned k = 0; k < axes; ++k) {
                if (level_of(ahead.front().levels, k, Line::step) && !level_of(shown, k, Line::step)) {
                    made[k] += level_of(ahead.front().levels, k, Line::direction) ? 1 : -1;
                }
            }
            shown = ahead.front().levels;
        }
        left = left < 0.0 ? 0.0 : left; // it waits
    }
    template <class Seen>
    std::uint32_t cut(std::uint32_t levels, Seen&& seen) {
        std::uint32_t before = shown;
        for (const LineWord& word : ahead) {
            seen(before, word.levels);
            before = word.levels;
        }
        seen(before, levels);
        ahead.clear();
        left = 0.0;
        return shown;
    }
    std::deque<LineWord> ahead;
    std::uint32_t shown = 0;
    double left = 0.0; // of the word that is executed
    PerAxis<std::int32_t> made{};
};

template <firmware::WordSettings settings>
std::size_t compare(std::uint64_t seed) {
    splinefeed_test::RandomSegments random(seed);
    const StepTiming& timing = settings.timing;
    const std::vector<FeedSegment> segments =
        random.smooth(axes, 200, 8000, 0.98 * timing.most_steps_per_s() * random.decades(0.01, 1.0));
    std::vector<Change> here = changes_of(words_of<settings>(segments));
    std::vector<Change> there = sequenced(segments, timing);
    sort(here);
    sort(there);
    REQUIRE(here.size() == there.size());
    for (std::size_t i = 0; i < here.size(); ++i) {
        CAPTURE(i, here[i].cycle, there[i].cycle, here[i].axis, here[i].line == Line::step);
        REQUIRE(std::tuple(here[i].axis, here[i].line, here[i].level) ==
                std::tuple(there[i].axis, there[i].line, there[i].level));
        REQUIRE(std::fabs(here[i].cycle - there[i].cycle) < 1.0);
    }
    return here.size();
}

} // namespace

TEST_CASE("Word lines: the edges of the core's sequencer behind the interpolating engine, to a cycle", "[words]") {
    std::size_t edges = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        CAPTURE(seed);
        edges += compare<settings_of(40.0, 5.0, 5.0)>(seed);
        edges += compare<settings_of(62.5, 16.0, 11.125)>(seed + 100);
        edges += compare<settings_of(12.25, 1.0, 9.25)>(seed + 200);
    }
    CHECK(edges > 100'000);
}

TEST_CASE("Word lines: of a motion that is cut, the steps that were made are counted", "[words]") {
    constexpr firmware::WordSettings settings = settings_of(40.0, 5.0, 5.0);
    const std::uint64_t seed = splinefeed_test::random_seed();
    CAPTURE(seed);
    splinefeed_test::RandomSegments random(seed);
    unsigned moved = 0;
    for (int round = 0; round < 60; ++round) {
        CAPTURE(round);
        std::vector<firmware::MotionPart> storage(200);
        firmware::Lookahead lookahead;
        lookahead.slew = 1U << 16;
        const Lines<settings> lines(masks);
        firmware::StepGenerator<axes, Lines<settings>> steps(storage, lookahead, lines);
        Port port;
        port.shown = lines.levels();
        DdaLoader loader(axes, settings.timing.tick, Lines<settings>::samples);
        PerAxis<std::int32_t> from{};
        for (const FeedSegment& segment : random.smooth(axes, 60, 8000, 150'000.0 * random.decades(0.05, 1.0))) {
            if (steps.level() == 0) {
                for (unsigned k = 0; k < axes; ++k) {
                    from[k] = static_cast<std::int32_t>(nearest_step(segment.start[k]));
                }
                steps.set_counts(from);
            }
            loader.take(segment);
            firmware::MotionPart part;
            REQUIRE(loader.next(part.ticks));
            part.end = loader.end_count();
            part.rest = false;
            steps.push(part);
        }
        const int cut = random.below(240); // of 300 batches
        const int lag = random.below(5);   // ticks of the last one
        for (int batch = 0; batch <= cut; ++batch) {
            const bool stops = batch == cut;
            for (int i = 0; i < 5; ++i) {
                steps.tick({stops && i == lag, false}, port);
            }
            if (!stops) {
                port.execute(5.0 * settings.timing.tick * cycles_per_us / ticks_per_us);
            }
        }
        for (unsigned k = 0; k < axes; ++k) {
            CAPTURE(k);
            CHECK(steps.count(k) - from[k] == port.made[k]);
            moved += port.made[k] != 0 ? 1 : 0;
        }
        CHECK(steps.stopped() == firmware::Stop::estop);
        // It goes on from the levels that it left.
        const PerAxis<std::int32_t> made = port.made;
        for (int i = 0; i < 50; ++i) {
            steps.tick({}, port);
        }
        port.execute(1e6);
        CHECK(port.made == made);
    }
    CHECK(moved > 60);
}
