// SPDX-License-Identifier: MIT
#include "host_sim/config/machine_file.hpp"

#include "support/catch.hpp"
#include "support/places.hpp"

#include <fmt/format.h>
#include <fstream>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

const std::string good = "name = 'router'\n"                              // 1
                         "sample_period_us = 500\n"                       // 2
                         "[path]\n"                                       // 3
                         "max_feed_mm_s = 80\n"                           // 4
                         "centripetal_mm_s2 = 2000\n"                     // 5
                         "chord_error_mm = 0.001\n"                       // 6
                         "[[axis]]\n"                                     // 7
                         "name = 'x'\n"                                   // 8
                         "travel_mm = [-10, 310.5]\n"                     // 9
                         "max_velocity_mm_s = 100\n"                      // 10
                         "max_acceleration_mm_s2 = 1e3\n"                 // 11
                         "steps_per_mm = 320\n"                           // 12
                         "drive = 'modbus-tcp://127.0.0.1:1502?unit=1'\n" // 13
                         "[[axis]]\n"                                     // 14
                         "name = 'a'\n"                                   // 15
                         "max_velocity_mm_s = 50\n"                       // 16
                         "max_acceleration_mm_s2 = 500\n"                 // 17
                         "steps_per_mm = 12.5\n";                         // 18

std::string with(const std::string& old_text, const std::string& new_text) {
    std::string text = good;
    return text.replace(text.find(old_text), old_text.size(), new_text);
}

/// As people write it: without an exponent.
std::string plain(double value) {
    std::string text = fmt::format("{:.6f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    return text.back() == '.' ? text.substr(0, text.size() - 1) : text;
}

/// The line of the example in docs/reference/files.md that has the key.
std::string line_of_page(const std::string& key) {
    std::ifstream page(splinefeed::test::source_folder() + "/docs/reference/files.md");
    for (std::string line; std::getline(page, line);) {
        if (line.rfind(key + " = ", 0) == 0) {
            return line;
        }
    }
    return {};
}

template <class Number>
void check_texts(const Number& number) {
    const std::string low = plain(number.low);
    const std::string high = plain(number.high);
    CAPTURE(number.key);
    CHECK(line_of_page(number.key).find(low + " to " + high) != std::string::npos);
    CHECK(describe(number.error) == std::string(number.sentence));
    CHECK(std::string(number.sentence).rfind(fmt::format("{} must lie between {} and {}", number.key, low, high), 0) ==
          0);
}

} // namespace

TEST_CASE("The page and the sentences have the ranges of the table") {
    for (const auto& number : path_numbers) {
        check_texts(number);
    }
    for (const auto& number : axis_numbers) {
        check_texts(number);
    }
    check_texts(sample_period);
}

TEST_CASE("A machine file is read") {
    const MachineDescription machine = parse_machine(good, "m.toml");
    CHECK(machine.file == "m.toml");
    CHECK(machine.name == "router");
    CHECK(machine.settings.axes == 2);
    CHECK(machine.settings.sample_period_us == 500);
    CHECK(machine.settings.max_feed_mm_s == 80.0);
    CHECK(machine.settings.centripetal_mm_s2 == 2000.0);
    CHECK(machine.settings.chord_error_mm == 0.001);
    CHECK(machine.axis_name[1] == "a");
    CHECK(machine.settings.axis[0].max_acceleration_mm_s2 == 1000.0);
    CHECK(machine.settings.axis[1].steps_per_mm == 12.5);
    REQUIRE(machine.travel[0]);
    CHECK(machine.travel[0]->high == 310.5);
    CHECK_FALSE(machine.travel[1]);
    CHECK(machine.settings.axis[0].max_braking_mm_s2 == 0.0);
    const AxisSettings ends =
        parse_machine(with("310.5]\n", "310.5]\ntravel_end_zone_mm = 5\ntravel_end_velocity_mm_s = 7\n"), "m.toml")
            .settings.axis[0];
    CHECK(ends.travel_low_mm == -10.0);
    CHECK(ends.travel_high_mm == 310.5);
    CHECK(ends.travel_end_zone_mm == 5.0);
    CHECK(ends.travel_end_velocity_mm_s == 7.0);
    CHECK(machine.settings.axis[0].travel_end_zone_mm == 0.0);
    CHECK_FALSE(machine.drives_on_at_end.has_value());
    CHECK(parse_machine(with("[path]", "drives_at_end = 'on'\n[path]"), "m.toml").drives_on_at_end == true);
    CHECK(parse_machine(with("[path]", "drives_at_end = 'off'\n[path]"), "m.toml").drives_on_at_end == false);
    CHECK(standstill_window_counts(machine, 0) == 3.2); // 0.01 mm of 320 counts
    CHECK(standstill_window_counts(machine, 1) == 2.0); // and of 12.5
    const auto window = [](const char* mm) {
        return standstill_window_counts(
            parse_machine(with("= 12.5", std::string("= 12.5\nstandstill_window_mm = ") + mm), "m.toml"), 1);
    };
    CHECK(window("0.8") == 10.0);
    CHECK(window("0.001") == 1.0); // reports are whole counts
    CHECK_FALSE(machine.settings.axis[1].rotary);
    CHECK(parse_machine(with("'a'\n", "'a'\nkind = 'rotary'\n"), "m.toml").settings.axis[1].rotary);
    CHECK_FALSE(parse_machine(with("'a'\n", "'a'\nkind = 'linear'\n"), "m.toml").settings.axis[1].rotary);
    CHECK(parse_machine(with("= 1e3", "= 1e3\nmax_braking_mm_s2 = 600"), "m.toml").settings.axis[0].max_braking_mm_s2 ==
          600.0);
    CHECK(parse_machine(with("'router'", "'fr\xc3\xa4se'"), "m.toml").name == "fr\xc3\xa4se");
    CHECK(parse_machine(with("'router'", "\"\"\"\n[ \\\" ]\"\"\" # \xc3\xa4"), "m.toml").name == "[ \" ]");
    CHECK(parse_machine(with("sample_period_us = 500\n", ""), "m.toml").settings.sample_period_us == 1000);
}

TEST_CASE("Step and direction lines are read") {
    const MachineDescription plain = parse_machine(good, "m.toml");
    CHECK(plain.step.tick_us == 0.0);
    CHECK(plain.step.step_length_us == 2.0);
    CHECK(plain.motors[1].count == 1);
    CHECK_FALSE(plain.motors[1].invert_direction[0]);
    const MachineDescription machine = parse_machine(
        with("[path]", "[step]\nengine = 'fixed-rate'\ntick_us = 12.5\nstep_length_us = 3\nstep_space_us = 4.5\n"
                       "direction_setup_us = 0\ndirection_hold_us = 7\nstep_on_edge = true\n[path]"),
        "m.toml");
    CHECK(machine.step.tick_us == 12.5);
    CHECK(machine.step.step_length_us == 3.0);
    CHECK(machine.step.step_space_us == 4.5);
    CHECK(machine.step.direction_setup_us == 0.0);
    CHECK(machine.step.direction_hold_us == 7.0);
    CHECK(machine.step.step_on_edge);
    CHECK(parse_machine(with("[path]", "[step]\nengine = 'fixed-rate'\n[path]"), "m.toml").step.tick_us == 10.0);
    CHECK(parse_machine(with("[path]", "[step]\nengine = 'intervals'\n[path]"), "m.toml").step.tick_us == 0.0);
    const StepMotors motors =
        parse_machine(with("= 12.5\n", "= 12.5\nmotors = 2\ninvert_step = true\ninvert_direction = [true, false]\n"),
                      "m.toml")
            .motors[1];
    CHECK(motors.count == 2);
    CHECK(motors.invert_step);
    CHECK(motors.invert_direction == std::array<bool, 2>{true, false});
    CHECK(parse_machine(with("= 12.5\n", "= 12.5\ninvert_direction = true\n"), "m.toml").motors[1].invert_direction[0]);
    // An inverted axis is turned wherever it goes; its motors keep what distinguishes them.
    const MachineDescription turned = parse_machine(
        with("= 12.5\n", "= 12.5\ninvert = true\nmotors = 2\ninvert_direction = [true, false]\n"), "m.toml");
    CHECK(turned.inverted[1]);
    CHECK_FALSE(turned.inverted[0]);
    CHECK(turned.motors[1].invert_direction == std::array<bool, 2>{false, true});
    CHECK_FALSE(turned.motors[0].invert_direction[0]);
}

TEST_CASE("All problems of a machine file are found at once") {
    const std::string text = R"(name = 3
nmae = "x"
sample_period_us = 1
drives_at_end = "maybe"
[path]
max_feed_mm_s = -1
chord_error_mm = "0.01"
rapid_tolerance_mm = 1000
[step]
step_length_us = "2"
[[axis]]
name = "x"
max_velocity_mm_s = 1e9
max_jerk_mm_s3 = 0.1
kind = "round"
travel_mm = [5, 1]
invert = 1
drive = "nowhere"
[[axis]]
name = "x"
[[axis]]
name = "y"
max_velocity_mm_s = 100
motors = 3
)";
    const std::vector<std::string> expected{
        "m:2: unknown key 'nmae' in the machine file; did you mean 'name'?",
        "m:1: name must be a text in quotes",
        "m:3: sample_period_us must be a whole number from 50 to 100000",
        "m:4: drives_at_end is 'maybe'; it must be 'on' or 'off'",
        "m:6: max_feed_mm_s is -1; it must lie between 0.001 and 10000 mm/s",
        "m:7: chord_error_mm must be a number, without quotes: chord_error_mm = 0.01",
        "m:8: rapid_tolerance_mm is 1000; it must lie between 0 and 100 mm",
        "m:10: step_length_us must be a number, without quotes: step_length_us = 2",
        "m:15: kind is 'round'; it must be 'linear' or 'rotary'",
        "m:13: max_velocity_mm_s is 1000000000; it must lie between 0.001 and 10000 mm/s",
        "m:11: axis x has no max_acceleration_mm_s2; add a number between 0.1 and 1000000 mm/s^2",
        "m:14: max_jerk_mm_s3 is 0.1; it must lie between 1 and 1000000000 mm/s^3",
        "m:16: travel_mm is [5, 1]; the second number must be the larger one",
        "m:17: invert must be true or false",
        "m:18: drive: 'nowhere' is no address of a drive; write modbus-tcp://HOST:PORT or "
        "modbus-rtu:///dev/ttyUSB0?baud=115200",
        "m:20: there are two axes 'x'; each needs a name of its own",
        "m:21: axis y has no max_acceleration_mm_s2; add a number between 0.1 and 1000000 mm/s^2",
        "m:24: motors must be 1 or 2"};
    CHECK(machine_problems(text, "m") == expected);
    CHECK(machine_problems("[path\n", "m").size() == 1);
    CHECK(machine_problems("", "m") ==
          std::vector<std::string>{"m: there is no [path]; write [path] and below it max_feed_mm_s = 100",
                                   "m: there is no [[axis]]; a machine has one to six"});
}

TEST_CASE("The default machine is one that the planner takes") {
    const MachineDescription machine = default_machine();
    CHECK(machine.settings.axes == 3);
    CHECK(machine.axis_name[2] == "z");
    CHECK(MotionLimits<Fixed>::make(machine.settings).has_value());
}

TEST_CASE("Tolerances of the path have defaults") {
    const PathTolerances usual = parse_machine(good, "m.toml").tolerances;
    CHECK(usual.joint_mm == 0.001);
    CHECK(usual.programmed_mm == 0.01);
    CHECK(usual.rapid_mm == 0.1);
    CHECK(usual.rotary_deg == 100.0);
    const PathTolerances stated = parse_machine(with("[path]", "[path]\njoint_tolerance_mm = 0\n"
                                                               "default_tolerance_mm = 0.02\nrapid_tolerance_mm = 1\n"
                                                               "rotary_tolerance_deg = 0.5"),
                                                "m.toml")
                                      .tolerances;
    CHECK(stated.joint_mm == 0.0);
    CHECK(stated.programmed_mm == 0.02);
    CHECK(stated.rapid_mm == 1.0);
    CHECK(stated.rotary_deg == 0.5);
}
