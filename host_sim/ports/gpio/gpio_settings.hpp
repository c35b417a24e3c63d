// SPDX-License-Identifier: MIT
// gpio_settings: what a machine and its map ask of step lines: rates, the settings of their port, the times of its
// stops.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/ports/run_target.hpp"

#include "splinefeed/hal/gpio/gpio_port_settings.hpp"
#include "splinefeed/hal/gpio/pin_map.hpp"

namespace splinefeed::host {

/// Number of lines that may be set per second if a call takes this long: half of the time may be spent in calls.
[[nodiscard]] double most_edges_per_s(double call_ns) noexcept;
/// Number of edges per second that the machine's limits may require.
[[nodiscard]] double asked_edges_per_s(const MachineDescription& machine) noexcept;
/// Settings from the thread section of the map.
[[nodiscard]] hal::gpio::StepPortSettings port_settings(const MachineDescription& machine, const hal::gpio::PinMap& map,
                                                        hal::Clock* clock = nullptr);
/// A hold begins behind what was handed over, and takes the braking time of the path: each axis's from its full speed,
/// twice, for feeds that brake along a bend. A plan that does not bring that in time is stopped by the port.
[[nodiscard]] hal::StopTimes stop_times(const MachineDescription& machine);
/// All that a port of this machine has to know.
[[nodiscard]] hal::gpio::GpioPortSettings gpio_port_settings(const MachineDescription& machine,
                                                             const hal::gpio::PinMap& map, const RunOptions& options,
                                                             hal::Clock* clock);

} // namespace splinefeed::host
