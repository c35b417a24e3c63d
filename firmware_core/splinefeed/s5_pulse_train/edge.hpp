// SPDX-License-Identifier: MIT
// Edge: a change of level on the step or direction line of an axis, at an instant. LineMasks: the lines of an axis's
// motors.
#pragma once

#include <cstdint>

namespace splinefeed {

enum class Line : std::uint8_t { step, direction };

/// `level` is logical: it does not depend on the polarity of the line. Ticks are those of Step. If the first step needs
/// a change of direction at once, that edge has a negative tick: set the line before the motion starts.
struct Edge {
    std::int64_t tick = 0;
    std::uint8_t axis = 0;
    Line line = Line::step;
    bool level = false; ///< direction line: true is up; step line: the pulse is on (step_on_edge: the new level)
};

/// The lines of one or two motors of an axis, as bits of a port, for the set and clear registers of a microcontroller.
struct LineMasks {
    std::uint32_t step = 0;
    std::uint32_t direction = 0;
    std::uint32_t inverted = 0; ///< those of both masks that are low if the level is true
};

/// Bits to set and bits to clear, at the same time.
struct LineChange {
    std::uint32_t set = 0;
    std::uint32_t clear = 0;
};

[[nodiscard]] constexpr LineChange change_of(const LineMasks& masks, Line line, bool level) noexcept {
    const std::uint32_t lines = line == Line::step ? masks.step : masks.direction;
    const std::uint32_t high = level ? lines & ~masks.inverted : lines & masks.inverted;
    return {high, lines & ~high};
}

} // namespace splinefeed
