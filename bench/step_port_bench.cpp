// SPDX-License-Identifier: MIT
// How late edges are on this host: StepPort in real time, its lines going nowhere. Counters: octave N counts edges that
// were below 2^N us late and not in an octave before; `stretched_us` what the motion was stretched by.
// docs/pictures/late.py draws them.
#include "splinefeed/hal/gpio/step_port.hpp"

#include <benchmark/benchmark.h>
#include <chrono>
#include <thread>

using namespace splinefeed;
using namespace splinefeed::hal;
using namespace splinefeed::hal::gpio;

namespace {

class NoPins final : public PinWriter {
public:
    [[nodiscard]] bool set(std::uint64_t /*mask*/, std::uint64_t /*levels*/) noexcept override { return true; }
};

/// One axis at a constant rate for three seconds.
void edges_late(benchmark::State& state) {
    constexpr std::uint32_t ticks = 8000;
    constexpr int segments = 3000;
    const AwakeHost awake;
    NoPins lines;
    for (auto _ : state) { // NOLINT(clang-analyzer-deadcode.DeadStores)
        ChipOutputs chip{.writer = &lines};
        chip.step[0] = {1, 0};
        chip.direction[0] = {2, 0};
        StepPort port({chip}, {.axes = 1,
                               .timing = StepTiming::make({}).value(),
                               .real_time = {.spin_ns = static_cast<std::uint32_t>(state.range(1)) * 1000U}});
        state.SetLabel(port.start());
        const std::int64_t way = state.range(0) * units_per_count / 1000; // a segment of 1 ms
        FeedSegment segment;
        segment.duration_ticks = ticks;
        segment.start_velocity[0] = way;
        segment.end_velocity[0] = way;
        for (int i = 0; i < segments; ++i) {
            segment.start[0] = segment.end[0];
            segment.end[0] += way;
            while (port.room() == 0) {
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
            static_cast<void>(port.submit(segment));
        }
        port.complete();
        while (port.poll().phase == PortPhase::running) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        for (std::size_t octave = 0; octave < TimeHistogram::octaves; ++octave) {
            if (const std::uint64_t count = port.late().in_octave(octave); count > 0) {
                state.counters["octave " + std::to_string(octave)] = static_cast<double>(count);
            }
        }
        state.counters["worst_us"] = static_cast<double>(port.late().most_ns()) * 1e-3;
        state.counters["stretched_us"] = static_cast<double>(port.report().schedule_slip_ns) * 1e-3;
    }
}

} // namespace

BENCHMARK(edges_late)
    ->ArgNames({"steps_s", "spin_us"})
    ->ArgsProduct({{1000, 10000, 50000}, {0, 30}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
