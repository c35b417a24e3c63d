// SPDX-License-Identifier: MIT
#include "host_sim/ports/gpio/gpio_settings.hpp"

#include "splinefeed/base/units.hpp"
#include "splinefeed/number/vector.hpp"

#include "host_sim/config/step_lines.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

namespace {

constexpr double share_of_time = 0.5;    // that calls may take
constexpr double most_reserve_ms = 50.0; // of a slow-down that takes twice as long: a hold waits for what is buffered

/// Half of the longest time in which an axis brakes from the speed that it may have.
std::uint32_t reserve_ms(const MachineDescription& machine) {
    double braking_s = 0.0;
    for (const unsigned k : indices(machine.settings.axes)) {
        const AxisSettings& axis = machine.settings.axis[k];
        const double most =
            axis.rotary ? axis.max_velocity_mm_s : std::min(axis.max_velocity_mm_s, machine.settings.max_feed_mm_s);
        braking_s = std::max(braking_s, most / axis.max_acceleration_mm_s2);
    }
    return static_cast<std::uint32_t>(
        std::ceil(std::clamp(braking_s * 500.0, double{hal::gpio::StepPort::least_reserve_ms}, most_reserve_ms)));
}

} // namespace

double most_edges_per_s(double call_ns) noexcept {
    return share_of_time * ns_per_s / call_ns;
}

// Along a path at a feed f the axes make at most |steps_per_mm| f steps a second in all (Cauchy-Schwarz).
double asked_edges_per_s(const MachineDescription& machine) noexcept {
    double of_axes = 0.0;
    double squares = 0.0;
    double rotary = 0.0;
    for (const unsigned k : indices(machine.settings.axes)) {
        const AxisSettings& axis = machine.settings.axis[k];
        const double rate = axis.max_velocity_mm_s * axis.steps_per_mm;
        (axis.rotary ? rotary : of_axes) += rate;
        squares += axis.rotary ? 0.0 : axis.steps_per_mm * axis.steps_per_mm;
    }
    const double steps = rotary + std::min(of_axes, std::sqrt(squares) * machine.settings.max_feed_mm_s);
    return steps * (machine.step.step_on_edge ? 1.0 : 2.0);
}

hal::gpio::StepPortSettings port_settings(const MachineDescription& machine, const hal::gpio::PinMap& map,
                                          hal::Clock* clock) {
    const bool real = clock == nullptr;
    const auto& axis = machine.settings.axis;
    const PerAxis<double> acceleration =
        each(machine.settings.axes, [&](unsigned k) { return axis[k].max_acceleration_mm_s2 * axis[k].steps_per_mm; });
    return {.axes = machine.settings.axes,
            .timing = checked_step_timing(machine),
            .real_time = {.priority = real ? map.thread.priority : 0,
                          .cpu = map.thread.cpu,
                          .spin_ns = real ? static_cast<std::uint32_t>(map.thread.spin_us * ns_per_us) : 0},
            .tolerated_ns = std::uint64_t{map.thread.tolerated_late_us} * ns_per_us,
            .settle_ms = map.enable ? map.enable->settle_ms : 0,
            .brake_release_ms = map.brake ? map.brake->release_ms : 0,
            .brake_engage_ms = map.brake ? map.brake->engage_ms : 0,
            .acceleration = acceleration,
            .reserve_ms = reserve_ms(machine),
            .stall_ns = std::uint64_t{map.thread.stall_ms} * 1000 * ns_per_us,
            .clock = clock};
}

hal::StopTimes stop_times(const MachineDescription& machine) {
    constexpr double handed_over_s = 1.0;
    double braking_s = 0.0;
    for (const unsigned k : indices(machine.settings.axes)) {
        const AxisSettings& axis = machine.settings.axis[k];
        const double jerk_s = axis.max_jerk_mm_s3 > 0.0 ? axis.max_acceleration_mm_s2 / axis.max_jerk_mm_s3 : 0.0;
        braking_s = std::max(braking_s, axis.max_velocity_mm_s / axis.max_acceleration_mm_s2 + jerk_s);
    }
    return {.hold_us = static_cast<std::uint64_t>((handed_over_s + 2.0 * braking_s) * us_per_s),
            .quick_stop_us = 400'000, // the port's slow-down, four times
            .disable_us = 200'000,
            .settle_us = 2000};
}

hal::gpio::GpioPortSettings gpio_port_settings(const MachineDescription& machine, const hal::gpio::PinMap& map,
                                               const RunOptions& options, hal::Clock* clock) {
    constexpr double search_mm = 2000.0; // of an axis without travel limits
    constexpr double beyond = 1.2;       // of its travel
    const PerAxis<double> search = each(machine.settings.axes, [&](unsigned k) {
        const auto& travel = machine.travel[k];
        return travel ? beyond * (travel->high - travel->low) : search_mm;
    });
    return {.machine = machine.settings,
            .axis_name = machine.axis_name,
            .search_mm = search,
            .step = port_settings(machine, map, clock),
            .stop = stop_times(machine),
            .drives_on_at_end = machine.drives_on_at_end.value_or(false),
            .ends_at_probe = options.probe,
            .interrupted = options.interrupted};
}

} // namespace splinefeed::host
