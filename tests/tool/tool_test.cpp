// SPDX-License-Identifier: MIT
#include "tool.hpp"

#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/places.hpp"

#include <algorithm>

using namespace splinefeed::test;

namespace {

const std::string square = "x,y,z\n0,0,0\n100,0,0\n100,100,0\n0,100,0\n0,0,0\n";
const std::string steps = "steps_per_mm = 320\n";
const std::string machine =
    path_text(100) + axis_text("x", steps + "travel_mm = [0, 100]\n") + axis_text("y", steps) + axis_text("z", steps);

std::size_t lines(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

} // namespace

TEST_CASE("A run writes its outputs and says what it did") {
    const Tool tool;
    tool.write("square.csv", square);
    tool.write("machine.toml", machine);
    for (const std::string scalar : {"fixed", "float", "double"}) {
        for (const std::string curve : {"g2", "catmull-rom", "polyline"}) {
            const Call call = tool("run square.csv -m machine.toml --scalar " + scalar + " --curve " + curve +
                                   " --trace t.csv --segments s.csv --curve-out c.json --summary json");
            CAPTURE(scalar, curve, call.error);
            CHECK(call.status == 0);
            CHECK(call.error.empty());
            CHECK(contains(call.output, "\"stopped\": false"));
            CHECK(contains(call.output, "\"waypoints\": 5"));
            CHECK(tool.read("t.csv").substr(0, 14) == "t,x,y,z,speed\n");
            CHECK(lines(tool.read("t.csv")) > 4000);
            CHECK(contains(tool.read("s.csv"), "index,duration_ticks,x_start"));
            CHECK(contains(tool.read("c.json"), "\"segments\""));
        }
    }
    // A plan moves nothing, but is the same.
    const std::string trace = tool.read("t.csv");
    CHECK(tool("plan square.csv -m machine.toml --scalar double --curve polyline --trace p.csv").status == 0);
    CHECK(tool.read("p.csv") == trace);
}

TEST_CASE("Warnings go to standard error, a line each, unless --quiet") {
    const Tool tool;
    tool.write("twice.json", R"({"method": "ferguson", "input": {"points": [[0, 0], [10, 5], [10, 5], [20, 0]]}})");
    for (const std::string command : {"curve ", "run ", "plan "}) {
        const Call call = tool(command + "twice.json");
        CAPTURE(command, call.error);
        CHECK(call.status == 0);
        CHECK(call.error == "twice.json: warning: points 2 and 3 are the same: the curve makes a small loop there\n");
        CHECK(tool(command + "twice.json --quiet").error.empty());
    }
    CHECK(contains(tool("curve --quiet twice.json").output, "\"warnings\""));
}

TEST_CASE("Waypoints within 0.1 um are one for curves of all points, too") {
    const Tool tool;
    tool.write("near.csv", "0,0,0\n10,5,0\n10.00005,5,0\n20,0,0\n30,5,0\n0.00005,0,0\n");
    for (const std::string method : {"ferguson", "bspline-interpolation", "g2 --corner-angle 180"}) {
        const Call call = tool("curve near.csv --closed --curve " + method);
        CAPTURE(method, call.error);
        REQUIRE(call.status == 0);
        CHECK(nlohmann::json::parse(call.output)["segments"].size() == 4);
    }
    const Call cusp = tool("curve near.csv --curve ferguson --start-tangent 0,0 --end-tangent 500,0");
    CAPTURE(cusp.error);
    CHECK(cusp.status == 0);
}

TEST_CASE("A closed file that repeats its first point says with that row how the path closes") {
    const Tool tool;
    const std::string rows = "20,0,50,0\n20,20,50,0\n0,20,50,0\n";
    const auto segments = [&](const std::string& text) {
        tool.write("path.csv", "x,y,feed,corner\n" + text);
        const Call call = tool("plan path.csv --closed --corner-angle 180 --segments segments.csv");
        CAPTURE(call.error);
        CHECK(call.status == 0);
        return tool.read("segments.csv");
    };
    // Nothing leads to the first row, and so its feed says nothing
    const std::string slow_corner = segments("0,0,50,0\n" + rows + "0,0,5,1\n");
    CHECK(slow_corner == segments("0,0,5,1\n" + rows));
    CHECK(slow_corner == segments("0,0,5,1\n" + rows + "0,0,5,\n"));
    CHECK(slow_corner != segments("0,0,50,1\n" + rows));
    CHECK(slow_corner != segments("0,0,5,0\n" + rows));
}

TEST_CASE("A B-spline of control points runs, open and closed, and has no waypoint error") {
    const Tool tool;
    tool.write("square.csv", square);
    for (const std::string options : {"", "--degree 2", "--closed", "--closed --degree 2", "--corner-angle 60"}) {
        const Call call = tool("run square.csv --curve bspline " + options + " --summary json");
        CAPTURE(options, call.error);
        CHECK(call.status == 0);
        CHECK(contains(call.output, "\"waypoint_error_mm\": null"));
        CHECK(contains(call.output, options == "--corner-angle 60" ? "\"stops\": 3" : "\"stops\": 0"));
    }
    CHECK(contains(tool("run square.csv --curve bspline").output, "The waypoints are control points"));
    CHECK(contains(tool("run square.csv --curve g2 --summary json").output, "\"waypoint_error_mm\": 0.0"));
    // The hull of all control points is beyond the travel, the curve is not; then it is, and nothing moves.
    tool.write("hill.csv", "x,y,z\n0,0,0\n30,0,0\n60,140,0\n90,0,0\n120,0,0\n");
    for (const auto& [file, top] : {std::pair{"high.toml", "70.001"}, std::pair{"low.toml", "69.99"}}) {
        const std::string travel = std::string("travel_mm = [0, ") + top + "]\n";
        tool.write(file,
                   path_text(100) + axis_text("x", steps) + axis_text("y", steps + travel) + axis_text("z", steps));
    }
    CHECK(tool("run hill.csv -m high.toml --curve bspline").status == 0); // its top is (0 + 2 * 140 + 0) / 4
    const Call refused = tool("run hill.csv -m low.toml --curve bspline --trace t.csv");
    CHECK(refused.status == 2);
    CHECK(contains(refused.error, "axis y goes to 70.000000 mm; its travel_mm is [0, 69.99]"));
    CHECK(tool.read("t.csv").empty());
}

TEST_CASE("Boehm's method by both its names; a cusp is told") {
    const Tool tool;
    for (const std::string name : {"boehm", "bspline"}) {
        tool.write("cusp.json", "{\"method\": \"" + name +
                                    "\", \"input\": {\"degree\": 3, \"closed\": false, \"vertices\": [[0, 0], [3, 3], "
                                    "[6, 0], [6, 0], [6, 0], [9, 3], [12, 0]]}}");
        const Call call = tool("curve cusp.json --scalar double");
        CHECK(call.status == 0);
        CHECK(contains(call.output, "\"curve\": \"bspline\""));
        CHECK(contains(call.output, "C2+singular"));
    }
}

TEST_CASE("What curve prints can be run") {
    const Tool tool;
    tool.write("path.csv", "0,0\n10,5\n20,0\n30,5\n");
    const Call printed = tool("curve path.csv");
    CHECK(printed.status == 0);
    CHECK(contains(printed.output, "\"curve\": \"g2\""));
    CHECK(tool("curve path.csv -o path.json").output.empty());
    CHECK(tool.read("path.json") == printed.output);
    CHECK(tool("run path.json --summary json").status == 0);
    CHECK(tool("curve path.csv --closed -o closed.json").status == 0);
    CHECK(tool("run closed.json").status == 0);
    CHECK(contains(tool.read("closed.json"), "\"closed\": true"));
    tool.write("rom.json",
               R"({"method": "catmull_rom", "input": {"tension": "0.5", "points": [[0, 0], [1, 1], [2, 0]]}})");
    CHECK(contains(tool("curve rom.json").output, "\"curve\": \"catmull-rom\""));
}

TEST_CASE("Help and version are answers") {
    const Tool tool;
    for (const std::string arguments : {"--help", "run --help", "plan --help", "curve --help", "--version"}) {
        const Call call = tool(arguments);
        CAPTURE(arguments);
        CHECK(call.status == 0);
        CHECK(call.error.empty());
        CHECK(contains(call.output, "splinefeed"));
    }
    CHECK(contains(tool("run --help").output, "Example"));
}

TEST_CASE("Bad input gets one line and status 2, and nothing is written, however late it comes") {
    const Tool tool;
    tool.write("machine.toml", machine);
    const std::string outputs = " -m machine.toml --trace t.csv --segments s.csv --curve-out c.json";
    std::string late = "x,y\n";
    for (int i = 0; i < 50000; ++i) {
        late += std::to_string(i % 100) + "," + std::to_string(i % 7) + "\n";
    }
    tool.write("p.csv", late + "1,nan\n");
    for (const std::string command : {"run", "plan"}) {
        const Call call = tool(command + " p.csv" + outputs);
        CAPTURE(command, call.error);
        CHECK(call.status == 2);
        CHECK(call.output.empty());
        CHECK(lines(call.error) == 1);
        CHECK(contains(call.error, "p.csv:50002: "));
        CHECK(tool.holds_only("p.csv machine.toml"));
    }
}

TEST_CASE("A pipe moves the machine before it ends") {
    const Tool tool;
    // The writer waits for the first feed segments before it sends the rest.
    const Call call = tool.shell("mkfifo in && { '" + splinefeed::test::tool_path() +
                                 "' run in --format csv --segments - --quiet > s.csv & } && "
                                 "tool=$! && exec 3>in && "
                                 "awk 'BEGIN { for (i = 0; i < 12000; ++i) print i * 0.05 \",0\" }' >&3 && "
                                 "for i in $(seq 100); do [ $(wc -l < s.csv) -gt 100 ] && break; sleep 0.1; done && "
                                 "moved=$(wc -l < s.csv) && "
                                 "kill -0 $tool && echo 601,0 >&3 && exec 3>&- && wait $tool && [ $moved -gt 100 ]");
    CAPTURE(call.error);
    CHECK(call.status == 0);
}

TEST_CASE("What is wrong in a pipe after the first move ends in a controlled stop") {
    const Tool tool;
    tool.write("machine.toml", machine);
    // 12000 waypoints are more than the window of the feed plan holds.
    const std::string rows = "awk 'BEGIN { for (i = 0; i < 12000; ++i) print i * 0.008 \",\" 0; ";
    for (const auto& [last, part] : {std::pair{"print \"1,nan\" }'", "-:12001: y 'nan'"},
                                     std::pair{"print \"150,1\"; print \"0,1\" }'", "-:12001: axis x goes to"}}) {
        const Call call = tool.shell(rows + last + " | '" + splinefeed::test::tool_path() +
                                     "' run - -m machine.toml --trace t.csv --summary json");
        CAPTURE(last, call.error);
        CHECK(call.status == 1);
        CHECK(lines(call.error) == 1);
        CHECK(contains(call.error, part));
        CHECK(contains(call.error, "the machine stands at x=95.9"));
        CHECK(contains(call.output, "\"stopped\": true"));
        CHECK(contains(call.output, "\"optimum_time_s\": null"));
        CHECK(lines(tool.read("t.csv")) > 900);
    }
}
