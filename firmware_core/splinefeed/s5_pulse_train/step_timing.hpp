// SPDX-License-Identifier: MIT
// StepTiming: the timing that drives need on their step and direction lines, checked once.
#pragma once

#include "splinefeed/base/status.hpp"
#include "splinefeed/base/units.hpp"

#include <cstdint>

namespace splinefeed {

/// The largest rate and acceleration of one axis, for StepTiming::allows.
struct StepDemand {
    double steps_per_s = 0.0;
    double steps_per_s2 = 0.0; ///< acceleration or braking, whichever is larger
};

/// The settings as a machine file states them [us].
struct StepSettings {
    double tick_us = 0.0;            ///< tick of FixedRate or InterpolatedSteps; 0: the engine is StepIntervals
    bool interpolated = false;       ///< the engine is InterpolatedSteps
    double step_length_us = 2.0;     ///< least duration of a pulse
    double step_space_us = 2.0;      ///< least time between two pulses
    double direction_setup_us = 5.0; ///< least time from a change of direction to the step that needs it
    double direction_hold_us =
        5.0; ///< least time from the end of a pulse (step_on_edge: from its edge) to a change of direction
    bool step_on_edge =
        false; ///< each edge of the line is a step; each level lasts for the longer of step_length_us and step_space_us
};

/// A time of StepSettings, as machine files name it.
struct StepTime {
    const char* key;
    double StepSettings::*value;
    double least_us; ///< and at most longest_step_time_us
};
inline constexpr double longest_step_time_us = 1000.0;
inline constexpr StepTime step_times[] = {
    {"step_length_us", &StepSettings::step_length_us, 0.125},
    {"step_space_us", &StepSettings::step_space_us, 0.125},
    {"direction_setup_us", &StepSettings::direction_setup_us, 0.0},
    {"direction_hold_us", &StepSettings::direction_hold_us, 0.0},
};

/// In ticks of 1/8 us, rounded up. With the fixed-rate engine rounded up to multiples of its tick, because all edges
/// are at ticks.
struct StepTiming {
    std::uint32_t grid = 1; ///< all instants are multiples of it
    std::uint32_t tick = 0; ///< of InterpolatedSteps; 0: another engine
    std::uint32_t high = 0;
    std::uint32_t low = 0;
    std::uint32_t setup = 0;
    std::uint32_t hold = 0;
    bool step_on_edge = false;

    /// Checks the ranges: times are 0.125 to 1000 us (set-up and hold may be 0), tick_us is 0.25 to 1000 and a multiple
    /// of 0.25.
    [[nodiscard]] static constexpr Result<StepTiming> make(const StepSettings& settings) noexcept;

    /// Least time between two steps in one direction.
    [[nodiscard]] constexpr std::uint32_t step_gap() const noexcept {
        if (!step_on_edge) {
            return high + low;
        }
        const std::uint32_t level = high > low ? high : low;
        return grid > 1 && level < 2 * grid ? 2 * grid : level; // the DDA makes at most half a count per tick
    }
    /// Least time between a step and a step back.
    [[nodiscard]] constexpr std::uint32_t turn_gap() const noexcept {
        const std::uint32_t turn = (step_on_edge ? 0U : high) + hold + setup;
        return turn > step_gap() ? turn : step_gap();
    }
    /// The highest step rate that keeps step_gap() [1/s]. An instant may be wrong by a tick of 1/8 us; on a grid it is
    /// the nearest instant of the grid.
    [[nodiscard]] constexpr double most_steps_per_s() const noexcept {
        const double gap = step_gap() + (grid > 1 ? 1.0 : 2.0);
        return 8e6 / (gap > tick / 7.0 ? gap : tick / 7.0); // InterpolatedSteps: 7 counts in a tick
    }
    /// How far an axis may be beyond half a step when the two steps of a reversal, closer than turn_gap(), are left
    /// out. It is the distance out and back in that time [steps].
    [[nodiscard]] constexpr double most_left_out(double steps_per_s2) const noexcept {
        const double seconds = (turn_gap() + 2.0 * (grid > tick ? grid : tick)) / 8e6;
        return steps_per_s2 * seconds * seconds / 8.0;
    }

    /// Whether a plan can be stepped without moving any step. The rate must be kept, a reversal may leave out at most
    /// 1/64 of a step, and the direction times may last at most 24 steps (the capacity of StepDirSequencer).
    [[nodiscard]] constexpr Status allows(const StepDemand& demand) const noexcept {
        if (!(demand.steps_per_s <= most_steps_per_s())) {
            return Error::step_rate_too_high;
        }
        if (!(most_left_out(demand.steps_per_s2) <= 1.0 / 64.0) || turn_gap() > 24 * step_gap()) {
            return Error::direction_change_too_long;
        }
        return {};
    }
};

constexpr Result<StepTiming> StepTiming::make(const StepSettings& settings) noexcept {
    constexpr auto in_range = [](double us, double least_us) {
        return us >= least_us && us <= longest_step_time_us; // not NaN
    };
    for (const StepTime& time : step_times) {
        if (!in_range(settings.*time.value, time.least_us)) {
            return Error::step_times_out_of_range;
        }
    }
    StepTiming timing;
    if (settings.tick_us != 0.0) {
        if (!in_range(settings.tick_us, 0.25)) {
            return Error::step_tick_out_of_range;
        }
        const auto quarters = static_cast<std::uint32_t>(settings.tick_us * 4.0);
        if (quarters != settings.tick_us * 4.0) {
            return Error::step_tick_out_of_range;
        }
        timing.grid = 2 * quarters;
    }
    if (settings.interpolated) {
        if (timing.grid == 1) {
            return Error::step_tick_out_of_range;
        }
        timing.tick = timing.grid;
        timing.grid = 1;
    }
    const auto rounded_up = [&timing](double us) {
        const double grids = us * ticks_per_us / timing.grid;
        const auto whole = static_cast<std::uint32_t>(grids);
        return (whole + (whole < grids ? 1U : 0U)) * timing.grid;
    };
    timing.high = rounded_up(settings.step_length_us);
    timing.low = rounded_up(settings.step_space_us);
    timing.setup = rounded_up(settings.direction_setup_us);
    timing.hold = rounded_up(settings.direction_hold_us);
    timing.step_on_edge = settings.step_on_edge;
    return timing;
}

} // namespace splinefeed
