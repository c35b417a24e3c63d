// SPDX-License-Identifier: MIT
// The expressions of Fanuc's custom macro B, in words and assignments of the dialect fanuc.
#include "splinefeed/s0_program/text/macro_operation.hpp"

#include "support/gcode.hpp"

using namespace splinefeed_test;

namespace {

ProgramSettings fanuc() {
    ProgramSettings settings = six_axes();
    settings.dialect = Dialect::fanuc;
    return settings;
}

/// What is assigned, as a number; "vacant", or why it is refused.
std::string assigned(const std::string& value, const std::string& before = "#9=#0") {
    GcodeRun<double> run(fanuc());
    run.run(before);
    const BlockStatus status = run.push("#1=" + value);
    Decimal out;
    if (!status.ok()) {
        return describe(status.error);
    }
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", run.table().read(1, out) && out != vacant ? number(out) : 0.0);
    return out == vacant ? "vacant" : text;
}

ProgramError error_of(const std::string& line) {
    GcodeRun<double> run(fanuc());
    run.run("#1=1\n#2=2");
    return run.push(line).error;
}

} // namespace

TEST_CASE("An assignment takes an expression without brackets", "[program][macro_operation]") {
    CHECK(assigned("2+3*4") == "14");
    CHECK(assigned("-#2+10/4-1", "#2=3") == "-1.5");
    CHECK(assigned("#2*[#2-1] (comment)", "#2=3") == "6");
    CHECK(assigned("SIN[30]*2+COS[60]") == "1.5");
    CHECK(assigned("10-4-3") == "3");
    CHECK(assigned("5 #3=7") == "5");
    CHECK(error_of("#3=1+") == ProgramError::number_invalid);
    CHECK(error_of("#3=1]") == ProgramError::character_invalid);
    GcodeRun<double> linuxcnc;
    CHECK_FALSE(linuxcnc.push("#1=2+3").ok()); // as LinuxCNC itself
}

TEST_CASE("Nine brackets lie within one another in an assignment", "[program][macro_operation]") {
    CHECK(assigned(std::string(9, '[') + "1" + std::string(9, ']')) == "1");
    CHECK(error_of("#1=" + std::string(10, '[') + "1" + std::string(10, ']')) == ProgramError::expression_too_deep);
}

TEST_CASE("A vacant parameter is 0 in arithmetic, and has no value where it is assigned",
          "[program][macro_operation]") {
    CHECK(assigned("#0") == "vacant");
    CHECK(assigned("#9") == "vacant");
    CHECK(assigned("-#9") == "vacant");
    CHECK(assigned("[#9]") == "vacant");
    CHECK(assigned("#9+3") == "3");
    CHECK(assigned("#9*5") == "0");
    CHECK(assigned("#9+#9") == "0");
    CHECK(assigned("ABS[#9]") == "0");
    CHECK(assigned("COS[#9]") == "1");
    CHECK(assigned("ATAN[#9]/[1]") == "0");
    CHECK(assigned("ATAN[1]/[#9]") == "90");
    CHECK(assigned("#9 MOD 5") == "0");
    CHECK(assigned("EXISTS[#9]") == "0");
    CHECK(assigned("1/#9") == describe(ProgramError::division_by_zero));
    CHECK(assigned("##9") == describe(ProgramError::parameter_out_of_range));
    CHECK(assigned("#[#9]") == describe(ProgramError::parameter_out_of_range));
}

TEST_CASE("EQ and NE tell vacant from 0, the other comparisons do not", "[program][macro_operation]") {
    const std::string zero = "#8=0\n#9=#0";
    CHECK(assigned("[#9 EQ #0]", zero) == "1");
    CHECK(assigned("[#8 EQ #0]", zero) == "0");
    CHECK(assigned("[#9 NE 0]", zero) == "1");
    CHECK(assigned("[#8 NE 0]", zero) == "0");
    CHECK(assigned("[#0 NE #9]", zero) == "0");
    CHECK(assigned("[#9 GE #0]", zero) == "1");
    CHECK(assigned("[#8 GE #0]", zero) == "1");
    CHECK(assigned("[#9 GT 0]", zero) == "0");
    CHECK(assigned("[#9 LE 0]", zero) == "1");
    CHECK(assigned("[#9 LT 1]", zero) == "1");
}

TEST_CASE("A word whose value is vacant is left out", "[program][macro_operation]") {
    GcodeRun<double> run(fanuc());
    CHECK(run.text("#1=0\nG0 X5 Y5 Z5\nG0 X#1 Y#2") == "rapid 5 5 5\nrapid 0 5 5");
    CHECK(run.text("G#3 X-#2 Y-[#2] Z7") == "rapid 0 5 7");
    CHECK(run.text("X[#2+1]") == "rapid 1 5 7");
    CHECK(run.text("#1=4\nX-#1 Y#[#1-3]") == "rapid -4 4 7");
    CHECK(run.text("#5=0\nG#5 X#1 M#2").find("rapid 4") == 0);
}

TEST_CASE("AND, OR and XOR are of bits, and stand alone in their brackets", "[program][macro_operation]") {
    CHECK(assigned("6 AND 3") == "2");
    CHECK(assigned("6 OR 3") == "7");
    CHECK(assigned("6 XOR 3") == "5");
    CHECK(assigned("[1 EQ 1] AND [2 GT 1] AND [3 LT 4]") == "1");
    CHECK(assigned("100000000 AND 65535") == "57600");
    CHECK(error_of("#3=[#1 EQ 1 AND #2 EQ 2]") == ProgramError::logic_ambiguous);
    CHECK(error_of("#3=#1 AND #2 OR 4") == ProgramError::logic_ambiguous);
    CHECK(error_of("#3=#1+#2 AND 4") == ProgramError::logic_ambiguous);
    CHECK(error_of("#3=#1 OR 2*3") == ProgramError::logic_ambiguous);
    CHECK(error_of("#3=SIN[#1 AND 2+1]") == ProgramError::logic_ambiguous);
    CHECK(error_of("#3=1.5 AND 1") == ProgramError::integer_needed);
    CHECK(error_of("#3=[-1] OR 1") == ProgramError::integer_needed);
}

TEST_CASE("MOD has the sign of its dividend, FIX cuts off and FUP goes away from 0", "[program][macro_operation]") {
    CHECK(assigned("27 MOD 20") == "7");
    CHECK(assigned("-27 MOD 20") == "-7");
    CHECK(error_of("#3=2.5 MOD 2") == ProgramError::integer_needed);
    CHECK(error_of("#3=2 MOD 0") == ProgramError::division_by_zero);
    CHECK(assigned("FIX[1.2]") == "1");
    CHECK(assigned("FIX[-1.2]") == "-1");
    CHECK(assigned("FUP[1.2]") == "2");
    CHECK(assigned("FUP[-1.2]") == "-2");
    CHECK(assigned("FUP[-2]") == "-2");
    CHECK(assigned("ROUND[1.5]") == "2");
    CHECK(assigned("ROUND[-1.5]") == "-2");
}

TEST_CASE("Angles are 0 to 360, of ASIN 270 to 360 and 0 to 90", "[program][macro_operation]") {
    CHECK(assigned("ATAN[-1]/[-1]") == "225");
    CHECK(assigned("ATAN[1]/[1]") == "45");
    CHECK(assigned("ASIN[-0.5]") == "330");
    CHECK(assigned("ASIN[0.5]") == "30");
    CHECK(assigned("ACOS[-1]") == "180");
    CHECK(error_of("#3=ASIN[2]") == ProgramError::arc_function_argument);
}

TEST_CASE("ROUND in a word rounds to the least coordinate, elsewhere to a whole number", "[program][macro_operation]") {
    const std::string value = "#1=1.00333\n#2=33.3336\n";
    GcodeRun<double> run(fanuc());
    CHECK(run.text(value + "G0 X[ROUND[#1]+ROUND[#1]] A[ROUND[#2]]", 4) == "rapid 2.006 0 0 33.334");
    CHECK(run.text(value + "#3=ROUND[#1]\nG0 X#3") == "rapid 1 0 0");
    CHECK(run.last("G20\nG0 X[ROUND[#1]]") == "rapid 25.48382 0 0"); // 1.0033 inches
    CHECK(run.last("G21\nG0 Y[ROUND[1.0625]]") == "rapid 25.48382 1.063 0");
}

TEST_CASE("Variables of the control are refused by name", "[program][macro_operation]") {
    for (const char* line : {"#3=#1000", "#3=#3012", "#3=#4001", "#1132=1", "#3=#7001", "#3=#100500", "#2001=5"}) {
        CAPTURE(line);
        CHECK(error_of(line) == ProgramError::parameter_refused);
    }
    CHECK(error_of("#0=1") == ProgramError::parameter_refused);
    CHECK(error_of("#5221=#0") == ProgramError::position_out_of_range);
    CHECK(error_of("#999=1 #3=#999") == ProgramError::none);
    CHECK(error_of("#3=#1.5") == ProgramError::parameter_out_of_range);
}

TEST_CASE("Origins of work coordinates are in the units of the program", "[program][macro_operation]") {
    GcodeRun<double> run(fanuc());
    run.run("G20\n#5241=2\n#1=#5241+1\nG0 G55 X#1");
    CHECK(to_mm(run.items().back().element.to[0]) == 5 * 25.4);
    CHECK(run.interpreter().offsets().systems[1].origin[0] == Decimal{50'800'000'000});
    run.run("G21\n#5244=15");
    CHECK(run.interpreter().offsets().systems[1].origin[3] == Decimal{15'000'000'000});
}
