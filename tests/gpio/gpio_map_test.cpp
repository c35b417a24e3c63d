// SPDX-License-Identifier: MIT
#include "host_sim/config/gpio_map.hpp"

#include "host_sim/config/machine_file.hpp"
#include "support/catch.hpp"
#include "support/places.hpp"

using namespace splinefeed::host;
using namespace splinefeed::hal::gpio;

namespace {

const std::string chip = "/dev/gpiochip0";

// Axis x has two motors, the second one the other way round; pulses of y are low.
MachineDescription two_axes() {
    MachineDescription machine = default_machine();
    machine.settings.axes = 2;
    machine.motors[0] = {.count = 2, .invert_step = false, .invert_direction = {false, true}};
    machine.motors[1] = {.count = 1, .invert_step = true, .invert_direction = {true, true}};
    return machine;
}

const std::string good = R"([axis.y]
step = 6
direction = { chip = "/dev/gpiochip1", offset = 3 }
[axis.X]
step = "X_STEP"
direction = { offset = 5, name = "X_DIR" }
step2 = "X2_STEP"
direction2 = 9
)";

} // namespace

TEST_CASE("GPIO map: lines by chip, bits in the order of the machine's axes, safe levels with their polarity") {
    const PinMap map = parse_gpio_map(good, "m.toml", two_axes(), chip);
    CHECK(map.consumer == "splinefeed");
    REQUIRE(map.chips.size() == 2);
    CHECK(map.chips[0].chip == chip);
    CHECK(map.chips[1].chip == "/dev/gpiochip1");
    const std::vector<OutputRequest>& outputs = map.chips[0].outputs;
    REQUIRE(outputs.size() == 5);
    CHECK((outputs[0].line == PinName{"X_STEP", {}}));
    CHECK((outputs[1].line == PinName{"X_DIR", 5}));
    CHECK((outputs[2].line == PinName{"X2_STEP", {}}));
    CHECK((outputs[3].line == PinName{"", 9}));
    CHECK((outputs[4].line == PinName{"", 6}));
    CHECK_FALSE(outputs[0].safe_level);
    CHECK_FALSE(outputs[1].safe_level);
    CHECK_FALSE(outputs[2].safe_level);
    CHECK(outputs[3].safe_level); // direction2 is inverted
    CHECK(outputs[4].safe_level); // and so is y's step
    REQUIRE(map.chips[1].outputs.size() == 1);
    CHECK(map.chips[1].outputs[0].safe_level);
    CHECK(map.axis[0].motors == 2);
    CHECK((map.axis[0].motor[0].step == PinBit{0, 0}));
    CHECK((map.axis[0].motor[0].direction == PinBit{0, 1}));
    CHECK((map.axis[0].motor[1].step == PinBit{0, 2}));
    CHECK((map.axis[0].motor[1].direction == PinBit{0, 3}));
    CHECK(map.axis[1].motors == 1);
    CHECK((map.axis[1].motor[0].step == PinBit{0, 4}));
    CHECK((map.axis[1].motor[0].direction == PinBit{1, 0}));
    CHECK(map.axis[1].motor[0].step.mask() == 16);
    CHECK_FALSE(map.enable.has_value());
    CHECK_FALSE(map.brake.has_value());
    CHECK(map.inputs.empty());
    CHECK(map.thread.priority == 80);
    CHECK_FALSE(map.thread.cpu.has_value());
    CHECK(map.thread.spin_us == 30);
    CHECK(map.thread.tolerated_late_us == 100);
}

TEST_CASE("GPIO map: enable, inputs, homing and the thread") {
    const PinMap map = parse_gpio_map("consumer = \"mill\"\n" + good + R"([enable]
line = 20
settle_ms = 250
active = "low"
[brake]
line = 21
released = "low"
release_ms = 0
engage_ms = 5000
[[input]]
role = "e-stop"
line = 12
[[input]]
role = "limit"
axis = "y"
line = { chip = "/dev/gpiochip2", name = "Y_END" }
active = "low"
bias = "pull-down"
debounce_us = 0
[[input]]
role = "limit"
axis = "y"
line = 13
[[input]]
role = "home"
axis = "Y"
line = 14
bias = "pull-up"
debounce_us = 100000
[home.Y]
towards = "high"
seek_mm_s = 100
latch_mm_s = 0.5
pull_off_mm = 3
position_mm = -2.5
[thread]
priority = 98
cpu = 3
spin_us = 0
tolerated_late_us = 10000
)",
                                      "m.toml", two_axes(), chip);
    CHECK(map.consumer == "mill");
    REQUIRE(map.enable.has_value());
    CHECK_FALSE(map.enable->active_level);
    CHECK(map.enable->settle_ms == 250);
    CHECK((map.enable->line == PinBit{0, 5}));
    CHECK(map.chips[0].outputs[5].safe_level);
    REQUIRE(map.brake.has_value());
    CHECK_FALSE(map.brake->released_level);
    CHECK(map.brake->release_ms == 0);
    CHECK(map.brake->engage_ms == 5000);
    CHECK((map.brake->line == PinBit{0, 6}));
    CHECK(map.chips[0].outputs[6].safe_level);
    REQUIRE(map.inputs.size() == 4);
    CHECK(map.inputs[0].role == InputRole::e_stop);
    CHECK(map.inputs[0].axis == -1);
    CHECK(map.inputs[0].debounce_us == 0);
    CHECK(map.inputs[0].active_level);
    CHECK((map.inputs[0].line == PinBit{0, 0}));
    CHECK(map.inputs[1].role == InputRole::limit);
    CHECK(map.inputs[1].axis == 1);
    CHECK_FALSE(map.inputs[1].active_level);
    CHECK(map.inputs[1].debounce_us == 0);
    CHECK((map.inputs[1].line == PinBit{2, 0}));
    CHECK(map.chips[2].inputs[0].bias == Bias::pull_down);
    CHECK(map.chips[2].outputs.empty());
    CHECK(map.inputs[2].debounce_us == 1000);
    CHECK(map.chips[0].inputs[1].bias == Bias::as_is);
    CHECK(map.inputs[3].role == InputRole::home);
    CHECK(map.inputs[3].debounce_us == 100000);
    CHECK(map.chips[0].inputs[2].bias == Bias::pull_up);
    CHECK_FALSE(map.home[0].has_value());
    REQUIRE(map.home[1].has_value());
    CHECK(map.home[1]->towards_high);
    CHECK(map.home[1]->seek_mm_s == 100.0);
    CHECK(map.home[1]->latch_mm_s == 0.5);
    CHECK(map.home[1]->pull_off_mm == 3.0);
    CHECK(map.home[1]->position_mm == -2.5);
    CHECK(map.thread.priority == 98);
    CHECK(map.thread.cpu == 3U);
    CHECK(map.thread.spin_us == 0);
    CHECK(map.thread.tolerated_late_us == 10000);
}

TEST_CASE("GPIO map: the example is one for the example's machine") {
    const std::string examples = splinefeed::test::source_folder() + "/examples/";
    const PinMap map =
        read_gpio_map(examples + "gpio_lines.toml", read_machine_file(examples + "three_axis.toml"), chip);
    CHECK(map.chips.size() == 2);
    CHECK(map.chips[0].outputs.size() == 6);
    CHECK(map.inputs.size() == 3);
    CHECK(map.home[0].has_value());
    REQUIRE(map.enable.has_value());
    CHECK_FALSE(map.enable->active_level);
}

TEST_CASE("GPIO map: a switch that is home and limit, and limits that share a line, are one line of the chip") {
    const PinMap map = parse_gpio_map(good + R"([[input]]
role = "home"
axis = "x"
line = { offset = 12, name = "ENDS" }
bias = "pull-up"
[[input]]
role = "limit"
axis = "x"
line = { offset = 12, name = "ENDS" }
bias = "pull-up"
[[input]]
role = "limit"
axis = "y"
line = { offset = 12, name = "ENDS" }
bias = "pull-up"
[[input]]
role = "limit"
axis = "y"
line = 13
)",
                                      "m.toml", two_axes(), chip);
    REQUIRE(map.inputs.size() == 4);
    CHECK(map.chips[0].inputs.size() == 2);
    CHECK(map.inputs[0].line == map.inputs[1].line);
    CHECK(map.inputs[0].line == map.inputs[2].line);
    CHECK_FALSE(map.inputs[0].line == map.inputs[3].line);
    CHECK(map.inputs[0].role == InputRole::home);
    CHECK(map.inputs[2].axis == 1);
}
