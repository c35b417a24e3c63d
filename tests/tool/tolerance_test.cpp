// SPDX-License-Identifier: MIT
//
// Lines, arcs and splines within a tolerance, from the command line.
#include "support/catch.hpp"
#include "support/places.hpp"
#include "tool.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

using nlohmann::json;
using splinefeed::test::Call;
using splinefeed::test::last_positions;
using splinefeed::test::Tool;

namespace {

const std::string examples = "'" + splinefeed::test::source_folder() + "/examples/";
const std::string square = "run " + examples + "square.csv' --curve polyline --quiet --summary json";

constexpr double kept = 1.0 - 0x1p-14; // of a tolerance, see TolerancePath::push()

const std::string part = R"({"elements": [
 {"type": "line", "from": [0, 0, 0], "to": [20, 0, 0], "feed_mm_s": 80},
 {"type": "arc", "from": [20, 0, 0], "to": [30, 10, 0], "centre": [20, 10, 0], "axis": [0, 0, 1], "angle": 1.570796327, "feed_mm_s": 80},
 {"type": "line", "from": [30, 10, 0], "to": [30, 30, 0], "feed_mm_s": 40, "line_number": 12},
 {"type": "line", "from": [30, 30, 0], "to": [10, 30, 5], "feed_mm_s": 80, "mode": "exact_path"},
 {"type": "bezier", "from": [10, 30, 5], "to": [0, 0, 5], "control_points": [[10, 30, 5], [0, 30, 5], [0, 10, 5], [0, 0, 5]], "rapid": true},
 {"type": "line", "from": [0, 0, 5], "to": [0, 0, 0], "rapid": true}],
 "dwells": [{"after_element": 2, "seconds": 0.5}]})";

json summary_of(const Call& call) {
    CAPTURE(call.error);
    REQUIRE(call.status == 0);
    return json::parse(call.output);
}

} // namespace

TEST_CASE("The summary counts each joint at which the machine stands, and no window that is long enough") {
    const Tool tool;
    tool.write("kinks.ngc", "G21 G61 F600\nG0 X0 Y0\nG1 X10\nG1 X20 Y0.5\nG1 X30\nG1 X40 Y0.50001\nM2\n");
    const std::string run = "run kinks.ngc --quiet --summary json";
    const json rounded = summary_of(tool(run)); // its last kink, of a millionth
    CHECK(rounded["stops"] == 2);
    CHECK(rounded["tolerance"]["stopped"] == 3); // and at its end
    CHECK(rounded["tolerance"]["blended"] == 1);
    std::string exact = "[path]\nmax_feed_mm_s = 100\njoint_tolerance_mm = 0\n";
    for (const char* axis : {"x", "y", "z"}) {
        exact +=
            "[[axis]]\nname = \"" + std::string(axis) + "\"\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\n";
    }
    tool.write("exact.toml", exact);
    const json stands = summary_of(tool(run + " -m exact.toml"));
    CHECK(stands["stops"] == 3);
    CHECK(stands["tolerance"]["stopped"] == 4); // and at its end
    CHECK(stands["tolerance"]["through"] == 0);
    CHECK(stands["window_limited"] == 0);
    const std::string machine = " -m '" + splinefeed::test::source_folder() + "/examples/jerk_limited.toml'";
    CHECK(summary_of(tool(run + machine))["window_limited"] == 0);
}

TEST_CASE("A polyline within a tolerance goes round its corners") {
    const Tool tool;
    const json exact = summary_of(tool(square));
    CHECK(exact["stops"] == 3);
    CHECK_FALSE(exact.contains("tolerance"));
    CHECK(summary_of(tool(square + " --tolerance 0"))["cycle_time_s"] == exact["cycle_time_s"]);
    const json rounded = summary_of(tool(square + " --tolerance 0.05"));
    CHECK(rounded["stops"] == 0);
    CHECK(rounded["waypoints"] == 5);
    CHECK(rounded["waypoint_error_mm"].is_null());
    CHECK(rounded["cycle_time_s"].get<double>() < 0.992 * exact["cycle_time_s"].get<double>());
    const json& tolerance = rounded["tolerance"];
    CHECK(tolerance["kept"] == true);
    CHECK(tolerance["deviation_mm"]["distance"].get<double>() == Approx(0.05 * kept).margin(1e-6));
    CHECK(tolerance["blended"] == 3);
    CHECK(tolerance["stopped"] == 1);
    CHECK(tolerance["elements"] == 4);
    CHECK(tolerance["exact_stop_time_s"].get<double>() == Approx(4.4));
    tool.write("column.csv", "x,y,tolerance,corner\n0,0,,\n10,0,0.1,\n10,10,0.1,1\n0,10,0.02,\n0,0,,\n");
    const std::string column = "run column.csv --curve polyline --quiet --summary json";
    const json mixed = summary_of(tool(column));
    CHECK(mixed["tolerance"]["blended"] == 1); // a mark, and the empty field: --tolerance is 0
    CHECK(mixed["stops"] == 2);
    CHECK(mixed["tolerance"]["deviation_mm"]["line"] == 3);
    CHECK(summary_of(tool(column + " --tolerance 0.05"))["tolerance"]["blended"] == 2);
    CHECK(tool("run column.csv --quiet").error ==
          "column.csv: there is a column tolerance, and --curve g2 has none; add --curve polyline, or leave the column "
          "out\n");
    CHECK(tool(column + " --closed").status == 2);
}

TEST_CASE("Moves of a rotary axis keep its tolerance, too") {
    const Tool tool;
    tool.write("wrap.csv", "x,y,a\n0,0,0\n20,0,0\n20,20,30\n0,20,60\n0,0,60\n");
    const std::string machine = "[path]\nmax_feed_mm_s = 100\nrotary_tolerance_deg = 0.02\n"
                                "[[axis]]\nname = \"x\"\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\n"
                                "[[axis]]\nname = \"y\"\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\n"
                                "[[axis]]\nname = \"a\"\nkind = \"rotary\"\nmax_velocity_mm_s = 100\n"
                                "max_acceleration_mm_s2 = 1000\n";
    tool.write("own.toml", machine);
    tool.write("none.toml", std::string(machine).replace(machine.find("rotary_tol"), 27, ""));
    const std::string run = "run wrap.csv --curve polyline --tolerance 0.1 --quiet --summary json -m ";
    const json own = summary_of(tool(run + "own.toml"));
    const json none = summary_of(tool(run + "none.toml"));
    CHECK(own["tolerance"]["kept"] == true);
    CHECK(own["tolerance"]["blended"] == 3);
    CHECK(own["tolerance"]["deviation_mm"]["distance"].get<double>() == Approx(0.02 * kept).margin(1e-6));
    CHECK(none["tolerance"]["deviation_mm"]["distance"].get<double>() > 0.05);
}

TEST_CASE("A pipe of waypoints within a tolerance is run as it comes") {
    const Tool tool;
    const Call call = tool.shell("cat " + examples + "star.csv' | '" + splinefeed::test::tool_path() +
                                 "' run - --curve polyline --tolerance 0.05 --quiet --summary json");
    const json piped = summary_of(call);
    const json whole =
        summary_of(tool("run " + examples + "star.csv' --curve polyline --tolerance 0.05 --quiet --summary json"));
    CHECK(piped["cycle_time_s"] == whole["cycle_time_s"]);
    CHECK(piped["tolerance"] == whole["tolerance"]);
}

TEST_CASE("An element file runs in every scalar and with every planner") {
    const Tool tool;
    tool.write("part.json", part);
    for (const std::string& kind :
         {std::string("--scalar fixed"), std::string("--scalar float"), std::string("--scalar double"),
          "-m " + examples + "jerk_limited.toml'", "--jerk-scalar float -m " + examples + "jerk_limited.toml'"}) {
        CAPTURE(kind);
        const json summary = summary_of(tool("run part.json --quiet --summary json --segments s.csv " + kind));
        CHECK(summary["curve"] == "elements");
        CHECK(summary["tolerance"]["kept"] == true);
        CHECK(summary["tolerance"]["elements"] == 6);
        CHECK(summary["cycle_time_s"].get<double>() < summary["tolerance"]["exact_stop_time_s"].get<double>());
        CHECK(summary_of(tool("plan part.json --quiet --summary json " + kind))["cycle_time_s"] ==
              summary["cycle_time_s"]);
        for (const std::string& end : last_positions(tool, "s.csv")) {
            CHECK(end.substr(end.find('=')) == "=0");
        }
    }
    const json dwelled = summary_of(tool("run part.json --quiet --summary json"));
    CHECK(dwelled["stops"].get<int>() >= 2);
    CHECK(dwelled["program"]["dwells"] == 1);
    CHECK(dwelled["program"]["dwell_s"] == 0.5);
    std::string at_once = part;
    at_once.replace(at_once.find("\"seconds\": 0.5"), 14, "\"seconds\": 0");
    tool.write("at_once.json", at_once);
    const json quick = summary_of(tool("run at_once.json --quiet --summary json"));
    CHECK(std::abs(dwelled["cycle_time_s"].get<double>() - quick["cycle_time_s"].get<double>() - 0.5) < 1e-9);
}

TEST_CASE("A dwell before the first move and behind the last one takes its time, also while the feed is held") {
    const Tool tool;
    const std::string element = R"({"from": [1, 2, 0], "to": [11, 2, 0], "feed_mm_s": 20})";
    const auto program = [&](const char* a, const char* b) {
        return "{\"elements\": [" + element + R"(], "dwells": [{"after_element": 1, "seconds": )" + b +
               R"(}, {"after_element": 0, "seconds": )" + a + "}]}";
    };
    tool.write("at_once.json", program("0", "0"));
    tool.write("waits.json", program("0.5", "0.25"));
    tool.write("events.csv", "0.1,hold\n0.7,resume\n1.5,hold\n1.6,resume\n");
    const double at_once = summary_of(tool("run at_once.json --quiet --summary json"))["cycle_time_s"];
    const double waits = summary_of(tool("run waits.json --quiet --summary json"))["cycle_time_s"];
    CHECK(std::abs(waits - at_once - 0.75) < 1e-9);
    const json held = summary_of(tool("run waits.json --quiet --summary json --events events.csv"));
    CHECK(std::abs(held["cycle_time_s"].get<double>() - waits - 0.2) < 1e-9); // the first dwell is over at 0.5 s
}

TEST_CASE("The path does not depend on overrides, and survives a hold") {
    const Tool tool;
    tool.write("part.json", part);
    tool.write("events.csv", "0.3,override,0.5\n0.6,hold\n1.0,resume\n1.2,override,1.5\n");
    CHECK(tool("run part.json --quiet --curve-out a.json").status == 0);
    const json steered =
        summary_of(tool("run part.json --quiet --curve-out b.json --events events.csv --summary json"));
    CHECK(steered["events"] == 4);
    CHECK(steered["tolerance"]["kept"] == true);
    CHECK(tool.read("a.json") == tool.read("b.json"));
    CHECK(tool("curve part.json --quiet --curve-out c.json").status == 0);
    CHECK(json::parse(tool.read("c.json"))["segments"].size() > 6);
}

TEST_CASE("A dwell behind moves that are too short is kept, whether a chain takes them or not") {
    const Tool tool;
    for (const char* const tolerance : {"0", "0.01"}) {
        std::string program = "{\"elements\": [";
        double from = 0.0;
        for (const double to : {1.0, 1.00006, 1.00012, 1.00018, 2.0}) { // 0.06 um each: two are a move
            program += std::string(from > 0.0 ? "," : "") + R"({"type": "line", "from": [0, )" + std::to_string(from) +
                       R"(, 0], "to": [0, )" + std::to_string(to) + R"(, 0], "feed_mm_s": 10, "tolerance_mm": )" +
                       tolerance + "}";
            from = to;
        }
        program += R"(], "dwells": [{"after_element": 2, "seconds": 0.3}, {"after_element": 3, "seconds": 0.3},
                     {"after_element": 4, "seconds": 0.3}]})";
        tool.write("short.json", program);
        const json summary = summary_of(tool("run short.json --quiet --summary json"));
        CHECK(summary["program"]["dwells"] == 3);
        CHECK(summary["cycle_time_s"].get<double>() > 0.9);
        CHECK(summary["tolerance"]["kept"] == true);
    }
}
