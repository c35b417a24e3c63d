// SPDX-License-Identifier: MIT
// Any O words, or statements of macros, with blocks between them: a program goes on, ends, or is refused at one of its
// lines; what is executed are its lines, of macros parts of them; a call leaves the parameters of its caller as they
// were. Where problems are collected, as by `check`, each names a line of the program, once.
#include "host_sim/base/input_error.hpp"
#include "host_sim/program/gcode/macro_variables.hpp"
#include "host_sim/program/gcode/program_flow.hpp"

#include "splinefeed/s0_program/expression.hpp"
#include "splinefeed/s0_program/interpreter.hpp"

#include "fuzz/bytes.hpp"
#include "support/split.hpp"

#include <cstdio>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

class TextLines final : public SourceLines {
public:
    explicit TextLines(const std::vector<std::string>& lines) : lines_(&lines) {}
    bool next(SourceLine& out) override {
        if (at_ == lines_->size()) {
            return false;
        }
        out.text = (*lines_)[at_];
        out.number = ++at_;
        return true;
    }

private:
    const std::vector<std::string>* lines_;
    std::size_t at_ = 0;
};

[[noreturn]] void fail(const char* what, const std::string& line) {
    std::fprintf(stderr, "%s: %s\n", what, line.c_str());
    std::abort();
}

/// Each byte is a part of a line: programs that run, and jump, are common among these.
std::string text_of_parts(splinefeed_test::Bytes bytes, bool macros) {
    static const std::vector<std::string> statements = splinefeed_test::split(
        "GOTO |GOTO#1\n|10\n|20\n|N10 |N20 |N30\n|IF [#1 LT 3] |IF [#2 EQ #0] |IF [#101 GT 5] |THEN |WHILE [#1 LT 4] |"
        "DO1\n|DO2\n|DO3\n|END1\n|END2\n|END3\n|G65 P100 |G65 P200 |A#1 |B2. |I1 |J2 |L2 |\n|M97 P10\n|M97 P20 L2\n|"
        "M98 P100\n|M98 P20200\n|M99\n|M99 P10\n|M99 P#1\n|M30\n|%\n|O100\n|O200 (PART)\n|#1=#1+1\n|#2=#0\n|"
        "#101=#101+1\n|#1=#2\n|#3000=1 (END)\n|#3006=1\n|G0 X#1\n|G0 X[#5001+1]\n|X#500\n|#500=#1\n|o1 if [#1]\n|"
        "o1 endif\n|o2 call\n|/|(x)\n|[|]|#1=30\n|M0\n");
    static const std::vector<std::string> o_words = splinefeed_test::split(
        "o1 |o2 |o3 |o<a> |o#2 |o[#1] |sub\n|endsub\n|call\n|return\n|if |elseif |else\n|endif\n|while |endwhile\n|"
        "do\n|repeat |endrepeat\n|break\n|continue\n|[1]\n|[0]\n|[#1 LT 3]\n|[#2 GT 1]\n|[2]\n|[#1]\n|#1=[#1+1]\n|"
        "#2=[#2+#1]\n|#2=1\n|G0 X#1\n|\n|call [1] [#1]\n|endsub [#1]\n|return [3]\n|#<b>=#1\n|#1=#<b>\n|"
        "#1=#<_value>\n|M2\n|%\n|O100 (PART)\n|N7 o2 |(x)\n|[|]|#31=[#31+1]\n|[#31 LT 9]\n|o100\n|M98 P100\n|"
        "M98 P100 L2\n|M99\n|G91 X1\n");
    const std::vector<std::string>& parts = macros ? statements : o_words;
    std::string text;
    while (bytes.left > 0 && text.size() < 100'000) {
        text += parts[bytes.take() % parts.size()];
    }
    return text;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return lines;
}

/// @param problems  null: the first one ends the program
void run(const std::vector<std::string>& text, ProblemList* problems, bool macros, std::uint64_t times) {
    constexpr int most_steps = 4'000; // loops without an end would only take time
    TextLines lines(text);
    ParameterMemory parameters;
    const std::vector<std::string> axes{"x", "y", "z"};
    MacroVariables variables(parameters, axes);
    Expression expression(variables);
    ProgramSettings settings;
    settings.dialect = macros ? Dialect::fanuc : Dialect::linuxcnc;
    Interpreter<double> interpreter(settings, &expression);
    interpreter.start({});
    variables.follow(interpreter);
    ProgramFlow flow(
        lines, "p", expression, interpreter, parameters, problems,
        {.programs = macros ? NumberedPrograms::fanuc : NumberedPrograms::linuxcnc, .macros = macros, .runs = times});
    SourceLine line;
    ProgramItem<double> item;
    for (int steps = 0; steps < most_steps && !interpreter.has_ended(); ++steps) {
        const ProgramFlow::Step step = flow.next(line);
        if (step == ProgramFlow::Step::end) {
            return;
        }
        if (step == ProgramFlow::Step::nothing) {
            continue;
        }
        if (line.number == 0 || line.number > text.size() || (!macros && text[line.number - 1] != line.text)) {
            fail("a line that the program does not have", line.text);
        }
        if (interpreter.push(line.text, static_cast<std::uint32_t>(line.number)).ok()) {
            while (interpreter.next(item) == Pull::item) {
            }
        }
    }
}

/// Whether it begins with a place in this program, "p:LINE".
bool names_a_line(const std::string& what, std::size_t lines) {
    const int line = what.rfind("p:", 0) == 0 ? std::atoi(what.c_str() + 2) : 0;
    return line >= 1 && line <= static_cast<int>(lines);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    splinefeed_test::Bytes bytes{data, size};
    const unsigned choices = bytes.take();
    const bool as_text = (choices & 1U) != 0;
    const bool checks = (choices & 2U) != 0;
    const bool macros = (choices & 4U) != 0;
    const std::uint64_t times = (choices & 8U) != 0 ? 3 : 1; // if M99 ends it
    const std::vector<std::string> lines = lines_of(
        as_text ? std::string(reinterpret_cast<const char*>(bytes.data), bytes.left) : text_of_parts(bytes, macros));
    ProblemList problems;
    try {
        run(lines, checks ? &problems : nullptr, macros, times);
    } catch (const InputError& error) {
        problems.add(error, 0);
    }
    std::set<std::string> told;
    for (const std::string& problem : problems.texts()) {
        const bool says_how_many_more = told.size() == ProblemList::most_causes;
        if (!says_how_many_more && !names_a_line(problem, lines.size())) {
            fail("an error without its line", problem);
        }
        if (!told.insert(problem).second) {
            fail("told twice", problem);
        }
    }
    return 0;
}
