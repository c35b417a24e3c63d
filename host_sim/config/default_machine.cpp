// SPDX-License-Identifier: MIT
// What a machine has that its file does not state, or that has no file.
#include "host_sim/config/machine_file.hpp"

#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

double standstill_window_counts(const MachineDescription& machine, unsigned axis) noexcept {
    constexpr double default_mm = 0.01;
    constexpr double default_counts = 2.0;
    const double steps_per_mm = machine.settings.axis[axis].steps_per_mm;
    const std::optional<double>& window_mm = machine.standstill_window_mm[axis];
    return window_mm ? std::fmax(*window_mm * steps_per_mm, 1.0) : std::fmax(default_mm * steps_per_mm, default_counts);
}

MachineDescription default_machine(const std::vector<std::string>& settings) {
    std::string text = "name = 'default machine'\n[path]\nmax_feed_mm_s = 100\n";
    for (const char axis : {'x', 'y', 'z'}) {
        text += fmt::format("[[axis]]\nname = '{}'\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\n"
                            "steps_per_mm = 320\n",
                            axis);
    }
    MachineDescription machine = parse_machine(text, {}, settings);
    machine.axis_line = {};
    return machine;
}

} // namespace splinefeed::host
