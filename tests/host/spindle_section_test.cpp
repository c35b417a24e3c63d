// SPDX-License-Identifier: MIT
#include "host_sim/config/spindle_section.hpp"

#include "host_sim/config/machine_file.hpp"
#include "support/catch.hpp"

using namespace splinefeed::host;

namespace {

std::string with(const std::string& spindle) {
    return "[path]\nmax_feed_mm_s = 80\n[spindle]\n" + spindle +
           "\n[[axis]]\nname = 'x'\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\n";
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

TEST_CASE("A spindle on lines has its times, and is one of vfd and lines") {
    const auto machine = parse_machine(with("max_rpm = 10000\nspin_up_s = 2\nenable = { line = 'ON' }\n"
                                            "reverse = { line = 'REV', active = 'low' }\n"
                                            "at_speed = { line = 3, active = 'low', bias = 'pull-up' }\n"
                                            "[lines]\nchip = '/dev/gpiochip0'"),
                                       "m.toml");
    REQUIRE(machine.spindle->lines);
    const SpindlePins& lines = *machine.spindle->lines;
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
}
