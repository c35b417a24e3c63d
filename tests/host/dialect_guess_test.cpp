// SPDX-License-Identifier: MIT
#include "host_sim/program/dialect_guess.hpp"

#include "support/catch.hpp"

#include <sstream>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

DialectGuess guess(const std::string& program) {
    DialectGuess out;
    std::istringstream lines(program);
    std::uint64_t number = 0;
    for (std::string line; std::getline(lines, line);) {
        out.add(line, ++number);
    }
    return out;
}

} // namespace

TEST_CASE("A comment that names the controller decides") {
    CHECK(guess("G21\n(Post Processor: grbl_post)\nG64 P0.1").dialect() == Dialect::grbl);
    CHECK(guess("(Post Processor: linuxcnc_post)\nG1 X5").dialect() == Dialect::linuxcnc);
    CHECK(guess(";FLAVOR:Marlin\nG1 X5").dialect() == Dialect::marlin);
    CHECK(guess("; gcode_flavor = klipper\nM104 S20\nM82\nM140 S1").dialect() == Dialect::klipper);
    CHECK(guess(";FLAVOR:Marlin").reason() == "';FLAVOR:Marlin' on line 1");
}

TEST_CASE("Words that one controller alone has decide") {
    CHECK(guess("G21\nM104 S200\nG1 X5").dialect() == Dialect::marlin);
    CHECK(guess("G21\nM104 S200\nG1 X5").reason() == "'M104 S200' on line 2");
    CHECK(guess("G1 X5 E0.2 F600").dialect() == Dialect::marlin);
    CHECK(guess("$H\nG1 X5").dialect() == Dialect::grbl);
    CHECK(guess("START_PRINT\nM104 S1").dialect() == Dialect::klipper);
    CHECK(guess("%\nO1000\nG0 G80 G50 G69").dialect() == Dialect::fanuc);
    CHECK(guess("%\nO1000\nG28 U0 W0").dialect() == Dialect::fanuc);
    CHECK(guess("%\nO1000 (NAME)\nG4 P2").dialect() == Dialect::fanuc);
    CHECK(guess("O1000\nG154 P2 X0").dialect() == Dialect::fanuc);
    CHECK(guess("%\n:0097\nG0 X5").dialect() == Dialect::fanuc);
    CHECK(guess("IF [#1 EQ #0] GOTO 10\n#2 = #1").dialect() == Dialect::fanuc);
    CHECK(guess("T0101\nG0 X5").dialect() == Dialect::fanuc);
    CHECK(guess("G28 X Y\nG1 X5").dialect() == Dialect::marlin);
    CHECK(guess("G28 Z P0 T140\nG1 X5").dialect() == Dialect::marlin);
    CHECK(guess("G5\nG1 X5").dialect() == Dialect::marlin);
    CHECK(guess("G28\nG28 X0 Y0\nT1010\nT11 M6").dialect() == Dialect::fanuc);
    CHECK(guess("#1=[1+2]\n#2=#1+1\nN10 WHILE [#1 LT 5] DO1").reason() == "'N10 WHILE [#1 LT 5] DO1' on line 3");
    for (const char* line : {"IF[#1 EQ #0]GOTO 5", "n5 G65 P9010 A1", "M97 P100", "#3000=1 (STOP)", "#3006=1"}) {
        CHECK(guess("#1=[1]\nG64 P0.01\n" + std::string(line)).dialect() == Dialect::fanuc);
    }
    CHECK(guess("IF R1==5 GOTOF A\n#1=[1]").dialect() == Dialect::linuxcnc);
    CHECK(guess("_Contour_Setup(\"SHAFT\",3)\nG0 X5").dialect() == Dialect::linuxcnc); // of Siemens
    CHECK(guess("START_PRINT (now)").dialect() == Dialect::klipper);
    CHECK(guess("M2000;line mode\nG21").dialect() == Dialect::marlin);
    CHECK(guess("M888 P0\nG21").dialect() == Dialect::marlin);
    CHECK(guess("o<a> sub\no<a> endsub\nG1 X[1+2]").dialect() == Dialect::linuxcnc);
}

TEST_CASE("What LinuxCNC refuses tells another one, where nothing else does") {
    CHECK(guess("G21 G90\nG53 G0 Z-5\nX10").dialect() == Dialect::linuxcnc); // G0 is in effect
    CHECK(guess("G21 G90 G54\nN5 Z10\nG0 X5").dialect() == Dialect::grbl);
    CHECK(guess("G21\nG0 X1\nG81 X1 Z-1 R1\nG80\nZ10.").dialect() == Dialect::fanuc);
    CHECK(guess("G21\nG0 X1\nG81 X1 Z-1 R1\nG80\nG0 Z10.\nX5").dialect() == Dialect::linuxcnc);
    CHECK(guess("G21\nM104 S5\nZ10").dialect() == Dialect::marlin);
    CHECK(guess("G1 X5 F5\nG2 X5 Y0 I1 J0 K0").dialect() == Dialect::grbl);
    CHECK(guess("G1 X5 F5\nG2 X5 Y0 Z1 I1 J0").dialect() == Dialect::linuxcnc);
    CHECK(guess("(EMC2)\nG2 X5 Y0 I1 J0 K0\nG80\nZ5").dialect() == Dialect::linuxcnc);
    CHECK(guess("(replace (cut)\nG1 X5 F60").dialect() == Dialect::grbl);
    CHECK(guess("(a)(b)\nG1 X5 F60").dialect() == Dialect::linuxcnc);
}

TEST_CASE("Without evidence it is linuxcnc") {
    for (const char* const program : {"", "G21 G90\nG1 X5 F600\nM2", "G150\nM1040", "hello world", "(E5)\nG1 X5",
                                      "G1 X2.4e-16", "%\nG4 P2\n%", "O1000\nG1 X5", "G28 X0\nT1 M6\nT12345"}) {
        CAPTURE(program);
        CHECK(guess(program).dialect() == Dialect::linuxcnc);
        CHECK(guess(program).reason().empty());
    }
}

TEST_CASE("Where little says whose a program is, lines that others read otherwise are told") {
    const auto told = [](const std::string& program) {
        const DialectGuess of = guess(program);
        return of.differences(of.dialect());
    };
    CHECK(told("G21\nG4 P500") == "'G4 P500' on line 2 waits 500 s, in fanuc it waits 0.5 s");
    CHECK(told("%\nO1\no<a> sub\nG04 P2.").empty()); // both take a point for seconds
    CHECK(told("%\nO1\no<a> sub\nG04 P2").find("waits 2 s, in fanuc it waits 0.002 s") != std::string::npos);
    CHECK(told("(Easel)\nM82\nG28 X0") == "'G28 X0' on line 3 goes to a stored place, in marlin it is homing");
    CHECK(told("G1 X1 A5 F60").find("in grbl it has F along all of its axes, in fanuc") != std::string::npos);
    CHECK(told("G1 F60\nX1 A5").find("'X1 A5' on line 2 has F along X, Y and Z alone") == 0);
    CHECK(told("G93\nG1 X1 A5 F60").empty());
    CHECK(told("G04 P3\nG61\nG28 X\nG28 Y\nG28 Z") ==
          "'G04 P3' on line 1 waits 0.003 s, in linuxcnc it waits 3 s, in grbl it waits "
          "3 s; 'G28 X' on line 3 is homing, in linuxcnc it goes to a stored place, in "
          "grbl it goes to a stored place, in fanuc it goes to a stored place");
    CHECK(told("G21 G90\nG1 X5 F60\nG28 X0\nM2").empty());
    CHECK(told("(grbl)\nG1 X1 A5 F60\nG4 P500").empty()); // it is named
}
