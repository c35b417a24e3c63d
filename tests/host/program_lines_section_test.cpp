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
    CHECK(lines.mist->on_level);
    REQUIRE(lines.flood);
    CHECK_FALSE(lines.flood->on_level);
    REQUIRE(lines.output(63) != nullptr);
    CHECK(lines.output(63)->line.line == splinefeed::hal::gpio::LineBit{1, 0});
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
