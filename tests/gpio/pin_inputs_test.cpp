// SPDX-License-Identifier: MIT
#include "host_sim/ports/gpio/pin_outputs.hpp"

#include "host_sim/config/machine_file.hpp"
#include "recorded_chips.hpp"
#include "support/catch.hpp"
#include "support/virtual_clock.hpp"

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

constexpr const char* machine_text = R"(
[path]
max_feed_mm_s = 80
[lines]
chip = "/dev/gpiochip0"
[[module]]
name = "io"
address = "modbus-tcp://127.0.0.1"
[[input]]
number = 4
line = "DOOR"
[[input]]
number = 0
line = { offset = 9 }
active = "low"
bias = "pull-up"
[[input]]
number = 7
module = "io"
input = 0
[[axis]]
name = 'x'
max_velocity_mm_s = 100
max_acceleration_mm_s2 = 1000
)";

} // namespace

TEST_CASE("Inputs are lines with a level each, read when they are watched", "[inputs]") {
    const MachineDescription machine = parse_machine(machine_text, "m.toml");
    REQUIRE(machine.lines.chips.size() == 1);
    CHECK(machine.lines.chips[0].inputs[1].bias == hal::gpio::Bias::pull_up);
    RecordedChips chips{machine.lines};
    VirtualClock clock;
    const OutputParts outputs = pin_outputs(machine, chips.all, clock);
    OutputPart& inputs = *outputs.back();
    const auto watch = [&](std::int32_t number) {
        inputs.act({.kind = EventKind::input_wait, .number = number, .text = {}});
    };
    CHECK_FALSE(inputs.take());
    for (const int other : {5, 7}) { // one of a module
        watch(other);
        CHECK_FALSE(inputs.take());
    }
    watch(4);
    CHECK(inputs.take()->active == false);
    chips.inputs[0]->now = 1;
    CHECK(inputs.take()->active);
    CHECK(inputs.take()->asked_us == clock.now_us());
    watch(0);
    CHECK(inputs.take()->active);
    chips.inputs[0]->now = 3;
    CHECK_FALSE(inputs.take()->active);
    watch(-1);
    CHECK_FALSE(inputs.take());
    CHECK(inputs.trouble().empty());
}

TEST_CASE("An input that cannot be read is trouble that names it", "[inputs]") {
    const MachineDescription machine = parse_machine(machine_text, "m.toml");
    RecordedChips chips{machine.lines};
    const OutputParts outputs = pin_outputs(machine, chips.all);
    OutputPart& inputs = *outputs.back();
    inputs.act({.kind = EventKind::input_wait, .number = 4, .text = {}});
    chips.inputs[0]->now.reset();
    CHECK_FALSE(inputs.take());
    CHECK(inputs.trouble().rfind("the line of input 4 cannot be read", 0) == 0);
}
