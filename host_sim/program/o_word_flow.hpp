// SPDX-License-Identifier: MIT
// OWordFlow: the lines of a G-code file in the order in which its O words have them executed.
#pragma once

#include "host_sim/program/program_parameters.hpp"

#include "splinefeed/s0_program/block_interpreter.hpp"
#include "splinefeed/s0_program/expression.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace splinefeed::host {

/// sub endsub call return, if elseif else endif, while endwhile, do while, repeat endrepeat, break continue, with
/// numbers (o100) and names (`o<name>`), within one file. Lines without an O word are handed out for the interpreter;
/// conditions are evaluated when their line is reached, so all lines before it must have been executed.
///
///     OWordFlow flow(file, lines, parameters, expression, interpreter);
///     while (const auto line = flow.next()) { interpreter.push(line->text, line->number); ... }
///
/// Errors are InputError with the line: a label without its end, a call of what is not there, too deep calls, more
/// steps than `most_steps`.
class OWordFlow {
public:
    struct Line {
        std::string_view text;
        std::uint32_t number = 0; ///< from 1
    };
    static constexpr std::uint64_t usual_steps = 100'000'000;
    static constexpr std::size_t deepest_call = 100;

    /// All references must outlive it.
    OWordFlow(std::string file, const std::vector<std::string>& lines, ProgramParameters& parameters,
              Expression& expression, BlockInterpreter& interpreter, std::uint64_t most_steps = usual_steps);

    /// Whether a file needs this class at all.
    [[nodiscard]] static bool has_o_word(std::string_view line);
    /// The next line; none: the end of the file.
    [[nodiscard]] std::optional<Line> next();

private:
    enum class Word : std::uint8_t {
        none,
        sub,
        endsub,
        call,
        give_back,
        if_,
        elseif,
        else_,
        endif,
        while_,
        endwhile,
        do_,
        while_end,
        repeat,
        endrepeat,
        break_,
        continue_
    };
    /// A line with an O word.
    struct Statement {
        Word word = Word::none;
        std::string label;
        std::size_t rest = 0;    // of the text, behind the word
        std::size_t partner = 0; // where it goes on: the next branch, the end of a loop, its begin
    };
    struct Call {
        std::size_t back_to = 0;
        std::string label;
        std::unordered_map<std::size_t, std::int64_t> repeats; // left, by the line of the repeat
    };

    void read_statements();
    void pair_statements();
    [[noreturn]] void fail(std::size_t line, std::string_view what) const;
    [[nodiscard]] Decimal value(std::size_t line, TextCursor& text) const;
    [[nodiscard]] bool condition(std::size_t line) const;
    void execute(std::size_t line);
    void call(std::size_t line);
    void give_back(std::size_t line);
    void repeat(std::size_t line);
    [[nodiscard]] static Statement parse(std::string_view line);

    std::string file_;
    const std::vector<std::string>* lines_;
    ProgramParameters* parameters_;
    Expression* expression_;
    BlockInterpreter* interpreter_;
    std::uint64_t most_steps_;
    std::uint64_t steps_ = 0;
    std::unordered_map<std::size_t, Statement> statements_;
    std::unordered_map<std::string, std::size_t> subs_;
    std::vector<Call> calls_ = std::vector<Call>(1);
    std::size_t at_ = 0;
};

} // namespace splinefeed::host
