// SPDX-License-Identifier: MIT
// A machine of two axes with switches on one simulated chip: what tests of GPIO targets share.
#pragma once

#include "host_sim/config/gpio_map.hpp"
#include "host_sim/config/machine_file.hpp"
#include "simulated_pins.hpp"

namespace splinefeed_test {

inline constexpr double steps_per_mm = 80.0;

inline splinefeed::host::MachineDescription two_axes() {
    splinefeed::host::MachineDescription machine = splinefeed::host::default_machine();
    machine.settings.axes = 2;
    machine.settings.max_feed_mm_s = 100.0;
    for (unsigned k = 0; k < 2; ++k) {
        machine.settings.axis[k].max_velocity_mm_s = 100.0;
        machine.settings.axis[k].max_acceleration_mm_s2 = 1000.0;
        machine.settings.axis[k].steps_per_mm = steps_per_mm;
    }
    return machine;
}

enum Input : std::size_t { e_stop, limit, home, drive_fault };

inline const std::string map_text = R"([axis.x]
step = 0
direction = 1
[axis.y]
step = 2
direction = 3
[enable]
line = 4
settle_ms = 5
[[input]]
role = "e-stop"
line = 10
[[input]]
role = "limit"
axis = "x"
line = 11
[[input]]
role = "home"
axis = "x"
line = 12
[[input]]
role = "drive-fault"
line = 13
[home.x]
towards = "low"
seek_mm_s = 20
latch_mm_s = 2
pull_off_mm = 2
position_mm = 0
)";

} // namespace splinefeed_test
