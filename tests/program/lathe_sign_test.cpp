// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/words/lathe_sign.hpp"

#include "support/gcode.hpp"

using namespace splinefeed_test;

namespace {

struct Case {
    const char* before;
    const char* line;
    int column; // of the sign; 0: the line is a mill's
};

void check(Dialect dialect, const Case& test) {
    ProgramSettings settings;
    settings.dialect = dialect;
    GcodeRun<double> run(settings);
    run.run(test.before);
    CAPTURE(static_cast<int>(dialect), test.before, test.line);
    const BlockStatus status = run.push(test.line);
    CHECK((status.error == ProgramError::lathe_word) == (test.column > 0));
    CHECK((test.column == 0 || status.column == test.column));
}

} // namespace

TEST_CASE("a lathe's words refuse a program that is read as a mill's", "[program][lathe]") {
    const Case cases[] = {
        {"", "T0101", 1},
        {"", "N5 T1212", 4},
        {"", "T0200", 1},
        {"", "T0100", 1},
        {"", "T1010 M6", 0},
        {"", "T0101 M6", 0},
        {"", "T1001", 0},
        {"", "T0012", 0},
        {"", "T101", 0},
        {"", "T1", 0},
        {"", "G50 S2000", 1},
        {"G0 X0", "G50 X200. Z100.", 1},
        {"", "G0 G17 G40 G49 G50 G80 G90", 0},
        {"", "G50 G69", 0},
        {"", "G92 X10 Y5 Z1", 0},
        {"G0 X42 Z2", "G92 X40. Z-20. F1.5", 1},
        {"G0 X42 Z2", "G90 X38. Z-20. F0.2", 1},
        {"G0 X42 Z2", "G94 X38. Z-2. F100", 1},
        {"G0 X42 Z2", "G90 U-2. W-22. F0.2", 1},
        {"G0 X42 Z2", "G90 G1 X38. Z-20. F100", 0},
        {"G0 X42 Z2", "G90 X38. Y5 F100", 0},
        {"G0 X42 Z2", "G90 X38. Z-20.", 0},
        {"G1 X42 Z2 F100", "G90 X38. Z-20. F120", 0},
        {"G99", "G1 X5 F0.2", 7},
        {"", "G20 G99 G1 X5 F0.008", 15},
        {"G99", "G1 X5 F100", 0},
        {"G99 G95 S500", "G1 X5 F0.2", 0},
        {"G99 G93", "G1 X5 F0.2", 0},
        {"G98", "G1 X5 F0.2", 0},
        {"", "G99 G81 X1 Z-1 R1 F1.5", 0},
        {"F60", "G73 X1 Z-5 R1 Q2", 0},
    };
    for (const Case& test : cases) {
        check(Dialect::fanuc, test);
    }
}

TEST_CASE("in other dialects a cycle is a lathe's behind a tool with its offset", "[program][lathe]") {
    const Case cases[] = {
        {"", "T0101", 0},
        {"G99\nT0101\nG0 X42 Z2", "G90 X38 Z-20 F100", 1},
        {"T0101\nG0 X42 Z2", "G92 X38 Z-20 F100", 1},
        {"T0101 M6\nG0 X42 Z2", "G90 X38 Z-20 F100", 0},
        {"T0101\nM6\nG0 X42 Z2", "G90 X38 Z-20 F100", 0},
        {"T0101\nT1\nG0 X42 Z2", "G90 X38 Z-20 F100", 0},
        {"T0101\nG0 X42 Z2", "G90 X38 Z-20", 0},
        {"G0 X42 Z2", "G90 X38 Z-20 F100", 0},
        {"G0 X42 Z2", "G92 X38 Z-20 F100", 0},
    };
    for (const Case& test : cases) {
        for (const Dialect dialect : {Dialect::linuxcnc, Dialect::grbl}) {
            check(dialect, test);
        }
    }
}

TEST_CASE("cycles of lathes that a mill has not are refused without a sign", "[program][lathe]") {
    for (const char* const line : {"G92 S2000", "G71 U2 R1", "G73 U5 R3", "G73 P10 Q20 U0.4 W0.2 F0.3", "G74 R1",
                                   "G74 Z-50 Q5000 F0.1", "G75 X1 Z2 P3 Q4", "G96 S200", "G32 Z-5 F1"}) {
        ProgramSettings settings;
        settings.dialect = Dialect::fanuc;
        GcodeRun<double> run(settings);
        CAPTURE(line);
        CHECK_FALSE(run.push(line).ok());
    }
}
