// SPDX-License-Identifier: MIT
// The moves are those that LinuxCNC 2.9 makes of the same lines.
#include "support/gcode.hpp"

using namespace splinefeed_test;

TEST_CASE("drilling", "[program][cycle]") {
    GcodeRun<double> run;
    run.run("F1800 G0 Z12");
    CHECK(run.text("G99 G81 X10 Y10 Z-4 R1") == "rapid 10 10 12\nrapid 10 10 1\nfeed 10 10 -4\nrapid 10 10 1");
    CHECK(run.text("X20") == "rapid 20 10 1\nfeed 20 10 -4\nrapid 20 10 1");
    CHECK(run.text("X30 R2") == "rapid 30 10 2\nfeed 30 10 -4\nrapid 30 10 2");
    CHECK(run.text("G98 X40") == "rapid 40 10 12\nrapid 40 10 2\nfeed 40 10 -4\nrapid 40 10 12");
    CHECK(run.text("G99 G82 X30 Z-3 R1 P0.15") ==
          "rapid 30 10 12\nrapid 30 10 1\nfeed 30 10 -3\ndwell 0.15\nrapid 30 10 1");
    CHECK(run.items().front().element.mode == PathMode::exact_path);
    CHECK(run.text("G80\nG0 X0") == "rapid 0 10 1");
    CHECK(run.items().back().element.mode == PathMode::continuous);
}

TEST_CASE("a series that begins below R is lifted first", "[program][cycle]") {
    GcodeRun<double> run;
    run.run("F1800 G0 X1 Z-3");
    CHECK(run.text("G99 G81 X10 Y10 Z-4 R1") == "rapid 1 0 1\nrapid 10 10 1\nfeed 10 10 -4\nrapid 10 10 1");
    CHECK(run.items()[0].element.mode == PathMode::continuous);
    CHECK(run.text("G98 X30") == "rapid 10 10 1\nrapid 30 10 1\nfeed 30 10 -4\nrapid 30 10 1");
}

TEST_CASE("pecks", "[program][cycle]") {
    GcodeRun<double> run;
    run.run("F1800 G0 Z12");
    CHECK(run.text("G98 G83 X10 Z-4 R1 Q2") ==
          "rapid 10 0 12\nrapid 10 0 1\nfeed 10 0 -1\nrapid 10 0 1\nrapid 10 0 -0.746\nfeed 10 0 -3\nrapid 10 0 1\n"
          "rapid 10 0 -2.746\nfeed 10 0 -4\nrapid 10 0 12");
    CHECK(run.text("G99 G73 X20 Z-2 R1 Q1.5") ==
          "rapid 20 0 12\nrapid 20 0 1\nfeed 20 0 -0.5\nrapid 20 0 -0.246\nfeed 20 0 -2\nrapid 20 0 1");
}

TEST_CASE("boring", "[program][cycle]") {
    GcodeRun<double> run;
    run.run("F1800 G0 Z12 M3 S100");
    const std::string stop = "event " + std::to_string(static_cast<int>(EventKind::spindle_stop)) + " stop 0 100";
    const std::string start = "event " + std::to_string(static_cast<int>(EventKind::spindle_clockwise)) + " stop 0 100";
    CHECK(run.text("G98 G85 X40 Z-3 R1") == "rapid 40 0 12\nrapid 40 0 1\nfeed 40 0 -3\nfeed 40 0 1\nrapid 40 0 12");
    CHECK(run.text("G89 X30 Z-2 R1 P0.2") == "rapid 30 0 12\nrapid 30 0 1\nfeed 30 0 -2\ndwell 0.2\nfeed 30 0 12");
    CHECK(run.text("G86 X1 R1 Z-1 P0.1") ==
          "rapid 1 0 12\nrapid 1 0 1\nfeed 1 0 -1\ndwell 0.1\n" + stop + "\nrapid 1 0 12\n" + start);
}

TEST_CASE("tapping with a floating chuck", "[program][cycle]") {
    const auto event = [](EventKind kind) {
        return "event " + std::to_string(static_cast<int>(kind)) + " stop 0 100\n";
    };
    const std::string stop = event(EventKind::spindle_stop);
    const std::string right = event(EventKind::spindle_clockwise);
    const std::string left = event(EventKind::spindle_counterclockwise);
    GcodeRun<double> run;
    run.run("F1800 G0 Z12 M3 S100");
    CHECK(run.text("G98 G84 X40 Z-3 R1") + "\n" ==
          "rapid 40 0 12\nrapid 40 0 1\nturning 40 0 -3\n" + stop + left + "turning 40 0 12\n" + stop + right);
    CHECK(run.items()[2].element.feed_mm_s == 30.0);
    CHECK(run.text("G99 X30 P0.5") + "\n" == "rapid 30 0 12\nrapid 30 0 1\nturning 30 0 -3\n" + stop + left +
                                                 "dwell 0.5\nturning 30 0 1\n" + stop + right);
    run.run("G80 M4");
    CHECK(run.text("G74 X20 Z-2 R1 P0") + "\n" ==
          "rapid 20 0 1\nturning 20 0 -2\n" + stop + right + "turning 20 0 1\n" + stop + left);
    CHECK(run.push("M3 X5").error == ProgramError::tapping_direction);
}

TEST_CASE("increments and repeats", "[program][cycle]") {
    GcodeRun<double> run;
    run.run("F1800 G0 X5 Y10 Z3 G91");
    CHECK(
        run.text("G98 G81 X1 Z-2 R-1 L2") ==
        "rapid 6 10 3\nrapid 6 10 2\nfeed 6 10 0\nrapid 6 10 3\nrapid 7 10 3\nrapid 7 10 2\nfeed 7 10 0\nrapid 7 10 3");
    CHECK(run.text("X1") == "rapid 8 10 3\nrapid 8 10 2\nfeed 8 10 0\nrapid 8 10 3");
}

TEST_CASE("cycles in other planes and in a turned system", "[program][cycle]") {
    GcodeRun<double> run;
    run.run("F1800 G18 G0 Y5");
    CHECK(run.text("G98 G81 X1 Z3 Y-1 R2") == "rapid 1 5 3\nrapid 1 2 3\nfeed 1 -1 3\nrapid 1 5 3");
    run.run("G80 G17 G10 L2 P1 R90 X0 Y0\nG0 X0 Y0 Z5");
    CHECK(run.text("G81 X10 Z-1 R1") == "rapid 0 10 5\nrapid 0 10 1\nfeed 0 10 -1\nrapid 0 10 5");
}
