// SPDX-License-Identifier: MIT
// ControllerSettings: what a controller is told of its machine.
#pragma once

#include "splinefeed/base/work_budget.hpp"
#include "splinefeed/s0_program/dialects/program_settings.hpp"
#include "splinefeed/s3_feed_plan/limits/machine_settings.hpp"

namespace splinefeed {

/// The range of an axis [mm].
struct AxisTravel {
    bool limited = false;
    Decimal low{};
    Decimal high{};

    /// Of travel_allowance_mm.
    static constexpr Decimal allowance{Decimal::one / travel_allowances_a_mm};
    [[nodiscard]] constexpr bool holds(Decimal at) const noexcept {
        return !limited || (at <= high + allowance && at >= low - allowance);
    }
};

/// Of an axis, for `$` lines.
struct AxisWiring {
    bool invert_step = false;
    bool invert_direction = false;
    bool homes_low = false;
};

struct ControllerSettings {
    static constexpr std::int32_t drives_stay_on = 255; ///< of idle_ms

    MachineSettings machine{};
    /// Dialect::grbl, with the letters of the axes.
    ProgramSettings program{.dialect = Dialect::grbl, .numbered = true};
    Decimal max_feed_mm_s{};                                   ///< of moves that are no rapids; 0: the machine's
    Decimal rotary_tolerance_deg = Decimal::from_integer(100); ///< of moves that turn a rotary axis, if less
    PerAxis<AxisTravel> travel{};
    PerAxis<AxisWiring> wiring{};
    std::string_view version = "0.1"; ///< of splinefeed: two numbers
    std::string_view date = "20260101";
    std::string_view name;   ///< of the machine
    std::string_view source; ///< where its numbers stand, for messages
    std::uint32_t homes = 0; ///< axes that find a reference by $H, by bits; of the others what would be right:
    std::string_view no_home = "the machine has no switch for it";
    bool home_is_zero = false;       ///< the travel of an axis that homes low begins at 0
    std::uint32_t home_switches = 0; ///< axes that have one: what $22=1 makes of `homes`
    bool probes = true;              ///< it has a probe
    bool has_limits = false;         ///< limit switches
    bool invert_enable = false;      ///< the contrary of what the board has; the next two, too
    bool invert_limits = false;
    bool invert_probe = false;
    std::int32_t idle_ms = drives_stay_on; ///< the drives go off so long behind a motion
    bool holds_on_error = true;            ///< a refused line holds the motion
    Decimal max_rpm = Decimal::from_integer(1000);
    Decimal min_rpm{};
    bool has_speed = true; ///< the spindle has one
    std::int32_t step_us = 10;
    std::int32_t debounce_ms = 0;
    Decimal pull_off_mm{};
    Decimal home_latch_mm_min{};
    Decimal home_seek_mm_min{};
    std::uint32_t jog_timeout_ms = 1000; ///< a jog ends so long after the last byte of its sender; 0: never
    /// Spindle and coolant go off so long after the sender has gone, and the machine is held; 0: never.
    std::uint32_t unattended_ms = 60'000;
    std::int32_t receive_bytes = 1024; ///< what senders may count on
    /// Bounds of a call of the controller, for a main loop that has other work: lines that are begun, and steps of
    /// planning as Trajectory::next() counts them.
    unsigned lines_a_call = WorkBudget::unlimited;
    unsigned work_a_call = WorkBudget::unlimited;
};

} // namespace splinefeed
