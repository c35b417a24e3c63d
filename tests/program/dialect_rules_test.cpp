// SPDX-License-Identifier: MIT
// What each dialect takes beside its words, rule by rule: docs/reference/gcode.md names the controllers' sources.
#include "splinefeed/s0_program/dialects/dialect_rules.hpp"

#include "support/gcode.hpp"

#include <cmath>

using namespace splinefeed_test;

namespace {

constexpr Dialect every[] = {Dialect::linuxcnc, Dialect::grbl, Dialect::marlin, Dialect::fanuc, Dialect::klipper};

ProgramSettings in(Dialect dialect) {
    ProgramSettings settings;
    settings.dialect = dialect;
    return settings;
}

std::string text(Dialect dialect, const std::string& program) {
    GcodeRun<double> run(in(dialect));
    return run.text(program);
}

/// Of the last line.
ProgramError error(Dialect dialect, const std::string& before, const std::string& line) {
    GcodeRun<double> run(in(dialect));
    run.run(before);
    return run.push(line).error;
}

std::string changed() {
    return "event " + std::to_string(static_cast<int>(EventKind::offsets_changed)) + " 0 0";
}

struct Words final : LeftOutWords {
    void add(std::string_view word) noexcept override { all += std::string(word) + ";"; }
    std::string all;
};

} // namespace

TEST_CASE("G80 beside another motion ends cycles, and the other one stays", "[program][dialects]") {
    for (const Dialect dialect : {Dialect::linuxcnc, Dialect::grbl, Dialect::fanuc}) {
        CHECK(text(dialect, "G0 G17 G40 G80 G90\nX10") == "rapid 0 0 0\nrapid 10 0 0");
        CHECK(text(dialect, "F60 G80 G1 X1\nX2") == "feed 1 0 0\nfeed 2 0 0");
    }
    CHECK(text(Dialect::linuxcnc, "F60 G81 X1 Z-1 R0\nG80 G0 X3").find("rapid 3 0 0") != std::string::npos);
    CHECK(error(Dialect::linuxcnc, "", "G1 G0 X1") == ProgramError::modal_group_conflict);
}

TEST_CASE("arcs are as round as the controller wants them", "[program][dialects][arc]") {
    const auto arc = [](Dialect dialect, const std::string& line) {
        return error(dialect, dialect == Dialect::klipper ? "F600" : "G21 F600", line);
    };
    // The radii differ by 0.02 mm, which is more than 0.1 %: LinuxCNC takes 0.0283 mm.
    CHECK(arc(Dialect::linuxcnc, "G2 X20.02 I10") == ProgramError::none);
    CHECK(arc(Dialect::fanuc, "G2 X20.02 I10") == ProgramError::none);
    CHECK(arc(Dialect::grbl, "G2 X20.02 I10") == ProgramError::arc_radius_mismatch);
    CHECK(arc(Dialect::linuxcnc, "G2 X20.03 I10") == ProgramError::arc_radius_mismatch);
    CHECK(error(Dialect::linuxcnc, "G20 F60", "G2 X2.0028 I1") == ProgramError::none);
    CHECK(error(Dialect::linuxcnc, "G20 F60", "G2 X2.003 I1") == ProgramError::arc_radius_mismatch);
    // Printers do not look, up to 0.5 mm here.
    for (const Dialect dialect : {Dialect::marlin, Dialect::klipper}) {
        CHECK(arc(dialect, "G2 X20.4 I10") == ProgramError::none);
        CHECK(arc(dialect, "G2 X20.6 I10") == ProgramError::arc_radius_mismatch);
    }
    CHECK(arc(Dialect::marlin, "G2 X20 R9") == ProgramError::none); // a half circle
    CHECK(arc(Dialect::linuxcnc, "G2 X20 R9") == ProgramError::arc_radius_too_small);
}

TEST_CASE("the offset across the plane of an arc", "[program][dialects][arc]") {
    for (const Dialect dialect : every) {
        const bool free = dialect != Dialect::linuxcnc && dialect != Dialect::fanuc;
        CHECK(error(dialect, "F600", "G2 X20 I10 K0") == (free ? ProgramError::none : ProgramError::arc_offset_unused));
    }
}

TEST_CASE("P of an arc counts turns, in Marlin those before the arc", "[program][dialects][arc]") {
    CHECK(text(Dialect::linuxcnc, "F600 G3 X20 I10 P2") == "feed arc 20 0 0 about 10 0 0 by 540");
    CHECK(text(Dialect::marlin, "G3 X20 I10 P1") == "feed arc 20 0 0 about 10 0 0 by 540");
    CHECK(text(Dialect::marlin, "G3 X20 I10 P0") == "feed arc 20 0 0 about 10 0 0 by 180");
    CHECK(error(Dialect::linuxcnc, "F600", "G3 X20 I10 P0") == ProgramError::arc_turns_invalid);
}

TEST_CASE("an arc of a huge radius is a parabola within a nanometre", "[program][dialects][arc]") {
    GcodeRun<double> run(in(Dialect::linuxcnc));
    run.run("G21 F1200 G0 X10");
    const auto items = run.run("G3 X12 Y1 R78834.36831");
    REQUIRE(items.size() == 1);
    const PathElement<double>& element = items[0].element;
    REQUIRE(element.shape == MoveShape::bezier);
    REQUIRE(element.bezier.degree == 2);
    // The control point is twice the sagitta from the chord's middle, to the right of a counterclockwise arc.
    const double sagitta = 5.0 / (8.0 * 78834.36831);
    const double chord = std::sqrt(5.0);
    CHECK(element.bezier.points[0][1] / 4096.0 == Approx(1.0 + 2.0 * sagitta * 1.0 / chord).margin(2e-9));
    CHECK(element.bezier.points[1][1] / 4096.0 == Approx(0.5 - 2.0 * sagitta * 2.0 / chord).margin(2e-9));
    run.run("G0 X0 Y0");
    CHECK(run.run("G2 X200 R40000")[0].element.shape == MoveShape::bezier);
    run.run("G0 X0 Y0");
    CHECK(run.run("G2 X300 R40000")[0].element.shape == MoveShape::arc); // a parabola would be too far from it
}

TEST_CASE("a control point of G5 on its end", "[program][dialects]") {
    GcodeRun<double> run(in(Dialect::linuxcnc));
    run.run("G21 G17 F600 G0 X10 Y0");
    const auto spline = run.run("G5 I0 J0 P-3 Q0 X20 Y20")[0].element.bezier;
    const double x = spline.points[0][1] / 4096.0;
    const double y = spline.points[1][1] / 4096.0;
    CHECK(y / x == Approx(20.0 / 7.0)); // towards the other one
    CHECK(std::hypot(x, y) > 1e-4);
    CHECK(std::hypot(x, y) < 4e-3);
    run.run("G0 X0 Y0");
    const auto line = run.run("G5 I0 J0 P0 Q0 X8 Y0")[0].element.bezier;
    CHECK(line.points[0][1] > 0.0);
    CHECK(line.points[0][2] < 8.0 * 4096.0);
    CHECK(line.points[1][1] == 0.0);
}

TEST_CASE("comments that are not closed", "[program][dialects]") {
    for (const Dialect dialect : every) {
        const bool open = dialect == Dialect::grbl;
        CHECK(error(dialect, "F60", "G1 X1 (to the end") ==
              (open ? ProgramError::none : ProgramError::comment_not_closed));
        CHECK(error(dialect, "F60", "G1 (a (b) X1") == (open ? ProgramError::none : ProgramError::comment_nested));
    }
    CHECK(text(Dialect::grbl, "F60 G1 X1 (X5\n(a (b) X2") == "feed 1 0 0\nfeed 2 0 0");
}

TEST_CASE("the units of a block are those of its F in grbl", "[program][dialects]") {
    for (const Dialect dialect : {Dialect::linuxcnc, Dialect::grbl, Dialect::marlin, Dialect::fanuc}) {
        GcodeRun<double> run(in(dialect));
        run.run("G1 F60\nG20 G1 F10");
        CHECK(run.interpreter().modal().feed.raw == (dialect == Dialect::grbl ? 254 : 10) * Decimal::one);
    }
}

TEST_CASE("G53 under G91 is absolute in grbl", "[program][dialects]") {
    CHECK(text(Dialect::grbl, "G91\nX5\nG0 G53 X1\nX1") == "rapid 5 0 0\nrapid 1 0 0\nrapid 2 0 0");
    CHECK(error(Dialect::linuxcnc, "G91", "G0 G53 X1") == ProgramError::g53_unsuited);
}

TEST_CASE("letters without a number, and words that are the printer's own", "[program][dialects]") {
    for (const Dialect dialect : {Dialect::marlin, Dialect::klipper}) {
        CHECK(text(dialect, "G1 X5 Y5 F600\nG28 X\nG1 X1") == "feed 5 5 0\nhome 0 5 0\nfeed 1 5 0");
        CHECK(text(dialect, "G1 X5 Y5\nG1 X Y7") == "feed 5 5 0\nfeed 5 7 0");         // X alone says nothing
        CHECK(text(dialect, "G1 X5 Y5 F600\nG28 W O R2") == "feed 5 5 0\nhome 0 0 0"); // letters of the printer's own
        CHECK(error(dialect, "", "M115 U3.8.1") == ProgramError::none);
        CHECK(error(dialect, "", "M84 X Y E") == ProgramError::none);
        CHECK(error(dialect, "", "M0 S5 Click to go on") == ProgramError::none);
    }
    CHECK(error(Dialect::linuxcnc, "", "G28 X") == ProgramError::number_invalid);
    CHECK(error(Dialect::grbl, "", "G28 X") == ProgramError::number_invalid);
}

TEST_CASE("M words that a printer does not know are left out, and told", "[program][dialects]") {
    Words words;
    ProgramSettings settings = in(Dialect::marlin);
    settings.left_out = &words;
    GcodeRun<double> run(settings);
    CHECK(run.text("M862.3 P \"MK3S X5\"\nG1 X1 M400\nm 486 S1 ; text") == "feed 1 0 0");
    CHECK(words.all == "M862.3;M400;m 486;");
    CHECK(error(Dialect::linuxcnc, "", "M862") == ProgramError::m_code_unknown);
    for (const char* const line : {"M206 X5", "M600", "M290 Z0.1"}) { // these do something to the path
        CHECK(error(Dialect::marlin, "", line) == ProgramError::printer_move_unsupported);
    }
}

TEST_CASE("G28 and G92 of printers", "[program][dialects]") {
    // Homing ends the shift of its axes.
    CHECK(text(Dialect::marlin, "G1 X5 F600\nG92 X0\nG28 X0\nG1 X1") ==
          "feed 5 0 0\n" + changed() + "\n" + changed() + "\nhome 0 0 0\nfeed 1 0 0");
    CHECK(text(Dialect::klipper, "G1 X5 Y3\nG92\nG1 X1 Y1").find("feed 6 4 0") != std::string::npos);
    CHECK(error(Dialect::marlin, "", "G92") == ProgramError::g92_axes_missing);
    CHECK(error(Dialect::klipper, "", "G20") == ProgramError::not_in_dialect);
}

TEST_CASE("a printer moves at 1500 mm/min before any F", "[program][dialects]") {
    for (const Dialect dialect : every) {
        const bool printer = dialect == Dialect::marlin || dialect == Dialect::klipper;
        CHECK(error(dialect, "", "G1 X1") == (printer ? ProgramError::none : ProgramError::feed_missing));
    }
    GcodeRun<double> run(in(Dialect::marlin));
    CHECK(run.run("G1 X1")[0].element.feed_mm_s == Approx(25.0));
    CHECK(run.run("G0 X2")[0].element.feed_mm_s == Approx(25.0)); // G0 is G1
}

TEST_CASE("dwells in their units", "[program][dialects]") {
    CHECK(text(Dialect::linuxcnc, "G4 P0.5") == "dwell 0.5");
    CHECK(text(Dialect::grbl, "G4 P0.5") == "dwell 0.5");
    CHECK(text(Dialect::marlin, "G4 P500\nG4 S2\nG4 P500 S2\nG4") == "dwell 0.5\ndwell 2\ndwell 2\ndwell 0");
    CHECK(text(Dialect::fanuc, "G4 P500\nG4 X1.5\nG4 U2.") == "dwell 0.5\ndwell 1.5\ndwell 2");
    CHECK(error(Dialect::fanuc, "", "G4 X1 P1") == ProgramError::word_repeated);
    CHECK(text(Dialect::fanuc, "F60 G82 G99 X1 Z-1 R0 P500").find("dwell 0.5") != std::string::npos);
}

TEST_CASE("P with a decimal point is seconds in fanuc", "[program][dialects]") {
    CHECK(text(Dialect::fanuc, "G4 P2.\nG4 P0.5\nG4 P2\nG4 P[500]") == "dwell 2\ndwell 0.5\ndwell 0.002\ndwell 0.5");
    CHECK(text(Dialect::fanuc, "F60 G82 G99 X1 Z-1 R0 P0.5").find("dwell 0.5") != std::string::npos);
    CHECK(text(Dialect::marlin, "G4 P2.") == "dwell 0.002");
    CHECK(text(Dialect::linuxcnc, "G4 P2.\nG4 P2") == "dwell 2\ndwell 2");
}

TEST_CASE("G80 leaves the motion from before the cycle in fanuc", "[program][dialects]") {
    const std::string cycle = "F60 G0 X1 Y1 Z9\nG98 G81 X2 Z-1 R2\n";
    const auto last = [](const std::string& program) {
        const std::string all = text(Dialect::fanuc, program);
        return all.substr(all.rfind('\n') + 1);
    };
    CHECK(last(cycle + "G80\nZ15") == "rapid 2 1 15");
    CHECK(last(cycle + "G80 Z15") == "rapid 2 1 15");
    CHECK(last("F60 G1 X1\nG81 X2 Z-1 R0\nG80\nX3") == "feed 3 0 0");
    CHECK(last("F60 G1 X1\nG80\nX3") == "feed 3 0 0");
    CHECK(last("F60 G1 X1\nG81 X2 Z-1 R0\nG80\nG82 X4 Z-1 R0 P1\nG80\nX5") == "feed 5 0 0");
    CHECK(error(Dialect::fanuc, "G80", "X1") == ProgramError::axis_word_unused); // there was none
    CHECK(error(Dialect::linuxcnc, cycle + "G80", "Z15") == ProgramError::axis_word_unused);
    CHECK(error(Dialect::grbl, cycle, "G80 Z15") == ProgramError::axis_word_unused);
}

TEST_CASE("Fanuc's cycles take P, and make no hole with L0 or K0", "[program][dialects]") {
    CHECK(text(Dialect::fanuc, "F60 G83 G99 X1 Z-1 R0 Q5 P300").find("dwell 0.3") != std::string::npos);
    CHECK(text(Dialect::fanuc, "F60 G81 G99 X1 Z-1 R0 P300").find("dwell") == std::string::npos);
    CHECK(text(Dialect::fanuc, "F60 G82 G99 X1 Z-1 R0 P300\nG83 X2 Z-1 R0 Q5").rfind("dwell") ==
          text(Dialect::fanuc, "F60 G82 G99 X1 Z-1 R0 P300").rfind("dwell"));
    CHECK(error(Dialect::fanuc, "F60", "G83 X1 Z-1 R0 Q5 P-1") == ProgramError::cycle_dwell_missing);
    CHECK(error(Dialect::linuxcnc, "F60", "G83 X1 Z-1 R0 Q5 P1") == ProgramError::word_unused);
    for (const char* const none : {"L0", "K0"}) {
        const std::string cycle = std::string("F60 G0 Z5\nG81 G99 X1 Y1 Z-1 R2 ") + none;
        CHECK(text(Dialect::fanuc, cycle) == "rapid 0 0 5");
        CHECK(text(Dialect::fanuc, cycle + "\nX3").find("rapid 3 0 5\nrapid 3 0 2\nfeed 3 0 -1") != std::string::npos);
    }
    CHECK(error(Dialect::linuxcnc, "F60", "G81 X1 Z-1 R0 L0") == ProgramError::cycle_repeats_invalid);
    CHECK(error(Dialect::grbl, "F60", "G81 X1 Z-1 R0 L0") == ProgramError::cycle_repeats_invalid);
}

TEST_CASE("what a printer's words do not read has no effect", "[program][dialects]") {
    for (const Dialect dialect : {Dialect::marlin, Dialect::klipper}) {
        CHECK(text(dialect, "G1 X5 Y5 F600\nG28 Z P0 T140\nG28 X0 S5 F1 I\nG1 Y1") ==
              "feed 5 5 0\nhome 5 5 0\nhome 0 5 0\nfeed 0 1 0");
        CHECK(text(dialect, "G1 X5 F600\nG5\nX6\nG5 F1200\nX7") == "feed 5 0 0\nfeed 6 0 0\nfeed 7 0 0");
        CHECK(error(dialect, "", "G5 I1 J1") == ProgramError::axis_words_missing);
    }
    CHECK(error(Dialect::linuxcnc, "F60", "G5") == ProgramError::axis_words_missing);
}

TEST_CASE("Fanuc's steps, cancels and motions beside G28", "[program][dialects]") {
    CHECK(text(Dialect::fanuc, "G0 X5 Z5\nU1. W-1.\nG91 U1.\nG90 X1") ==
          "rapid 5 0 5\nrapid 6 0 4\nrapid 7 0 4\nrapid 1 0 4");
    CHECK(text(Dialect::fanuc, "G0 X5 Z5\nG28 U0 W1.") == "rapid 5 0 5\nrapid 5 0 6\nrapid 0 0 0");
    CHECK(text(Dialect::fanuc, "G0 X5 Z5\nG0 G91 G28 Z0\nG90 X2") ==
          "rapid 5 0 5\nrapid 5 0 5\nrapid 5 0 0\nrapid 2 0 0");
    CHECK(text(Dialect::fanuc, "G0 G17 G21 G40 G50 G69 G15 G67 G80 G90") == "rapid 0 0 0");
    CHECK(text(Dialect::fanuc, "G5.1 Q1\nG5 P10000\nG8 P1") == "");
    CHECK(error(Dialect::fanuc, "", "G0 X1 U2") == ProgramError::word_repeated);
    CHECK(error(Dialect::linuxcnc, "", "G0 U2") == ProgramError::axis_missing);
    CHECK(error(Dialect::linuxcnc, "", "G0 G91 G28 Z0") == ProgramError::axis_words_twice);
    CHECK(error(Dialect::linuxcnc, "", "G69") == ProgramError::g_code_unknown);
    CHECK(text(Dialect::fanuc, "F60 G81 G91 G99 X1 Z-1 R0 K2").find("feed 2 0 -1") != std::string::npos);
}

TEST_CASE("LinuxCNC's cycles begin in G99, others in G98", "[program][dialects]") {
    for (const Dialect dialect : {Dialect::linuxcnc, Dialect::grbl, Dialect::fanuc}) {
        const std::string end = dialect == Dialect::linuxcnc ? "rapid 1 0 2" : "rapid 1 0 9";
        const std::string cycle = text(dialect, "F60 G0 Z9\nG81 X1 Z-1 R2");
        CHECK(cycle.substr(cycle.size() - end.size()) == end);
    }
}

TEST_CASE("Fanuc's numbers without a decimal point", "[program][dialects]") {
    ProgramSettings settings = in(Dialect::fanuc);
    settings.increments = true;
    GcodeRun<double> run(settings);
    CHECK(run.text("G0 X1000 Y1.\nG1 X-500 F100\nG4 X2000") == "rapid 1 1 0\nfeed -0.5 1 0\ndwell 2");
    CHECK(run.run("G1 X0")[0].element.feed_mm_s == Approx(100.0 / 60.0)); // F is as it is
    CHECK(run.text("G20 G0 X10000\nG21") == "rapid 25.4 1 0");
}

TEST_CASE("an exponent is no word", "[program][dialects]") {
    for (const Dialect dialect : {Dialect::linuxcnc, Dialect::grbl, Dialect::fanuc}) {
        ProgramSettings settings = in(dialect);
        const IgnoredWord ignored[] = {{'E', IgnoredWord::any}};
        settings.ignored = ignored;
        settings.ignored_count = 1;
        GcodeRun<double> run(settings);
        run.run("F60");
        for (const char* const line : {"G1 X2.4492935982947064e-16", "G1 X1E+3", "G1 X1e5", "G1 X2.E-1"}) {
            CHECK(run.push(line).error == ProgramError::number_has_exponent);
        }
        CHECK(run.text("G1 X1 E-16") == "feed 1 0 0"); // a word of its own, which is ignored
    }
}

TEST_CASE("words that are left out take their axis words along", "[program][dialects]") {
    Words words;
    const IgnoredWord ignored[] = {{'G', 280}, {'G', 430}, {'A', IgnoredWord::any}};
    ProgramSettings settings = in(Dialect::linuxcnc);
    settings.ignored = ignored;
    settings.ignored_count = 3;
    settings.ignores_unknown = true;
    settings.left_out = &words;
    GcodeRun<double> run(settings);
    CHECK(run.text("G0 X5\nG91 G28 Z0\nG90 X6") == "rapid 5 0 0\nrapid 6 0 0"); // Z0 is not a move of G0
    CHECK(run.text("G43 H7 Z2") == "rapid 6 0 2");                              // Z is not G43's
    CHECK(run.text("M777 P1 X9") == "rapid 9 0 2");                             // X is of no M word
    CHECK(run.text("G30 A0\nG92 A5") == "");                                    // no other axis is meant
    CHECK(words.all == "G28;G43;M777;A0;A5;");
}

TEST_CASE("in fanuc Z and R of a cycle stay for another one, until something else ends the series",
          "[program][dialects][cycle]") {
    const std::string begin = "G0 Z12 F1800\nG99 G81 X10 Z-4 R1\n";
    const std::string holes = text(Dialect::fanuc, begin + "G83 X20 Q3\nG82 X30 R2 P500");
    CHECK(holes.find("rapid 20 0 1\nfeed 20 0 -2\nrapid 20 0 1\nrapid 20 0 -1.746\nfeed 20 0 -4\nrapid 20 0 1\n"
                     "rapid 30 0 2\nfeed 30 0 -4\ndwell 0.5\nrapid 30 0 2") != std::string::npos);
    CHECK(error(Dialect::fanuc, begin, "G83 X20") == ProgramError::cycle_peck_invalid);
    CHECK(error(Dialect::fanuc, begin, "G82 X20") == ProgramError::cycle_dwell_missing);
    for (const char* const end : {"G80", "G0 X1", "G1 X1"}) {
        CHECK(error(Dialect::fanuc, begin + end, "G83 X20 Q3") == ProgramError::cycle_depth_missing);
        CHECK(error(Dialect::fanuc, begin + end, "G83 X20 Z-4 Q3") == ProgramError::cycle_radius_missing);
    }
    CHECK(error(Dialect::linuxcnc, begin, "G83 X20 Q3") == ProgramError::cycle_depth_missing);
}

TEST_CASE("in fanuc D stands in any block, and stays for a G41 without one", "[program][dialects][cutter]") {
    const TenTools tools;
    ProgramSettings settings = in(Dialect::fanuc);
    settings.tools = &tools;
    GcodeRun<double> run(settings);
    run.run("T4 M6\nT11 D2 M6\nF600 G0 X-10"); // tool 11 is 11 mm thick, tool 2 is 2 mm
    CHECK(run.text("G41 G1 X0 Y0\nX10\nX20").find("feed 0 1 0\nfeed 10 1 0") == 0);
    CHECK(run.push("D3").error == ProgramError::cutter_active);
    CHECK(run.push("G40 D3 X30").ok());
    CHECK(run.push("D2.5").error == ProgramError::tool_unknown);
    CHECK(run.push("D-1").error == ProgramError::tool_unknown);
    CHECK(error(Dialect::linuxcnc, "", "T1 D1 M6") == ProgramError::word_unused);
}

TEST_CASE("T before any other command takes the words behind it, and M of a spindle its own", "[program][dialects]") {
    const std::string tool = "event " + std::to_string(static_cast<int>(EventKind::tool_select));
    for (const Dialect dialect : {Dialect::marlin, Dialect::klipper}) {
        CHECK(text(dialect, "G1 X1\nT0 S1 L0 D0\nT1 M1 S1\nG1 X2") ==
              "feed 1 0 0\n" + tool + " 0 0\n" + tool + " 1 0\nfeed 2 0 0");
        CHECK(text(dialect, "G1 X1\nP0 S1 M1 L2 D0 X50\nG1 X2") == "feed 1 0 0\nfeed 2 0 0"); // it parks a tool
        CHECK(error(dialect, "", "G1 X5 L2") == ProgramError::word_unused);
        CHECK(error(dialect, "", "M3 P100 I S128 O5") == ProgramError::none);
    }
    CHECK(error(Dialect::linuxcnc, "", "T1 S1 L0") == ProgramError::word_unused);
    CHECK(error(Dialect::grbl, "", "M3 P100") == ProgramError::word_unused);
    CHECK(error(Dialect::grbl, "", "P0") == ProgramError::word_unused);
    ProgramSettings settings = in(Dialect::marlin);
    Words words;
    settings.left_out = &words;
    GcodeRun<double> run(settings);
    run.run("P0 S1");
    CHECK(words.all == "P0;");
}
