// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/program_flow.hpp"

#include "host_sim/base/input_error.hpp"
#include "support/catch.hpp"
#include "text_lines.hpp"

#include "splinefeed/s0_program/expression.hpp"
#include "splinefeed/s0_program/interpreter.hpp"

#include <algorithm>

using namespace splinefeed;
using namespace splinefeed::host;
using splinefeed_test::TextLines;

namespace {

/// The X of each move, or the error; with `problems` all errors go there.
std::string run(const std::string& text, ProblemList* problems = nullptr, const FlowRules& rules = {}) {
    TextLines lines(text);
    ParameterMemory parameters;
    Expression expression(parameters);
    Interpreter<double> interpreter(ProgramSettings{}, &expression);
    interpreter.start({});
    std::string out;
    try {
        ProgramFlow flow(lines, "p.ngc", expression, interpreter, parameters, problems, rules);
        SourceLine line;
        ProgramItem<double> item;
        for (auto step = flow.next(line); step != ProgramFlow::Step::end && !interpreter.has_ended();
             step = flow.next(line)) {
            if (step == ProgramFlow::Step::nothing) {
                continue;
            }
            const BlockStatus status = interpreter.push(line.text, static_cast<std::uint32_t>(line.number));
            if (!status.ok() && problems != nullptr) {
                problems->add({"p.ngc", line.number, "no word"}, line.number,
                              "no word of line " + std::to_string(line.number));
            } else if (!status.ok()) {
                return out + " error " + describe(status.error);
            }
            while (interpreter.next(item) == Pull::item) {
                out += item.kind == ItemKind::move ? " " + std::to_string(static_cast<int>(to_mm(item.element.to[0])))
                                                   : " end";
            }
        }
        out += flow.has_ended() && !interpreter.has_ended() ? " end" : "";
    } catch (const InputError& error) {
        return error.what();
    }
    return out;
}

std::string run(const std::string& text, NumberedPrograms programs) {
    return run(text, nullptr, {programs});
}

} // namespace

TEST_CASE("Branches") {
    const std::string branches =
        "\no1 if [#1 EQ 1]\nG0 X1\no1 elseif [#1 EQ 2]\nG0 X2\no1 else\nG0 X3\no1 endif\nG0 X9";
    CHECK(run("#1=1" + branches) == " 1 9");
    CHECK(run("#1=2" + branches) == " 2 9");
    CHECK(run("#1=3" + branches) == " 3 9");
    CHECK(run("O<a> IF [0]\nG0 X1\nO<A> endif") == "");
}

TEST_CASE("O words in any case and spacing, behind an N number, and not in comments") {
    CHECK(run(" n10 o 100 s u b\nG0 X#1\nN5O0100ENDSUB(c)\n(o100 call [1])\no100call[3]\nX9") == " 3 9");
    CHECK(run("o<My Hole> sub\nG0 X[#1+#2]\no<myhole> endsub\nO<MYHOLE> call [1] [2]\n#1=3\n"
              "o7 sub\nX5\no7endsub\no[#1+[2*2]] call") == " 3 5");
}

TEST_CASE("Loops, also within one another, with break and continue") {
    CHECK(run("#1=0\no1 while [#1 LT 3]\n#1=[#1+1]\nG0 X#1\no1 endwhile\nX9") == " 1 2 3 9");
    CHECK(run("#1=5\no1 do\nG0 X#1\n#1=[#1+1]\no1 while [#1 LT 3]\nX9") == " 5 9");
    CHECK(run("o1 repeat [2]\no2 repeat [2]\nG91 G0 X1\no2 endrepeat\no1 endrepeat") == " 1 2 3 4");
    CHECK(run("o1 repeat [0]\nG0 X1\no1 endrepeat\nG0 X9") == " 9");
    CHECK(run("#1=0\no1 while [1]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\no3 if [#1 GT 3]\no1 break\n"
              "o3 endif\nG0 X#1\no1 endwhile\nX9") == " 1 3 9");
    CHECK(run("#1=0\no1 repeat [5]\n#1=[#1+1]\no2 if [#1 EQ 3]\no1 break\no2 endif\nG0 X#1\no1 endrepeat\nX9") ==
          " 1 2 9");
}

TEST_CASE("A jump out of several loops ends all of them") {
    // break, continue and the end of an outer loop from within an inner one, of each kind
    CHECK(run("G91\no1 repeat [2]\no2 repeat [3]\nG0 X1\no1 continue\no2 endrepeat\no1 endrepeat\nG90 X9") == " 1 2 9");
    CHECK(run("G91\no1 repeat [2]\no2 repeat [3]\nG0 X1\no1 break\no2 endrepeat\no1 endrepeat\nG90 X9") == " 1 9");
    CHECK(run("#1=0\no1 while [#1 LT 2]\n#1=[#1+1]\no2 repeat [3]\nG0 X#1\no1 continue\no2 endrepeat\no1 endwhile\n"
              "o3 repeat [2]\nG91 X5\no3 endrepeat") == " 1 2 7 12");
    CHECK(run("#1=0\no1 do\n#1=[#1+1]\no2 repeat [9]\no3 repeat [9]\nG0 X#1\no1 continue\no3 endrepeat\n"
              "o2 endrepeat\no1 while [#1 LT 3]\nX9") == " 1 2 3 9");
    CHECK(run("o1 sub\no2 repeat [3]\no3 repeat [3]\no1 return [7]\no3 endrepeat\no2 endrepeat\no1 endsub\n"
              "o4 repeat [2]\no1 call\nG91 G0 X#<_value>\no4 endrepeat") == " 7 14");
    CHECK(run("#1=0\no1 repeat [2]\no2 repeat [2]\no3 if [#1 EQ 1]\no2 break\no3 endif\n#1=[#1+1]\nG0 X#1\n"
              "o2 endrepeat\no1 endrepeat") == " 1");
}

TEST_CASE("A number may stand for several structures, one after the other") {
    CHECK(run("#1=0\no9 if [1]\no1 do\n#1=[#1+1]\nG0 X#1\no1 while [#1 LT 2]\no1 while [#1 LT 4]\n#1=[#1+1]\nX#1\n"
              "o1 endwhile\no1 if [1]\nX9\no1 endif\no9 endif") == " 1 2 3 4 9");
}

TEST_CASE("A subprogram in a block that runs is defined where the program comes to it") {
    const std::string either = "\no1 if [#1 EQ 1]\no2 sub\nG0 X1\no3 if [#1 GT 5]\no2 return\no3 endif\nX2\no2 endsub\n"
                               "o1 else\no2 sub\no4 repeat [2]\nG91 G0 X5\no4 endrepeat\no2 endsub\no1 endif\no2 call";
    CHECK(run("#1=1" + either) == " 1 2");
    CHECK(run("#1=2" + either) == " 5 10");
    CHECK(run("o1 repeat [3]\no2 sub\nG91 G0 X1\no2 endsub\no2 call\no1 endrepeat") == " 1 2 3");
    CHECK(run("o1 if [1]\nG0 X3\no2 sub\nX1\no4 repeat [9]\nX2\no4 break\no4 endrepeat\nX5\no2 endsub\n"
              "o1 endif\no2 call") == " 3 1 2 5");
}

TEST_CASE("A jump costs the same in a long block") {
    // Looking for the ends of these loops line by line would take an hour.
    std::string program = "#1=0\no1 sub\no4 do\no4 while [0]\n";
    for (int i = 0; i < 100'000; ++i) {
        program += "(line)\n";
    }
    program += "o2 while [#1 LT 100000]\n#1=[#1+1]\no3 if [#1 GT 0]\no2 continue\no3 endif\no2 endwhile\no1 endsub\n";
    CHECK(run(program + "o1 call\nG0 X7") == " 7");
}

TEST_CASE("Subprograms have parameters of their own, and may call themselves") {
    CHECK(run("o100 sub\nG0 X#1\n#1=50\no100 endsub\n#1=7\no100 call [3]\no100 call [4] [5]\nG0 X#1\nM2") ==
          " 3 4 7 end");
    CHECK(run("o<f> sub\no1 if [#1 LE 1]\no<f> return [1]\no1 endif\no<f> call [#1 - 1]\no<f> endsub [#1 * #<_value>]\n"
              "o<f> call [5]\nG0 X#<_value>") == " 120");
    CHECK(run("o1 sub\n#<a>=2\n#<_all>=3\no1 endsub\n#<a>=1\no1 call\nG0 X#<a>\nX#<_all>") == " 1 3");
}

TEST_CASE("Wrong O words are told with line and column") {
    const auto says = [](const std::string& text, const char* what) {
        const std::string said = run(text);
        CAPTURE(text, said);
        CHECK(said.find(what) == 0);
    };
    says("G0 X1\no1 call", "p.ngc:2:2: there is no subprogram o1");
    says("o1 if [1]", "p.ngc:1:1: o1 has no end; write o1 endif behind its last line");
    says("o1 endif", "p.ngc:1:2: o1 has no begin");
    says("o1 while [1]\no2 if [1]\no1 endwhile\no2 endif", "p.ngc:3:2: o2 of line 2 has no end before this one");
    says("o1 if [1]\no2 while [1]\no1 endif", "p.ngc:3:2: o2 of line 2 has no end before this one");
    says("o1 if [1]\no2 else\no1 endif", "p.ngc:2:2: o2 has no begin; what is open here is o1 of line 1");
    says("o1 if [1]\no1 else\no1 else\no1 endif",
         "p.ngc:3:2: o1 has its else in line 2; it has one, behind each elseif");
    says("o1 if [1]\no1 else\no1 elseif [1]\no1 endif", "p.ngc:3:2: o1 has its else in line 2");
    says("o1 sub\no2 endsub\nG0 X1", "p.ngc:2:2: o2 has no begin; what is open here is o1 of line 1");
    says("o1 if [1]\no2 break\no1 endif", "p.ngc:2:2: there is no loop o2 around this line");
    says("o1 repeat [1]\no2 sub\no1 break\no2 endsub\no1 endrepeat", "p.ngc:3:2: there is no loop o1 around");
    says("o1 if [1]\no#1 repeat [1]\no1 endif", "p.ngc:2:2: only call takes an expression");
    says("o1 hop", "p.ngc:1:4: an O word has a number or a <name>");
    for (const char* const word : {"o sub", "o<> sub", "o<abc sub", "o"}) {
        says(word, "p.ngc:1:1: an O word has a number or a <name>");
    }
    std::string deep;
    for (std::size_t i = 0; i <= FlowBlock::deepest; ++i) {
        deep += "o" + std::to_string(i) + " if [1]\n";
    }
    CHECK(run(deep) == "p.ngc:1001:2: O words are nested more than 1000 deep");
    says("o1 break", "p.ngc:1:2: there is no loop o1 around this line");
    says("o1 return", "p.ngc:1:2: return stands in a subprogram");
    says("o1 repeat [1]\no2 return\no1 endrepeat", "p.ngc:2:2: return stands in a subprogram");
    says("o1 if [1/0]\no1 endif", "p.ngc:1:");
    says("o1 if 1\no1 endif", "p.ngc:1:7: a condition stands in brackets");
    says("o1 repeat 2\no1 endrepeat", "p.ngc:1:11: repeat needs a number in brackets");
    says("o[1/2] call", "p.ngc:1:2: the number of an O word must be a whole number");
    says("o1 sub\no1 call\no1 endsub\no1 call", "p.ngc:2:2: calls are nested more than 30 deep");
}

TEST_CASE("Words behind an O word are refused, comments are not") {
    const auto says = [](const std::string& text, const char* where) {
        const std::string said = run(text);
        CAPTURE(text, said);
        CHECK(said.find(std::string(where) + ": behind an O word there may be a comment only") == 0);
    };
    says("o1 if [1] G0 X5\no1 endif", "p.ngc:1:11");
    says("o1 repeat [2] X5\no1 endrepeat", "p.ngc:1:15");
    says("o1 if [0]\no1 else G0 X5\no1 endif", "p.ngc:2:9");
    says("o1 sub\no1 endsub [1] X5\no1 call", "p.ngc:2:15");
    says("o1 sub\no1 endsub\no1 call [1], [2]", "p.ngc:3:12");
    CHECK(run("o1 sub (a)\nG0 X#1\no1 endsub ; b\no1 call [3] (c)\no2 if [1] ; d\nX4\no2 endif (e)") == " 3 4");
}

TEST_CASE("Each wrong O word is told once, and the lines around it are read as if it were not there") {
    const auto says = [](const std::string& text, const std::string& moves, const std::vector<std::string>& expected) {
        ProblemList problems;
        const std::string moved = run(text, &problems);
        const std::vector<std::string> texts = problems.texts();
        CAPTURE(text, texts, moved);
        CHECK(moved == moves);
        CHECK(problems.count() == expected.size());
        for (const std::string& one : expected) {
            CAPTURE(one);
            const std::string line = one.substr(0, one.find(':'));
            CHECK(std::any_of(texts.begin(), texts.end(), [&](const std::string& told) {
                return told.find("p.ngc:" + one) == 0 || told.find("also on line " + line) != std::string::npos;
            }));
        }
    };
    says("o100 sub\nG0 X1\nG999\nX2", " 1 2",
         {"1:1: o100 has no end; write o100 endsub behind its last line", "3: no"});
    says("o1 if [0]\nG0 X1\no1 else\nX2\nG999\no2 repeat [2]\nX3\no2 endrepeat\nX4", " 1 2 3 3 4",
         {"1:1: o1 has no end", "5: no"});
    says("o1 while [1]\nG0 X1\no1 break\nG999\nX2", " 1 2", {"1:1: o1 has no end; write o1 endwhile", "4: no"});
    says("o1 do\nG0 X1\nG999", " 1", {"1:1: o1 has no end; write o1 while [...]", "3: no"});
    says("o1 if [1]\nG0 X1\no2 while [1]\no1 endif\no2 endwhile\nG999", " 1",
         {"4:2: o2 of line 3 has no end before this one", "6: no"});
    says("o1 do\no2 if [1]\nG0 X1\no1 while [0]\no2 endif\nX2", " 1 2", {"4:2: o2 of line 2 has no end before"});
    says("o1 if [1]\nG0 X1\no1 else\nX2\no1 else\nX3\no1 endif\nG999", " 1",
         {"5:2: o1 has its else in line 3", "8: no"});
    says("o1 sub\nG0 X#1\no2 endsub\nX5\no1 call [7]\nG999", " 7", // X5 is no line: there is no motion yet
         {"3:2: o2 has no begin; what is open here is o1 of line 1", "4: no", "6: no"});
    says("G0 X1\no1 endif\nX2\no1 break\no1 return\nG999", " 1 2",
         {"2:2: o1 has no begin", "4:2: there is no loop", "5:2: return stands", "6: no"});
    says("G0 X1\no1 hop\nX2\no sub\nX3", " 1 2 3", {"2:4: an O word has", "4:1: an O word has"});
    says("o1 if [1]\nG0 X1\no1 hop\nX2\no1 endif\nG999", " 1 2", {"3:4: an O word has", "6: no"});
    says("o1 call\nG0 X1\no100 sub\nX2\no3 call\no100 call", " 1 2",
         {"1:2: there is no subprogram o1", "3:1: o100 has no end", "5:2: there is no subprogram o3"});
    says("o1 while 1\nG0 X1\no1 endwhile\nG999", " 1", {"1:10: a condition stands in brackets", "4: no"});
    says("o1 repeat 3\nG0 X1\no1 endrepeat\nG999", " 1", {"1:11: repeat needs a number", "4: no"});
    says("o1 if 1\nG0 X1\no1 elseif [1]\nX2\no1 endif\nX3", " 1 3", {"1:7: a condition stands in brackets"});
    says("o1 if [0]\nG0 X1\no1 elseif 1\nG0 X2\no1 endif\nX3", " 2 3", {"3:11: a condition stands in brackets"});
    says("o1 do\nG0 X1\no1 while 1\nX2", " 1 2", {"3:10: a condition stands in brackets"});
    says("o9 repeat [3]\nG0 X1\no1 return\no9 endrepeat\nX2", " 1 1 1 2", {"3:2: return stands in a subprogram"});
    says("#1=4\no1 sub\nG0 X#1\no1 endsub [1/0]\no1 call [3]\nX#1", " 3 4", {"4:"});
    says("o1 sub\no1 call\no1 endsub\no1 call\nG0 X1", " 1", {"2:2: calls are nested more than 30 deep"});
    says("o1 while [1]\no1 endwhile\nG0 X1", " 1", {"2:1: the program has executed"});
    says("o1 while [1]\no2 call\no1 endwhile\nG0 X1", " 1", {"2:2: there is no subprogram o2"}); // not 10 million times
    says("o1 if [1]\no1 if [1]\nG0 X1\no1 endif\nX2\no1 endif\nX3", " 1 2 3", {});
}

TEST_CASE("A number of the program stands before its first block") {
    CHECK(run("%\nO0001 (PART)\nG1 X3 F100\nM2\n") == " 3 end");
    CHECK(run("\n(part)\nN10 o12\nG1 X3 F100\nM2\n") == " 3 end");
    CHECK(run("G1 X3 F100\nO0001\nM2\n").find("p.ngc:2:6: an O word has a number") == 0);
    CHECK(run("O0001 X2\nM2\n").find("p.ngc:1:7: an O word has a number") == 0);
    CHECK(run("O1\nO2 sub\nG1 X5 F100\nO2 endsub\nO2 call\nM2\n") == " 5 end");
}

TEST_CASE("A subprogram may stand behind its call, and behind the end of the program") {
    CHECK(run("o1 call [5]\nX9\no2 call\nM2\no1 sub\nG0 X#1\no1 endsub\no2 sub\nX1\no1 call [3]\no2 endsub") ==
          " 5 9 1 3 end");
    CHECK(run("o1 repeat [2]\no2 call\no1 endrepeat\no2 sub\nG91 G0 X1\no2 endsub\nX5") == " 1 2 7");
    CHECK(run("o1 call\nG0 X1\no2 sub\no2 endsub") ==
          "p.ngc:1:2: there is no subprogram o1 in this program; there is no folder to look for 1.ngc in; "
          "--subprograms states some");
    CHECK(run("o1 call\nM2\no1 sub\no3 endif\no1 endsub") ==
          "p.ngc:4:2: o3 has no begin; what is open here is o1 of line 3");
}

TEST_CASE("What was run behind the end of a program is not left out") {
    TextLines lines("o1 call\nM2\nG0 X1\no1 sub\nG0 X2\no1 endsub\nG0 X3");
    ParameterMemory parameters;
    Expression expression(parameters);
    Interpreter<double> interpreter(ProgramSettings{}, &expression);
    ProgramFlow flow(lines, "p.ngc", expression, interpreter, parameters);
    SourceLine line;
    while (flow.next(line) != ProgramFlow::Step::line || line.text != "M2") {
        REQUIRE(line.number > 0);
    }
    REQUIRE(flow.next_unread(line));
    CHECK(line.number == 3);
    REQUIRE(flow.next_unread(line));
    CHECK(line.number == 7);
    CHECK_FALSE(flow.next_unread(line));
}

TEST_CASE("Numbered programs are called by M98, and share the parameters of their caller") {
    const std::string sub = "\nM30\no100 (a comment)\n#1=[#1+1]\nG0 X#1\nM98 P0200\nM99\nO200\n#1=[#1+10]\nM99";
    for (const NumberedPrograms programs : {NumberedPrograms::linuxcnc, NumberedPrograms::fanuc}) {
        CHECK(run("o1 (main)\n#1=0\nM98 P100 L3\nX#1" + sub, programs) == " 1 12 23 33 end");
        CHECK(run("#1=0\n#2=100\nN5 M98 P#2 (once)\nM98 P[50+50] L0" + sub, programs) == " 1 end");
        CHECK(run("#1=0\no7 repeat [2]\nM98 P100\no7 endrepeat" + sub, programs) == " 1 12 end");
        for (const char* const call :
             {"M98 P300 L2", "n5 m 0 9 8p300L2", "/M98P300L2;x", "(M99) M98 P300 (twice) L2"}) {
            CHECK(run(std::string("G91\n") + call + "\nM30\no300\nG0 X1\nN9 M99", programs) == " 1 2 end");
        }
        CHECK(run("(M98 P1)\nG0 X1 ; M98 P1\n#<m98>=3\nX98\n/M30", programs) == " 1 98 end");
        CHECK(run("M98 P1\nM30\no1\no5 if [1]\nG0 X1\nM99\no5 endif\nX2\nM99", programs) == " 1 end");
        CHECK(run("M98 P1\nM30\no1\nG0 X1\nM30\nM99", programs) == " 1 end"); // M30 ends all
        CHECK(run("M98 P1\nM30\n%\nO0001\nG0 X4\nM99\n%", programs) == " 4 end");
        CHECK(run("M98 P7" + sub, programs) ==
              std::string("p.ngc:1:6: there is no subprogram O7 behind this line; there is no folder to look for ") +
                  (programs == NumberedPrograms::fanuc ? "O0007.nc" : "7.ngc") + " in; --subprograms states some");
        CHECK(run("M98 P1\nM30\no1\nG0 X1", programs) ==
              "p.ngc:3:1: the subprogram that begins here has no M99 at its end");
        CHECK(run("M98 P1\nM30\no1\nM98 P1\nM99", programs) == "p.ngc:4:6: calls are nested more than 30 deep");
        CHECK(run("M98 P1\nM30\no1\no3 return\nM99", programs) == "p.ngc:4:2: return stands in a subprogram");
        CHECK(run("o1 call\nM30\no1 sub\nM99\no1 endsub", programs).find("p.ngc:4:1: M99 ends a subprogram") == 0);
        CHECK(run("M98 L2", programs).find("p.ngc:1:1: M98 needs P") == 0);
    }
    CHECK(run("M98 P1\nM30\no1\nM99") ==
          " error O words, M70 to M73, M97 to M99 and G65 need the file; they are read by "
          "the host, in a line of their own");
}

TEST_CASE("Beside M98 and M99 there are other words where posts for Fanuc write them") {
    const auto fanuc = NumberedPrograms::fanuc;
    CHECK(run("G91 G0 X1 M98 P12 X2\nM30\nO12\nX5 M99", fanuc).find("error") != std::string::npos); // X twice
    CHECK(run("G91 G0 X1 M98 P12 L2\nX100\nM30\nO12\nX5 M99", fanuc) == " 1 6 11 111 end");
    CHECK(run("G91 M98 P30012\nM30\nO12\nG0 X5 M99", fanuc) == " 5 10 15 end"); // three times
    CHECK(run("#1=4\nG91 G0 X[1+2] M98 P7 Y#1\nM30\nO7\nN7 G80 M99 (end)", fanuc) == " 3 end");
    CHECK(run("G91 M98 P30012\nM30\nO12\nX5 M99\nO30012\nG0 X7 M99", fanuc) == " 7 end");
    CHECK(run("G0 X1 M98 P12\nM30\nO12\nM99", NumberedPrograms::linuxcnc).find("error O words") != std::string::npos);
    CHECK(run("M98 P12 X3\nM30\nO12\nM99", NumberedPrograms::linuxcnc) ==
          "p.ngc:1:6: M98 stands alone in its line, with P and L");
    CHECK(run("M98 P30012\nM30\nO12\nM99", NumberedPrograms::linuxcnc).find("no subprogram O30012") !=
          std::string::npos);
}

TEST_CASE("M70 to M73 save modes in each call, and put them back") {
    const FlowRules rules{.programs = NumberedPrograms::linuxcnc, .saves_modes = true, .axes = {"x", "y", "z"}};
    const auto of = [&](const std::string& text) {
        return run(text, nullptr, rules);
    };
    CHECK(of("G90 G0 X1\nM70\nG91 X5\nM72\nX3") == " 1 6 3");
    CHECK(of("M70 (all)\nG20 G0 X1\nM72\nX1") == " 25 1");
    const std::string sub = "\nM2\no1 sub\nM73\nG20 G91 G0 X1\no1 endsub";
    CHECK(of("G0 X1\no1 call\nX2" + sub) == " 1 26 2 end");
    CHECK(of("G0 X1\nM98 P1\nX2\nM2\no1\nN9 M73\nG91 X5\nM99") == " 1 6 2 end");
    CHECK(of("G0 X1\no1 call\nX2\nM2\no1 sub\nM73\nG91 X5\nM71\no1 endsub") == " 1 6 8 end"); // forgotten
    CHECK(of("G0 X1\nM73\nG91 X5\nX1") == " 1 6 7"); // of the main program: nobody returns
    // Not those of the caller.
    CHECK(of("M70\no1 call\nM2\no1 sub\nM72\no1 endsub") ==
          "p.ngc:5:1: M72 needs an M70 or M73 before, in the same subprogram");
    CHECK(of("G90 G0 X1\nM70\nG91\no1 call\nM72\nX9\nM2\no1 sub\nM70\nX2\nM72\no1 endsub") == " 1 3 9 end");
    CHECK(of("M70\nM71\nM72") == "p.ngc:3:1: M72 needs an M70 or M73 before, in the same subprogram");
    CHECK(of("M70 G90") == "p.ngc:1:1: M70 to M73 stand alone in their line");
    CHECK(of("G90 M70").find("error O words, M70 to M73") == 1);
    CHECK(of("G41.1 D1 G0 X5\nM70\nG40\nM72").find("cannot begin cutter compensation") != std::string::npos);
    CHECK(run("M70").find("error O words, M70 to M73") == 1); // a dialect without them
}

TEST_CASE("What is wrong with calls is collected, and the program goes on") {
    ProblemList problems;
    CHECK(run("M98 P5\nG0 X1\nM98 P6\nM99\nX2\nM30\nO6\no1 endif\nM98 P7\nX3\nM99", &problems,
              {NumberedPrograms::linuxcnc}) == " 1 3 2 end");
    CHECK(problems.texts() ==
          std::vector<std::string>{
              "p.ngc:1:6: there is no subprogram O5 behind this line; there is no folder to look for 5.ngc in; "
              "--subprograms states some",
              "p.ngc:8:2: o1 has no begin",
              "p.ngc:9:6: there is no subprogram O7 behind this line; there is no folder to look for 7.ngc in; "
              "--subprograms states some",
              "p.ngc:4:1: M99 ends a subprogram that M98 has called; the main program, which M30 ends, stands first"});
}

TEST_CASE("M99 ends a main program, which controls would begin again") {
    for (const NumberedPrograms programs : {NumberedPrograms::linuxcnc, NumberedPrograms::fanuc}) {
        CHECK(run("o1\nG0 X1\nM99", programs) == " 1 end");
        CHECK(run("o1\nG0 X1\nM98 P2\nX3\nM99\nO2\nX2\nM99", programs) == " 1 2 3 end");
        CHECK(run("G0 X1\no5 if [1]\nX2\nM99\no5 endif\nX3", programs) == " 1 2 end");
        CHECK(run("G0 X1\nM99\nX3\n%", programs) == " 1 end");
        // A subprogram that stands before the main program is none.
        CHECK(run("O2\nG0 X1\nM99\nO1\nX5\nM98 P2\nN9 M 0 2", programs).find("p.ngc:3:1: M99 ends a sub") == 0);
        CHECK(run("M99 P5\nM30", programs).find("p.ngc:1:6: M99 P, which goes on") == 0);
    }
    CHECK(run("G0 X1 M99", NumberedPrograms::fanuc) == " 1 end");
    CHECK(run("G0 X1\n(M30)\n/M99\n; M2", NumberedPrograms::fanuc) == " 1 end");
}

TEST_CASE("A main program that M99 ends runs as often as is stated") {
    for (const NumberedPrograms programs : {NumberedPrograms::linuxcnc, NumberedPrograms::fanuc}) {
        const auto runs = [&](const std::string& text, std::uint64_t times) {
            return run(text, nullptr,
                       {.programs = programs, .macros = programs == NumberedPrograms::fanuc, .runs = times});
        };
        CHECK(runs("G91 G0 X1\nM99", 1) == " 1 end");
        CHECK(runs("%\no1\nG91 G0 X1\nM98 P2\nM99\nO2\nX10\nM99\n%", 3) == " 1 11 12 22 23 33 end");
        CHECK(runs("o5 if [1]\nG91 G0 X1\nM99\no5 endif\nX3", 2) == " 1 2 end"); // from within a block
        CHECK(runs("o5 sub\nG0 X#1\no5 endsub\nG91\no5 call [3]\n(M2)\nM99", 2) == " 3 6 end");
        CHECK(runs("G91 G0 X1\nM30", 3) == " 1 end");
    }
    // What stands beside it is executed before; M99 P goes on without counting.
    const FlowRules fanuc{.programs = NumberedPrograms::fanuc, .macros = true, .runs = 2};
    CHECK(run("G91 G0 X1\nX5 M99", nullptr, fanuc) == " 1 6 7 12 end");
    CHECK(run("#1=0\nG91 G0 X1\nN5 #1=[#1+1]\nIF [#1 LT 3] GOTO 5\nX#1\nM99", nullptr, fanuc) == " 1 4 5 8 end");
}
