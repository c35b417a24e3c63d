// SPDX-License-Identifier: MIT
// The machine that the firmware moves: change this file for yours. machine.toml says the same to the tool on a PC.
#pragma once

#include "board.hpp"

#include "splinefeed/s3_feed_plan/acceleration/feed_plan.hpp"
#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

namespace firmware {

using board::Real;

inline constexpr unsigned axes = 3;

inline constexpr splinefeed::MachineSettings machine = [] {
    splinefeed::MachineSettings settings;
    settings.axes = static_cast<int>(axes);
    const double steps_per_mm[] = {80.0, 80.0, 400.0};
    const double acceleration[] = {1000.0, 1000.0, 200.0};
    // The path is smoothed by T^2 A / 6: with longer segments the machine is softer, and as exact.
    const double softer = 1000.0 / board::segment_us * 1000.0 / board::segment_us;
    for (unsigned k = 0; k < axes; ++k) {
        settings.axis[k].steps_per_mm = steps_per_mm[k];
        settings.axis[k].max_velocity_mm_s = board::steps_per_s / steps_per_mm[k];
        settings.axis[k].max_acceleration_mm_s2 = acceleration[k] * softer;
    }
    settings.max_feed_mm_s = 100.0;
    settings.sample_period_us = static_cast<int>(board::segment_us);
    return settings;
}();

/// What the controller keeps to: from where the machine is switched on [mm].
inline constexpr int travel_mm[axes][2] = {{0, 300}, {0, 200}, {-80, 0}};

// At compile time: the chip does no arithmetic in double.
inline constexpr auto limits = splinefeed::MotionLimits<Real>::make(machine);
static_assert(splinefeed::no_error<limits.error()>());

inline constexpr std::uint32_t tick_ticks = board::tick_us * splinefeed::ticks_per_us;
static_assert(limits->segment_ticks == board::segment_us * splinefeed::ticks_per_us, "one segment a sample");
static_assert(limits->segment_ticks % tick_ticks == 0 && limits->segment_ticks / tick_ticks <= 1024,
              "a segment is one part: a whole number of ticks");
static_assert(board::steps_per_s * std::uint64_t{board::tick_us} * board::Lines::counts_in_ticks[1] <
                  1'000'000 * board::Lines::counts_in_ticks[0],
              "an axis is too fast for the ticks");

using Steps = StepGenerator<axes, board::Lines>;

/// A motion begins when the ring is three quarters full, or holds 96 parts: a planner that waits for more lines may not
/// give more. Half of the ring, at most 64 parts, is kept to slow down over.
inline constexpr Lookahead lookahead = [] {
    Lookahead ahead;
    while (ahead.reserve_log2 < 6 && (2U << ahead.reserve_log2) <= board::parts / 2) {
        ++ahead.reserve_log2;
    }
    constexpr unsigned most = 96;
    constexpr unsigned three_quarters = static_cast<unsigned>(board::parts) * 3 / 4;
    ahead.start = three_quarters < most ? three_quarters : most;
    ahead.leaving_steps = 800; // 10 mm of x and y, 2 mm of z
    ahead.slew = (Steps::full_rate / 2 * tick_ticks / limits->segment_ticks) >> ahead.reserve_log2;
    return ahead;
}();
static_assert(lookahead.slew > 0);

/// Steps of planning in a round of the main loop, between which the loop looks at the serial line.
inline constexpr unsigned work_a_call = 4;
static_assert(board::window >= splinefeed::FeedPlan<Real>::smallest_window);

} // namespace firmware
