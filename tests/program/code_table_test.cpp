// SPDX-License-Identifier: MIT
// Which words may be left out of a program: docs/reference/gcode.md.
#include "splinefeed/s0_program/dialects/code_table.hpp"

#include "support/gcode.hpp"

using namespace splinefeed_test;

namespace {

ProgramSettings in_dialect(Dialect dialect) {
    ProgramSettings settings;
    settings.dialect = dialect;
    return settings;
}

} // namespace

TEST_CASE("a word has the effect of its group, unless its row says another", "[program][dialects]") {
    CHECK(find_g_code(10, Dialect::linuxcnc).effect == CodeEffect::motion);
    CHECK(find_g_code(170, Dialect::linuxcnc).effect == CodeEffect::coordinates);
    CHECK(find_g_code(280, Dialect::linuxcnc).effect == CodeEffect::machine);
    CHECK(find_g_code(650, Dialect::fanuc).effect == CodeEffect::flow);
    CHECK(find_g_code(9990, Dialect::linuxcnc).effect == CodeEffect::motion); // of no table
    CHECK(find_m_code(2, Dialect::grbl).effect == CodeEffect::flow);
    CHECK(find_m_code(8, Dialect::grbl).effect == CodeEffect::machine);
    CHECK(find_m_code(73, Dialect::linuxcnc).effect == CodeEffect::coordinates);
    CHECK(find_m_code(73, Dialect::marlin).effect == CodeEffect::machine);
    CHECK(find_m_code(808, Dialect::marlin).effect == CodeEffect::flow);
    CHECK(find_m_code(808, Dialect::linuxcnc).effect == CodeEffect::machine); // of no table
}

TEST_CASE("what changes the path, its place or the order of blocks is not left out", "[program][dialects]") {
    struct Case {
        Dialect dialect;
        IgnoredWord named;
        const char* line;
        ProgramError error;
    };
    constexpr Case cases[] = {
        {Dialect::linuxcnc, {'G', 810}, "G81 X1 Z-1 R1 F60", ProgramError::ignored_word_counts},
        {Dialect::linuxcnc, {'G', 10}, "G1 X1 F60", ProgramError::ignored_word_counts},
        {Dialect::linuxcnc, {'G', 910}, "G91", ProgramError::ignored_word_counts},
        {Dialect::linuxcnc, {'G', 540}, "G54", ProgramError::ignored_word_counts},
        {Dialect::linuxcnc, {'G', 920}, "G92 X1", ProgramError::ignored_word_counts},
        {Dialect::linuxcnc, {'G', 610}, "G61", ProgramError::ignored_word_counts},
        {Dialect::linuxcnc, {'M', 20}, "M2", ProgramError::ignored_word_counts},
        {Dialect::linuxcnc, {'M', 980}, "M98 P1", ProgramError::ignored_word_counts},
        {Dialect::linuxcnc, {'M', 720}, "M72", ProgramError::ignored_word_counts},
        {Dialect::linuxcnc, {'X', IgnoredWord::any}, "G0 X1", ProgramError::ignored_word_counts},
        {Dialect::linuxcnc, {'F', IgnoredWord::any}, "F60", ProgramError::ignored_word_counts},
        {Dialect::linuxcnc, {'R', IgnoredWord::any}, "G2 X1 R5 F60", ProgramError::ignored_word_counts},
        {Dialect::linuxcnc, {'G', 680}, "G68 X0 Y0 R90", ProgramError::coordinates_unsupported},
        {Dialect::linuxcnc, {'G', 2340}, "G234 X9", ProgramError::g_code_unknown},
        {Dialect::fanuc, {'W', IgnoredWord::any}, "G0 W1", ProgramError::ignored_word_counts}, // a step of Z
        {Dialect::fanuc, {'G', 160}, "G16", ProgramError::coordinates_unsupported},
        {Dialect::fanuc, {'G', 510}, "G51 X0 Y0 P2", ProgramError::coordinates_unsupported},
        {Dialect::fanuc, {'G', 511}, "G51.1 X0", ProgramError::coordinates_unsupported},
        {Dialect::fanuc, {'G', 682}, "G68.2 X0 Y0 Z0 I1 J2 K3", ProgramError::coordinates_unsupported},
        {Dialect::fanuc, {'G', 541}, "G54.1 P3", ProgramError::coordinates_unsupported},
        {Dialect::fanuc, {'G', 1540}, "G154 P3", ProgramError::coordinates_unsupported},
        {Dialect::fanuc, {'G', 650}, "G65 P9010 A1", ProgramError::ignored_word_counts},
        {Dialect::fanuc, {'M', 970}, "M97 P100", ProgramError::ignored_word_counts},
        {Dialect::fanuc, {'M', 960}, "M96 P100 Q3", ProgramError::macro_unsupported},
        {Dialect::fanuc, {'M', 1980}, "M198 P100", ProgramError::macro_unsupported},
        {Dialect::fanuc, {'G', 120}, "G12 I5 F60", ProgramError::pocket_unsupported},
        {Dialect::grbl, {'G', 520}, "G52 X1", ProgramError::not_in_dialect},
        {Dialect::linuxcnc, {'M', 250}, "M25 G49", ProgramError::m_code_unknown}, // Centroid's, which retracts
        {Dialect::fanuc, {'M', 260}, "M26", ProgramError::m_code_unknown},
        {Dialect::grbl, {'M', 910}, "M91 X Y", ProgramError::m_code_unknown},
        {Dialect::linuxcnc, {'M', 920}, "M92", ProgramError::m_code_unknown},
        {Dialect::marlin, {'M', 8080}, "M808 L3", ProgramError::printer_flow_unsupported},
        {Dialect::marlin, {'M', 6220}, "M622 J1", ProgramError::printer_flow_unsupported},
        {Dialect::marlin, {'M', 8100}, "M810 G1 X5", ProgramError::printer_flow_unsupported},
        {Dialect::marlin, {'M', 920}, "M92 X160", ProgramError::printer_move_unsupported},
        {Dialect::marlin, {'M', 2060}, "M206 X5", ProgramError::printer_move_unsupported},
        {Dialect::klipper, {'G', 200}, "G20", ProgramError::not_in_dialect},
    };
    for (const Case& test : cases) {
        for (const bool by_name : {true, false}) {
            if (!by_name && test.error == ProgramError::ignored_word_counts) {
                continue; // it is understood
            }
            ProgramSettings settings = in_dialect(test.dialect);
            settings.ignored = &test.named;
            settings.ignored_count = by_name ? 1 : 0;
            settings.ignores_unknown = !by_name;
            GcodeRun<double> run(settings);
            CAPTURE(test.line, by_name);
            CHECK(run.push(test.line).error == test.error);
        }
    }
}

TEST_CASE("a letter that is left out stays where a word before it takes it", "[program][dialects]") {
    const IgnoredWord ignored[] = {{'S', IgnoredWord::any}, {'T', IgnoredWord::any}, {'E', IgnoredWord::any}};
    const auto run_of = [&](Dialect dialect) {
        ProgramSettings settings = in_dialect(dialect);
        settings.ignored = ignored;
        settings.ignored_count = 3;
        return settings;
    };
    GcodeRun<double> marlin(run_of(Dialect::marlin));
    CHECK(marlin.text("G4 S2\nG1 X1 S5 E3") == "dwell 2\nfeed 1 0 0");
    GcodeRun<double> fanuc(run_of(Dialect::fanuc));
    for (const char* const sign : {"G50 S2000", "T0101"}) {
        CHECK(fanuc.push(sign).error == ProgramError::lathe_word);
    }
    CHECK(fanuc.text("T1 S500").empty());
    GcodeRun<double> linuxcnc(run_of(Dialect::linuxcnc));
    CHECK(linuxcnc.push("M68 E1 Q2").ok());
    CHECK(linuxcnc.text("M3 S5 E1").find("event") == 0);
}

TEST_CASE("words of the machine are left out by name, by letter and as unknown", "[program][dialects]") {
    const IgnoredWord all_m{'M', IgnoredWord::any};
    ProgramSettings settings = in_dialect(Dialect::fanuc);
    settings.ignored = &all_m;
    settings.ignored_count = 1;
    GcodeRun<double> by_letter(settings);
    CHECK(by_letter.text("M3 S5 M8\nM31\nM72\nG0 X1 M6").find("rapid 1 0 0") != std::string::npos);
    CHECK(by_letter.push("M2").ok()); // the letter names those that may be left out, and the end is none of them
    CHECK(by_letter.interpreter().has_ended());
    settings.ignored_count = 0;
    settings.ignores_unknown = true;
    GcodeRun<double> unknown(settings);
    CHECK(unknown.text("M31\nM33\nM72\nM150\nG0 X1") == "rapid 1 0 0");
    GcodeRun<double> neither(in_dialect(Dialect::fanuc));
    CHECK(neither.push("M72").error == ProgramError::m_code_unknown);
}
