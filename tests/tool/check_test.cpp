// SPDX-License-Identifier: MIT
// splinefeed check: what is wrong with a program, and how long it takes.
#include "support/catch.hpp"
#include "support/places.hpp"
#include "tool.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

using namespace splinefeed::test;
using json = nlohmann::json;

TEST_CASE("check tells every problem of a program, each with its line") {
    const Tool tool;
    tool.write("m.toml", path_text(20) + axis_text("x", "travel_mm = [0, 50]\n"));
    tool.write("part.ngc", "G1 X10\nG41 D1\nG1 X5 F100\nG0 X-3\nM104 S1\nG1 X60\nX61\n");
    const Call call = tool("check part.ngc -m m.toml");
    CHECK(call.status == 1);
    CHECK(call.output.find("part.ngc:1:1: 'G1': ") == 0);
    for (const char* const part : {"\npart.ngc:2:1: 'G41': ", "\npart.ngc:4: axis x goes to -3.0000 mm, below",
                                   "\npart.ngc:5:1: 'M104': ", "\npart.ngc:6: axis x goes to 60.0000 mm, above",
                                   "end of its travel at 50.0000 mm; also on line 7\n", "\n6 problems\n"}) {
        CAPTURE(part);
        CHECK(call.output.find(part) != std::string::npos);
    }
    const Call as_json = tool("check part.ngc -m m.toml --json");
    CHECK(as_json.status == 1);
    CHECK(json::parse(as_json.output)["problems"].size() == 5); // causes
    CHECK(json::parse(as_json.output)["problem_count"] == 6);
    CHECK(tool("check part.ngc -m m.toml --ignore G41,M104").output.find("\n4 problems\n") != std::string::npos);
    CHECK(tool("check missing.ngc").status == 2);
    tool.write("part.csv", "0,0\n1,1\n");
    CHECK(tool("check part.csv").error.find("splinefeed: check takes a program in G-code") == 0);
    CHECK(tool("check - --format gcode </dev/null").status == 2);
}

TEST_CASE("check goes on behind O words that are wrong, and tells a line that runs often once") {
    const Tool tool;
    tool.write("m.toml", path_text(20) + axis_text("x", "travel_mm = [0, 5]\n"));
    tool.write("part.ngc", "o100 sub\nG999\no1 repeat [9]\nG91 G0 X1\nG998\no1 endrepeat\n");
    const Call call = tool("check part.ngc -m m.toml");
    CAPTURE(call.output);
    CHECK(call.status == 1);
    for (const char* const part :
         {"part.ngc:1:1: o100 has no end; write o100 endsub behind its last line\n", "\npart.ngc:2:1: 'G999'",
          "\npart.ngc:4: axis x goes to 6.0000 mm, above", "\npart.ngc:5:1: 'G998'", "\n4 problems\n"}) {
        CAPTURE(part);
        CHECK(call.output.find(part) != std::string::npos);
    }
}

TEST_CASE("check ends where the program ends itself, and tells its text") {
    const Tool tool;
    tool.write("part.ngc", "G1 X5 F600\no1 if [#5070 EQ 0]\n(ABORT,no contact)\no1 endif\nG1 X50\nG999\n");
    const Call call = tool("check part.ngc");
    CHECK(call.status == 1);
    CHECK(call.output.find("part.ngc:3:8: the program ends itself by (ABORT,no contact)\n\n1 problem\n") == 0);
    CHECK(json::parse(tool("check part.ngc --json").output)["feed_box"]["x"][1] == 5.0);
    tool.write("part.ngc", "G1 X5 F600\no1 if [0]\n(ABORT,no contact)\no1 endif\nG1 X50\n");
    CHECK(tool("check part.ngc").status == 0);
}

TEST_CASE("check takes the time of a real plan, and its parts make the whole") {
    const Tool tool;
    const std::string program = "'" + source_folder() + "/examples/bracket.ngc'";
    const Call call = tool("check " + program + " --json");
    CHECK(call.status == 0);
    const json report = json::parse(call.output);
    const json run = json::parse(tool("run " + program + " --quiet --summary json").output);
    CHECK(report["cycle_time_s"] == run["cycle_time_s"]);
    CHECK(report["problems"].empty());
    const double parts = report["feeds"]["time_s"].get<double>() + report["rapids"]["time_s"].get<double>() +
                         report["dwell_s"].get<double>();
    CHECK(std::abs(parts - run["cycle_time_s"].get<double>()) < 1e-6);
    CHECK(report["feed_box"]["z"][0] == -5.0);
    CHECK(report["slowest_lines"].size() == 10);
    CHECK(tool("check " + program).output.find("0 problems\n") == 0);
}

TEST_CASE("check knows M66: the time-outs of inputs that are low, and a number that the machine file lacks") {
    const Tool tool;
    tool.write("bare.toml", path_text(20) + axis_text("x"));
    tool.write("m.toml", path_text(20) +
                             "[[module]]\nname = \"io\"\naddress = \"modbus-tcp://127.0.0.1\"\n"
                             "[[input]]\nnumber = 2\nmodule = \"io\"\ninput = 7\n" +
                             axis_text("x"));
    tool.write("part.ngc",
               "G1 X10 F600\nM66 P2 L3 Q2.5\nX[20+5*#5399]\nM66 P2 L4 Q2\nM66 P4 L1 Q1\nM66 P2 L0\nM66 P2 L2 Q0.5\n");
    const Call bare = tool("check part.ngc -m bare.toml --json");
    CHECK(bare.status == 0);
    const json report = json::parse(bare.output);
    CHECK(report["dwell_s"].get<double>() == Approx(4.0));
    CHECK(report["feed_box"]["x"][1] == 15.0);
    const Call call = tool("check part.ngc -m m.toml");
    CHECK(call.status == 1);
    CHECK(call.output.find(
              "part.ngc:5: input_wait: the machine file has no input 4; name its line in [[input]] with number = "
              "4, or add the word to --ignore\n\n1 problem\n") == 0);
}

TEST_CASE("The advice of a long program is that of its first moves, and planning time is what one waits for") {
    const Tool tool;
    std::string program = "F600\n";
    for (int i = 0; i < 10'001; ++i) {
        program += i % 2 == 0 ? "G1 X0.1\n" : "G1 X0\n";
    }
    tool.write("long.ngc", program);
    const json summary = json::parse(tool("plan long.ngc --summary json --scalar double").output);
    CHECK(summary["what_would_help_moves"] == 10'000);
    REQUIRE_FALSE(summary["what_would_help"].empty());
    const json& first = summary["what_would_help"][0];
    CHECK(first["gain"].get<double>() > 0.01);
    CHECK(first["cycle_time_s"].get<double>() ==
          Approx(summary["cycle_time_s"].get<double>() * (1.0 - first["gain"].get<double>())));
    CHECK(summary["planning_time_s"].get<double>() > 0.0);
    tool.write("short.ngc", "F600 G1 X10\n");
    CHECK_FALSE(json::parse(tool("plan short.ngc --summary json").output).contains("what_would_help_moves"));
}

TEST_CASE("A path is planned without a look at it where its moves stay away from the ends of travel, and only there") {
    const Tool tool;
    tool.write("m.toml", path_text(100) + axis_text("x", "travel_mm = [0, 50]\n") + axis_text("y"));
    for (const char* const x : {"10", "49.9999", "50"}) {
        CAPTURE(x);
        tool.write("part.ngc", std::string("F900 G1 X") + x + "\nY1\nX5\n");
        CHECK(tool("plan part.ngc -m m.toml --quiet").status == 0);
    }
    tool.write("part.ngc", "F900 G1 X10\nY1\nX50.01\n");
    const Call call = tool("plan part.ngc -m m.toml --quiet --trace t.csv");
    CHECK(call.status == 2);
    CHECK(call.error.find("part.ngc:3: ") == 0);
    CHECK(call.error.find("axis x goes to 50.0") != std::string::npos);
}
