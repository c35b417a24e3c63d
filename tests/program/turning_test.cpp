// SPDX-License-Identifier: MIT
// Feeds that go with the turns of the spindle, and the words of lathes.
#include "support/gcode.hpp"

using namespace splinefeed_test;

namespace {

double feed_of(GcodeRun<double>& run, const std::string& line) {
    return run.run(line).back().element.feed_mm_s;
}

std::string turn(EventKind kind, int speed) {
    return "event " + std::to_string(static_cast<int>(kind)) + " stop 0 " + std::to_string(speed) + "\n";
}

} // namespace

TEST_CASE("G95: the feed is F for each turn of the spindle at the speed that was told", "[program][turning]") {
    GcodeRun<double> run;
    CHECK(feed_of(run, "G95 S600 M3 G1 X1 F0.25") == 2.5);
    CHECK(feed_of(run, "X2 S1200") == 5.0);
    CHECK(feed_of(run, "G2 X4 I1") == 5.0);
    CHECK(feed_of(run, "G20 G1 X5 F0.01") == Approx(0.2)); // F is in the units of the blocks before
    CHECK(feed_of(run, "X6 F0.01") == Approx(5.08));
    CHECK(run.push("G94 X7").error == ProgramError::feed_missing); // as in LinuxCNC
    CHECK(feed_of(run, "G94 F60 X7") == Approx(25.4));
    CHECK(run.push("G95 X8").error == ProgramError::feed_missing);
    CHECK(run.text("M2") != "");
    CHECK_FALSE(run.interpreter().modal().per_turn);
    CHECK(run.interpreter().modal().feed == Decimal::from_integer(1524)); // F of G94 stays, one of G95 does not
    GcodeRun<double> turning;
    CHECK(turning.text("G95 S600 M3 G1 X1 F0.25 M30") != "");
    CHECK(turning.interpreter().modal().feed.raw == 0);
}

TEST_CASE("G33 travels K for each turn, along the line", "[program][turning]") {
    GcodeRun<double> run;
    run.run("S300 M3 G0 X10");
    CHECK(run.text("G33 Z-20 K1.5") == "turning 10 0 -20");
    CHECK(run.items()[0].element.feed_mm_s == 7.5);
    CHECK(run.items()[0].stops_before); // for the mark of the spindle
    CHECK(run.text("X12 Z-30 K1") == "turning 12 0 -30");
    CHECK(run.items()[0].element.feed_mm_s == 5.0);
    CHECK_FALSE(run.items()[0].stops_before); // the thread goes on
    CHECK(run.push("Z-40").error == ProgramError::turn_way_missing);
    CHECK(run.push("M5 Z-40 K1").error == ProgramError::spindle_stands);
    run.run("G0 Z0");
    CHECK(run.text("G20 G33 Z-1 K0.1") == "turning 12 0 -25.4");
    CHECK(run.items()[0].element.feed_mm_s == Approx(12.7));
    CHECK(run.items()[0].stops_before);
    run.run("G41.1 D1 G0 X1");
    CHECK(run.push("G33 X2 K1").error == ProgramError::cutter_active);
}

TEST_CASE("G33.1 goes in, and out again with a spindle that turns back", "[program][turning]") {
    GcodeRun<double> run;
    run.run("S300 M3 G0 X10 Z5");
    CHECK(run.text("G33.1 Z-20 K1") + "\n" == "turning 10 0 -20\n" + turn(EventKind::spindle_counterclockwise, 300) +
                                                  "turning 10 0 5\n" + turn(EventKind::spindle_clockwise, 300));
    CHECK(run.items()[0].element.feed_mm_s == 5.0);
    CHECK(run.items()[0].element.stop_at_end);
    CHECK(run.items()[2].element.feed_mm_s == 5.0);
    run.run("M4");
    CHECK(run.text("Z-20 K1 I2") + "\n" == "turning 10 0 -20\n" + turn(EventKind::spindle_clockwise, 600) +
                                               "turning 10 0 5\n" + turn(EventKind::spindle_counterclockwise, 300));
    CHECK(run.items()[2].element.feed_mm_s == 10.0);
    CHECK(run.text("G0 X11") == "rapid 11 0 5");
}

TEST_CASE("M19 stops the spindle at an angle", "[program][turning]") {
    GcodeRun<double> run;
    run.run("S300 M3");
    const std::string event = "event " + std::to_string(static_cast<int>(EventKind::spindle_orient)) + " stop ";
    CHECK(run.text("M19 R90.5 P2 Q3") == event + "2 90.5");
    CHECK(run.push("G33 Z-5 K1").error == ProgramError::spindle_stands);
    CHECK(run.text("M19") == event + "0 0");
}

TEST_CASE("G33 of fanuc has its lead in F, which stays no feed", "[program][turning]") {
    ProgramSettings settings = six_axes();
    settings.dialect = Dialect::fanuc;
    GcodeRun<double> run(settings);
    run.run("F100 S300 M3 G0 X10");
    CHECK(run.text("G33 Z-20. F1.5") == "turning 10 0 -20");
    CHECK(run.items()[0].element.feed_mm_s == 7.5);
    CHECK(run.push("Z-30.").error == ProgramError::turn_way_missing);
    run.run("G1 X11");
    CHECK(run.items()[0].element.feed_mm_s == Approx(100.0 / 60));
    CHECK(run.push("G32 Z-20. F1.5").error == ProgramError::thread_unsupported);
    CHECK(run.push("G33.1 Z-20. K1.5").error == ProgramError::thread_unsupported);
}

TEST_CASE("G7: X is a diameter, from its own block on", "[program][turning]") {
    GcodeRun<double> run;
    CHECK(run.text("G7 G0 X10\nX20 Y3") == "rapid 5 0 0\nrapid 10 3 0");
    CHECK(run.text("G91 X2") == "rapid 11 3 0");
    CHECK(run.text("G90 F60 G18 G3 X20 Z-1 I-1").find("10 3 -1") != std::string::npos); // I is a radius
    CHECK(run.text("G0 X#5420") == "rapid 5 3 -1");                                     // #5420 is one, too
    CHECK(run.text("X[#<_lathe_diameter_mode>*8]") == "rapid 4 3 -1");
    CHECK(run.text("G92 X2\nX2").find("rapid 4 3 -1") != std::string::npos);
    CHECK(run.text("G8 G0 X2") == "rapid 5 3 -1");
}
