// SPDX-License-Identifier: MIT
// Where the zero of a program lies on the machine: --zero, and what is said where it lies outside the travel.
#include "support/catch.hpp"
#include "support/places.hpp"
#include "tool.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <random>

using namespace splinefeed::test;
using json = nlohmann::json;

namespace {

/// As grbl's settings become: the machine's space ends at 0.
const std::string router = path_text(100) + axis_text("x", "travel_mm = [-780, 0]\n") +
                           axis_text("y", "travel_mm = [-790, 0]\n") + axis_text("z", "travel_mm = [-80, 0]\n");
const std::string part = "G21 G90\nG0 Z15\nG0 X0 Y3\nG1 Z-4.4 F333\nG1 X60 Y60 F1000\nG0 Z15\nM30\n";
const std::string advice = "the program fits if the part's zero lies within X -780..-60, Y -793..-60, Z -75.6..-15: "
                           "add --zero=";

} // namespace

TEST_CASE("A program that another zero brings into the travel is one problem, which says where that may lie") {
    const Tool tool;
    tool.write("m.toml", router);
    tool.write("part.nc", part);
    const Call check = tool("check part.nc -m m.toml --dialect grbl");
    CHECK(check.status == 1);
    CHECK(check.output.find("part.nc:2: axis z goes to 15.0000 mm, above the end of its travel at 0.0000 mm") == 0);
    CHECK(contains(check.output, advice));
    CHECK(contains(check.output, "\n1 problem\n"));
    for (const char* const command : {"plan", "run"}) {
        const Call call = tool(std::string(command) + " part.nc -m m.toml --dialect grbl");
        CHECK(call.status == 2);
        CHECK(contains(call.error, "part.nc:2: axis z goes to "));
        CHECK(contains(call.error, advice));
    }
    // As it says, and at the corners of what it says; a hundredth beyond is outside.
    for (const char* const zero : {"-420,-427,-45", "-780,-793,-75.6", "-60,-60,-15", "-780,-60,-15"}) {
        for (const char* const command : {"check", "plan", "run"}) {
            CAPTURE(zero, command);
            CHECK(tool(fmt::format("{} part.nc -m m.toml --dialect grbl --zero={}", command, zero)).status == 0);
        }
    }
    for (const char* const zero : {"-780.01,-400,-45", "-59.99,-400,-45", "-400,-793.01,-45", "-400,-59.99,-45",
                                   "-400,-400,-75.61", "-400,-400,-14.99"}) {
        CAPTURE(zero);
        const Call call = tool(fmt::format("check part.nc -m m.toml --dialect grbl --zero={}", zero));
        CHECK(call.status == 1);
        CHECK(contains(call.output, "of its travel at ")); // the place is told, since the zero is
        CHECK(contains(call.output, "\npart.nc: " + advice));
    }
    const json summary =
        json::parse(tool("plan part.nc -m m.toml --dialect grbl --zero=-400,-300,-45.5 --summary json").output);
    CHECK(summary["zero_mm"] == json{{"x", -400.0}, {"y", -300.0}, {"z", -45.5}});
    CHECK(summary["travel_mm"]["z"] == json({-80.0, 0.0}));
    REQUIRE(tool("run part.nc -m m.toml --zero=-400,-300,-45.5 --quiet --elements e.json").status == 0);
    CHECK(json::parse(tool.read("e.json"))["elements"].back()["to"] == json({-340.0, -240.0, -30.5}));
}

TEST_CASE("Only what the zero moves counts: not G53, G28 and steps from where the machine stands") {
    const Tool tool;
    tool.write("m.toml", router);
    tool.write("part.nc", "G53 G0 Z-2\nG0 X10 Y10\nG1 Z-5 F300\nG2 I5\nG53 G0 Z0\nG28\n");
    CHECK(contains(tool("check part.nc -m m.toml").output, "lies within X -790..-20, Y -795..-15, Z -75..5:"));
    CHECK(tool("check part.nc -m m.toml --zero=-20,-795,5").status == 0);
    for (const char* const fixed : {"G53 G0 X5\n", "G91 G0 X5\n", "#1=[#5221*2]\nG0 X#1\n"}) {
        tool.write("fixed.nc", std::string("G0 Y-5\n") + fixed + "G90 G0 X7\n");
        CAPTURE(fixed);
        CHECK_FALSE(contains(tool("check fixed.nc -m m.toml").output, "zero"));
    }
    tool.write("long.nc", "G0 X1\nG1 X800 F1000\n");
    CHECK(contains(tool("check long.nc -m m.toml").output,
                   "\nlong.nc: no zero helps: the program goes 799 mm along X, and the travel is 780 mm\n"));
    tool.write("mixed.nc", "G0 X1\nG999\n");
    CHECK(contains(tool("check mixed.nc -m m.toml").output, "\n2 problems\n"));
    // Who has offsets has said where the zero lies: every place is told.
    tool.write("set.nc", "G10 L2 P1 X-10 Y0 Z0\nG0 X5\nM30\n");
    REQUIRE(tool("run set.nc -m m.toml --state s.json --quiet").status == 0);
    tool.write("part.nc", part);
    const Call told = tool("check part.nc -m m.toml --state s.json");
    CHECK(contains(told.output, "\n10 problems\n"));
    CHECK(contains(told.output, "\npart.nc: " + advice));
    CHECK(tool("check part.nc -m m.toml --state s.json --zero=-420,-427,-45").status == 0);
}

TEST_CASE("Of random programs of lines and arcs the ranges are right: within them is no problem, beyond is one") {
    const Tool tool;
    tool.write("m.toml", router);
    std::mt19937 random(57);
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int round = 0; round < 12; ++round) {
        std::string program = round % 2 == 0 ? "G21 G90\n" : "G20 G90\n";
        const double unit = round % 2 == 0 ? 1.0 : 25.4;
        program += "G0 X0 Y0 Z1\n";
        for (int move = 0; move < 6; ++move) {
            const double x = number(-200.0, 200.0) / unit;
            const double y = number(-200.0, 200.0) / unit;
            program += move % 3 == 2 ? fmt::format("G3 I{:.3f} J{:.3f} F900\n", x / 4.0, y / 4.0)
                                     : fmt::format("G1 X{:.3f} Y{:.3f} Z{:.3f} F900\n", x, y, number(-9.0, 9.0) / unit);
        }
        tool.write("p.nc", program);
        const std::string said = tool("check p.nc -m m.toml").output;
        CAPTURE(program, said);
        double low[3] = {};
        double high[3] = {};
        const std::size_t at = said.find("lies within X ");
        REQUIRE(at != std::string::npos);
        std::string ends = said.substr(at);
        for (std::size_t dots = 0; (dots = ends.find("..", dots)) != std::string::npos;) {
            ends.replace(dots, 2, " ");
        }
        REQUIRE(std::sscanf(ends.c_str(), "lies within X %lf %lf, Y %lf %lf, Z %lf %lf", &low[0], &high[0], &low[1],
                            &high[1], &low[2], &high[2]) == 6);
        double zero[3];
        for (int k = 0; k < 3; ++k) {
            zero[k] = number(low[k], high[k]);
        }
        const int axis = round % 3;
        for (const auto& [place, status] : {std::pair{zero[axis], 0},
                                            {low[axis], 0},
                                            {high[axis], 0},
                                            {low[axis] - 0.002, 1},
                                            {high[axis] + 0.002, 1}}) {
            zero[axis] = place;
            CAPTURE(axis, place);
            CHECK(tool(fmt::format("check p.nc -m m.toml --zero={:.6f},{:.6f},{:.6f}", zero[0], zero[1], zero[2]))
                      .status == status);
        }
    }
}

TEST_CASE("--zero is refused where it says nothing") {
    const Tool tool;
    tool.write("a.ngc", "G0 X1\n");
    tool.write("a.csv", "0,0,0\n1,1,1\n");
    CHECK(tool("plan a.ngc --zero 1,2").error ==
          "splinefeed: --zero '1,2': it must be a number for each axis, x,y,z\n");
    CHECK(tool("check a.ngc --zero 1,2,3e9").error ==
          "splinefeed: --zero '1,2,3e9': z is out of range; a position must lie within +-1048576 mm\n");
    CHECK(tool("plan a.csv --zero 1,2,3").error == "splinefeed: --zero is of programs in G-code; other inputs have "
                                                   "the machine's coordinates: leave it out\n");
}
