// SPDX-License-Identifier: MIT
// What the controller is told of the machine of machine.hpp. Senders read it ($$, $I); nothing changes it from there.
#pragma once

#include "machine.hpp"

#include "splinefeed/controller/controller_settings.hpp"
#include "splinefeed/s3_feed_plan/limits/machine_path_rules.hpp"

namespace firmware {

inline constexpr splinefeed::ControllerSettings operator_settings = [] {
    using splinefeed::Decimal;
    splinefeed::ControllerSettings settings;
    settings.machine = machine;
    settings.program.axes = static_cast<int>(axes);
    settings.max_feed_mm_s = Decimal::from_integer(static_cast<int>(machine.max_feed_mm_s));
    for (unsigned k = 0; k < axes; ++k) {
        settings.travel[k] = {true, Decimal::from_integer(travel_mm[k][0]), Decimal::from_integer(travel_mm[k][1])};
    }
    settings.name = board::name;
    settings.probes = false;
    settings.has_limits = true;
    settings.has_speed = false;
    settings.step_us = static_cast<int>(board::tick_us);
    settings.lines_a_call = 1;
    settings.work_a_call = work_a_call;
    return settings;
}();

inline constexpr auto path_rules = splinefeed::rules_cast<Real>(splinefeed::path_rules(operator_settings.machine));

} // namespace firmware
