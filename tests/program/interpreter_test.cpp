// SPDX-License-Identifier: MIT
#include "splinefeed/number/vector.hpp"

#include "support/gcode.hpp"

using namespace splinefeed_test;

namespace {

std::string event(EventKind kind, const std::string& rest = " 0 0") {
    return "event " + std::to_string(static_cast<int>(kind)) + rest;
}

} // namespace

TEMPLATE_TEST_CASE("straight moves", "[program][interpreter]", double, float, Fixed) {
    GcodeRun<TestType> run;
    CHECK(run.text("G0 X1 Y2 Z3\nG1 X4 F600\nY5\nG91 X1 Z-1\nG90 X0 G20\nG1 X1\nG21 X1") ==
          "rapid 1 2 3\nfeed 4 2 3\nfeed 4 5 3\nfeed 5 5 2\nfeed 0 5 2\nfeed 25.4 5 2\nfeed 1 5 2");
    CHECK(to_double(run.items()[1].element.feed_mm_s) == Approx(10.0));
    CHECK(to_double(run.items()[0].element.feed_mm_s) == 0.0);
    CHECK(run.items()[5].line == 6);
}

TEST_CASE("inches are exact, increments do not drift", "[program][interpreter]") {
    GcodeRun<double> run;
    run.run("G20 G91 G1 F10");
    for (int i = 0; i < 1000; ++i) {
        REQUIRE(run.push("X0.0001 Y-0.1").ok());
    }
    CHECK(run.interpreter().position()[0] == to_position({2'540'000'000}));
    CHECK(run.interpreter().position()[1] == to_position(Decimal::from_integer(-2540)));
    CHECK(run.items().back().feed.raw == 10 * Decimal::one); // F was read before G20 of its block
    CHECK(run.run("F10\nX1").back().feed.raw == 254 * Decimal::one);
}

TEST_CASE("the feed counts x, y and z, else rotary axes", "[program][interpreter]") {
    GcodeRun<double> run;
    const auto feed = [&](const char* line) {
        return run.run(line).back().element.feed_mm_s;
    };
    run.run("F600 G1 X0");
    CHECK(feed("X3 Y4") == Approx(10.0));
    CHECK(feed("A30") == Approx(10.0));
    CHECK(feed("G91 X3 A4") == Approx(10.0 * 5.0 / 3.0));
    CHECK(feed("B3 C4") == Approx(10.0));
    CHECK(feed("G93 X3 Y4 F60") == Approx(5.0)); // in a second
    CHECK(feed("X3 A4 F30") == Approx(2.5));
    CHECK(feed("G2 X10 I5 F60") == Approx(5.0 * M_PI));
    CHECK(feed("G94 G2 X10 I5 A10 F600") == Approx(10.0 * std::hypot(5.0 * M_PI, 10.0) / (5.0 * M_PI)));
}

TEST_CASE("a feed plan that knows rotary axes gets F", "[program][interpreter]") {
    ProgramSettings settings = six_axes();
    settings.rotary_axes = 0x38; // A, B, C
    GcodeRun<double> run(settings);
    const auto feed = [&](const char* line) {
        return run.run(line).back().element.feed_mm_s;
    };
    run.run("F600 G1 X0");
    CHECK(feed("G91 X3 A4") == Approx(10.0));
    CHECK(feed("B3 C4") == Approx(10.0));
    CHECK(feed("G93 X3 A4 F60") == Approx(3.0));
    CHECK(feed("X0.0005 A100 F60") == Approx(0.0005)); // a slower one than the slowest F
    CHECK(feed("A30 F60") == Approx(30.0));
}

TEST_CASE("what F counts is the controller's", "[program][interpreter]") {
    struct Case {
        Dialect dialect;
        const char* before;
        const char* line;
        double seconds;
    };
    constexpr double minute = 60.0;
    const Case cases[] = {
        {Dialect::linuxcnc, "G21", "G1 X10 A90 F600", minute * 10.0 / 600.0},
        {Dialect::grbl, "G21", "G1 X10 A90 F600", minute * std::hypot(10.0, 90.0) / 600.0},
        {Dialect::fanuc, "G21", "G1 X10 A90 F600", minute * std::hypot(10.0, 90.0) / 600.0},
        {Dialect::fanuc, "G21", "G1 X20 B40 F300", 0.14907 * minute}, // the example of its manual
        {Dialect::grbl, "G21 G0 X0", "G2 X10 I5 A40 F600", minute * std::hypot(5.0 * M_PI, 40.0) / 600.0},
        {Dialect::linuxcnc, "G20", "G1 A90 F60", minute * 90.0 / 60.0},
        {Dialect::fanuc, "G20", "G1 A90 F60", minute * 90.0 / 60.0},
        {Dialect::fanuc, "G20", "G1 X1 A90 F60", minute * std::hypot(1.0, 90.0) / 60.0},
        {Dialect::grbl, "G20", "G1 A90 F60", minute * 90.0 / (60.0 * 25.4)},
        {Dialect::grbl, "G20", "G1 X1 A90 F60", minute * std::hypot(25.4, 90.0) / (60.0 * 25.4)},
        {Dialect::linuxcnc, "G20\nF60\nG21", "G1 A90", minute * 90.0 / 60.0}, // as F was stated
        {Dialect::linuxcnc, "G20", "G1 X1 F60", minute / 60.0},
        {Dialect::fanuc, "G20", "G93 G1 X1 A90 F2", minute / 2.0},
        {Dialect::grbl, "G21", "G1 Z0.001 A360 F600", minute * 360.0 / 600.0},
    };
    for (const Case& test : cases) {
        for (const bool knows_rotary : {false, true}) {
            ProgramSettings settings = six_axes();
            settings.dialect = test.dialect;
            settings.rotary_axes = knows_rotary ? 0x38 : 0;
            GcodeRun<double> run(settings);
            run.run(test.before);
            const PerAxis<Position> from = run.interpreter().position();
            const ProgramItem<double> item = run.run(test.line).back();
            const PerAxis<double> way = distances<double>(from, item.element.to, 0, 6);
            const double space = item.element.shape == MoveShape::arc ? 5.0 * M_PI : std::hypot(way[0], way[1], way[2]);
            const double rotary = std::hypot(way[3], way[4], way[5]);
            const double length = !knows_rotary ? std::hypot(space, rotary) : space > 0.0 ? space : rotary;
            CAPTURE(test.line, test.before, static_cast<int>(test.dialect), knows_rotary);
            CHECK(length / item.element.feed_mm_s == Approx(test.seconds).epsilon(1e-4));
        }
    }
}

TEST_CASE("items have the line of the source, or its number N where that is asked for", "[program][interpreter]") {
    const bool numbered = GENERATE(false, true);
    ProgramSettings settings = six_axes();
    settings.numbered = numbered;
    GcodeRun<double> run(settings);
    std::vector<std::uint32_t> lines;
    for (const auto& item : run.run("N70 G0 X1\nX2 N9 N8\nN0 X3\nN2.5 X4\n/ n 1 2 X5\n#1=6 N[10+#1] X6")) {
        lines.push_back(item.line);
    }
    CHECK(lines ==
          (numbered ? std::vector<std::uint32_t>{70, 9, 3, 4, 12, 10} : std::vector<std::uint32_t>{1, 2, 3, 4, 5, 6}));
}

TEST_CASE("path modes", "[program][interpreter]") {
    GcodeRun<double> run;
    const auto move = [&](const char* line) {
        return run.run(line).back();
    };
    run.run("F600 G1 X0");
    CHECK(move("X1").element.mode == PathMode::continuous);
    CHECK(move("X2").element.tolerance_mm == Approx(0.01)); // the machine's
    CHECK(move("X2.5").element.chain_tolerance_mm == Approx(0.0075));
    CHECK(move("G61 X3").element.mode == PathMode::exact_path);
    CHECK(move("X4").element.tolerance_mm == 0.0);
    CHECK(move("G61.1 X5").element.mode == PathMode::exact_stop);
    CHECK(move("G64 P0.05 X6").element.tolerance_mm == Approx(0.05));
    CHECK(move("X7").element.chain_tolerance_mm == Approx(0.0375));
    CHECK(move("G64 P0.05 Q0.02 X8").element.chain_tolerance_mm == Approx(0.02));
    CHECK(move("G64 P0.05 Q0.07 X8.5").element.chain_tolerance_mm == Approx(0.07)); // counts as P
    CHECK(move("G64 X9").element.tolerance_mm == Approx(0.01));
    CHECK(move("X9.5").element.chain_tolerance_mm == Approx(0.0075));
    CHECK(move("G64 P0 X10").element.mode == PathMode::exact_path);
    CHECK(move("G20 G64 P0.01 X1").element.tolerance_mm == Approx(0.254));
    CHECK(move("G0 X2").element.tolerance_mm == Approx(0.1)); // between rapids
}

TEST_CASE("offsets", "[program][interpreter]") {
    GcodeRun<double> run;
    const std::string saved = event(EventKind::offsets_changed);
    CHECK(run.text("G10 L2 P1 X1 Y2\nG0 X0 Y0 Z0") == saved + "\nrapid 1 2 0");
    CHECK(run.last("G10 L2 P2 X10 Y5 R90\nG55 X1 Y0") == "rapid 10 6 0");
    CHECK(run.last("G91 X1\nG90") == "rapid 10 7 0");
    CHECK(run.last("G54 G92 X100\nX101 Y0") == "rapid 11 2 0");
    CHECK(run.last("G92.2\nX0") == "rapid 1 2 0");
    CHECK(run.last("G92.3\nX101") == "rapid 11 2 0");
    CHECK(run.last("G52 X5\nX0") == "rapid 6 2 0");
    CHECK(run.last("G92.1\nX0") == "rapid 1 2 0");
    CHECK(run.last("G10 L20 P0 X7\nX7.5") == "rapid 1.5 2 0");
    CHECK(run.last("G43.1 Z5\nX0 Z1") == "rapid -6 2 6");
    CHECK(run.last("G43 H2\nZ1") == "rapid -6 2 21");
    CHECK(run.last("X0") == "rapid -5 2 21");
    CHECK(run.last("G49 X0 Z1") == "rapid -6 2 1");
    CHECK(run.last("G59.3 X3 Y3") == "rapid 3 3 1");
    CHECK(run.last("G53 X1 Z0") == "rapid 1 3 0");
    CHECK(run.items().back().stops_before);
}

TEST_CASE("reference positions", "[program][interpreter]") {
    GcodeRun<double> run;
    run.run("G0 X1 Y2 Z3\nG28.1\nX9 Y9 Z9\nG30.1\nX5");
    CHECK(run.text("G28 Z4") == "rapid 5 9 4\nrapid 5 9 3");
    CHECK(run.text("G91 G28 X0 Y1\nG90") == "rapid 5 10 3\nrapid 1 2 3");
    CHECK(run.text("G30") == "rapid 1 2 3\nrapid 9 9 9");
    CHECK(run.items().front().stops_before);
    CHECK(run.items().back().element.stop_at_end);
}

TEST_CASE("arcs", "[program][interpreter]") {
    GcodeRun<double> run;
    CHECK(run.last("F600 G2 X10 I5") == "feed arc 10 0 0 about 5 0 0 by -180");
    CHECK(run.last("G3 X0 R5") == "feed arc 0 0 0 about 5 0 0 by 180");
    CHECK(run.last("G3 I5 P2") == "feed arc 0 0 0 about 5 0 0 by 720");
    CHECK(run.last("J5 Z2") == "feed arc 0 0 2 about 0 5 0 by 360");
    CHECK(run.last("G90.1 G2 X5 Y5 I0 J5") == "feed arc 5 5 2 about 0 5 2 by -270");
    CHECK(run.last("G91.1 G18 G2 X15 I5 K0") == "feed arc 15 5 2 about 10 5 2 by -180");
    CHECK(run.items().back().element.arc.normal[1] == 1.0);
    CHECK(run.last("G19 G3 Y8 Z5 R3 A90", 4) == "feed arc 15 8 5 90 about 15 5 5 by 90");
    CHECK(run.last("G17 G2 X5 R-20") != "");
    CHECK(std::fabs(to_double(run.items().back().element.arc.sweep_rad)) > M_PI);
}

TEST_CASE("splines", "[program][interpreter]") {
    GcodeRun<double> run;
    const auto points = [&](const char* line) {
        const auto items = run.run(line);
        std::string out = std::to_string(items.size()) + ":";
        for (unsigned k = 0; k < 2; ++k) {
            for (int i = 1; i <= items.back().element.bezier.degree; ++i) {
                char text[20];
                std::snprintf(text, sizeof text, " %g",
                              items.back().element.bezier.points[k][static_cast<unsigned>(i)] / 4096.0);
                out += text;
            }
            out += k == 0 ? "," : "";
        }
        return out;
    };
    run.run("F600 G1 X1 Y1");
    CHECK(points("G5 X11 Y1 I2 J3 P-4 Q5") == "1: 2 6 10, 3 5 0");
    CHECK(points("X21 P0 Q0") == "1: 4 9.99878 10, -5 -0.00101725 0"); // a direction at its end
    CHECK(points("G5.1 X31 I5 J2") == "1: 5 10, 2 0");
    run.run("G1 X0 Y0");
    CHECK(points("G5.2 X10 Y10 L3\nX20 Y0\nG5.3") == "1: 10 20, 10 0");
    run.run("G1 X0 Y0\nG5.2 X10 Y10\nX20 Y0\nX30 Y5 P2\nX40 Y0\nG5.3");
    CHECK(run.items().size() > 5); // the weight makes it rational: quintics
    CHECK(text_of(run.items().back()) == "feed bezier 40 0 0 degree 5");
    CHECK(run.push("X50").error == ProgramError::axis_word_unused);
}

TEST_CASE("probing", "[program][interpreter]") {
    GcodeRun<double> run;
    run.run("F60 G92 X10");
    const auto items = run.run("G38.2 Z-5");
    CHECK(text_of(items.back()) == "probe 0 0 -5");
    CHECK(items.back().probe.required);
    CHECK(!items.back().probe.away);
    PerAxis<Position> contact{};
    contact[2] = to_position(Decimal::from_integer(-2));
    PerAxis<Position> stands = contact;
    stands[2].raw -= 1000;
    run.interpreter().report_probe(true, contact, stands);
    CHECK(run.last("G0 X#5061 Y#5070 Z#5063") == "rapid 0 1 -2");
    CHECK(run.run("G38.5 Z-9").back().probe.away);
    CHECK(run.push("G38.3 Z-9").error == ProgramError::probe_too_short);
    // As in LinuxCNC the result has the units of the program that probed, and stays as it is.
    run.run("G20 G38.3 Z1\nG21");
    CHECK(run.last("G0 Z#5063") == "rapid 0 1 1");
    run.run("G38.3 Z20\nG20");
    CHECK(run.last("G0 Z[#5063 / 10]") == "rapid 0 1 50.8");
    run.run("#5063=7");
    CHECK(run.last("G0 Z#5063") == "rapid 0 1 177.8");
}

TEST_CASE("events, in the order of execution", "[program][interpreter]") {
    GcodeRun<double> run;
    CHECK(run.text("G0 X1 M8 M3 S1000 T2 M6 (MSG,go)") ==
          event(EventKind::message, " 0 0 go") + "\n" + event(EventKind::spindle_speed, " stop 0 1000") + "\n" +
              event(EventKind::tool_select, " 2 0") + "\n" + event(EventKind::tool_change, " stop 2 0") + "\n" +
              event(EventKind::spindle_clockwise, " stop 0 1000") + "\n" + event(EventKind::flood_on, " stop 0 0") +
              "\n" + event(EventKind::offsets_changed) + "\nrapid 1 0 0");
    CHECK(run.text("M62 P3 G0 X2") == event(EventKind::output_on_with_motion, " 3 0") + "\nrapid 2 0 0");
    CHECK(run.text("M65 P0") == event(EventKind::output_off));
    CHECK(run.text("M67 E2 Q-1.5 G0 X2\nM68 E0 Q3") == event(EventKind::analog_output_with_motion, " 2 -1.5") +
                                                           "\nrapid 2 0 0\n" + event(EventKind::analog_output, " 0 3"));
    CHECK(run.text("M66 P1 L3 Q2.5") == event(EventKind::input_wait, " stop 1 2.5"));
    CHECK(run.items().back().event.wait == InputWait::high);
    run.interpreter().report_input(Decimal::from_integer(-1));
    CHECK(run.last("G0 X#5399") == "rapid -1 0 0");
    CHECK(run.text("M50 P0\nM48\nM53 P1") == event(EventKind::feed_override) + "\n" + event(EventKind::overrides_on) +
                                                 "\n" + event(EventKind::feed_hold, " 1 0"));
    CHECK(run.text("G4 P0.5 G0 X3") == "dwell 0.5\nrapid 3 0 0");
    CHECK(run.text("X4 M0") == "rapid 4 0 0\n" + event(EventKind::pause, " stop 0 0"));
    CHECK(run.text("M1\nM60") ==
          event(EventKind::optional_pause, " stop 1 0") + "\n" + event(EventKind::pallet_pause, " stop 60 0"));
    CHECK(run.text("M61 Q7").find(event(EventKind::tool_set, " stop 7 0")) == 0);
    CHECK(run.text("M5 S500") == event(EventKind::spindle_stop, " stop 0 0") + "\n" +
                                     event(EventKind::spindle_speed, " stop 0 500")); // never turns at 500
    CHECK(run.text("M5 M9 X9 M30") == event(EventKind::spindle_stop, " stop 0 0") + "\n" +
                                          event(EventKind::coolant_off, " stop 0 0") + "\nrapid 9 0 0\n" +
                                          event(EventKind::program_end, " stop 30 0"));
}

TEST_CASE("Marlin's words", "[program][interpreter]") {
    ProgramSettings settings;
    settings.axes = 4;
    settings.letters = {'X', 'Y', 'Z', 'E'};
    settings.dialect = Dialect::marlin;
    GcodeRun<double> run(settings);
    CHECK(run.text("M104 S200 ; warm\nM109 S200\nM106 S255\nM107", 4) ==
          event(EventKind::printer, " 104 200") + "\n" + event(EventKind::printer, " stop 109 200") + "\n" +
              event(EventKind::printer, " 106 255") + "\n" + event(EventKind::printer, " 107 0"));
    CHECK(run.text("G28 ; home\nM82\nG92 E0\nG1 X1 E2 F600\nG1 E1\nM83\nG1 X2 E0.5\nG91\nG90\nG1 E2", 4) ==
          "home 0 0 0 0\n" + event(EventKind::offsets_changed) +
              "\nfeed 1 0 0 2\nfeed 1 0 0 1\nfeed 2 0 0 1.5\nfeed 2 0 0 2");
    CHECK(run.text("M117 Layer 3; x") == event(EventKind::printer, " 117 0 Layer 3"));
    // The text of a line is that line's only, and a comment's is its own event's.
    CHECK(run.text("M117 Layer 3\nM106 S1\n(MSG,hot)\nM104 S20\n(MSG,cold) M107") ==
          event(EventKind::printer, " 117 0 Layer 3") + "\n" + event(EventKind::printer, " 106 1") + "\n" +
              event(EventKind::message, " 0 0 hot") + "\n" + event(EventKind::printer, " 104 20") + "\n" +
              event(EventKind::message, " 0 0 cold") + "\n" + event(EventKind::printer, " 107 0"));
    run.run("M3 S1000");
    CHECK(run.text("G4 S2\nG4 P500\nM0 S5") == "dwell 2\ndwell 0.5\n" + event(EventKind::pause, " stop 0 0"));
    CHECK(run.interpreter().modal().speed == Decimal::from_integer(1000)); // those are seconds
    CHECK(run.text("N3 G0 X5*" + std::to_string('N' ^ '3' ^ ' ' ^ 'G' ^ '0' ^ ' ' ^ 'X' ^ '5'), 4) == "feed 5 0 0 2");
    CHECK(run.push("N3 G0 X6*1").error == ProgramError::checksum_wrong);
    CHECK(run.push("G10").error == ProgramError::firmware_retraction_unsupported);
    CHECK(run.push("G29").error == ProgramError::bed_levelling_unsupported);
    CHECK(run.push("G81 X1 Z-1 R1").error == ProgramError::not_in_dialect);
}

TEST_CASE("grbl's words", "[program][interpreter]") {
    ProgramSettings settings;
    settings.dialect = Dialect::grbl;
    GcodeRun<double> run(settings);
    CHECK(run.text("X1") == "rapid 1 0 0"); // G0 at the start
    CHECK(run.text("$H") == "home 0 0 0");
    CHECK(run.push("$X").error == ProgramError::grbl_command_unsupported);
    CHECK(run.push("G90.1").error == ProgramError::not_in_dialect);
    CHECK(run.text("F60 G81 X1 Z-1 R1").find("feed 1 0 -1") != std::string::npos); // grblHAL's
}

TEST_CASE("memory of an interpreter", "[program][interpreter]") {
    CHECK(sizeof(Interpreter<Fixed>) <= 4720);
}
