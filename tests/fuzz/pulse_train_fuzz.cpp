// SPDX-License-Identifier: MIT
// Any chain of feed segments to both engines: all of them end, in order of time, at the count of the last position.
#include "fuzz/bytes.hpp"
#include "splinefeed/s5_pulse_train/fixed_rate.hpp"
#include "splinefeed/s5_pulse_train/interpolated_steps.hpp"
#include "splinefeed/s5_pulse_train/step_intervals.hpp"

#include <cstdlib>
#include <vector>

using namespace splinefeed;
using splinefeed_test::Bytes;

namespace {

constexpr std::uint32_t tick_ticks = 16;

/// Bezier points of the velocity below half a count a tick of the DDA, at most some ten thousand steps in all.
std::vector<FeedSegment> segments_of(Bytes& bytes) {
    std::vector<FeedSegment> segments;
    std::int64_t at =
        (static_cast<std::int64_t>(bytes.take16()) - 32768) * (units_per_count / 2) + bytes.take() % 3 - 1;
    std::int64_t velocity = 0; // [units per tick_ticks, below half a count]
    std::uint32_t duration = 8000;
    while (bytes.left > 0 && segments.size() < 32) {
        const std::uint8_t kind = bytes.take();
        if (kind % 4 == 0) {
            duration = 2U + bytes.take16() % 16000U;
        }
        const int shift = kind / 4 % 32;
        const auto random = [&] {
            return (static_cast<std::int64_t>(bytes.take16()) - 32768) * 49000 >> shift;
        };
        const std::int64_t middle = random();
        const std::int64_t next = random();
        FeedSegment segment;
        segment.duration_ticks = duration;
        segment.start[0] = at;
        segment.start_velocity[0] = velocity * duration / tick_ticks;
        segment.end_velocity[0] = next * duration / tick_ticks;
        at += (velocity + middle + next) * duration / tick_ticks / 3;
        segment.end[0] = at;
        velocity = next;
        segments.push_back(segment);
    }
    return segments;
}

template <StepEngine E>
void require_end(E engine, const std::vector<FeedSegment>& segments) {
    std::int64_t count = nearest_step(segments.front().start[0]);
    std::int64_t last = 0;
    std::int64_t end = 0;
    Step step;
    const auto drain = [&] {
        while (engine.next(step)) {
            count += step.up ? 1 : -1;
            if (step.tick < last || step.tick > end + tick_ticks) {
                std::abort();
            }
            last = step.tick;
        }
    };
    for (const FeedSegment& segment : segments) {
        end += segment.duration_ticks;
        engine.take(segment);
        drain();
    }
    engine.finish();
    drain();
    if (count != nearest_step(segments.back().end[0])) {
        std::abort();
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes{data, size};
    const std::vector<FeedSegment> segments = segments_of(bytes);
    if (!segments.empty()) {
        require_end(StepIntervals(1), segments);
        require_end(FixedRate(1, tick_ticks), segments);
        require_end(InterpolatedSteps(1, tick_ticks), segments);
    }
    return 0;
}
