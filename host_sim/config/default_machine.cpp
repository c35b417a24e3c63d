// SPDX-License-Identifier: MIT
// What a machine has that its file does not state, or that has no file.
#include "host_sim/config/machine_file.hpp"

#include <cmath>

namespace splinefeed::host {

namespace {

constexpr std::string_view default_text = R"(name = "default machine"
[path]
max_feed_mm_s = 100
[[axis]]
name = "x"
max_velocity_mm_s = 100
max_acceleration_mm_s2 = 1000
steps_per_mm = 320
[[axis]]
name = "y"
max_velocity_mm_s = 100
max_acceleration_mm_s2 = 1000
steps_per_mm = 320
[[axis]]
name = "z"
max_velocity_mm_s = 100
max_acceleration_mm_s2 = 1000
steps_per_mm = 320
)";

} // namespace

double standstill_window_counts(const MachineDescription& machine, unsigned axis) noexcept {
    constexpr double default_mm = 0.01;
    constexpr double default_counts = 2.0;
    const double steps_per_mm = machine.settings.axis[axis].steps_per_mm;
    const std::optional<double>& window_mm = machine.standstill_window_mm[axis];
    return window_mm ? std::fmax(*window_mm * steps_per_mm, 1.0) : std::fmax(default_mm * steps_per_mm, default_counts);
}

MachineDescription default_machine(const std::vector<std::string>& settings) {
    MachineDescription machine = parse_machine(default_text, {}, settings);
    machine.axis_line = {};
    return machine;
}

} // namespace splinefeed::host
