// SPDX-License-Identifier: MIT
// Step: an axis moves by one count, at an instant. StepEngine: what turns feed segments into steps.
#pragma once

#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <concepts>
#include <cstdint>

namespace splinefeed {

/// A step of one axis by one count. Ticks are those of feed segments, 1/8 us, counted from the start of the first one.
struct Step {
    std::int64_t tick = 0;
    std::uint8_t axis = 0;
    bool up = false; ///< true: to the next larger count
};

/// Use: while (engine.next(step)) {...}; then take the next segment, or call finish(), which may give the last steps.
/// Steps come in order of time. now(): no later call of next() delivers an earlier step.
template <class E>
concept StepEngine = requires(E& engine, const E& constant, const FeedSegment& segment, Step& step) {
    { engine.take(segment) }
    noexcept->std::same_as<void>;
    { engine.next(step) }
    noexcept->std::same_as<bool>;
    { engine.finish() }
    noexcept->std::same_as<void>;
    { constant.now() }
    noexcept->std::same_as<std::int64_t>;
};

/// The count of an axis at a position: the nearest one [units], ties upwards.
[[nodiscard]] constexpr std::int64_t nearest_step(std::int64_t units) noexcept {
    constexpr std::int64_t half = units_per_count / 2;
    const std::int64_t count = units / units_per_count;
    const std::int64_t rest = units % units_per_count;
    return count + (rest >= half ? 1 : 0) - (rest < -half ? 1 : 0);
}

} // namespace splinefeed
