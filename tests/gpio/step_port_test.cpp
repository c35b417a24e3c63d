// SPDX-License-Identifier: MIT
// StepPort in real time on a chip that records: every edge of the pulse train, in order, none too near to another.
#include "../pulse/random_segments.hpp"
#include "recording_writer.hpp"
#include "splinefeed/hal/gpio/step_port.hpp"
#include "splinefeed/hal/rt/clock.hpp"
#include "support/allocations.hpp"
#include "support/catch.hpp"

#include <chrono>
#include <csignal>
#include <map>
#include <thread>
#include <unistd.h>

using namespace splinefeed;
using namespace splinefeed::hal;
using namespace splinefeed::hal::gpio;
using namespace splinefeed_test;

namespace {

constexpr int axes = 2;
constexpr std::uint64_t enable_mask = 1U << 8U;

StepPortSettings settings(const StepSettings& step = {}) {
    // How edges come, whatever the host does meanwhile: what a stall is, is judged on a virtual clock.
    return {.axes = axes,
            .timing = StepTiming::make(step).value(),
            .real_time = {.spin_ns = 0},
            .stall_ns = std::uint64_t{60} * 1'000'000'000};
}

/// Axis k: step 2 k and direction 2 k + 1; the second axis's lines are inverted, enable is, too.
ChipOutputs wired(RecordingWriter& writer) {
    ChipOutputs chip{.writer = &writer};
    for (unsigned k = 0; k < axes; ++k) {
        chip.step[k] = {std::uint64_t{1} << 2 * k, k == 1 ? std::uint64_t{1} << 2 * k : 0};
        chip.direction[k] = {std::uint64_t{2} << 2 * k, k == 1 ? std::uint64_t{2} << 2 * k : 0};
    }
    chip.enable = {enable_mask, enable_mask};
    return chip;
}

void sleep_ms(int ms) {
    std::this_thread::sleep_for(std::chrono::milliseconds(ms));
}

/// Hands all of them on; between(i) is called before the i-th.
template <class F>
PortPhase run(StepPort& port, const std::vector<FeedSegment>& segments, F between) {
    for (std::size_t i = 0; i < segments.size(); ++i) {
        between(i);
        while (port.room() == 0) {
            if (const PortPhase phase = port.poll().phase; phase != PortPhase::running && phase != PortPhase::idle) {
                return phase;
            }
            sleep_ms(1);
        }
        if (!port.submit(segments[i])) {
            return port.poll().phase;
        }
    }
    port.complete();
    while (port.poll().phase == PortPhase::running) {
        sleep_ms(1);
    }
    return port.poll().phase;
}

/// When lines change, by the plan. [ns]
std::vector<std::int64_t> planned_instants(const std::vector<FeedSegment>& segments, const StepTiming& timing) {
    PulseTrain<StepIntervals> train(StepIntervals(axes), StepDirSequencer(axes, timing));
    std::vector<std::int64_t> instants;
    const auto drain = [&] {
        Edge edge;
        while (train.next(edge)) {
            if (instants.empty() || instants.back() != edge.tick * 125) {
                instants.push_back(edge.tick * 125);
            }
        }
    };
    for (const FeedSegment& segment : segments) {
        train.take(segment);
        drain();
    }
    train.finish();
    drain();
    return instants;
}

using Levels = std::map<unsigned, std::vector<std::uint64_t>>; // of a line: when it changed

/// Steps that the lines made on an axis, and the times of each line's changes. The first row is how they begin.
std::int64_t replay(const std::vector<RecordingWriter::Row>& rows, unsigned axis, Levels& changes,
                    bool on_edge = false) {
    const bool inverted = axis == 1;
    std::int64_t count = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const std::uint64_t changed = rows[i].levels ^ rows[i - 1].levels;
        const bool step = ((rows[i].levels >> 2 * axis & 1U) != 0) != inverted;
        const bool up = ((rows[i - 1].levels >> (2 * axis + 1) & 1U) != 0) != inverted;
        for (const unsigned line : {2 * axis, 2 * axis + 1}) {
            if ((changed >> line & 1U) != 0) {
                changes[line].push_back(rows[i].at_ns);
            }
        }
        if ((changed >> 2 * axis & 1U) != 0 && (step || on_edge)) {
            count += up ? 1 : -1;
        }
    }
    return count;
}

void check_rows(const std::vector<RecordingWriter::Row>& rows, const std::vector<FeedSegment>& segments,
                const StepPort& port, const StepSettings& step) {
    for (unsigned k = 0; k < axes; ++k) {
        Levels changes;
        const std::int64_t expected = nearest_step(segments.back().end[k]) - nearest_step(segments.front().start[k]);
        CHECK(replay(rows, k, changes) == expected);
        CHECK(port.counts(static_cast<int>(k)) == expected);
        const std::vector<std::uint64_t>& steps = changes[2 * k];
        for (std::size_t i = 1; i < steps.size(); ++i) { // to high, to low, to high
            const double width_us = static_cast<double>(steps[i] - steps[i - 1]) * 1e-3;
            REQUIRE(width_us >= (i % 2 == 1 ? step.step_length_us : step.step_space_us));
        }
        for (const std::uint64_t turn : changes[2 * k + 1]) {
            for (const std::uint64_t edge : steps) {
                const double apart_us = std::fabs(static_cast<double>(turn) - static_cast<double>(edge)) * 1e-3;
                REQUIRE(apart_us >= std::min(step.direction_setup_us, step.direction_hold_us));
            }
        }
    }
}

} // namespace

TEST_CASE("a motion becomes all of its edges, and every time between them is kept") {
    const std::uint64_t seed = GENERATE(1U, 2U, 3U);
    StepSettings step;
    step.tick_us = seed == 3 ? 20.0 : 0.0;
    INFO("seed " << seed);
    const std::vector<FeedSegment> segments = RandomSegments(seed).smooth(axes, 300, 8000, 4000.0);
    RecordingWriter writer;
    StepPort port({wired(writer)}, settings(step));
    INFO(port.start());
    REQUIRE(run(port, segments, [](std::size_t) {}) == PortPhase::idle);
    check_rows(writer.rows(), segments, port, step);
    CHECK(port.late().total() == port.report().edges);
    CHECK(port.poll().executed == segments.size());
    CHECK((writer.rows().front().levels & enable_mask) == 0); // on, inverted
}

TEST_CASE("segments that come too late make all axes slow down on the path, and go on") {
    const std::vector<FeedSegment> segments = RandomSegments(4).smooth(axes, 300, 8000, 4000.0);
    RecordingWriter writer;
    StepPort port({wired(writer)}, settings());
    INFO(port.start());
    REQUIRE(run(port, segments, [](std::size_t i) { sleep_ms(i == 150 ? 300 : 0); }) == PortPhase::idle);
    check_rows(writer.rows(), segments, port, {});
    CHECK(port.report().buffer_underruns >= 1);
    CHECK(port.report().buffer_underruns < 10); // it goes on when there is enough, not hop by hop
}

TEST_CASE("a thread that stood still goes on where it was, and catches nothing up") {
    const StepSettings step;
    // Once it stands still in the call that sets lines, once asleep between steps that are far apart: in a signal's
    // handler.
    const bool in_a_call = GENERATE(true, false);
    const std::vector<FeedSegment> segments = RandomSegments(9).smooth(axes, 300, 8000, in_a_call ? 4000.0 : 200.0);
    RecordingWriter writer;
    const StepPortSettings all = settings(step);
    StepPort port({wired(writer)}, all);
    writer.stall_after(in_a_call ? 200 : 0, 200);
    static_cast<void>(std::signal(SIGUSR1, [](int) { usleep(200'000); }));
    INFO(port.start());
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGUSR1);
    REQUIRE(pthread_sigmask(SIG_BLOCK, &signals, nullptr) == 0); // of this thread, so that the other one gets it
    REQUIRE(run(port, segments, [&](std::size_t i) {
                if (i == 150 && !in_a_call) {
                    kill(getpid(), SIGUSR1);
                }
            }) == PortPhase::idle);
    static_cast<void>(std::signal(SIGUSR1, SIG_DFL));
    REQUIRE(pthread_sigmask(SIG_UNBLOCK, &signals, nullptr) == 0);
    const auto rows = writer.rows();
    check_rows(rows, segments, port, step);
    CHECK(port.report().schedule_slip_ns > 150'000'000);
    // However late an edge was, none behind it is earlier against the plan by more than what is tolerated.
    const std::vector<std::int64_t> instants = planned_instants(segments, all.timing);
    REQUIRE(rows.size() == instants.size() + 1); // the first one switches the drives on
    std::int64_t latest = static_cast<std::int64_t>(rows[1].at_ns) - instants[0];
    for (std::size_t i = 0; i < instants.size(); ++i) {
        const std::int64_t late = static_cast<std::int64_t>(rows[i + 1].at_ns) - instants[i];
        REQUIRE(late >= latest - static_cast<std::int64_t>(all.tolerated_ns) - 20'000);
        latest = std::max(latest, late);
    }
}

TEST_CASE("a chip that does not obey any more is a fault with the system's reason") {
    const std::vector<FeedSegment> segments = RandomSegments(6).smooth(axes, 100, 8000, 4000.0);
    RecordingWriter writer;
    writer.fail_after(40);
    StepPort port({wired(writer)}, settings());
    INFO(port.start());
    CHECK(run(port, segments, [](std::size_t) {}) == PortPhase::fault);
    CHECK(port.failure().what == "a line cannot be set: No such device");
    const auto rows = writer.rows();
    REQUIRE(rows.size() > 40);
    for (std::size_t i = 40; i < rows.size(); ++i) { // what is tried behind it is to switch off
        CHECK((rows[i].mask & enable_mask) != 0);
        CHECK((rows[i].levels & enable_mask) != 0);
        CHECK((rows[i].levels & 0b101U) == 0b100U);
    }
}

TEST_CASE("one motion after another: counts go on, and so do lines of which each edge is a step") {
    RecordingWriter writer;
    writer.begin_with(0b1100U); // idle: the second axis is inverted
    StepSettings step;
    step.step_on_edge = GENERATE(false, true);
    StepPort port({wired(writer)}, settings(step));
    PerAxis<std::int64_t> expected{};
    for (const std::uint64_t seed : {7U, 8U, 9U, 10U}) {
        const std::vector<FeedSegment> segments = RandomSegments(seed).smooth(axes, 60, 8000, 3000.0);
        INFO(port.start());
        REQUIRE(run(port, segments, [](std::size_t) {}) == PortPhase::idle);
        port.close();
        port.reset();
        for (unsigned k = 0; k < axes; ++k) {
            expected[k] += nearest_step(segments.back().end[k]) - nearest_step(segments.front().start[k]);
            CHECK(port.counts(static_cast<int>(k)) == expected[k]);
            Levels changes;
            CHECK(replay(writer.rows(), k, changes, step.step_on_edge) == expected[k]);
        }
    }
}

TEST_CASE("nothing is allocated while a motion runs") {
    class Silent final : public PinWriter {
    public:
        [[nodiscard]] bool set(std::uint64_t /*mask*/, std::uint64_t /*levels*/) noexcept override { return true; }
    };
    const std::vector<FeedSegment> segments = RandomSegments(11).smooth(axes, 200, 8000, 4000.0);
    Silent writer;
    ChipOutputs chip{.writer = &writer};
    chip.step[0] = {1, 0};
    chip.step[1] = {2, 0};
    StepPort port({chip}, settings());
    INFO(port.start());
    const std::size_t before = allocations();
    const PortPhase end = run(port, segments, [](std::size_t) {});
    const std::size_t after = allocations();
    CHECK(end == PortPhase::idle);
    CHECK(port.report().edges > 100);
    CHECK(after == before);
}
