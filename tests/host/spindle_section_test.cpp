// SPDX-License-Identifier: MIT
#include "host_sim/config/spindle_section.hpp"

#include "host_sim/config/machine_file.hpp"
#include "refusal.hpp"
#include "support/catch.hpp"

using namespace splinefeed::host;

namespace {

std::string with(const std::string& spindle) {
    return "[path]\nmax_feed_mm_s = 80\n[spindle]\n" + spindle +
           "\n[[axis]]\nname = 'x'\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\n";
}

std::string refusal(const std::string& spindle) {
    return splinefeed_test::refusal_of([&] { static_cast<void>(parse_machine(with(spindle), "m.toml")); });
}

} // namespace

TEST_CASE("A spindle has the numbers of the machine file, and those of its profile where the address has none") {
    const auto spindle =
        parse_machine(with("max_rpm = 24000\nmin_rpm = 6000\nramp_s = 3\nrpm_per_hz = 30\n"
                           "at_speed_timeout_s = 5\nvfd = 'modbus-rtu:///dev/ttyUSB0?profile=vfd-gs2'"),
                      "m.toml")
            .spindle;
    REQUIRE(spindle);
    CHECK(spindle->max_rpm == 24000.0);
    CHECK(spindle->min_rpm == 6000.0);
    CHECK(spindle->rpm_per_hz == 30.0);
    CHECK(spindle->at_speed_timeout_s == 5.0);
    CHECK(spindle->change_s(0.0, 12000.0) == 1.5);
    CHECK(spindle->change_s(24000.0, -24000.0) == 6.0);
    REQUIRE(spindle->vfd);
    CHECK(spindle->vfd->address.link.baud == 38400);
    CHECK(spindle->vfd->address.link.parity == 'O');
    CHECK(spindle->reverses());
    CHECK_FALSE(parse_machine(with("max_rpm = 1000"), "m.toml").spindle->vfd);
    CHECK(parse_machine(with("max_rpm = 9000\nvfd = 'modbus-tcp://h?profile=vfd-optidrive'"), "m.toml")
              .spindle->reverses() == false);
}

TEST_CASE("A wrong spindle is refused with its line") {
    CHECK(refusal("") == "m.toml:3: [spindle] has no max_rpm; it must be the fastest speed that a program may ask for");
    CHECK(refusal("max_rpm = 0") == "m.toml:4: max_rpm must be a number from 0.001 to 1000000 1/min");
    CHECK(refusal("max_rpm = 1000\nmin_rpm = 2000") == "m.toml:5: min_rpm must be a number from 0 to 1000 1/min");
    CHECK(refusal("max_rpm = 1000\nrpm = 2").rfind("m.toml:5: unknown key 'rpm' in [spindle]", 0) == 0);
    CHECK(refusal("max_rpm = 1000\nvfd = 'com1'").rfind("m.toml:5: vfd: 'com1' is no address", 0) == 0);
    CHECK(refusal("max_rpm = 1000\nvfd = 'modbus-tcp://h'")
              .rfind("m.toml:5: vfd: the profile 'splinefeed-pvt' is not of "
                     "a frequency inverter",
                     0) == 0);
    CHECK(refusal("max_rpm = 1000\nvfd = 'modbus-tcp://h?profile=vfd-gs3'") ==
          "m.toml:5: vfd: there is no profile 'vfd-gs3' (a file must end in .toml); did you mean 'vfd-gs2'?");
    CHECK(refusal("max_rpm = 40000\nrpm_per_hz = 60\nvfd = 'modbus-tcp://h?profile=vfd-ls-ig5a'")
              .rfind("m.toml:6: max_rpm is 666.667 Hz by rpm_per_hz, which the register", 0) == 0);
}

TEST_CASE("A spindle on lines has its times, and is one of vfd and lines") {
    const auto machine = parse_machine(with("max_rpm = 10000\nspin_up_s = 2\nenable = { line = 'ON' }\n"
                                            "reverse = { line = 'REV', active = 'low' }\n"
                                            "at_speed = { line = 3, active = 'low', bias = 'pull-up' }\n"
                                            "[lines]\nchip = '/dev/gpiochip0'"),
                                       "m.toml");
    REQUIRE(machine.spindle->lines);
    const SpindleLines& lines = *machine.spindle->lines;
    CHECK(machine.spindle->is_controlled());
    CHECK(machine.spindle->reverses());
    CHECK(lines.spin_down_s == 2.0); // as it spins up
    CHECK_FALSE(lines.reverse->on_level);
    CHECK_FALSE(lines.at_speed->active_level);
    REQUIRE(machine.lines.chips.size() == 1);
    CHECK_FALSE(machine.lines.chips[0].outputs[0].safe_level);
    CHECK(machine.lines.chips[0].outputs[1].safe_level);
    CHECK(machine.lines.chips[0].inputs[0].bias == splinefeed::hal::gpio::Bias::pull_up);
    CHECK(machine.spindle->change_s(0.0, 5000.0) == 2.0);
    CHECK(machine.spindle->change_s(5000.0, 8000.0) == 0.0);
    CHECK(machine.spindle->change_s(5000.0, -5000.0) == 4.0);
    CHECK(machine.spindle->change_s(-5000.0, 0.0) == 0.0);

    const std::string lines_at_end = "\n[lines]\nchip = '/dev/gpiochip0'";
    CHECK(refusal("max_rpm = 1\nspin_up_s = 1") == "m.toml:5: spin_up_s is of a spindle on lines; name the line that "
                                                   "turns it on, enable = { line = ... }, or leave it "
                                                   "out");
    CHECK(refusal("max_rpm = 1\nenable = { line = 1 }" + lines_at_end) ==
          "m.toml:3: [spindle] has no spin_up_s; it must be the time from standstill to the speed, 0 to 600 s");
    CHECK(
        refusal("max_rpm = 1\nspin_up_s = 1\nenable = { line = 1 }\nvfd = 'modbus-rtu:///dev/ttyUSB0?profile=vfd-gs2'" +
                lines_at_end) == "m.toml:7: [spindle] has vfd and enable; a spindle is turned by its inverter's "
                                 "registers or by lines: leave one out");
    CHECK_FALSE(
        refusal("max_rpm = 1\nspin_up_s = 1\nenable = { line = 1 }\nreverse = { line = 1 }" + lines_at_end).empty());
}
