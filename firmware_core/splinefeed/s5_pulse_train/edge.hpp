// SPDX-License-Identifier: MIT
// Edge: an axis's step or direction line takes a level, at an instant; LineMasks: the lines of an axis's motors.
#pragma once

#include <cstdint>

namespace splinefeed {

enum class Line : std::uint8_t { step, direction };

/// What a line means, whatever its polarity. Ticks as in Step; a direction that the first step needs at once comes
/// before 0: it is set before the motion starts.
struct Edge {
    std::int64_t tick = 0;
    std::uint8_t axis = 0;
    Line line = Line::step;
    bool level =
        false; ///< of the direction: up; of a step: the pulse is on (step_on_edge: the level that it changes to)
};

/// The lines of one or two motors that follow an axis, as bits of a port: for a microcontroller's set and clear
/// registers.
struct LineMasks {
    std::uint32_t step = 0;
    std::uint32_t direction = 0;
    std::uint32_t inverted = 0; ///< those of both that are low where the level is true
};

/// Bits to set and to clear, at once.
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
