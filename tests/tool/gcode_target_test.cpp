// SPDX-License-Identifier: MIT
// Words of programs that real targets refuse, before anything moves.
#include "support/catch.hpp"
#include "tool.hpp"

#include <nlohmann/json.hpp>

using namespace splinefeed::test;

namespace {

const std::string target = " --target modbus-tcp://127.0.0.1:1";

double seconds(const Tool& tool, const std::string& program) {
    tool.write("part.ngc", program);
    const Call call = tool("run part.ngc --quiet --summary json");
    CAPTURE(call.error);
    REQUIRE(call.status == 0);
    return nlohmann::json::parse(call.output)["cycle_time_s"];
}

std::string error_of(const Tool& tool, const std::string& program, const std::string& options = target) {
    tool.write("part.ngc", program);
    const Call call = tool("run part.ngc " + options);
    CHECK(call.status == 2);
    return call.error;
}

} // namespace

TEST_CASE("A real target without an inverter refuses a spindle before anything moves") {
    const Tool tool;
    const std::string error = error_of(tool, "S1000 M3\nG1 X10 F3000\nM2\n");
    CHECK(
        error.rfind("part.ngc:1: spindle_speed: the machine file has no spindle for this; name its frequency inverter",
                    0) == 0);
}

TEST_CASE("A real target refuses probe moves and homing within a program, before anything moves") {
    const Tool tool;
    const std::string begin = "G1 X10 F3000\n";
    for (const int number : {2, 3, 4, 5}) {
        const std::string word = "G38." + std::to_string(number);
        CHECK(error_of(tool, begin + word + " Z-5 F100\nM2\n")
                  .rfind("part.ngc:2: " + word + ": only the simulated machine probes within a program so far", 0) ==
              0);
        CHECK(seconds(tool, begin + word + " Z-5 F100\nM2\n") > 0.0);
    }
    CHECK(error_of(tool, begin + "G28\n", target + " --dialect marlin")
              .rfind("part.ngc:2: G28: only the simulated machine homes within a program so far", 0) == 0);
    CHECK(error_of(tool, begin + "$H\n", target + " --dialect grbl").rfind("part.ngc:2: $H: only the simulated", 0) ==
          0);
    // Left out: what is missing then is the drive.
    tool.write("part.ngc", begin + "G28 X Y\n");
    CHECK(tool("run part.ngc --dialect marlin --ignore G28 " + target).status == 1);
}

TEST_CASE("A real target refuses coolant and outputs that the machine file does not name before anything moves") {
    const Tool tool;
    CHECK(error_of(tool, "M8\nG1 X10 F3000\nM2\n") ==
          "part.ngc:1: flood_on: the machine file has no line for this; name it in [coolant.flood], or add the word to "
          "--ignore\n");
    CHECK(
        error_of(tool, "G1 X10 F3000\nM9\nM2\n") ==
        "part.ngc:2: coolant_off: the machine file has no coolant; name its line in [coolant.mist] or [coolant.flood], "
        "or add the word to --ignore\n");
    CHECK(error_of(tool, "G1 X10 F3000\nM62 P3\nX20\nM2\n") ==
          "part.ngc:2: output_on_with_motion: the machine file has no output 3; name its line in [[output]] with "
          "number = "
          "3, or add the word to --ignore\n");
}

TEST_CASE("A real target refuses inputs that the machine file does not name before anything moves") {
    const Tool tool;
    CHECK(error_of(tool, "G1 X10 F3000\nM66 P3 L3 Q1\nX20\nM2\n") ==
          "part.ngc:2: input_wait: the machine file has no input 3; name its line in [[input]] with number = 3, or add "
          "the word to --ignore\n");
    CHECK(error_of(tool, "G1 X10 F3000\nM66 E0 L0\nM2\n").rfind("part.ngc:2: input_wait: M66 E reads an analog", 0) ==
          0);
}

TEST_CASE("Tapping and threads are of the simulated machine, feeds for each turn of all") {
    const Tool tool;
    for (const std::string word : {"G84 Z-5 R1 F50", "G33 Z-5 K1", "G33.1 Z-5 K1", "G76 P1 Z-5 I-1 J0.4 K0.8"}) {
        const std::string program = "G0 Z5\nM3 S600\n" + word + "\nM2\n";
        CHECK(error_of(tool, program).find("part.ngc:2: spindle_speed: the machine file has no spindle") == 0);
        CHECK(error_of(tool, program, target + " --ignore S,M3").find("part.ngc:3:") == 0); // nothing turns
        CHECK(seconds(tool, program) > 0.1);
    }
    CHECK(seconds(tool, "G95 S600 F0.1\nG1 X10\nM2\n") == Approx(seconds(tool, "F60 G1 X10\nM2\n")).margin(1e-6));
}

TEST_CASE("Analog outputs and the angle of the spindle are of the simulated machine") {
    const Tool tool;
    CHECK(error_of(tool, "M19 R90\nM2\n").rfind("part.ngc:1: spindle_orient: only the simulated machine", 0) == 0);
    CHECK(error_of(tool, "G1 X10 F3000\nM67 E1 Q2\nX20\nM2\n")
              .rfind("part.ngc:2: analog_output_with_motion: only the simulated machine does this so far", 0) == 0);
}

TEST_CASE("A real target refuses a surface speed that changes along a move, and takes a constant one") {
    const Tool tool;
    tool.write("m.toml", "[path]\nmax_feed_mm_s = 100\n[spindle]\nmax_rpm = 4000\nvfd = "
                         "'modbus-tcp://h?profile=vfd-gs2'\n[[axis]]\nname = 'x'\nmax_velocity_mm_s = "
                         "100\nmax_acceleration_mm_s2 = 1000\n");
    const std::string begin = "G0 X30\nG96 S100 M3\nG95 F0.3\nG1 X";
    CHECK(error_of(tool, begin + "2\nM2\n", target + " -m m.toml")
              .rfind("part.ngc:4: surface_speed: only the simulated machine changes the speed", 0) == 0);
    tool.write("part.ngc", begin + "30\nM2\n");
    CHECK(tool("run part.ngc -m m.toml" + target).status == 1); // what is missing is the drive
}
