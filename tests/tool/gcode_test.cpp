// SPDX-License-Identifier: MIT
// Programs in G-code, as a user runs them.
#include "support/catch.hpp"
#include "support/places.hpp"
#include "tool.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

using namespace splinefeed::test;
using json = nlohmann::json;

namespace {

const std::string examples = "'" + source_folder() + "/examples/";

json summary_of(const Call& call) {
    CAPTURE(call.error);
    REQUIRE(call.status == 0);
    return json::parse(call.output);
}

double seconds(const Tool& tool, const std::string& program, const std::string& options = "") {
    tool.write("part.ngc", program);
    return summary_of(tool("run part.ngc --quiet --summary json " + options))["cycle_time_s"];
}

std::string error_of(const Tool& tool, const std::string& program, const std::string& options = "") {
    tool.write("part.ngc", program);
    const Call call = tool("run part.ngc " + options);
    CHECK(call.status == 2);
    return call.error;
}

} // namespace

TEST_CASE("The examples in G-code run within their tolerance") {
    const Tool tool;
    const std::string machine = " -m " + examples + "three_axis.toml' --quiet --summary json";
    for (const std::string& program : {examples + "bracket.ngc'", examples + "nameplate.nc'",
                                       examples + "ring.gcode' --dialect marlin --ignore E"}) {
        CAPTURE(program);
        const json summary = summary_of(tool("run " + program + machine));
        CHECK(summary["curve"] == "gcode");
        CHECK(summary["tolerance"]["kept"] == true);
        CHECK(summary["cycle_time_s"].get<double>() < 1.03 * summary["optimum_time_s"].get<double>());
        CHECK(summary_of(tool("plan " + program + machine))["cycle_time_s"] == summary["cycle_time_s"]);
    }
}

TEST_CASE("A program from a pipe is the program from its file") {
    const Tool tool;
    const json file = summary_of(tool("run " + examples + "bracket.ngc' --quiet --summary json --segments a.csv"));
    const Call piped = tool.shell("cat " + examples + "bracket.ngc' | '" + tool_path() +
                                  "' run - --format gcode --quiet --summary json --segments b.csv");
    CHECK(summary_of(piped)["cycle_time_s"] == file["cycle_time_s"]);
    CHECK(tool.read("a.csv") == tool.read("b.csv"));
}

TEST_CASE("Dwells, pauses and events stand where the program has them, and dwells take their time") {
    const Tool tool;
    const std::string moves = "G1 X10 F3000\n%\nG1 X20\nM2\n";
    const auto with = [&](const std::string& what) {
        std::string text = moves;
        return text.replace(text.find("%\n"), 2, what);
    };
    const double straight = seconds(tool, with(""));
    const double stopped = seconds(tool, with("M0\n"));
    CHECK(stopped > straight + 0.04);
    CHECK(std::abs(seconds(tool, with("G4 P0.25\n")) - stopped - 0.25) < 1e-9);
    CHECK(std::abs(seconds(tool, with("M1\n")) - straight) < 1e-9);
    CHECK(std::abs(seconds(tool, with("M1\n"), "--optional-stop") - stopped) < 1e-9);
    CHECK(std::abs(seconds(tool, with("/G4 P1\n"), "--block-delete") - straight) < 1e-9);
    CHECK(std::abs(seconds(tool, "G4 P0.5\n" + with("")) - straight - 0.5) < 1e-9);

    tool.write("part.ngc", with("M3 S1200\nG4 P0.25\nM5\n(MSG,halfway)\n"));
    const Call call = tool("run part.ngc --summary json --trace t.csv --elements e.json");
    CHECK(call.error.find("halfway\n") != std::string::npos);
    const json program = summary_of(call)["program"];
    CHECK(program["dwells"] == 1);
    CHECK(program["line"] == 6);
    const json& events = program["first_events"];
    REQUIRE(events.size() == 5);
    CHECK(events[0]["what"] == "spindle_speed");
    CHECK(events[1]["what"] == "spindle_clockwise");
    CHECK(events[2]["what"] == "spindle_stop");
    CHECK(events[2]["line"] == 4);
    CHECK(events[4]["what"] == "end");
    CHECK(events[2]["t"].get<double>() - events[1]["t"].get<double>() > 0.2499);
    const json elements = json::parse(tool.read("e.json"));
    CHECK(elements["elements"].size() == 2);
    CHECK(elements["elements"][1]["line_number"] == 6);
    CHECK(elements["dwells"][0]["after_element"] == 1);
    CHECK(elements["events"].size() == 5);
    const std::string trace = tool.read("t.csv");
    CHECK(trace.find("t,x,y,z,speed,line\n") == 0);
    CHECK(trace.substr(trace.rfind(',')) == ",6\n");
}

TEST_CASE("A program without a move takes the time of its dwells") {
    const Tool tool;
    CHECK(std::abs(seconds(tool, "M3 S100\nG4 P0.5\nM5\n") - 0.5) < 1e-9);
    CHECK(seconds(tool, "(nothing)\n") == 0.0);
}

TEST_CASE("Rapids move at the axes' own limits, feeds at the machine's") {
    const Tool tool;
    tool.write("m.toml", "[path]\nmax_feed_mm_s = 20\n[[axis]]\nname = \"x\"\nmax_velocity_mm_s = 100\n"
                         "max_acceleration_mm_s2 = 1000\n[[axis]]\nname = \"y\"\nmax_velocity_mm_s = 50\n"
                         "max_acceleration_mm_s2 = 1000\n");
    CHECK(std::abs(seconds(tool, "G0 X100\n", "-m m.toml") - 1.1) < 0.005);
    CHECK(std::abs(seconds(tool, "G0 X100 Y50\n", "-m m.toml") - 1.1) < 0.005);
    CHECK(std::abs(seconds(tool, "G0 X100 Y100\n", "-m m.toml") - 2.05) < 0.005);
    CHECK(std::abs(seconds(tool, "G1 X100 F6000\n", "-m m.toml") - 5.02) < 0.005);
    CHECK(std::abs(seconds(tool, "G1 X100 F600\n", "-m m.toml") - 10.01) < 0.005);
}

TEST_CASE("What is wrong is said with line and column, before anything moves") {
    const Tool tool;
    CHECK(error_of(tool, "G1 X10 F600\nG1 Y5 G33\n").find("part.ngc:2:7: 'G33': ") == 0);
    CHECK(error_of(tool, "G1 X10\n").find("part.ngc:1:1: 'G1': ") == 0);
    CHECK(error_of(tool, "G1 X10 (open\n").find("part.ngc:1:8: ") == 0);
    CHECK(error_of(tool, "M104 S200\n").find("part.ngc:1:1: 'M104': ") == 0);
    CHECK(error_of(tool, std::string("G1 \0X1 F100\n", 12)).find("part.ngc:1:4: ") == 0);
    CHECK(error_of(tool, std::string(1'000'000, 'X')).find("part.ngc:1: the line is longer than") == 0);
    CHECK(error_of(tool, "G1 X" + std::string(200, '9') + " F100\n").find("part.ngc:1:4: ") == 0);
    CHECK(error_of(tool, "G1 X1 F100\n", "--curve g2").find("splinefeed: --curve: ") == 0);
    CHECK(error_of(tool, "G1 X1 F100\n", "--dialect mach3").find("splinefeed: --dialect 'mach3': ") == 0);
    CHECK(tool("run part.ngc --ignore G33 --quiet").status == 0);
    tool.write("part.csv", "0,0\n1,1\n");
    CHECK(tool("run part.csv --dialect grbl").error.find("splinefeed: --dialect: only a program in G-code has it") ==
          0);
    tool.write("m.toml", "[path]\nmax_feed_mm_s = 20\n[[axis]]\nname = \"x\"\nmax_velocity_mm_s = 100\n"
                         "max_acceleration_mm_s2 = 1000\ntravel_mm = [0, 50]\n");
    CHECK(error_of(tool, "G0 X10\nG0 X51\n", "-m m.toml").find("part.ngc:2: ") == 0);
}

TEST_CASE("The tolerance of --tolerance is that of a program that states none") {
    const Tool tool;
    const std::string program = "G1 X10 F6000\nY10\nM2\n";
    tool.write("part.ngc", program);
    for (const double tolerance : {0.02, 0.5}) {
        const json summary =
            summary_of(tool("run part.ngc --quiet --summary json --tolerance " + std::to_string(tolerance)));
        const double deviation = summary["tolerance"]["deviation_mm"]["distance"];
        CHECK(deviation < tolerance + 0.001);
        CHECK(deviation > 0.5 * tolerance);
    }
}
