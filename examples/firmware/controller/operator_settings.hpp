// SPDX-License-Identifier: MIT
// What the controller is told of the machine of machine.hpp. Senders read it ($$, $I); nothing changes it from there.
#pragma once

#include "machine.hpp"

#include "splinefeed/controller/controller_settings.hpp"
#include "splinefeed/s3_feed_plan/limits/machine_path_rules.hpp"

namespace firmware {

/// Rapids are as fast as the axes, not as the largest feed: `splinefeed run` has the same law.
inline constexpr splinefeed::MachineSettings operated_machine = [] {
    splinefeed::MachineSettings out = machine;
    double square = 0.0;
    for (unsigned k = 0; k < axes; ++k) {
        square += out.axis[k].max_velocity_mm_s * out.axis[k].max_velocity_mm_s;
    }
    const double fastest = splinefeed::detail::root_up_to(10000.0, square);
    out.max_feed_mm_s = fastest > machine.max_feed_mm_s ? fastest : machine.max_feed_mm_s;
    return out;
}();
inline constexpr auto operated_limits = splinefeed::MotionLimits<Real>::make(operated_machine);
static_assert(splinefeed::no_error<operated_limits.error()>());

inline constexpr splinefeed::ControllerSettings operator_settings = [] {
    using splinefeed::Decimal;
    splinefeed::ControllerSettings settings;
    settings.machine = operated_machine;
    settings.program.axes = static_cast<int>(axes);
    settings.max_feed_mm_s = Decimal::from_integer(static_cast<int>(machine.max_feed_mm_s));
    for (unsigned k = 0; k < axes; ++k) {
        settings.travel[k] = {true, Decimal::from_integer(travel_mm[k][0]), Decimal::from_integer(travel_mm[k][1])};
    }
    settings.name = board::name;
    settings.probes = false;
    settings.has_limits = true;
    settings.has_speed = false;
    settings.step_us = static_cast<int>(board::pulse_us);
    settings.lines_a_call = 1;
    settings.work_a_call = work_a_call;
    return settings;
}();

inline constexpr auto path_rules = splinefeed::rules_cast<Real>(splinefeed::path_rules(operator_settings.machine));

} // namespace firmware
