// SPDX-License-Identifier: MIT
#include "host_sim/config/program_pins_section.hpp"

#include "host_sim/config/machine_file.hpp"
#include "support/catch.hpp"

using namespace splinefeed::host;

namespace {

std::string with(const std::string& lines) {
    return "[path]\nmax_feed_mm_s = 80\n" + lines +
           "\n[[axis]]\nname = 'x'\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\n";
}

ProgramPins lines_of(const std::string& lines) {
    return parse_machine(with(lines), "m.toml").lines;
}

} // namespace

TEST_CASE("Lines of coolant and outputs are grouped by chip, with the levels at which they are safe") {
    CHECK(lines_of("").empty());
    const ProgramPins lines = lines_of("[lines]\nchip = '/dev/gpiochip0'\n[coolant]\nmist = { line = 'MIST' }\n"
                                       "flood = { line = 17, active = 'low' }\n"
                                       "[[output]]\nnumber = 63\nline = { chip = '/dev/gpiochip1', offset = 2 }\n"
                                       "safe = 'on'\n[[output]]\nnumber = 0\nline = 4\nactive = 'low'\nsafe = 'on'");
    REQUIRE(lines.chips.size() == 2);
    CHECK(lines.chips[0].chip == "/dev/gpiochip0");
    REQUIRE(lines.chips[0].outputs.size() == 3);
    CHECK(lines.chips[0].outputs[0].line.name == "MIST");
    CHECK_FALSE(lines.chips[0].outputs[0].safe_level);
    CHECK(lines.chips[0].outputs[1].line.offset == 17U);
    CHECK(lines.chips[0].outputs[1].safe_level);
    CHECK_FALSE(lines.chips[0].outputs[2].safe_level); // on, which is low
    CHECK(lines.chips[1].outputs[0].safe_level);
    REQUIRE(lines.mist);
    CHECK(std::get<SwitchedPin>(*lines.mist).on_level);
    REQUIRE(lines.flood);
    CHECK_FALSE(std::get<SwitchedPin>(*lines.flood).on_level);
    REQUIRE(lines.output(63) != nullptr);
    CHECK(std::get<SwitchedPin>(lines.output(63)->line).line == splinefeed::hal::gpio::PinBit{1, 0});
    CHECK(lines.output(0)->safe_on);
    CHECK(lines.output(1) == nullptr);
}

TEST_CASE("Coils and inputs are bits of the modules that the machine file names") {
    const ProgramPins lines =
        lines_of("[[module]]\nname = 'io'\naddress = 'modbus-tcp://10.0.0.7?unit=3'\nresponse_timeout_ms = 40\n"
                 "[[module]]\nname = 'more'\naddress = 'modbus-rtu:///dev/ttyUSB3?baud=9600'\n"
                 "[coolant]\nmist = { module = 'more', coil = 7, active = 'low' }\n"
                 "[[output]]\nnumber = 2\nmodule = 'io'\ncoil = 65535\nsafe = 'on'\n"
                 "[[input]]\nnumber = 63\nmodule = 'io'\ninput = 4\nactive = 'low'\n"
                 "[[input]]\nnumber = 1\nmodule = 'io'\ncoil = 65535");
    CHECK(lines.empty()); // no GPIO line
    REQUIRE(lines.modules.size() == 2);
    CHECK(lines.modules[0].address.link.unit == 3);
    CHECK(lines.modules[0].answer_ms == 40);
    CHECK(lines.modules[1].answer_ms == 100);
    CHECK(lines.modules[1].address.link.baud == 9600);
    const SwitchedCoil mist = std::get<SwitchedCoil>(lines.mist.value());
    CHECK((mist.module == 1 && mist.address == 7 && !mist.on_level));
    const SwitchedCoil output = std::get<SwitchedCoil>(lines.output(2)->line);
    CHECK((output.module == 0 && output.address == 65535 && output.on_level));
    CHECK(lines.output(2)->safe_on);
    using splinefeed::hal::modbus::BitTable;
    const SensedBit door = std::get<SensedBit>(lines.input(63)->line);
    CHECK((door.module == 0 && door.table == BitTable::inputs && door.address == 4 && !door.active_level));
    const SensedBit coil = std::get<SensedBit>(lines.input(1)->line);
    CHECK((coil.table == BitTable::coils && coil.active_level));
    CHECK(lines.input(2) == nullptr);
}

TEST_CASE("All that is wrong with spindle, lines and modules is said at once, and nothing that only follows from it") {
    const std::string text = with("[lines]\nchip = 'gpiochip0'\n"                                        // 4
                                  "[spindle]\nmax_rpm = 0\nmin_rpm = 6000\nramp_s = -1\nturns = 3\n"     // 5 to 9
                                  "enable = { line = 1, on = 'low' }\nreverse = { line = 1.5 }\n"        // 10, 11
                                  "at_speed = { line = 3, bias = 'up' }\nspin_down_s = 'long'\n"         // 12, 13
                                  "[[module]]\nname = 'io'\naddress = 'modbus-tcp://h?units=3'\n"        // 16
                                  "[[module]]\naddress = 'modbus-tcp://h'\nresponse_timeout_ms = 9\n"    // 17
                                  "[coolant]\nmist = { module = 'io', coil = -1 }\nflood = 3\n"          // 21, 22
                                  "[[output]]\nnumber = 64\nline = 4\n"                                  // 24
                                  "[[output]]\nnumber = 1\nline = 4\n[[output]]\nnumber = 1\nline = 5\n" // 30
                                  "[[output]]\nnumber = 2\nmodule = 'none'\ncoil = 1\n"                  // 34
                                  "[[input]]\nnumber = 1\nline = 4\nactive = 'up'");                     // 39
    const std::vector<std::string> problems = machine_problems(text, "m");
    std::string found;
    for (const std::string& problem : problems) {
        found += problem.substr(0, problem.find(':', 2)) + " ";
    }
    CAPTURE(problems);
    CHECK(found == "m:9 m:6 m:8 m:4 m:16 m:17 m:21 m:22 m:10 m:11 m:12 m:5 m:13 m:24 m:30 m:34 m:39 ");
}
