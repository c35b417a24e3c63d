// SPDX-License-Identifier: MIT
#include "host_sim/program/o_word_flow.hpp"

#include "host_sim/base/input_error.hpp"
#include "splinefeed/s0_program/interpreter.hpp"

#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines(1);
    for (const char c : text) {
        if (c == '\n') {
            lines.emplace_back();
        } else {
            lines.back() += c;
        }
    }
    return lines;
}

/// The X of each move, or the error.
std::string run(const std::string& text, std::uint64_t most_steps = 10000) {
    const std::vector<std::string> lines = lines_of(text);
    ProgramParameters parameters;
    Expression expression(parameters);
    Interpreter<double> interpreter(ProgramSettings{}, &expression);
    interpreter.start({});
    std::string out;
    try {
        OWordFlow flow("p.ngc", lines, parameters, expression, interpreter, most_steps);
        ProgramItem<double> item;
        while (const auto line = flow.next()) {
            const BlockStatus status = interpreter.push(line->text, line->number);
            if (!status.ok()) {
                return out + " error " + describe(status.error);
            }
            while (interpreter.next(item) == Pull::item) {
                out += item.kind == ItemKind::move ? " " + std::to_string(static_cast<int>(to_mm(item.element.to[0])))
                                                   : " end";
            }
        }
    } catch (const InputError& error) {
        return error.what();
    }
    return out;
}

} // namespace

TEST_CASE("branches", "[o_words]") {
    const std::string branches =
        "\no1 if [#1 EQ 1]\nG0 X1\no1 elseif [#1 EQ 2]\nG0 X2\no1 else\nG0 X3\no1 endif\nG0 X9";
    CHECK(run("#1=1" + branches) == " 1 9");
    CHECK(run("#1=2" + branches) == " 2 9");
    CHECK(run("#1=3" + branches) == " 3 9");
    CHECK(run("O<a> IF [0]\nG0 X1\nO<A> endif") == "");
}

TEST_CASE("loops", "[o_words]") {
    CHECK(run("#1=0\no1 while [#1 LT 3]\n#1=[#1+1]\nG0 X#1\no1 endwhile\nX9") == " 1 2 3 9");
    CHECK(run("#1=5\no1 do\nG0 X#1\n#1=[#1+1]\no1 while [#1 LT 3]\nX9") == " 5 9");
    CHECK(run("o1 repeat [2]\no2 repeat [2]\nG91 G0 X1\no2 endrepeat\no1 endrepeat") == " 1 2 3 4");
    CHECK(run("o1 repeat [0]\nG0 X1\no1 endrepeat\nG0 X9") == " 9");
    CHECK(run("#1=0\no1 while [1]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\no3 if [#1 GT 3]\no1 break\n"
              "o3 endif\nG0 X#1\no1 endwhile\nX9") == " 1 3 9");
    CHECK(run("#1=0\no1 repeat [5]\n#1=[#1+1]\no2 if [#1 EQ 3]\no1 break\no2 endif\nG0 X#1\no1 endrepeat\nX9") ==
          " 1 2 9");
}

TEST_CASE("subroutines", "[o_words]") {
    CHECK(run("o100 sub\nG0 X#1\n#1=50\no100 endsub\n#1=7\no100 call [3]\no100 call [4] [5]\nG0 X#1\nM2") ==
          " 3 4 7 end");
    CHECK(run("o<f> sub\no1 if [#1 LE 1]\no<f> return [1]\no1 endif\no<f> call [#1 - 1]\no<f> endsub [#1 * #<_value>]\n"
              "o<f> call [5]\nG0 X#<_value>") == " 120");
    CHECK(run("o1 sub\n#<a>=2\n#<_all>=3\no1 endsub\n#<a>=1\no1 call\nG0 X#<a>\nX#<_all>") == " 1 3");
}

TEST_CASE("wrong O words", "[o_words]") {
    const auto says = [](const std::string& text, const char* what) {
        const std::string said = run(text);
        CAPTURE(text, said);
        CHECK(said.find(what) != std::string::npos);
    };
    says("G0 X1\no1 call", "p.ngc:2: there is no subroutine o1");
    says("o1 if [1]", "p.ngc:1: the end of this O word is missing");
    says("o1 endif", "p.ngc:1: o1 ends or continues nothing");
    says("o1 if [1]\no2 while [1]\no1 endif\no2 endwhile", "p.ngc:3: o1 ends or continues");
    says("o1 hop", "behind an O word stands");
    says("o sub", "has a number or a name");
    says("o1 sub\no1 endsub\no1 sub\no1 endsub", "two subroutines");
    says("o1 break", "need a loop o1");
    says("o1 return", "in no subroutine");
    says("o1 if [1/0]\no1 endif", "column 9: the divisor is 0");
    says("o1 if 1\no1 endif", "stands in brackets");
    says("o1 repeat [1.5]\no1 endrepeat", "a whole number");
    says("o1 while [1]\no1 endwhile", "never ends");
    says("o1 sub\no1 call\no1 endsub\no1 call", "more than 100 deep");
}
