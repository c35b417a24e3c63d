// SPDX-License-Identifier: MIT
#include "host_sim/serve/serve_settings.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/config/decimal_number.hpp"

#include "splinefeed/s0_program/text/text_cursor.hpp"

namespace splinefeed::host {

namespace {

#ifndef SPLINEFEED_VERSION
#define SPLINEFEED_VERSION "0.0"
#endif

// What senders divide by dots has two numbers.
constexpr std::string_view two_numbers(std::string_view version) {
    const std::size_t second = version.find('.', version.find('.') + 1);
    return version.substr(0, second);
}

} // namespace

ControllerSettings serve_settings(const RunMachine& machine_of_run, const SwitchFacts& switches) {
    const MachineDescription& machine = machine_of_run.machine;
    ControllerSettings out;
    out.machine = machine.settings;
    out.program.axes = machine.settings.axes;
    out.program.dialect = Dialect::grbl;
    out.program.default_tolerance_mm = decimal_of(machine.tolerances.programmed_mm);
    out.program.chain_quarters = machine.tolerances.rules.chain_quarters;
    out.program.rapid_tolerance_mm = decimal_of(machine.tolerances.rapid_mm);
    out.max_feed_mm_s = decimal_of(machine_of_run.max_feed_mm_s);
    out.rotary_tolerance_deg = decimal_of(machine.tolerances.rotary_deg);
    for (const unsigned k : indices(machine.settings.axes)) {
        const char letter = upper_case(machine.axis_name[k].front());
        if (std::string_view("XYZABC").find(letter) == std::string_view::npos) {
            throw UsageError("axis {}: senders know the axes x, y, z, a, b and c; name it like one of them",
                             machine.axis_name[k]);
        }
        out.program.letters[k] = letter;
        out.program.rotary_axes |= machine.settings.axis[k].rotary ? 1U << k : 0U;
        if (const std::optional<Travel>& travel = machine.travel[k]) {
            out.travel[k] = {true, decimal_of(travel->low), decimal_of(travel->high)};
        }
        out.wiring[k] = {machine.motors[k].invert_step, machine.inverted[k], (switches.homes_low >> k & 1U) != 0};
    }
    out.version = two_numbers(SPLINEFEED_VERSION);
    out.name = machine.name;
    constexpr double s_per_min = 60.0;
    constexpr std::uint32_t us_per_ms = 1000;
    out.homes = switches.homes;
    out.no_home = switches.no_home.empty() ? out.no_home : switches.no_home;
    out.probes = switches.probe;
    out.has_limits = switches.limits != 0;
    out.debounce_ms = static_cast<std::int32_t>(switches.debounce_us / us_per_ms);
    out.pull_off_mm = decimal_of(switches.pull_off_mm);
    out.home_seek_mm_min = decimal_of(switches.seek_mm_s * s_per_min);
    out.home_latch_mm_min = decimal_of(switches.latch_mm_s * s_per_min);
    if (machine.spindle) {
        out.max_rpm = decimal_of(machine.spindle->max_rpm);
        out.min_rpm = decimal_of(machine.spindle->min_rpm);
        out.program.most_speed = out.max_rpm;
    }
    out.idle_ms = machine.drives_on_at_end.value_or(true) ? ControllerSettings::drives_stay_on : 25;
    return out;
}

} // namespace splinefeed::host
