// SPDX-License-Identifier: MIT
#include "host_sim/config/machine_file.hpp"

#include "host_sim/base/input_error.hpp"
#include "refusal.hpp"
#include "support/catch.hpp"

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

std::string refusal(const std::string& text) {
    return splinefeed_test::refusal_of([&] { static_cast<void>(parse_machine(text, "m.toml")); });
}

} // namespace

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
    CHECK(refusal(with("[path]", "drives_at_end = true\n[path]")) ==
          "m.toml:3: drives_at_end must be a text in quotes");
    CHECK(refusal(with("[path]", "drives_at_end = 'stay'\n[path]")) ==
          "m.toml:3: drives_at_end is 'stay'; it must be 'on' or 'off'");
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

TEST_CASE("The default machine is one that the planner takes") {
    const MachineDescription machine = default_machine();
    CHECK(machine.settings.axes == 3);
    CHECK(machine.axis_name[2] == "z");
    CHECK(MotionLimits<Fixed>::make(machine.settings).has_value());
}

TEST_CASE("Every malformed machine file is refused in one line that names the place") {
    struct Case {
        std::string text;
        std::string start;
        std::string part;
    };
    std::string seven;
    for (const char* name : {"x", "y", "z", "a", "b", "c", "x"}) {
        seven += std::string("[[axis]]\nname='") + name +
                 "'\nmax_velocity_mm_s=1\nmax_acceleration_mm_s2=1\nsteps_per_mm=1\n";
    }
    const std::vector<Case> cases{
        {"", "m.toml: ", "[path]"},
        {"[path]\nmax_feed_mm_s = 1\n", "m.toml: ", "[[axis]]"},
        {"x = \n", "m.toml:1: ", ""},
        {"name = 'a'\nname = 'b'\n", "m.toml:2: ", ""},
        {with("name = 'router'", "name = 7"), "m.toml:1: ", "text"},
        {with("name = 'router'", "nmae = 'router'"), "m.toml:1: ", "did you mean 'name'"},
        {with("= 500", "= 49"), "m.toml:2: ", "50 to 100000"},
        {with("= 500", "= 100001"), "m.toml:2: ", "50 to 100000"},
        {with("= 500", "= 500.0"), "m.toml:2: ", "whole number"},
        {with("= 80", "= 'fast'"), "m.toml:4: ", "finite number"},
        {with("= 80", "= nan"), "m.toml:4: ", "finite number"},
        {with("= 80", "= inf"), "m.toml:4: ", "finite number"},
        {with("= 80", "= 0"), "m.toml:4: ", "between"},
        {with("= 80", "= true"), "m.toml:4: ", "finite number"},
        {with("max_feed_mm_s = 80\n", ""), "m.toml:3: ", "max_feed_mm_s"},
        {with("max_feed_mm_s = 80", "max_fed_mm_s = 80"), "m.toml:4: ", "did you mean 'max_feed_mm_s'"},
        {with("= 2000", "= -1"), "m.toml:5: ", "between"},
        {with("= 0.001", "= 2"), "m.toml:6: ", "between"},
        {with("[path]", "[step]\nengine = 'fast'\n[path]"), "m.toml:4: ", "'intervals' or 'fixed-rate'"},
        {with("[path]", "[step]\ntick_us = 5\n[path]"), "m.toml:4: ", "of engine = 'fixed-rate'"},
        {with("[path]", "[step]\nengine = 'fixed-rate'\ntick_us = 0.3\n[path]"), "m.toml:5: ", "multiple of 0.25"},
        {with("[path]", "[step]\nengine = 'fixed-rate'\ntick_us = 0\n[path]"), "m.toml:5: ", "multiple of 0.25"},
        {with("[path]", "[step]\nstep_length_us = 0.1\n[path]"), "m.toml:4: ", "between 0.125 and 1000 us"},
        {with("[path]", "[step]\ndirection_hold_us = -1\n[path]"), "m.toml:4: ", "between 0 and 1000 us"},
        {with("[path]", "[step]\nstep_on_edge = 1\n[path]"), "m.toml:4: ", "true or false"},
        {with("[path]", "[step]\nstep_lenght_us = 1\n[path]"), "m.toml:4: ", "did you mean 'step_length_us'"},
        {"step = 3\n" + good, "m.toml:1: ", "[step]"},
        {with("= 12.5\n", "= 12.5\nmotors = 3\n"), "m.toml:19: ", "1 or 2"},
        {with("= 12.5\n", "= 12.5\nmotors = true\n"), "m.toml:19: ", "1 or 2"},
        {with("= 12.5\n", "= 12.5\ninvert_step = 'yes'\n"), "m.toml:19: ", "true or false"},
        {with("= 12.5\n", "= 12.5\ninvert = -1\n"), "m.toml:19: ", "invert must be true or false"},
        {with("= 12.5\n", "= 12.5\ninvert_direction = [true, false]\n"), "m.toml:19: ", "one for each of 1 motors"},
        {with("= 12.5\n", "= 12.5\ninvert_direction = [1]\n"), "m.toml:19: ", "true or false"},
        {with("[path]", "[paht]"), "m.toml:3: ", "did you mean 'path'"},
        {"[\x07]\n", "m.toml:1: ", "name of a table"},
        {"a = 1\n [ [ .b ] ]\n", "m.toml:2: ", "name of a table"},
        {"[", "m.toml:1: ", "name of a table"},
        {"a = [1,\n # ]\n }]\n", "m.toml:3: ", "a } where a value"},
        {"a = [{b = 1}, {b = [}]}]\n", "m.toml:1: ", "a } where a value"},
        {"# \xc3\xa4\nn\xc3\xa4me = 1\n", "m.toml:2: ", "beyond ASCII"},
        {"a = 1x'\xc3\xa4'\n", "m.toml:1: ", "beyond ASCII"},
        {"path = 3\n", "m.toml:1: ", "table"},
        {"axis = 3\n[path]\nmax_feed_mm_s = 1\n", "m.toml:1: ", "[[axis]]"},
        {"axis = [3]\n[path]\nmax_feed_mm_s = 1\n", "m.toml:1: ", "[[axis]]"},
        {"axis = []\n[path]\nmax_feed_mm_s = 1\n", "m.toml:1: ", "one to six"},
        {"[path]\nmax_feed_mm_s = 1\n" + seven, "m.toml:33: ", "7 axes"},
        {with("name = 'x'\n", ""), "m.toml:7: ", "no name"},
        {with("name = 'x'", "name = 'w'"), "m.toml:8: ", "one of x, y, z, a, b, c"},
        {with("name = 'x'", "name = 1"), "m.toml:8: ", "text"},
        {with("name = 'a'", "name = 'x'"), "m.toml:15: ", "two axes 'x'"},
        {with("[-10, 310.5]", "[310.5, -10]"), "m.toml:9: ", "larger"},
        {with("[-10, 310.5]", "[1, 1]"), "m.toml:9: ", "larger"},
        {with("[-10, 310.5]", "[1]"), "m.toml:9: ", "two numbers"},
        {with("[-10, 310.5]", "7"), "m.toml:9: ", "two numbers"},
        {with("[-10, 310.5]", "['a', 7]"), "m.toml:9: ", "finite number"},
        {with("[-10, 310.5]", "[0, 2000000]"), "m.toml:9: ", "1048576"},
        {with("steps_per_mm = 320", "steps_per_mm = 1e7"), "m.toml:12: ", "between"},
        {with("[-10, 310.5]\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1e3\nsteps_per_mm = 320",
              "[0, 100000]\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1e3\nsteps_per_mm = 1e6"),
         "m.toml:9: ", "counts"},
        {with("= 100\n", "= 0\n"), "m.toml:10: ", "between"},
        {with("max_velocity_mm_s = 50\n", ""), "m.toml:14: ", "axis a has no max_velocity_mm_s"},
        {with("max_velocity_mm_s = 50", "max_velocity = 50"), "m.toml:16: ", "unknown key"},
        {with("steps_per_mm = 12.5", "steps_per_mm = 12.5\nmax_jerk_mm_s3 = 0.5"), "m.toml:19: ", "max_jerk_mm_s3"},
        {with("= 12.5", "= 12.5\nstandstill_window_mm = 0"), "m.toml:19: ", "between 0.0001 and 10 mm"},
        {with("'a'\n", "'a'\nkind = 'round'\n"), "m.toml:16: ", "kind is 'round'; it must be 'linear' or 'rotary'"},
        {with("'a'\n", "'a'\nkind = true\n"), "m.toml:16: ", "text"},
        {with("310.5]\n", "310.5]\ntravel_end_zone_mm = 5\n"), "m.toml:10: ", "travel_end_velocity_mm_s, or neither"},
        {with("310.5]\n", "310.5]\ntravel_end_velocity_mm_s = 5\n"), "m.toml:10: ", "both travel_end_zone_mm"},
        {with("310.5]\n", "310.5]\ntravel_end_zone_mm = 0\ntravel_end_velocity_mm_s = 5\n"), "m.toml:10: ", "between"},
        {with("310.5]\n", "310.5]\ntravel_end_zone_mm = 5\ntravel_end_velocity_mm_s = 0\n"), "m.toml:11: ", "between"},
        {with("= 12.5\n", "= 12.5\ntravel_end_zone_mm = 5\ntravel_end_velocity_mm_s = 5\n"),
         "m.toml:19: ", "no travel_mm"},
        {with("= 1e3", "= 1e3\nmax_braking_mm_s2 = 0"), "m.toml:12: ", "between 0.1 and 1000000 mm/s^2"},
        {with("= 1e3", "= 1e3\nmax_braking_mm_s2 = 'hard'"), "m.toml:12: ", "finite number"},
        {with("= 1e3", "= 1e3\nmax_brake_mm_s2 = 1"), "m.toml:12: ", "did you mean 'max_braking_mm_s2'"},
        {with("drive = 'modbus-tcp://127.0.0.1:1502?unit=1'", "drive = 1"), "m.toml:13: ", "text"},
    };
    for (const Case& c : cases) {
        const std::string told = refusal(c.text);
        CAPTURE(c.text, told);
        CHECK(told.compare(0, c.start.size(), c.start) == 0);
        CHECK(told.find(c.part) != std::string::npos);
        CHECK(told.find('\n') == std::string::npos);
    }
}

TEST_CASE("Tolerances of the path have defaults and ranges") {
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
    CHECK(refusal(with("[path]", "[path]\njoint_tolerance_mm = 2")) ==
          "m.toml:4: joint_tolerance_mm is 2; it must lie between 0 and 1 mm");
    CHECK(refusal(with("[path]", "[path]\nrotary_tolerance_deg = -1")) ==
          "m.toml:4: rotary_tolerance_deg is -1; it must lie between 0 and 100 degrees");
    CHECK(refusal(with("[path]", "[path]\nrapid_tolerance = 2")).find("did you mean 'rapid_tolerance_mm'?") !=
          std::string::npos);
}
