// SPDX-License-Identifier: MIT
#include "step_generator.hpp"

#include "splinefeed/s5_pulse_train/dda_loader.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <memory>
#include <vector>

using namespace splinefeed;
using firmware::Inputs;
using firmware::MotionPart;
using firmware::Stop;

namespace {

constexpr unsigned axes = 2;
constexpr std::uint32_t tick = 400;                // 50 us
constexpr unsigned ticks_in_part = 20;             // 1 ms
constexpr double counts_per_s = 8000.0;            // in the middle of the motion
constexpr std::int64_t unit = units_per_count / 6; // of control points

/// A motion along x and, half as fast, y: rest, a constant speed, rest.
std::vector<MotionPart> motion(unsigned parts, bool comes_to_rest) {
    DdaLoader loader(axes, tick);
    std::vector<MotionPart> out;
    std::int64_t c[4] = {0, 0, 0, 0};
    double v = 0.0;
    const double most = counts_per_s / 1000.0;
    for (unsigned i = 0; i < parts; ++i) {
        const bool ends = comes_to_rest && i + 30 > parts;
        v = ends ? std::fmax(v - most / 20.0, 0.0) : std::fmin(v + most / 20.0, most);
        c[0] = c[1], c[1] = c[2], c[2] = c[3];
        c[3] += static_cast<std::int64_t>(v * static_cast<double>(unit));
        FeedSegment segment;
        segment.duration_ticks = 8000;
        for (unsigned k = 0; k < axes; ++k) {
            const std::int64_t d = k == 0 ? 2 : 1;
            segment.start[k] = (c[0] + 4 * c[1] + c[2]) * d / 2;
            segment.end[k] = (c[1] + 4 * c[2] + c[3]) * d / 2;
            segment.start_velocity[k] = 3 * (c[2] - c[0]) * d / 2;
            segment.end_velocity[k] = 3 * (c[3] - c[1]) * d / 2;
        }
        loader.take(segment);
        MotionPart part;
        REQUIRE(loader.next(part.ticks));
        part.end = loader.end_count();
        part.rest = segment.end_velocity[0] == 0;
        out.push_back(part);
        TickPart none;
        REQUIRE_FALSE(loader.next(none));
    }
    REQUIRE((!comes_to_rest || out.back().rest));
    return out;
}

/// An interrupt, a main loop, and a motor that counts the pulses of each millisecond.
struct Bench {
    explicit Bench(unsigned places) : storage(places + 1) {
        firmware::Lookahead lookahead;
        lookahead.start = places * 3 / 4;
        lookahead.reserve_log2 = 6;
        lookahead.slew = (1U << 16) / (2 * 64 * ticks_in_part);
        steps = std::make_unique<firmware::StepGenerator<axes>>(storage, lookahead);
    }
    void fill(const std::vector<MotionPart>& parts, std::size_t end) {
        while (next < end && next < parts.size() && steps->room() > 0) {
            steps->push(parts[next++]);
        }
    }
    /// A millisecond. The number of steps of x.
    int run(const Inputs& inputs = {}) {
        const std::int32_t before = pulses;
        for (unsigned i = 0; i < ticks_in_part; ++i) {
            steps->tick(inputs, [this](firmware::Pins lines) {
                pulses += (lines.step & 1U) == 0 ? 0 : (lines.up & 1U) != 0 ? 1 : -1;
            });
        }
        return pulses - before;
    }
    void pass(int milliseconds, const Inputs& inputs = {}) {
        for (int ms = 0; ms < milliseconds; ++ms) {
            run(inputs);
        }
    }
    /// So many milliseconds, with all of the parts that there is room for.
    void travel(const std::vector<MotionPart>& parts, int milliseconds) {
        for (int ms = 0; ms < milliseconds; ++ms) {
            fill(parts, parts.size());
            run();
        }
    }

    std::vector<MotionPart> storage;
    std::unique_ptr<firmware::StepGenerator<axes>> steps;
    std::size_t next = 0;
    std::int32_t pulses = 0;
};

} // namespace

TEST_CASE("Step generator: a motion to its end, at full rate", "[generator]") {
    const std::vector<MotionPart> parts = motion(400, true);
    Bench bench(128);
    int ms = 0;
    do {
        bench.fill(parts, parts.size());
        bench.run();
        ++ms;
    } while (ms < 1000 && (bench.steps->active() || bench.next < parts.size()));
    CHECK(ms <= 402);
    CHECK(bench.pulses == parts.back().end[0]);
    CHECK(bench.steps->count(0) == parts.back().end[0]);
    CHECK(bench.steps->count(1) == parts.back().end[1]);
    CHECK(bench.steps->underruns() == 0);
}

TEST_CASE("Step generator: a crossing in the last half tick is a step, too", "[generator]") {
    std::vector<MotionPart> parts = motion(60, true);
    ++parts.back().end[0]; // as if the motion ended on the middle between two counts, which is rounded upwards
    --parts.back().end[1];
    Bench bench(128);
    bench.fill(parts, parts.size());
    bench.pass(70);
    CHECK(bench.steps->count(0) == parts.back().end[0]);
    CHECK(bench.steps->count(1) == parts.back().end[1]);
}

TEST_CASE("Step generator: it waits until the ring holds enough, or a motion to its end", "[generator]") {
    const std::vector<MotionPart> parts = motion(400, true);
    Bench bench(128);
    bench.fill(parts, 95);
    bench.run();
    CHECK_FALSE(bench.steps->active());
    bench.fill(parts, 96);
    bench.run();
    CHECK(bench.steps->active());

    const std::vector<MotionPart> few = motion(60, true);
    Bench other(128);
    other.fill(few, few.size());
    other.run();
    CHECK(other.steps->active());
}

TEST_CASE("Step generator: where the ring runs out the motion slows down along the path and goes on", "[generator]") {
    const std::vector<MotionPart> parts = motion(600, true);
    Bench bench(128);
    bench.fill(parts, 300);
    int before = 0;
    int largest = 0;
    int ms = 0;
    do {
        bench.fill(parts, 300);
        const int now = bench.run();
        // 8 steps/ms: a slowdown of v / (2 S) is 1 in 16 ms; where the ring ends, sqrt(1 / 64) of the speed is left.
        largest = std::max(largest, std::abs(now - before));
        before = now;
        ++ms;
    } while (ms < 2000 && bench.steps->active());
    CHECK(ms > 340);
    CHECK(largest <= 2);
    CHECK(bench.steps->underruns() == 1);
    CHECK(bench.steps->count(0) == bench.pulses);

    // The planner has caught up: from there as slowly as it ended, to the exact end.
    ms = 0;
    largest = before = 0;
    do {
        bench.fill(parts, parts.size());
        const int now = bench.run();
        largest = std::max(largest, std::abs(now - before));
        before = now;
        ++ms;
    } while (ms < 2000 && (bench.steps->active() || bench.next < parts.size()));
    CHECK(largest <= 2);
    CHECK(bench.pulses == parts.back().end[0]);
    CHECK(bench.steps->count(1) == parts.back().end[1]);
}

TEST_CASE("Step generator: an emergency stop ends all pulses with its tick", "[generator]") {
    const std::vector<MotionPart> parts = motion(400, true);
    for (unsigned at = 0; at < 40; ++at) {
        Bench bench(128);
        bench.travel(parts, 100);
        const auto write = [&](firmware::Pins lines) {
            bench.pulses += static_cast<std::int32_t>(lines.step & 1U);
        };
        for (unsigned i = 0; i < at; ++i) {
            bench.steps->tick({}, write);
        }
        const std::int32_t before = bench.pulses;
        bench.steps->tick({true, false}, write);
        for (int i = 0; i < 1000; ++i) {
            bench.steps->tick({}, write);
        }
        CHECK(bench.pulses == before);
        CHECK(bench.steps->count(0) == before);
        CHECK(bench.steps->stopped() == Stop::estop);
        CHECK_FALSE(bench.steps->active());

        bench.steps->restart();
        CHECK(bench.steps->stopped() == Stop::estop);
        bench.steps->forgive();
        CHECK(bench.steps->stopped() == Stop::none);
        CHECK(bench.steps->level() == 0);
        bench.run();
        CHECK(bench.pulses == before);
    }
}

TEST_CASE("Step generator: a limit switch slows down, and may be left", "[generator]") {
    const std::vector<MotionPart> parts = motion(600, true);
    Bench bench(128);
    int before = 0;
    for (int ms = 0; ms < 200; ++ms) {
        bench.fill(parts, parts.size());
        before = bench.run();
    }
    int ms = 0;
    while (bench.steps->stopped() == Stop::none && ms < 1000) {
        bench.fill(parts, parts.size());
        const int now = bench.run({false, true});
        CHECK(std::abs(now - before) <= 2); // a part of a step, each way
        before = now;
        ++ms;
    }
    CHECK(ms >= 128); // 2 S, and the rounding of the slew: 25 for 25.6
    CHECK(ms <= 133);
    CHECK(bench.steps->stopped() == Stop::limit);
    CHECK(bench.run({false, true}) <= 1); // what is under way
    CHECK(bench.steps->count(0) == bench.pulses);
    CHECK_FALSE(bench.steps->active());

    bench.steps->restart();
    bench.steps->forgive();
    const std::int32_t stopped_at = bench.pulses;
    const std::vector<MotionPart> off = motion(60, true);
    bench.next = 0;
    bench.fill(off, off.size());
    bench.pass(100, {false, true});
    CHECK(bench.steps->stopped() == Stop::none);
    CHECK(bench.pulses != stopped_at);
}

TEST_CASE("Step generator: a switch that stays pressed stops every motion that does not leave it", "[generator]") {
    const std::vector<MotionPart> parts = motion(600, true);
    Bench bench(128);
    bench.run({false, true}); // from the start
    for (int program = 1; program <= 2; ++program) {
        const std::int32_t before = bench.pulses;
        bench.next = 0;
        for (int ms = 0; bench.steps->stopped() == Stop::none && ms < 2000; ++ms) {
            bench.fill(parts, parts.size());
            bench.run({false, true});
        }
        CHECK(bench.steps->stopped() == Stop::limit);
        const std::int32_t way = std::abs(bench.pulses - before);
        CHECK(way >= 900);               // it may leave it: 1000 steps, some ticks with two
        CHECK(way <= 1000 + 8 * 64 + 8); // and slow down over the reserve
        bench.steps->restart();
        bench.steps->forgive();
    }
}

TEST_CASE("Step generator: told to halt it slows down from the next tick on", "[generator]") {
    const std::vector<MotionPart> parts = motion(600, true);
    Bench bench(128);
    bench.travel(parts, 200);
    bench.steps->order(Stop::halted);
    CHECK_FALSE(bench.steps->stands());
    const int first = bench.run();
    const int second = bench.run();
    CHECK(second <= first);
    int ms = 2;
    for (; bench.steps->stopped() == Stop::none && ms < 1000; ++ms) {
        bench.fill(parts, parts.size());
        bench.run();
    }
    CHECK(ms >= 128);
    CHECK(ms <= 133);
    CHECK(bench.steps->stopped() == Stop::halted);
    CHECK(bench.steps->count(0) == bench.pulses);
    bench.run();
    CHECK_FALSE(bench.steps->stands()); // what is in the ring is still there
    bench.steps->restart();
    bench.steps->forgive();
    CHECK(bench.steps->stands());
}

TEST_CASE("Step generator: told to halt before a motion begins, or just before it ends, it is halted", "[generator]") {
    const std::vector<MotionPart> parts = motion(60, true);
    for (const int before_ms : {0, 55, 59}) {
        INFO(before_ms << " ms");
        Bench bench(128);
        bench.fill(parts, before_ms == 0 ? 10 : parts.size());
        bench.pass(before_ms);
        bench.steps->order(Stop::halted);
        bench.pass(200);
        CHECK(bench.steps->stopped() == Stop::halted);
        CHECK((before_ms != 0 || bench.pulses == 0));
        CHECK_FALSE(bench.steps->active());
    }
}

TEST_CASE("Step generator: what stopped it stays known behind an order, and an emergency stop behind all",
          "[generator]") {
    const std::vector<MotionPart> parts = motion(600, true);
    Bench bench(128);
    bench.travel(parts, 200);
    bench.pass(140, {false, true});
    CHECK(bench.steps->stopped() == Stop::limit);
    for (const Stop order : {Stop::halted, Stop::cut}) {
        bench.steps->order(order);
        bench.run();
        CHECK(bench.steps->stopped() == Stop::limit);
    }
    bench.run({true, false});
    bench.steps->order(Stop::halted);
    bench.run();
    CHECK(bench.steps->stopped() == Stop::estop);
}

TEST_CASE("Step generator: cut off, no pulse begins any more, and it counts those that were made", "[generator]") {
    const std::vector<MotionPart> parts = motion(600, true);
    Bench bench(128);
    bench.travel(parts, 100);
    bench.steps->order(Stop::cut);
    CHECK(bench.run() == 0);
    CHECK(bench.steps->stopped() == Stop::cut);
    CHECK(bench.steps->count(0) == bench.pulses);
}

TEST_CASE("Step generator: it tells the feed of the part that it makes, slower where it is late", "[generator]") {
    std::vector<MotionPart> parts = motion(200, false);
    for (MotionPart& part : parts) {
        part.feed_mm_min = 6000;
    }
    Bench bench(128);
    CHECK(bench.steps->feed_mm_min() == 0);
    bench.fill(parts, 100);
    bench.pass(10);
    CHECK(bench.steps->feed_mm_min() == 6000);
    bench.pass(70);
    CHECK(bench.steps->feed_mm_min() > 1000);
    CHECK(bench.steps->feed_mm_min() < 5000);
    bench.pass(400);
    CHECK(bench.steps->feed_mm_min() == 0);
}
