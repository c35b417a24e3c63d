// SPDX-License-Identifier: MIT
//
// Wrong map files: each is refused with its line, what is wrong, and what would be right.
#include "host_sim/config/gpio_map.hpp"

#include "host/refusal.hpp"
#include "host_sim/config/machine_file.hpp"
#include "support/catch.hpp"

using namespace splinefeed::host;

namespace {

// x and y, one motor each.
const std::string axes = "[axis.x]\nstep = 1\ndirection = 2\n[axis.y]\nstep = 3\ndirection = 4\n"; // 6 lines

const std::string home = axes + "[[input]]\nrole = \"home\"\naxis = \"x\"\nline = 9\n[home.x]\n"; // 11 lines

std::string refusal(const std::string& text, int x_motors = 1) {
    return splinefeed_test::refusal_of([&] {
        MachineDescription machine = default_machine();
        machine.settings.axes = 2;
        machine.motors[0].count = x_motors;
        static_cast<void>(parse_gpio_map(text, "m.toml", machine, "/dev/gpiochip0"));
    });
}

struct Wrong {
    std::string text;
    int line; ///< 0: of the file as a whole
    std::string said;
};

void check(const Wrong& wrong, int x_motors = 1) {
    const std::string said = refusal(wrong.text, x_motors);
    INFO(wrong.text << "\n=> " << said);
    const std::string start = wrong.line == 0 ? "m.toml: " : "m.toml:" + std::to_string(wrong.line) + ": ";
    CHECK(said.find(start) == 0);
    CHECK(said.find(wrong.said) != std::string::npos);
    CHECK(said.find('\n') == std::string::npos);
}

} // namespace

TEST_CASE("GPIO map: what it starts from is right") {
    CHECK(refusal(axes) == "accepted");
    CHECK(refusal(home + "towards = \"low\"\nseek_mm_s = 20\nlatch_mm_s = 2\npull_off_mm = 2\nposition_mm = 0\n") ==
          "accepted");
}

TEST_CASE("GPIO map: wrong axes and lines") {
    const std::string y = "[axis.y]\nstep = 3\ndirection = 4\n";
    const std::vector<Wrong> all{
        {"", 0, "there is no [axis.x]; each axis of the machine needs one"},
        {"[axis.x]\nstep = 1\ndirection = 2\n", 0, "there is no [axis.y]"},
        {axes + "[axis.z]\nstep = 7\ndirection = 8\n", 7, "[axis.z]: the machine has no axis 'z'; its axes are x, y"},
        {"[[axis]]\nname = \"x\"\n", 1, "here it is [axis.x]"},
        {"axis = 3\n", 1, "axis must be a table"},
        {"[axis]\nx = 3\n" + y, 2, "axis.x must be a table"},
        {"[axis.x]\nstep = 1\n" + y, 1, "[axis.x] has no direction; it must be a line"},
        {"[axis.x]\nstep = 1\ndirektion = 2\n" + y, 3,
         "unknown key 'direktion' in [axis.x]; did you mean 'direction'?"},
        {"[axis.x]\nstep = 1\ndirection = 2\nstep2 = 7\n" + y, 4, "step2 is of a second motor, and axis x has one"},
        {"[axis.x]\nstep = -1\ndirection = 2\n" + y, 2, "step of [axis.x] must be a whole number from 0 to 65535"},
        {"[axis.x]\nstep = 1.5\ndirection = 2\n" + y, 2, "step of [axis.x] must be a line's name like \"X_STEP\""},
        {"[axis.x]\nstep = \"\"\ndirection = 2\n" + y, 2, "must be a text in quotes, and not empty"},
        {"[axis.x]\nstep = \"" + std::string(32, 'a') + "\"\ndirection = 2\n" + y, 2, "at most 31 letters"},
        {"[axis.x]\nstep = { chip = \"/dev/gpiochip1\" }\ndirection = 2\n" + y, 2, "has neither offset nor name"},
        {"[axis.x]\nstep = { chip = \"gpiochip1\", offset = 1 }\ndirection = 2\n" + y, 2,
         "chip is 'gpiochip1'; it must be its whole path"},
        {"[axis.x]\nstep = { ofset = 1 }\ndirection = 2\n" + y, 2, "unknown key 'ofset'"},
        {"[axis.x]\nstep = { offset = \"1\" }\ndirection = 2\n" + y, 2, "offset must be a whole number"},
        {"[axis.x]\nstep = 1\ndirection = 3\n" + y, 5,
         "step of [axis.y] is line 3 of /dev/gpiochip0, which is direction of [axis.x] already"},
        {"[axis.x]\nstep = \"A\"\ndirection = { offset = 7, name = \"A\" }\n" + y, 3, "line 'A' of /dev/gpiochip0"},
        {"[axis.x]\nstep = 1\ndirection = { chip = \"/dev/gpiochip0\", offset = 1 }\n" + y, 3, "line 1 of"},
        {"consumer = \"" + std::string(32, 'a') + "\"\n" + axes, 1, "consumer must have at most 31 letters"},
        {"consumer = 1\n" + axes, 1, "consumer must be a text"},
        {axes + "[inputs]\n", 7, "unknown key 'inputs' in the map; did you mean 'input'?"},
        {axes + "[brake]\n", 7, "[brake] has no line; it must be a line"},
        {axes + "[brake]\nline = 4\n", 8, "which is direction of [axis.y] already"},
        {axes + "[brake]\nline = 5\nactive = \"low\"\n", 9, "unknown key 'active' in [brake]"},
        {axes + "[brake]\nline = 5\nengage_ms = 5001\n", 9, "engage_ms"},
        {axes + "[enable]\n", 7, "[enable] has no line; it must be a line"},
        {axes + "[enable]\nline = 4\n", 8, "which is direction of [axis.y] already"},
        {axes + "[enable]\nline = 5\nactive = \"lo\"\n", 9, "active is 'lo'"},
        {axes + "[enable\n", 7, ""},
        {axes + "[[input]]\nrole = \"limit\"\naxis = \"x\"\nline = 9\n[[input]]\nrole = \"limit\"\naxis = \"x\"\nline "
                "= 9\n",
         11, "this input is in the map already"},
        {axes +
             "[[input]]\nrole = \"limit\"\naxis = \"x\"\nline = 9\n[[input]]\nrole = \"home\"\naxis = \"x\"\nline = 9\n"
             "active = \"low\"\n",
         11, "acts at the other level"},
        {axes +
             "[[input]]\nrole = \"limit\"\naxis = \"x\"\nline = 9\n[[input]]\nrole = \"home\"\naxis = \"x\"\nline = 9\n"
             "bias = \"pull-up\"\n",
         14, "a line has one bias"},
        {axes + "[[input]]\nrole = \"limit\"\naxis = \"x\"\nline = 4\n", 10, "which is direction of [axis.y] already"},
    };
    for (const Wrong& wrong : all) {
        check(wrong);
    }
    // The same line of another chip is another line.
    CHECK(refusal("[axis.x]\nstep = 1\ndirection = { chip = \"/dev/gpiochip1\", offset = 1 }\n" + y) == "accepted");
}

TEST_CASE("GPIO map: an axis of two motors has two of each line") {
    const std::string y = "[axis.y]\nstep = 3\ndirection = 4\n";
    check(
        {"[axis.x]\nstep = 1\ndirection = 2\n" + y, 1, "[axis.x] has no step2; it must be a line, as the machine file"},
        2);
    check({"[axis.x]\nstep = 1\ndirection = 2\nstep2 = 5\n" + y, 1, "[axis.x] has no direction2"}, 2);
    CHECK(refusal("[axis.x]\nstep = 1\ndirection = 2\nstep2 = 5\ndirection2 = 6\n" + y, 2) == "accepted");
}

TEST_CASE("GPIO map: wrong inputs") {
    const std::string input = axes + "[[input]]\n"; // 7 lines
    std::string many = axes;
    for (int i = 0; i < 65; ++i) {
        many += "[[input]]\nrole = \"e-stop\"\nline = " + std::to_string(10 + i) + "\n";
    }
    const std::vector<Wrong> all{
        {axes + "[input]\nrole = \"probe\"\nline = 9\n", 7, "input must be tables, each with [[input]]"},
        {input, 7, "[[input]] has no role; it must be e-stop, limit, home, drive-fault, probe"},
        {input + "role = \"estop\"\n", 8, "role is 'estop'; did you mean 'e-stop'?"},
        {input + "role = \"limit\"\nline = 9\n", 7, "an input of role limit has no axis; it must be the axis"},
        {input + "role = \"home\"\naxis = \"q\"\nline = 9\n", 9, "the machine has no axis 'q'; its axes are x, y"},
        {input + "role = \"probe\"\naxis = \"x\"\nline = 9\n", 9, "an input of role probe has no axis; leave axis out"},
        {input + "role = \"e-stop\"\naxis = \"x\"\nline = 9\n", 9, "leave axis out"},
        {input + "role = \"probe\"\n", 7, "[[input]] has no line"},
        {input + "role = \"probe\"\nline = 1\n", 9,
         "line of the input probe is line 1 of /dev/gpiochip0, which is step"},
        {input + "role = \"probe\"\nline = 9\nactive = true\n", 10, "active must be a text"},
        {input + "role = \"probe\"\nline = 9\nbias = \"pullup\"\n", 10, "bias is 'pullup'; did you mean 'pull-up'?"},
        {input + "role = \"probe\"\nline = 9\ndebounce_us = 100001\n", 10, "debounce_us must be a whole number from 0"},
        {input + "role = \"probe\"\nline = 9\ndebounce_ms = 1\n", 10, "did you mean 'debounce_us'?"},
        {input + "role = \"probe\"\nline = 9\n[[input]]\nrole = \"probe\"\nline = 10\n", 11,
         "this is the second input of role probe; give one"},
        {home.substr(0, home.size() - 9) + "[[input]]\nrole = \"home\"\naxis = \"x\"\nline = 10\n", 12,
         "this is the second input of role home of this axis"},
        {many, 6 + 3 * 65, "this is more than 64 lines of /dev/gpiochip0"},
    };
    for (const Wrong& wrong : all) {
        check(wrong);
    }
}

TEST_CASE("GPIO map: wrong homing and threads") {
    const std::vector<Wrong> all{
        {axes + "[home.x]\ntowards = \"low\"\n", 7, "[home.x] has no switch; add [[input]] with role = \"home\""},
        {axes + "[home.z]\n", 7, "[home.z]: the machine has no axis 'z'"},
        {home, 11, "[home.x] has no towards; it must be \"low\" or \"high\""},
        {home + "towards = \"left\"\n", 12, "towards is 'left'"},
        {home + "towards = \"low\"\n", 11, "[home.x] has no seek_mm_s; it must be a number from 0.001 to 100 mm/s"},
        {home + "towards = \"low\"\nseek_mm_s = 101\n", 13, "seek_mm_s must be a number from 0.001 to 100 mm/s"},
        {home + "towards = \"low\"\nseek_mm_s = 20\nlatch_mm_s = 21\n", 14,
         "latch_mm_s must be a number from 0.001 to 20"},
        {home + "towards = \"low\"\nseek_mm_s = 20\nlatch_mm_s = 2\npull_off_mm = 0\n", 15, "pull_off_mm must be"},
        {home + "towards = \"low\"\nseek_mm_s = 20\nlatch_mm_s = 2\npull_off_mm = 1\nposition_mm = nan\n", 16,
         "position_mm must be a number"},
        {home + "speed = 1\n", 12, "unknown key 'speed' in [home.x]"},
        {axes + "[thread]\npriority = 99\n", 8, "priority must be a whole number from 1 to 98"},
        {axes + "[thread]\npriority = 0\n", 8, "priority must be"},
        {axes + "[thread]\ncpu = -1\n", 8, "cpu must be a whole number from 0 to 1023"},
        {axes + "[thread]\nspin_us = 1001\n", 8, "spin_us must be a whole number from 0 to 1000"},
        {axes + "[thread]\ntolerated_late_us = 10001\n", 8, "tolerated_late_us must be a whole number from 0 to 10000"},
        {axes + "[thread]\nprio = 1\n", 8, "unknown key 'prio' in [thread]"},
    };
    for (const Wrong& wrong : all) {
        check(wrong);
    }
}
