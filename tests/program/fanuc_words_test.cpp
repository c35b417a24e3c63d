// SPDX-License-Identifier: MIT
// Coordinates of Fanuc's and Haas' controls: docs/reference/gcode.md names the places in their manuals.
#include "splinefeed/s0_program/words/fanuc_words.hpp"

#include "support/gcode.hpp"

using namespace splinefeed_test;

namespace {

/// An interpreter with these words.
struct FanucRun {
    std::array<WorkSystem, 99> further{};
    FanucWords words{further};
    GcodeRun<double> run;

    explicit FanucRun(int systems = 99)
        : words(std::span(further).first(static_cast<unsigned>(systems))), run(settings()) {}

    ProgramSettings settings() {
        ProgramSettings out = six_axes();
        out.dialect = Dialect::fanuc;
        out.extension = &words;
        return out;
    }
    /// The moves, one a line.
    std::string moves(const std::string& program) {
        std::string out;
        run.run(program);
        for (std::size_t i = 0; i < run.items().size(); ++i) {
            if (run.items()[i].kind == ItemKind::move) {
                out += (out.empty() ? "" : "\n") + run.item_text(i);
            }
        }
        return out;
    }
    /// Why the line is refused; none: it is not, or for another cause.
    FanucFault fault(const std::string& line) {
        return run.push(line).error == ProgramError::coordinates_unsuited ? words.fault() : FanucFault::none;
    }
    ProgramError error(const std::string& line) { return run.push(line).error; }
};

std::string moves(const std::string& program) {
    FanucRun of;
    return of.moves(program);
}

/// Of the last line.
FanucFault fault(const std::string& before, const std::string& line) {
    FanucRun of;
    of.run.run(before);
    return of.fault(line);
}

} // namespace

TEST_CASE("without them the words are refused by name", "[program][fanuc_words]") {
    ProgramSettings settings = six_axes();
    settings.dialect = Dialect::fanuc;
    GcodeRun<double> run(settings);
    for (const char* const line : {"G52 X1", "G54.1 P1", "G154 P1", "G68 X0 Y0 R30", "G51 X0 Y0 P2.", "G51.1 X0"}) {
        CAPTURE(line);
        CHECK(run.push(line).error == ProgramError::coordinates_unsupported);
    }
    CHECK(run.push("G10 L20 P1 X5").error == ProgramError::g10_invalid); // LinuxCNC's is another one
    CHECK(run.push("G10 L2 P0 X5").error == ProgramError::g10_invalid);
    CHECK(run.push("G10 L2 P1 X5").ok());
    CHECK(run.text("G69 G50 G50.1\nG0 X1") == "rapid 6 0 0");
}

TEST_CASE("further work systems have origins of their own, which G10 L20 writes", "[program][fanuc_words]") {
    FanucRun of;
    CHECK(of.moves("G90 G10 L20 P3 X100 Y50\nG10 L20 P99 X-7\nG0 X1 Y1 Z1") == "rapid 1 1 1");
    CHECK(of.moves("G54.1 P3 G0 X1 Y1") == "rapid 101 51 1");
    CHECK(of.moves("X2\nG154 P99\nX2") == "rapid 102 51 1\nrapid -5 51 1");
    CHECK(of.moves("G154 P4 X2 Y2") == "rapid 2 2 1"); // none has been stated
    CHECK(of.moves("G10 L2 P2 X10\nG55 X0 Y0") == "rapid 10 0 1");
    CHECK(of.moves("G154 P3 X0 Y0\nG54 X0") == "rapid 100 50 1\nrapid 0 50 1");
    CHECK(of.moves("G154 P3\nG91 G10 L20 P3 X1\nG90 X0") == "rapid 101 50 1");
    CHECK(of.moves("G20 G10 L20 P3 X1\nG21 X0") == "rapid 25.4 50 1");
    CHECK(of.moves("G91 G10 L2 P1 X5\nG10 L2 P1 X5\nG90 G54 X0") == "rapid 10 50 1");
    CHECK(of.moves("G43.1 Z10\nG54.1 P3 Z0") == "rapid 10 50 10");
}

TEST_CASE("further work systems have other names, too", "[program][fanuc_words]") {
    FanucRun of;
    CHECK(of.moves("G10 L20 P1 X100\nG10 L20 P20 X200\nG110 G0 X0\nG129 X0\nG54 X0\nG54 P1 X0") ==
          "rapid 100 0 0\nrapid 200 0 0\nrapid 0 0 0\nrapid 100 0 0");
    CHECK(of.moves("F60 G54 G98 G82 X1 Y1 Z-1 R1 P500\nG80 G54 G64 P0.1\nG0 X2") // P is that of the cycle, and of G64
              .find("rapid 101") == std::string::npos);
    CHECK(of.fault("G54 P49") == FanucFault::system_number);
    CHECK(of.error("G110 P2") == ProgramError::word_unused);
    CHECK(of.error("G54.1 P2 Q2") == ProgramError::word_unused);
    CHECK(of.error("G52 X2 P2") == ProgramError::word_unused);
    CHECK(of.error("G110.5") == ProgramError::g_code_unknown);
    FanucRun few(4);
    CHECK(few.fault("G114") == FanucFault::system_number);
}

TEST_CASE("a further work system is a number, alone with its P", "[program][fanuc_words]") {
    FanucRun of;
    for (const char* const line : {"G54.1", "G54.1 P0", "G54.1 P49", "G154 P100", "G54.1 P1.5", "G4 G54.1 P1"}) {
        CAPTURE(line);
        CHECK(of.fault(line) == FanucFault::system_number);
    }
    CHECK(of.error("G54 G54.1 P1") == ProgramError::modal_group_conflict);
    CHECK(of.fault("G10 L20 P100 X1") == FanucFault::origin_word);
    CHECK(of.fault("G10 L2 P0 X1") == FanucFault::origin_word);
    CHECK(of.fault("G10 L2 P7 X1") == FanucFault::origin_word);
    CHECK(of.fault("G10 L2 P1 R30") == FanucFault::origin_word);
    CHECK(of.fault("G10 L20 P1") == FanucFault::origin_word);
    CHECK(of.error("G10 L20 P1 X2000000") == ProgramError::position_out_of_range);
    CHECK(of.error("G10 L10 P1 X1") == ProgramError::g10_tool_table);
    FanucRun few(4);
    CHECK(few.error("G154 P4") == ProgramError::none);
    CHECK(few.fault("G154 P5") == FanucFault::system_number);
    CHECK(few.fault("G10 L20 P5 X1") == FanucFault::origin_word);
}

TEST_CASE("P of a further system beside a cycle is no dwell", "[program][fanuc_words]") {
    CHECK(
        moves("G10 L20 P2 X100\nG98 G81 X1 Y1 Z-1 R1 F60\nG54.1 P2 X2") ==
        "rapid 0 0 1\nrapid 1 1 1\nfeed 1 1 -1\nrapid 1 1 1\nrapid 1 1 1\nrapid 102 1 1\nfeed 102 1 -1\nrapid 102 1 1");
}

TEST_CASE("G52 shifts all work systems, beside G92", "[program][fanuc_words]") {
    FanucRun of;
    CHECK(of.moves("G10 L2 P2 X100\nG10 L20 P1 X200\nG52 X5 Y6\nG0 X0 Y0\nG55 X0\nG154 P1 X0\nG54 X0") ==
          "rapid 5 6 0\nrapid 105 6 0\nrapid 205 6 0\nrapid 5 6 0");
    CHECK(of.moves("G52 X0\nX0 Y0") == "rapid 0 6 0");
    CHECK(of.moves("G92 X10\nX10\nG52 X1\nX10") == "rapid 0 6 0\nrapid 1 6 0"); // it leaves the shift of G92
    CHECK(of.moves("G92 X10\nX9") == "rapid 0 6 0");                            // which ends its own for X
    CHECK(of.moves("X10 Y0\nG52 Y0\nY0") == "rapid 1 6 0\nrapid 1 0 0");
    CHECK(of.moves("G20 G52 X1\nG21 X9") == "rapid 25.4 0 0");
    CHECK(of.moves("G91 G0 X1\nG90 G53 X3\nX9") == "rapid 26.4 0 0\nrapid 3 0 0\nrapid 25.4 0 0");
    CHECK(of.error("G52") == ProgramError::g92_axes_missing);
    CHECK(of.error("G52 X2000000") == ProgramError::position_out_of_range);
    CHECK(of.fault("G91 G52 X1") == FanucFault::local_step);
    CHECK(of.moves("G91 G52 Z0\nG90 Z1") == "rapid 25.4 0 1"); // nothing to add to
}

TEST_CASE("M30 ends what they do, and origins stay", "[program][fanuc_words]") {
    FanucRun of;
    of.run.run("G10 L20 P1 X100\nG52 X5\nG54.1 P1\nG68 X0 Y0 R90\nG0 X1 Y0\nM30");
    of.run.interpreter().begin_next();
    CHECK(of.moves("G0 X1 Y2") == "rapid 1 2 0");
    CHECK(of.moves("G54.1 P1 X1") == "rapid 101 2 0");
}

TEST_CASE("G68 turns lines, arcs, cycles and increments in the plane", "[program][fanuc_words]") {
    FanucRun of;
    CHECK(of.moves("G68 X10 Y0 R90\nG0 X20 Y0 Z5\nG1 Y10 F60\nG2 X30 Y0 I10 J0") ==
          "rapid 10 10 5\nfeed 0 10 5\nfeed arc 10 20 5 about 0 20 5 by -270");
    CHECK(of.moves("G91 G1 X1\nG90 G98 G81 X5 Y1 Z-1 R1\nG80") ==
          "feed 10 21 5\nrapid 9 -5 5\nrapid 9 -5 1\nfeed 9 -5 -1\nrapid 9 -5 5");
    CHECK(of.moves("G69\nG0 X1 Y2") == "rapid 1 2 5");
    CHECK(of.moves("G52 X100\nG68 X0 Y0 R-90\nX1 Y0 A3\nG69 G52 X0") == "rapid 100 -1 5");
}

TEST_CASE("the centre of a rotation may be where the tool stands", "[program][fanuc_words]") {
    CHECK(moves("G0 X10 Y5\nG68 R180\nX11\nG91 X1 Y2") == "rapid 10 5 0\nrapid 9 5 0\nrapid 8 3 0");
    CHECK(moves("G20 G68 X1 Y1 R90\nG0 X2 Y1") == "rapid 25.4 50.8 0");
    CHECK(moves("G18 G68 X0 Z0 R90\nG0 X0 Z1\nG69") == "rapid 1 0 0");
    CHECK(moves("G19 G68 Y0 Z0 R90\nG0 Y1 Z0") == "rapid 0 0 1");
    CHECK(moves("G68 X0 Y0 R30\nG68 X0 Y0 R90\nG0 X1 Y0") == "rapid 0 1 0"); // of the angle before nothing is left
}

TEST_CASE("what controls do not agree on in a rotation is refused", "[program][fanuc_words]") {
    CHECK(fault("", "G68 X0 Y0") == FanucFault::rotation_angle);
    CHECK(fault("", "G68 X0 R30") == FanucFault::rotation_centre);
    CHECK(fault("", "G68 X0 Y0 Z0 R30") == FanucFault::rotation_centre);
    CHECK(fault("", "G55 G68 R30") == FanucFault::rotation_centre);
    CHECK(fault("G68 X0 Y0 R30", "G91 G68 X0 Y0 R30") == FanucFault::rotation_step);
    CHECK(fault("", "G91 G68 X0 Y0 R30") == FanucFault::none);
    CHECK(fault("G68 X0 Y0 R30", "G68 X1 Y0 R30") == FanucFault::rotation_again);
    CHECK(fault("G68 X0 Y0 R30", "G68 R30") == FanucFault::rotation_again);
    CHECK(fault("G0 X5 Y5\nG68 X0 Y0 R30", "G0 X1") == FanucFault::place_unstated);
    CHECK(fault("G0 X5 Y5\nG68 X0 Y0 R30", "G91 G0 X1") == FanucFault::none);
    CHECK(fault("G0 X5 Y5\nG68 X5 Y5 R30", "G0 X1") == FanucFault::none); // it is where it was
    CHECK(fault("G0 X5 Y5\nG68 X0 Y0 R30\nX1 Y1", "X2") == FanucFault::none);
    CHECK(fault("G68 X0 Y0 R30\nG0 X5 Y5\nG69", "G91 X1") == FanucFault::step_behind_end);
    CHECK(fault("G68 X0 Y0 R30\nG0 X5 Y5\nG69", "U1") == FanucFault::step_behind_end);
    CHECK(fault("G68 X0 Y0 R30\nG0 X5 Y5\nG69", "G91 G28 X1") == FanucFault::step_behind_end);
    CHECK(fault("G68 X0 Y0 R30\nG0 X5 Y5\nG69", "G91 G28 X0 Y0") == FanucFault::none);
    CHECK(fault("G68 X0 Y0 R30\nG0 X5 Y5\nG69\nX1", "G91 X1") == FanucFault::none);
    FanucRun of;
    CHECK(of.error("G68 X0 Y0 R30 I1") == ProgramError::word_unused);
    CHECK(of.error("G68 X0 Y0 R30 G28") == ProgramError::axis_words_twice);
    CHECK(of.error("G68 X2000000 Y0 R30") == ProgramError::position_out_of_range);
    CHECK(of.fault("G68 G69 X0 Y0 R30") == FanucFault::order);
    CHECK(of.error("G52 Y1 G50.1") == ProgramError::axis_words_twice);
    CHECK(of.error("G1 G68 X0 Y0 R30") == ProgramError::feed_missing);
    CHECK(of.moves("G0 X1 Y2") == "rapid 1 2 0"); // it has been taken back
}

TEST_CASE("in turned coordinates nothing else changes them", "[program][fanuc_words]") {
    for (const char* const line : {"G18", "G55", "G54.1 P1", "G52 X1", "G92 X1", "G10 L2 P1 X1", "G28", "G28 X0",
                                   "G53 G0 X1", "G92.1", "G28.1"}) {
        CAPTURE(line);
        CHECK(fault("G68 X0 Y0 R30", line) == FanucFault::with_turned);
    }
    FanucRun of;
    CHECK(of.moves("G17 G68 X0 Y0 R90\nG0 X1 Y0 Z5\nG17 G91 G28 Z0\nG90 G53 Z3\nG4 X1.") ==
          "rapid 0 1 5\nrapid 0 1 5\nrapid 0 1 0\nrapid 0 1 3");
    CHECK(of.fault("G69 G55 G0 X1 Y1") == FanucFault::none);
}

TEST_CASE("G51 scales about a centre, and G50 ends it", "[program][fanuc_words]") {
    FanucRun of;
    CHECK(of.moves("G51 X10 Y10 Z0 P2.\nG0 X20 Y10 Z1\nG3 X10 Y20 I-10 J0 F60\nG91 G1 X-1 Y-1") ==
          "rapid 30 10 2\nfeed arc 10 30 2 about 10 10 2 by 90\nfeed 8 28 2");
    CHECK(of.moves("G90 G50\nG1 X1 Y1 Z1") == "feed 1 1 1");
    CHECK(of.moves("G51 P0.5\nX3 Y1 Z1") == "feed 2 1 1"); // about where the tool stands
    CHECK(of.moves("X1 Y1\nG69 G50\nX0 Y0 Z0\nG51 X0 Y0 P2.\nG68 X10 Y0 R90\nX20 Y0\nG69\nX1 Y0\nG50") ==
          "feed 1 1 1\nfeed 0 0 0\nfeed 20 20 0\nfeed 2 0 0"); // the centre is scaled, too
}

TEST_CASE("what controls do not agree on in a scale is refused", "[program][fanuc_words]") {
    for (const char* const line : {"G51 X0 Y0", "G51 X0 Y0 P2", "G51 P2000", "G51 P0.001", "G51 P-1.", "G51 P11."}) {
        CAPTURE(line);
        CHECK(fault("", line) == FanucFault::scale_factor);
    }
    CHECK(fault("", "G51 X0 Y0 I2. J2. P1.") == FanucFault::scale_parts);
    CHECK(fault("G51 P2.", "G51 P3.") == FanucFault::order);
    CHECK(fault("G68 X0 Y0 R30", "G51 P3.") == FanucFault::order);
    CHECK(fault("G51 P2.\nG68 X0 Y0 R30", "G50") == FanucFault::order);
    CHECK(fault("G51 P2.\nG68 X0 Y0 R30", "G69 G50") == FanucFault::none);
    CHECK(fault("", "G51 G50 P2.") == FanucFault::order);
    CHECK(fault("G51 P2.\nF60", "G81 X1 Y1 Z-1 R1") == FanucFault::scaled_cycle);
    CHECK(fault("G81 X1 Y1 Z-1 R1 F60", "G51 P2.") == FanucFault::scaled_cycle);
    CHECK(fault("", "G43.1 Z1 G51 P2.") != FanucFault::none);
    CHECK(fault("G51 X1 Y1 Z1 P2.\nG0 X1 Y1 Z5\nG50", "G91 Z1") == FanucFault::step_behind_end);
    FanucRun of;
    CHECK(of.error("G51 A0 P2.") == ProgramError::word_unused);
    CHECK(of.moves("#1=1.5\nG51 P#1\nG0 X2") == "rapid 3 0 0");
}

TEST_CASE("G51.1 mirrors axes, and arcs with them", "[program][fanuc_words]") {
    FanucRun of;
    CHECK(of.moves("F60 G51.1 X10\nG0 X0 Y0\nG2 X10 Y10 I10 J0\nG91 G1 X1\nG90") ==
          "rapid 20 0 0\nfeed arc 10 10 0 about 10 0 0 by 90\nfeed 9 10 0");
    CHECK(of.moves("G51.1 Y0\nG1 X0 Y0\nG2 X10 Y10 I10 J0\nG50.1 Y0\nG1 X0 Y1\nG50.1 X0\nX0 Y1") ==
          "feed 20 0 0\nfeed arc 10 -10 0 about 10 0 0 by -90\nfeed 20 1 0\nfeed 0 1 0");
    CHECK(fault("G51.1 X0", "G50.1") == FanucFault::mirror_axes);
    CHECK(fault("", "G51.1") == FanucFault::mirror_axes);
    CHECK(fault("", "G51.1 A0") == FanucFault::mirror_axes);
    CHECK(fault("", "G91 G51.1 X0") == FanucFault::local_step);
    CHECK(fault("G51.1 X0", "G68 X0 Y0 R30") == FanucFault::order);
    CHECK(fault("G51.1 X0", "G51 P2.") == FanucFault::order);
    CHECK(fault("G68 X0 Y0 R30", "G51.1 X0") == FanucFault::order);
    CHECK(fault("G51.1 X0", "G41 D1") == FanucFault::mirrored_side);
    CHECK(fault("G51.1 Z0\nF60", "G81 X1 Y1 Z-1 R1") == FanucFault::scaled_cycle);
    CHECK(fault("G51.1 X0\nF60", "G81 X1 Y1 Z-1 R1") == FanucFault::none);
}

TEST_CASE("cutter compensation follows a rotation, and does not begin or end within one", "[program][fanuc_words]") {
    FanucRun of;
    CHECK(of.moves("G68 X0 Y0 R90\nG0 X0 Y0\nG41 D2 G1 X10 Y0 F60\nX20\nG40 X30 Y0\nG69") ==
          "rapid 0 0 0\nfeed -1 10 0\nfeed -1 20 0\nfeed 0 30 0");
    of.run.run("G0 X0 Y0\nG41 D2");
    CHECK(of.error("G68 X0 Y0 R90") == ProgramError::cutter_active);
    CHECK(of.error("G54.1 P1") == ProgramError::cutter_active);
    CHECK(of.error("G69 G50") == ProgramError::none); // neither is in effect
}

TEST_CASE("a refused line leaves all as it was", "[program][fanuc_words]") {
    FanucRun of;
    of.run.run("G10 L20 P1 X100\nF0 G0 X5 Y0");
    for (const char* const line :
         {"G54.1 P1 G1 X0", "G10 L20 P1 X7 G1", "G52 X3 G1", "G68 X0 Y0 R90 G1", "G51 P2. G1"}) {
        CAPTURE(line);
        CHECK(of.error(line) == ProgramError::feed_missing);
        CHECK_FALSE(of.words.moves_program());
        CHECK(of.words.system() == nullptr);
        CHECK(of.further[0].origin[0] == Decimal::from_integer(100));
        CHECK(of.moves("G0 X6") == "rapid 6 0 0");
    }
}

TEST_CASE("whoever looks for further errors goes on without the words that are refused", "[program][fanuc_words]") {
    FanucRun of;
    of.run.run("G0 X1 Y1");
    const PerAxis<Position> place = of.run.interpreter().position();
    for (const char* const line :
         {"G154 P100 X9", "G10 L20 P0 X9", "G68 X9 R3", "G51 X9 P2", "G51.1 A9", "G91 G52 P1"}) {
        CAPTURE(line);
        CHECK_FALSE(of.run.push(line).ok());
        of.run.interpreter().obey_refused();
        CHECK(of.run.interpreter().position() == place);
        CHECK(of.moves("G90 X1 Y1") == "rapid 1 1 0");
        CHECK_FALSE(of.words.moves_program());
    }
}

TEST_CASE("a dwell in a hole of more than a minute by a decimal point is refused", "[program][fanuc_words]") {
    CHECK(fault("F60", "G82 X1 Y1 Z-1 R1 P500.") == FanucFault::dwell_point);
    CHECK(fault("F60", "G82 X1 Y1 Z-1 R1 P0.5") == FanucFault::none);
    CHECK(fault("F60", "G82 X1 Y1 Z-1 R1 P500") == FanucFault::none);
    CHECK(fault("", "G4 P500.") == FanucFault::none); // a spindle may take its time to get warm
}

TEST_CASE("every fault has a sentence, which names no option of the host", "[program][fanuc_words]") {
    for (int fault = 0; fault <= static_cast<int>(FanucFault::dwell_point); ++fault) {
        const std::string sentence = describe(static_cast<FanucFault>(fault));
        CAPTURE(fault, sentence);
        CHECK(sentence.size() > 7);
        CHECK(sentence.find("--") == std::string::npos);
    }
}
