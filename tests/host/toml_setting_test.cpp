// SPDX-License-Identifier: MIT
#include "host_sim/config/toml_setting.hpp"

#include "host_sim/config/machine_file.hpp"

#include "support/catch.hpp"

#include <string>
#include <vector>

using namespace splinefeed::host;

// What is refused: tests/tool/refusals/settings.txt.
TEST_CASE("settings replace what a machine file states, and add what it does not") {
    const std::string text = "name = \"m\"\n[path]\nmax_feed_mm_s = 100\n[[axis]]\nname = \"x\"\n"
                             "max_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\n[[axis]]\nname = \"c\"\n"
                             "max_velocity_mm_s = 360\nmax_acceleration_mm_s2 = 2000\n";
    const std::vector<std::string> settings{"path.max_feed_mm_s=20.5",     "path.chord_error_mm=0.01",
                                            "axis.c.kind=rotary",          "axis.c.max_jerk_mm_s3=30000",
                                            "axis.x.travel_mm=[-1, 2e2]",  "axis.x.invert=true",
                                            "name=\"the mill, slower\"",   "step.engine=fixed-rate",
                                            "axis.x.max_velocity_mm_s=50", "axis.x.max_velocity_mm_s=60"};
    const MachineDescription machine = parse_machine(text, "m.toml", settings);
    CHECK(machine.file == "m.toml");
    CHECK(machine.axis_line[1] == parse_machine(text, "m.toml").axis_line[1]);
    CHECK(machine.name.rfind("the mill, slower, with path.max_feed_mm_s=20.5 path.chord_error_mm=0.01 ", 0) == 0);
    CHECK(machine.settings.max_feed_mm_s == 20.5);
    CHECK(machine.settings.chord_error_mm == 0.01);
    CHECK(machine.settings.axis[0].max_velocity_mm_s == 60.0);
    CHECK(machine.settings.axis[1].rotary);
    CHECK(machine.settings.axis[1].max_jerk_mm_s3 == 30000.0);
    CHECK(machine.travel[0].value().low == -1.0);
    CHECK(machine.travel[0].value().high == 200.0);
    CHECK(machine.inverted[0]);
    CHECK(machine.step.tick_us == 10.0);
}

TEST_CASE("settings find an axis by its small or its capital letter, as the machine file may write it") {
    for (const char* const name : {"x", "X"}) {
        const std::string text = std::string("[path]\nmax_feed_mm_s = 100\n[[axis]]\nname = \"") + name +
                                 "\"\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\n";
        for (const char* const setting : {"axis.x.max_velocity_mm_s=50", "axis.X.max_velocity_mm_s=50"}) {
            CAPTURE(name, setting);
            CHECK(parse_machine(text, "m.toml", {setting}).settings.axis[0].max_velocity_mm_s == 50.0);
        }
    }
}
