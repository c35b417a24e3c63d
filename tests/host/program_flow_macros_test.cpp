// SPDX-License-Identifier: MIT
// Fanuc's custom macro B: jumps, loops, calls of macros and of lines.
#include "host_sim/base/input_error.hpp"
#include "host_sim/program/gcode/macro_variables.hpp"
#include "host_sim/program/gcode/program_flow.hpp"
#include "support/catch.hpp"
#include "text_lines.hpp"

#include "splinefeed/s0_program/expression.hpp"
#include "splinefeed/s0_program/interpreter.hpp"

using namespace splinefeed;
using namespace splinefeed::host;
using splinefeed_test::TextLines;

namespace {

/// The X of each move and "stop" for a pause, or the error; with `problems` all errors go there.
std::string run(const std::string& text, ProblemList* problems = nullptr, FlowRules rules = {}) {
    rules.programs = NumberedPrograms::fanuc;
    rules.macros = true;
    TextLines lines(text);
    ParameterMemory parameters;
    const std::vector<std::string> axes{"x", "y", "z"};
    MacroVariables variables(parameters, axes);
    Expression expression(variables);
    ProgramSettings settings;
    settings.dialect = Dialect::fanuc;
    settings.block_delete = rules.block_delete;
    Interpreter<double> interpreter(settings, &expression);
    interpreter.start({});
    variables.follow(interpreter);
    std::string out;
    try {
        ProgramFlow flow(lines, "p.nc", expression, interpreter, parameters, problems, rules);
        SourceLine line;
        ProgramItem<double> item;
        for (auto step = flow.next(line); step != ProgramFlow::Step::end && !interpreter.has_ended();
             step = flow.next(line)) {
            if (step == ProgramFlow::Step::nothing) {
                continue;
            }
            const BlockStatus status = interpreter.push(line.text, static_cast<std::uint32_t>(line.number));
            if (!status.ok()) {
                return out + " line " + std::to_string(line.number) + " " + describe(status.error);
            }
            while (interpreter.next(item) == Pull::item) {
                const bool pause = item.kind == ItemKind::event && item.event.kind == EventKind::pause;
                out += item.kind == ItemKind::move ? " " + std::to_string(static_cast<int>(to_mm(item.element.to[0])))
                       : pause                     ? " stop"
                                                   : "";
            }
        }
        out += flow.has_ended() && !interpreter.has_ended() ? " end" : "";
    } catch (const InputError& error) {
        return error.what();
    }
    return out;
}

/// Whether the program is refused with a text that begins so.
void says(const std::string& text, const std::string& begin) {
    CAPTURE(text);
    CHECK(run(text).substr(0, begin.size()) == begin);
}

} // namespace

TEST_CASE("GOTO leads forward and back") {
    CHECK(run("G0 X1\nGOTO 20\nX2\nN20 X3") == " 1 3");
    CHECK(run("#1=0\nN10 G0 X#1\n#1=#1+1\nIF [#1 LE 3] GOTO10\nX9") == " 0 1 2 3 9");
    CHECK(run("#1=30\nG0 X1\nGOTO#1\nX2\nN30 X3\nGOTO[#1+10]\nX4\nN40 X5") == " 1 3 5");
    CHECK(run("O1\nN5 G0 X1\nIF [#1 NE #0] GOTO 9\n#1=1\nGOTO 5\nN9 X4\nM30\nN10 X7") == " 1 1 4");
    CHECK(run("#1=1\nIF [#1 EQ 2] GOTO 77\nG0 X5") == " 5"); // nobody asks where it would lead
    CHECK(run("G0 X1\n/GOTO 5\nX2\nN5 X3", nullptr, {.block_delete = true}) == " 1 2 3");
}

TEST_CASE("IF THEN sets a variable, or stops") {
    CHECK(run("IF [#1 EQ #0] THEN #1=5\nG0 X#1\nIF [#1 GT 9] THEN #1=7 (no)\nX[#1+1]") == " 5 6");
    CHECK(run("G0 X1\nIF [1] THEN #3006=1 (LOOK)\nX2\n#3006=2(AGAIN)\nX3") == " 1 stop 2 stop 3");
    says("G0 X1\nIF [1] THEN #3000=12 (TOO DEEP)\nX2", "p.nc:2:13: the program ends itself by #3000=12 (TOO DEEP)");
    says("#3000=#1", "p.nc:1:1: the program ends itself by #3000=0 ()");
}

TEST_CASE("Loops, also within one another") {
    CHECK(run("#1=0\nWHILE [#1 LT 3] DO1\nG0 X#1\n#1=#1+1\nEND1\nX9") == " 0 1 2 9");
    CHECK(run("#1=0\nWHILE [#1 LT 2] DO1\n#2=0\nWHILE [#2 LT 2] DO2\nG0 X[10*#1+#2]\n#2=#2+1\nEND2\n#1=#1+1\nEND1") ==
          " 0 1 10 11");
    CHECK(run("WHILE [0] DO3\nG0 X1\nEND3\nG0 X2") == " 2");
    CHECK(run("#1=0\nDO1\n#1=#1+1\nG0 X#1\nIF [#1 EQ 3] GOTO 5\nEND1\nN5 X9") == " 1 2 3 9");
    CHECK(run("#1=0\nN1 WHILE [#1 LT 4] DO1\n#1=#1+1\nIF [#1 EQ 2] GOTO 1\nIF [#1 EQ 3] GOTO 2\nG0 X#1\nN2 END1") ==
          " 1 4");
    CHECK(run("WHILE [#1 LT 1] DO1\n#1=#1+1\nEND1\nWHILE [#1 LT 3] DO1\n#1=#1+1\nEND1\nG0 X#1") == " 3");
    CHECK(run("O1\n#1=0\nM98 P2 L2\nM30\nO2\n#2=0\nWHILE [#2 LT 2] DO1\nG0 X#1\n#2=#2+1\n#1=#1+1\nEND1\nM99") ==
          " 0 1 2 3");
}

TEST_CASE("Loops and jumps that do not fit are refused") {
    says("WHILE [1] DO1\nG0 X1", "p.nc:1:1: DO1 has no end; write END1 behind its last line");
    says("G0 X1\nEND2", "p.nc:2:1: END2 has no begin");
    says("WHILE [0] DO1\nEND2\nEND1", "p.nc:2:1: END2 has no begin; what is open here is DO1 of line 1");
    says("DO1\nDO2\nEND1\nEND2", "p.nc:3:1: DO2 of line 2 has no end before this one");
    says("DO1\nDO1\nEND1\nEND1", "p.nc:2:1: DO1 stands within DO1");
    says("GOTO 5\nDO1\nN5 G0 X1\nEND1", "p.nc:1:6: N5 stands in a loop, and a jump from outside does not lead there");
    says("DO1\nGOTO 5\nEND1\nDO1\nN5 END1", "p.nc:2:6: N5 stands in a loop");
    says("GOTO 5\nN6", "p.nc:1:6: there is no block N5 in this program");
    says("GOTO 5\nN5\nN5 G0", "p.nc:1:6: N5 stands in 2 blocks of this program; a jump needs one");
    says("GOTO 1.5", "p.nc:1:6: the number N of a block is a whole number from 0");
    says("GOTO -1", "p.nc:1:6: the number N of a block");
    says("GOTO", "p.nc:1:5: a number must follow");
    says("o1 if [1]\nGOTO 5\no1 endif\nN5", "p.nc:2:1: GOTO, WHILE and M97 do not stand within O words; o1 of line 1");
    says("o1 sub\nDO1\nEND1\no1 endsub", "p.nc:2:1: GOTO, WHILE and M97 do not stand within O words");
    says("N1 GOTO 1", "p.nc:1:1: the program has executed 10000000 jumps, loops and calls; does it ever end?");
}

TEST_CASE("G65 calls a macro with variables of its own") {
    const std::string macro = "\nM30\nO9010\n#30=#30+1\nG0 X#1\nX[#24+#30]\nIF [#2 EQ #0] THEN #2=50\nX#2\nM99";
    CHECK(run("#1=7\n#30=20\nG65 P9010 A3. X4\nG0 X#1 Y#30" + macro) == " 3 5 50 7");
    CHECK(run("#1=7\nG65 A#1 B[#1*2] X-#1 P9010 (call)" + macro) == " 7 -6 14");
    CHECK(run("G65 P9010 X1 A#5" + macro) == " 0 2 50"); // a vacant argument is none
    CHECK(run("G91 G65 P9010\nG65 P9010 X1" + macro).find("line 1 O words, M70 to M73, M97 to M99 and G65") != 0U);
    CHECK(run("G65 P1 A5\nM30\nO1\nG65 P2 A[#1+1]\nG0 X#1\nM99\nO2\nG0 X#1\n#1=0\nM99") == " 6 5");
    CHECK(run("G65 P1 L3 A5\nM30\nO1\nG91 G0 X#1\nM99") == " 5 10 15");
    CHECK(run("G65 P1 L0\nG0 X3\nM30\nO1\nG0 X1\nM99") == " 3");
    CHECK(run("#100=1\nG65 P1\nG0 X#100\nM30\nO1\n#100=#100+4\nM98 P2\nM99\nO2\n#1=9\nG0 X#1\nM99") == " 9 5");
}

TEST_CASE("Arguments have their variables, and count increments where that is wanted") {
    const std::string macro = "\nM30\nO1\n#100=#1*1000\n#101=#4*1000\n#102=#7\nG0 X#100\nX#101\nX#102\nM99";
    CHECK(run("G65 P1 A1 I2 D3" + macro) == " 1000 2000 3");
    CHECK(run("G65 P1 A1 I2. D3" + macro, nullptr, {.increments = true}) == " 1 2000 3");
    CHECK(run("#9=2\nG65 P1 A-5 I#9 D3" + macro, nullptr, {.increments = true}) == " -5 2000 3");
    CHECK(run("G20\nG65 P1 I1000 D0\nM30\nO1\nG21 G0 X[#4*100]\nM99", nullptr, {.increments = true}) == " 10");
}

TEST_CASE("Wrong calls are refused by name") {
    says("G65 A1", "p.nc:1:1: G65 needs P, the number of the macro");
    says("G65 P9", "p.nc:1:1: there is no subprogram O9 behind this line");
    says("G65 P1 I1 I2", "p.nc:1:11: I, J and K of G65 stand once, in this order");
    says("G65 P1 J1 A2 I2", "p.nc:1:14: I, J and K of G65 stand once, in this order");
    says("G65 P1 A1 A2", "p.nc:1:11: the letter stands twice");
    says("G65 P1 G90", "p.nc:1:8: G65 takes P, L and the arguments");
    says("G65 P1.5", "p.nc:1:6: P and L of G65 are whole numbers");
    says("G65 P#1", "p.nc:1:6: P and L of G65 are whole numbers");
    says("G65 P1 L-1", "p.nc:1:9: P and L of G65 are whole numbers");
    says("G65 P1 A", "p.nc:1:9: a number must follow");
    says("G65 P1 L2 A1\nM30\nO1\n#1=#1+1\nM99",
         "p.nc:5:1: the macro is to run again (L) and has set some of #1 to #33");
    says("G65 P1\nM30\nO1\nG65 P1\nM99", "p.nc:4:1: calls are nested more than 30 deep");
    says("G65 P1\nM30\nO1\nG0 X1", "p.nc:3:1: the subprogram that begins here has no M99 at its end");
}

TEST_CASE("M97 calls lines of the same program") {
    CHECK(run("G91 G0 X1\nM97 P100 L2\nX10\nM30\nN100 X2\nM99") == " 1 3 5 15");
    CHECK(run("#1=100\nM97 P#1\nG0 X9\nM30\nN100 G0 X2\nM97 P200\nM99\nN200 X3\nM99") == " 2 3 9");
    CHECK(run("M98 P1 L2\nM30\nN5 G0 X99\nM99\nO1\nM97 P5\nG0 X1\nM99\nN5 G0 X2\nM99") == " 2 1 2 1");
    CHECK(run("G0 X1 M97 P5\nM30\nN5 X2 M99") == " 1 2");
    says("M97 L2", "p.nc:1:1: M97 needs P, the number N of a block");
    says("M97 P7", "p.nc:1:6: there is no block N7 in this program");
    says("M97 P7\nM30\nDO1\nN7\nEND1", "p.nc:1:6: N7 stands in a loop, and a call does not lead there");
    says("M97 P7\nM30\nN7 M97 P7\nM99", "p.nc:3:9: calls are nested more than 30 deep");
    says("M97 P7\nM30\nN7 G0 X1", "p.nc:3:1: the subprogram that begins here has no M99 at its end");
}

TEST_CASE("M98 repeats by L or by the digits before the last four") {
    const std::string program = "\nM30\nO1000\nX1\nM99\nO7\nX5\nM99";
    CHECK(run("G91 G0 X10\nM98 P1000 L2" + program) == " 10 11 12");
    CHECK(run("G91 G0 X10\nM98 P00031000" + program) == " 10 11 12 13");
    CHECK(run("G91 G0 X10\nM98 P31000" + program) == " 10 11 12 13");
    CHECK(run("G91 G0 X10\nM98 P20007" + program) == " 10 15 20");
}

TEST_CASE("M99 at the end of a main program ends it, and leads to a block") {
    CHECK(run("G0 X1\nM99\nX2") == " 1 end");
    CHECK(run("G0 X1\nN5 X2 M99 (again)\nX3") == " 1 2 end");
    CHECK(run("G0 X1\nIF [1] GOTO 5\nX2\nN5 M99\nX3") == " 1 end");
    CHECK(run("#1=0\nN5 G0 X#1\n#1=#1+1\nIF [#1 GT 2] GOTO 9\nM99 P5\nN9 M30") == " 0 1 2");
    says("O2\nG0 X1\nM99\nO1\nX5\nM98 P2\nM30",
         "p.nc:3:1: M99 ends a subprogram that M98 has called; the main program");
    says("G0 X1\nO5\nM99", "p.nc:3:1: M99 ends a subprogram that M98 has called"); // the sub is no part of the main one
}

TEST_CASE("M99 P goes on at a block of the caller") {
    CHECK(run("G0 X1\nM98 P7\nX2\nN50 X3\nM30\nO7\nG0 X9\nM99 P50") == " 1 9 3");
    CHECK(run("M98 P6\nM30\nO6\nM98 P7\nG0 X2\nN50 X3\nM99\nO7\n#1=50\nG0 X9\nM99 P#1") == " 9 3");
    CHECK(run("#1=0\nN50 G0 X#1\n#1=#1+1\nIF [#1 GT 2] GOTO 60\nG65 P7\nN60 M30\nO7\n#1=50\nM99 P#1") == " 0 1 2");
    says("M98 P7\nN50\nM30\nO7\nN50 G0 X1\nM99 P50", "p.nc:6:6: N50 stands in the subprogram itself, too, where Haas");
    says("M98 P7 L2\nN50\nM30\nO7\nM99 P50", "p.nc:5:6: M99 P leaves a call that is to run again (L)");
    says("M98 P7\nM30\nO7\nM99 P50", "p.nc:4:6: there is no block N50 in this program");
}

TEST_CASE("Jumps back reach as far as the program is kept") {
    std::string far = "N1 G0 X1\n#1=#1+1\n";
    for (std::size_t i = 3; i < ProgramFlow::most_lines_back; ++i) {
        far += "(line)\n";
    }
    CHECK(run(far + "IF [#1 LT 3] GOTO 1") == " 1 1 1");
    CHECK(run(far + "(line)\nIF [#1 LT 3] GOTO 1")
              .find("there is no block N1 in this program; jumps back lead over at "
                    "most 16384 lines before the first one") != std::string::npos);
}

TEST_CASE("A jump costs the same in a long program") {
    std::string program = "#1=0\nN1 #1=#1+1\nIF [#1 LT 100000] GOTO 1\nM97 P5\nM30\n";
    for (int i = 0; i < 50'000; ++i) {
        program += "(line)\n";
    }
    CHECK(run(program + "N5 G0 X7\nM99") == " 7");
}

TEST_CASE("All problems are told, and the other lines run") {
    ProblemList problems;
    CHECK(run("G0 X1\nGOTO 7\nX2\nIF [1] G0 X3\nEND2\nX5\nG65 P9\nX6", &problems) == " 1 2 5 6");
    CHECK(problems.texts().size() == 4);
    ProblemList loops;
    CHECK(run("WHILE [1/0] DO1\nG0 X1\nEND1\nX2\n#3000=1\nX3", &loops) == " 1 2 end");
    CHECK(loops.texts().size() == 2);
}

TEST_CASE("A / before an O word leaves its line out, or says nothing") {
    const std::string program = "G0 X1\n/o1 if [0]\nX2\n/ O1 endif\n/N5 o2 repeat [3]\nG91 X1\n/N6 o2 endrepeat\nX1";
    CHECK(run(program) == " 1 2 3 4 5");
    CHECK(run(program, nullptr, {.block_delete = true}) == " 1 2 3 4");
}

TEST_CASE("A colon before the number of a program is an O") {
    CHECK(run(":1\nG0 X1\nM98 P20\nX5\nM30\n:0020\nX2\nM99\n:30\nX9\nM99") == " 1 2 5");
    CHECK(run("G0 X1\n:20 X5").find("line 2") != std::string::npos);
}
