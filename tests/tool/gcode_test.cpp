// SPDX-License-Identifier: MIT
// Programs in G-code, as a user runs them.
#include "support/catch.hpp"
#include "support/places.hpp"
#include "tool.hpp"

#include <cmath>
#include <fmt/format.h>
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

TEST_CASE("Tool lengths come from the table of --tools") {
    const Tool tool;
    tool.write("tool.tbl", "T1 P1 Z10\nT2 P2 Z25.5\n");
    tool.write("lengths.ngc", "G21 G90 T1 M6 G43\nG1 Z0 F600\nG43 H2\nG1 Z0\nM2\n");
    const Call call = tool("plan lengths.ngc --tools tool.tbl --elements e.json --quiet");
    CAPTURE(call.error);
    REQUIRE(call.status == 0);
    const json elements = json::parse(tool.read("e.json"))["elements"];
    REQUIRE(elements.size() == 2);
    CHECK(elements[0]["to"][2].get<double>() == Approx(10.0));
    CHECK(elements[1]["to"][2].get<double>() == Approx(25.5));
    CHECK(tool("plan lengths.ngc --quiet").error.find("; --tools gives one") != std::string::npos);
}

TEST_CASE("A contour with cutter compensation ends with its file") {
    const Tool tool;
    tool.write("tool.tbl", "T3 P3 D4\n");
    tool.write("contour.ngc", "G21 G90 F600\nG42 D3 G1 X10\nX20\nY9\n");
    const Call call = tool("plan contour.ngc --tools tool.tbl --elements e.json --quiet");
    CAPTURE(call.error);
    REQUIRE(call.status == 0);
    const json elements = json::parse(tool.read("e.json"))["elements"];
    REQUIRE(elements.size() == 4);
    CHECK(elements[2]["type"] == "arc");
    CHECK(elements[3]["to"][0].get<double>() == Approx(22.0));
    CHECK(elements[3]["line_number"] == 4);
    tool.write("contour.ngc", "G21 G90 F600\nG41 D3 G1 X10\nX20\nY1\n");
    CHECK(tool("check contour.ngc --tools tool.tbl").output.find("contour.ngc:4: the tool would gouge") !=
          std::string::npos);
}

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

TEST_CASE("A rapid of rotary axes alone takes what their limits need") {
    const Tool tool;
    const auto axis = [](const char* name, const char* kind, int velocity) {
        return fmt::format("[[axis]]\nname = '{}'\nkind = '{}'\nmax_velocity_mm_s = {}\nmax_acceleration_mm_s2 = {}\n",
                           name, kind, velocity, 10 * velocity);
    };
    tool.write("m.toml", path_text(50) + axis("x", "linear", 100) + axis("y", "linear", 100) +
                             axis("a", "rotary", 360) + axis("c", "rotary", 180));
    const auto seconds = [&](const std::string& line) {
        tool.write("p.ngc", line + "\nM2\n");
        const json summary = summary_of(tool("run p.ngc -m m.toml --quiet --summary json"));
        CAPTURE(line, summary["optimum_time_s"].get<double>());
        CHECK(summary["cycle_time_s"].get<double>() >= summary["optimum_time_s"].get<double>());
        CHECK(summary["cycle_time_s"].get<double>() < 1.001 * summary["optimum_time_s"].get<double>() + 0.002);
        return summary["cycle_time_s"].get<double>();
    };
    CHECK(seconds("G0 A720") == Approx(2.1).margin(0.002));
    CHECK(seconds("G0 A720 C360") == Approx(2.1).margin(0.002));
    CHECK(seconds("G0 X10 A720") == Approx(2.1).margin(0.002));
    CHECK(seconds("G1 A720 F21600") == Approx(14.414).margin(0.003)); // a feed is 50 at most
    CHECK(seconds("G1 A720 F600") == Approx(72.003).margin(0.003));
}

TEST_CASE("A program from a pipe is the program from its file") {
    const Tool tool;
    const json file = summary_of(tool("run " + examples + "bracket.ngc' --quiet --summary json --segments a.csv"));
    const Call piped = tool.shell("cat " + examples + "bracket.ngc' | '" + tool_path() +
                                  "' run - --format gcode --quiet --summary json --segments b.csv");
    CHECK(summary_of(piped)["cycle_time_s"] == file["cycle_time_s"]);
    CHECK(tool.read("a.csv") == tool.read("b.csv"));
}

TEST_CASE("The power of a laser changes while it moves, in the dialects of engravers") {
    const Tool tool;
    std::string changing = "G1 F3000\n";
    std::string steady = changing + "S100\n";
    for (int i = 1; i <= 20; ++i) {
        const std::string x = "X" + std::to_string(i);
        changing += x + " S" + std::to_string(10 * i) + "\n";
        steady += x + "\n";
    }
    CHECK(seconds(tool, changing, "--dialect grbl") == Approx(seconds(tool, steady, "--dialect grbl")).margin(1e-9));
    CHECK(seconds(tool, changing, "--dialect linuxcnc") > seconds(tool, steady, "--dialect linuxcnc") + 0.1);
    tool.write("spindle.toml", path_text(100) + "[spindle]\nmax_rpm = 20000\nramp_s = 4\n" + axis_text("x"));
    CHECK(seconds(tool, "M3 S100\n" + changing, "--dialect grbl -m spindle.toml") >
          seconds(tool, "M3 S100\n" + steady, "--dialect grbl -m spindle.toml") + 0.1);
}

TEST_CASE("A sender that dies within a line: the line is not executed") {
    const Tool tool;
    const auto piped = [&](const std::string& text) {
        return tool.shell("printf '" + text + "' | '" + tool_path() + "' run - --format gcode --quiet --summary json");
    };
    const Call cut = piped("G1 X1 F600\\nG1 X2");
    CHECK(cut.status == 2);
    CHECK(cut.error.find("-:2: the input ends within this line, so it was not executed") == 0);
    CHECK(piped("O1 sub\\nG1 X1 F600\\nO1 endsub\\nO1 call").status == 2);
    CHECK(summary_of(piped("G1 X1 F600\\nM2"))["length_mm"] == 1.0);
}

TEST_CASE("What a curve through points or cutter compensation holds back is executed at the end of a pipe") {
    const Tool tool;
    std::string begin = "F6000\n"; // until the machine moves
    for (int i = 0; i < 20; ++i) {
        begin += "G1 X1\nX0\n";
    }
    const auto piped = [&](const std::string& text) {
        tool.write("part.ngc", begin + text);
        return tool.shell("cat part.ngc | '" + tool_path() +
                          "' run - --format gcode --window 32 --quiet --summary json");
    };
    const auto [held, place, next] = GENERATE(
        table<std::string, std::string, std::string>({{"G5.5 X1 Y0\nX2 Y1\nX3 Y1\n", "x=3.000000 y=1.000000", "X9"},
                                                      {"G5.5 X1 Y0\nX2 Y1\nX3 Y1\n", "x=3.000000 y=1.000000", "G1 X9"},
                                                      {"G5.5 X1 Y0\nX2 Y1\nX3 Y1\n", "x=3.000000 y=1.000000", "X9 M2"},
                                                      {"G5.5 X1 Y0\nX2 Y1\nX3 Y1\n", "x=3.000000 y=1.000000", "G1 X"},
                                                      {"G5.5 X1 Y0\nX2 Y1\nX3 Y1\n", "x=3.000000 y=1.000000", "o1 ca"},
                                                      {"G41.1 D2 G1 X10\nX20\n", "x=20.000000 y=1.000000", "Y9"}}));
    CAPTURE(held, next);
    const double length_mm = summary_of(piped(held))["length_mm"];
    CHECK(length_mm == summary_of(tool("run part.ngc --window 32 --quiet --summary json"))["length_mm"]);
    for (const std::string behind : {"M2", "%", "(note)", "G91"}) {
        CAPTURE(behind);
        CHECK(summary_of(piped(held + behind))["length_mm"] == length_mm);
    }
    const Call cut = piped(held + next);
    CHECK(cut.error.find(": the input ends within this line, so it was not executed") != std::string::npos);
    CHECK(cut.error.find("the machine stands at " + place) != std::string::npos);
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
    CHECK(seconds(tool, with("G4 P0.25\n")) == Approx(stopped + 0.25).margin(1e-9));
    CHECK(seconds(tool, with("M1\n")) == Approx(straight).margin(1e-9));
    CHECK(seconds(tool, with("M1\n"), "--optional-stop") == Approx(stopped).margin(1e-9));
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
    CHECK(error_of(tool, std::string("G1 \0X1 F100\n", 12)).find("part.ngc:1: the line holds a NUL byte; ") == 0);
    CHECK(error_of(tool, std::string(1'000'000, 'X')).find("part.ngc:1: the line is longer than") == 0);
    CHECK(error_of(tool, "G1 X" + std::string(200, '9') + " F100\n").find("part.ngc:1:4: ") == 0);
    CHECK(error_of(tool, "G1 X1 F100\n", "--curve g2").find("splinefeed: --curve: ") == 0);
    CHECK(error_of(tool, "G1 X1 F100\n", "--dialect mach3").find("splinefeed: --dialect 'mach3': ") == 0);
    CHECK(tool("run part.ngc --ignore G33 --quiet").status == 0);
    tool.write("part.csv", "0,0\n1,1\n");
    CHECK(tool("run part.csv --dialect grbl").error.find("splinefeed: --dialect: only a program in G-code has it") ==
          0);
    tool.write("m.toml", path_text(20) + axis_text("x", "travel_mm = [0, 50]\n"));
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

TEST_CASE("Subprograms, conditions and loops run as they are written") {
    const Tool tool;
    const auto ends_of = [&](const std::string& program) {
        tool.write("part.ngc", program);
        const Call call = tool("run part.ngc --quiet --summary json --elements e.json");
        CAPTURE(call.error);
        REQUIRE(call.status == 0);
        std::string ends;
        const json document = json::parse(tool.read("e.json"));
        for (const auto& element : document["elements"]) {
            ends += std::to_string(element["to"][0].get<int>()) + " ";
        }
        return ends;
    };
    CHECK(ends_of("F600\no1 repeat [3]\nG91 G1 X10\no1 endrepeat\nG90 X0\n") == "10 20 30 0 ");
    CHECK(ends_of("F600\n#1=0\no1 while [#1 LT 3]\n#1=[#1+1]\nG1 X[#1*10]\no1 endwhile\nX0\n") == "10 20 30 0 ");
    CHECK(ends_of("F600\n#1=0\no1 do\n#1=[#1+1]\nG1 X[#1]\no1 while [#1 LT 3]\nX0\n") == "1 2 3 0 ");
    CHECK(ends_of("F600\n#1=0\no1 while [1]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 elseif [#1 GT 4]\no1 break\n"
                  "o2 else\nG1 X[#1]\no2 endif\no1 endwhile\nX9\n") == "1 3 4 9 ");
    CHECK(ends_of("o<hole> sub\n#<x>=[#1+#2]\nG1 X#<x> F600\no10 if [#1 LE 0]\no<hole> return [7]\no10 endif\n"
                  "o<hole> call [#1-1] [#2]\nX[#1*100]\no<hole> endsub\n#1=5\no<hole> call [2] [20]\n"
                  "G1 X[#1*1000] F600\n") == "22 21 20 100 200 5000 ");
    CHECK(ends_of("o1 sub\nG1 X1 F600\no1 endsub\no2 sub\nG1 X2 F600\no2 endsub\n#5=2\no#5 call\no[#5-1] call\n") ==
          "2 1 ");
    CHECK(ends_of("o1 repeat [2]\no2 repeat [2]\nG91 G1 X1 F600\no2 endrepeat\no1 endrepeat\n") == "1 2 3 4 ");
}

TEST_CASE("Wrong O words are refused with their line, and a program that never ends, ends") {
    const Tool tool;
    CHECK(error_of(tool, "o1 call\n").find("part.ngc:1:2: there is no subprogram o1") == 0);
    CHECK(error_of(tool, "o1 while [1]\nG1 X1 F100\n").find("part.ngc:1:1: o1 has no end") == 0);
    CHECK(error_of(tool, "o1 endwhile\n").find("part.ngc:1:2: o1 has no begin") == 0);
    CHECK(error_of(tool, "o1 loop\n").find("part.ngc:1:4: an O word has a number or a <name>") == 0);
    CHECK(error_of(tool, "o1 if 1\no1 endif\n").find("part.ngc:1:7: a condition stands in brackets") == 0);
    CHECK(error_of(tool, "o1 sub\no1 call\no1 endsub\no1 call\n").find("nested more than 30 deep") !=
          std::string::npos);
    CHECK(error_of(tool, "o1 while [1]\no1 endwhile\n").find("does it ever end?") != std::string::npos);
    CHECK(error_of(tool, "o1 repeat [2]\nG1 X1 G33\no1 endrepeat\n").find("part.ngc:2:7: ") == 0);
}

TEST_CASE("The simulated spindle takes its time at standstill, and has the speeds of the machine file") {
    const Tool tool;
    tool.write("plain.toml", path_text(100) + axis_text("x"));
    tool.write("spindle.toml", path_text(100) + "[spindle]\nmax_rpm = 20000\nramp_s = 4\n" + axis_text("x"));
    const std::string program = "G1 X10 F3000\nS10000 M3\nX20\nM5\nX30\nM2\n";
    const double waiting_s = seconds(tool, program, "-m spindle.toml");
    CHECK(waiting_s == Approx(seconds(tool, "G61.1\n" + program, "-m plain.toml") + 4.0).margin(0.01));
    const std::string stops = "G1 X10 F3000\nS10000 M3\nX20\nM5 S0\nX30\nS20000 M3\nM5 S10000\nM2\n"; // S is for later
    CHECK(seconds(tool, stops, "-m spindle.toml") == Approx(waiting_s + 8.0).margin(0.01));
    CHECK(
        error_of(tool, "S30000 M3\nG1 X10 F3000\nM2\n", "-m spindle.toml") ==
        "part.ngc:1: the spindle would turn with S30000; S must be at most 20000, as [spindle] of the machine file has "
        "it, or 0 to stand\n");
    // S0 in between: 2 s down and 2 s up; at the begin it takes no time
    CHECK(seconds(tool, "M3 S0\nS10000\nG1 X10 F3000\nS0\nX20\nS10000\nX30\nM5\nM2\n", "-m spindle.toml") ==
          Approx(seconds(tool, "M3 S10000\nG1 X10 F3000\nM5\nX20\nM3\nX30\nM5\nM2\n", "-m spindle.toml")).margin(0.01));
    tool.write("part.ngc", "S30000 M3\nG1 X10 F3000\nM2\n");
    const Call checked = tool("check part.ngc -m spindle.toml");
    CHECK(checked.status == 1);
    CHECK(checked.output.find("part.ngc:1: the spindle would turn with S30000") != std::string::npos);
}

TEST_CASE("Q of G64 bounds the chains of short moves, also by way of --elements") {
    const Tool tool;
    std::string machine; // the default one
    const auto run = [&](const std::string& mode) {
        std::string program = "G1 F3000 " + mode + "\n";
        for (int i = 1; i <= 200; ++i) {
            program += "X" + std::to_string(0.1 * i) + " Y" + std::to_string(0.3 * std::sin(0.25 * i)) + "\n";
        }
        tool.write("part.ngc", program + "M2\n");
        const json summary = summary_of(tool("run part.ngc --quiet --summary json --elements e.json" + machine));
        const json again = summary_of(tool("run e.json --quiet --summary json" + machine));
        CHECK(again["tolerance"]["deviation_mm"]["distance"] == summary["tolerance"]["deviation_mm"]["distance"]);
        CHECK(again["tolerance"]["pieces"] == summary["tolerance"]["pieces"]);
        return summary["tolerance"];
    };
    const json usual = run("G64 P0.02");
    CHECK(run("G64 P0.02 Q0.015") == usual);
    const json wide = run("G64 P0.02 Q0.02");
    CHECK(run("G64 P0.02 Q0.5") == wide);
    CHECK(usual["deviation_mm"]["distance"].get<double>() < 0.015);
    CHECK(wide["deviation_mm"]["distance"].get<double>() > 0.006);
    const json fine = run("G64 P0.02 Q0.003");
    CHECK(fine["chains"].get<int>() > 0);
    CHECK(fine["deviation_mm"]["distance"].get<double>() <= 0.003);
    CHECK(run("G64 P0.02 Q0")["chains"] == 0);
    machine = " -m " + examples + "jerk_limited.toml'";
    CHECK(run("G64 P0.02") == run("G64 P0.02 Q0.02"));
}

TEST_CASE("A line may be as long as lines are, and have a comment behind it") {
    const Tool tool;
    const auto line = [](std::size_t characters) {
        std::string text = "G1 X10 F3000";
        return text + std::string(characters - text.size(), ' ') + ";" + std::string(300, 'c') + "\n";
    };
    CHECK(seconds(tool, line(255)) > 0.0);
    CHECK(seconds(tool, line(256)) > 0.0);
    CHECK(error_of(tool, line(257)).rfind("part.ngc:1:257: ", 0) == 0);
}

TEST_CASE("A dwell behind a message takes its time") {
    const Tool tool;
    const double without_s = seconds(tool, "G64\nG1 X10 F3000\nG4 P2\nX20\nM2\n", "");
    CHECK(seconds(tool, "G64\nG1 X10 F3000\n(MSG,a)\nS100\nG4 P2\nX20\nM2\n", "") == Approx(without_s).margin(1e-6));
}

TEST_CASE("A tool change stops the spindle, as in LinuxCNC") {
    const Tool tool;
    tool.write("spindle.toml", path_text(100) + "[spindle]\nmax_rpm = 20000\nramp_s = 4\n" + axis_text("x"));
    const double on_s = seconds(tool, "S10000 M3\nG1 X10 F3000\nM0\nX20\nM2\n", "-m spindle.toml");
    const double changed_s = seconds(tool, "S10000 M3\nG1 X10 F3000\nT2 M6\nX20\nM2\n", "-m spindle.toml");
    CHECK(changed_s == Approx(on_s + 2.0).margin(0.01));
    CHECK(seconds(tool, "S10000 M3\nG1 X10 F3000\nT2 M6\nS5000\nX20\nM2\n", "-m spindle.toml") ==
          Approx(changed_s).margin(0.01));
}
