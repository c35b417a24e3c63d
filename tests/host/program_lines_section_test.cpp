// SPDX-License-Identifier: MIT
#include "host_sim/config/program_lines_section.hpp"

#include "host_sim/config/machine_file.hpp"
#include "refusal.hpp"
#include "support/catch.hpp"

using namespace splinefeed::host;

namespace {

std::string with(const std::string& lines) {
    return "[path]\nmax_feed_mm_s = 80\n" + lines +
           "\n[[axis]]\nname = 'x'\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\n";
}

ProgramLines lines_of(const std::string& lines) {
    return parse_machine(with(lines), "m.toml").lines;
}

std::string refusal(const std::string& lines) {
    return splinefeed_test::refusal_of([&] { static_cast<void>(lines_of(lines)); });
}

} // namespace

TEST_CASE("Lines of coolant and outputs are grouped by chip, with the levels at which they are safe") {
    CHECK(lines_of("").empty());
    const ProgramLines lines = lines_of("[lines]\nchip = '/dev/gpiochip0'\n[coolant]\nmist = { line = 'MIST' }\n"
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
    CHECK(std::get<SwitchedLine>(*lines.mist).on_level);
    REQUIRE(lines.flood);
    CHECK_FALSE(std::get<SwitchedLine>(*lines.flood).on_level);
    REQUIRE(lines.output(63) != nullptr);
    CHECK(std::get<SwitchedLine>(lines.output(63)->line).line == splinefeed::hal::gpio::LineBit{1, 0});
    CHECK(lines.output(0)->safe_on);
    CHECK(lines.output(1) == nullptr);
}

TEST_CASE("What is wrong with a line of the machine file is said with its line") {
    CHECK(refusal("[coolant]\nmist = { line = 'MIST' }") ==
          "m.toml:4: line of [coolant.mist] names no chip; write it as { chip = \"/dev/gpiochip0\", name = ... }, or "
          "name "
          "the chip of all lines, chip = \"/dev/gpiochip0\" in [lines]");
    CHECK(refusal("[lines]\nchip = 'gpiochip0'") ==
          "m.toml:4: chip is 'gpiochip0'; it must be its whole path, like \"/dev/gpiochip1\"");
    CHECK(refusal("[coolant]\nfloood = { line = 1 }") ==
          "m.toml:4: unknown key 'floood' in [coolant]; did you mean 'flood'?");
    const std::string chip = "[lines]\nchip = '/dev/gpiochip0'\n";
    CHECK(refusal(chip + "[coolant]\nmist = { line = 1 }\nflood = { line = 1 }")
              .rfind("m.toml:7: line of [coolant.flood] is line 1", 0) == 0);
    CHECK(refusal(chip + "[[output]]\nnumber = 64\nline = 1").rfind("m.toml:6: number", 0) == 0);
    CHECK(refusal(chip + "[[output]]\nnumber = 1\nline = 1\n[[output]]\nnumber = 1\nline = 2") ==
          "m.toml:9: this is the second output 1; give each a number of its own");
    CHECK_FALSE(refusal(chip + "[[output]]\nline = 1").empty());
    CHECK_FALSE(refusal(chip + "[[output]]\nnumber = 1").empty());
    CHECK_FALSE(refusal(chip + "[[output]]\nnumber = 1\nline = 1\nsafe = 'off '").empty());
}

TEST_CASE("Coils and inputs are bits of the modules that the machine file names") {
    const ProgramLines lines =
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

TEST_CASE("What is wrong with a module, or a bit of one, is said with its line") {
    const std::string io = "[[module]]\nname = 'io'\naddress = 'modbus-tcp://10.0.0.7'\n"; // lines 3 to 5
    CHECK(refusal("[[output]]\nnumber = 1\nmodule = 'io'\ncoil = 0") ==
          "m.toml:5: output 1 names module 'io', and there is no [[module]] with name = \"io\"; add it");
    CHECK(refusal(io + "[[output]]\nnumber = 1\nmodule = 'io'\ncoil = 0\nline = 4")
              .find("output 1 names a line and a module; leave one out") != std::string::npos);
    CHECK(refusal(io + "[[output]]\nnumber = 1\nmodule = 'io'\ncoil = 65536").rfind("m.toml:9: coil", 0) == 0);
    CHECK_FALSE(refusal(io + "[[output]]\nnumber = 1\nmodule = 'io'").empty());
    CHECK_FALSE(refusal(io + "[[output]]\nnumber = 1\ncoil = 2").empty());
    CHECK(
        refusal(io +
                "[coolant]\nmist = { module = 'io', coil = 3 }\n[[output]]\nnumber = 1\nmodule = 'io'\ncoil = 3") ==
        "m.toml:11: output 1 is coil 3 of module 'io', which is [coolant.mist] already; each needs a coil of its own");
    CHECK(refusal(io + "[[input]]\nnumber = 1\nmodule = 'io'\ncoil = 3\ninput = 3")
              .find("input 1 names an input and a coil; leave one out") != std::string::npos);
    CHECK(refusal(io +
                  "[[input]]\nnumber = 1\nmodule = 'io'\ninput = 3\n[[input]]\nnumber = 1\nmodule = 'io'\ninput = 4") ==
          "m.toml:11: this is the second input 1; give each a number of its own");
    CHECK(refusal(io + "[[input]]\nnumber = 64\nmodule = 'io'\ninput = 3").rfind("m.toml:7: number", 0) == 0);
    CHECK(refusal(io + io).find("this is the second module 'io'; give each a name of its own") != std::string::npos);
    CHECK(refusal(io + "[[module]]\nname = 'b'\naddress = 'modbus-tcp://10.0.0.7'")
              .find("module 'b' has the address of module 'io'") != std::string::npos);
    CHECK(refusal("[[module]]\nname = 'a'\naddress = 'modbus-rtu:///dev/ttyS1?unit=1'\n"
                  "[[module]]\nname = 'b'\naddress = 'modbus-rtu:///dev/ttyS1?unit=2&baud=9600'")
              .find("with another baud, parity or stop") != std::string::npos);
    CHECK(refusal("[[module]]\nname = 'a'\naddress = 'tcp://10.0.0.7'").rfind("m.toml:5: address: ", 0) == 0);
    CHECK_FALSE(refusal("[[module]]\naddress = 'modbus-tcp://10.0.0.7'").empty());
    CHECK_FALSE(refusal(io + "response_timeout_ms = 5").empty());
}
