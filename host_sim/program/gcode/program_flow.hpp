// SPDX-License-Identifier: MIT
// ProgramFlow: the lines of a program in the order in which they are executed: subprograms, conditions, loops.
#pragma once

#include "host_sim/base/input_error.hpp"
#include "host_sim/program/gcode/flow_block.hpp"
#include "host_sim/program/gcode/flow_code.hpp"
#include "host_sim/program/gcode/macro_word.hpp"
#include "host_sim/program/gcode/parameter_memory.hpp"
#include "host_sim/program/gcode/subprogram_files.hpp"
#include "host_sim/program/problem_list.hpp"
#include "host_sim/program/source_line.hpp"

#include "splinefeed/s0_program/text/word_evaluator.hpp"

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

namespace splinefeed::host {

/// Lines without O words pass as they come. A subprogram, a condition or a loop is read to its end before it begins,
/// and kept in memory while it runs. For a subprogram behind its call the rest of the input is read. One that is a file
/// of its own gives lines that name this file. Steps and depth are bounded.
class ProgramFlow {
public:
    static constexpr std::size_t most_lines = 1'000'000;    ///< kept in memory
    static constexpr std::uint64_t most_words = 10'000'000; ///< O words executed
    static constexpr std::uint64_t most_repeated = 10'000;  ///< times that a block may come to problems that are known
    static constexpr std::size_t deepest = 30;              ///< calls within calls
    static constexpr std::int32_t most_arguments = 30;
    static constexpr std::size_t most_lines_back = 16'384;   ///< of a program, kept for jumps back until the first jump
    static constexpr std::size_t most_text_back = 1U << 20U; ///< characters of them

    enum class Step : std::uint8_t {
        line,    ///< execute it
        nothing, ///< ask again
        end,
    };

    /// Everything must outlive it.
    /// @param problems  gets what is wrong with O words, and the program goes on as if they were not there, so that the
    ///                  other lines are read, too; null: the first problem ends it
    ProgramFlow(SourceLines& lines, std::string file, WordEvaluator& evaluator, const BlockInterpreter& system,
                ParameterMemory& parameters, ProblemList* problems = nullptr, FlowRules rules = {})
        : lines_(&lines), file_(std::move(file)), evaluator_(&evaluator), system_(&system), parameters_(&parameters),
          problems_(problems), rules_(std::move(rules)), files_(rules_.folders) {}

    /// Throws InputError where problems are not collected, or the input cannot be read. May wait for the input.
    Step next(SourceLine& out);
    /// Whether next() needs no more input.
    [[nodiscard]] bool in_memory() const noexcept {
        return (runs_block() || !again_.empty() || !restoring_.empty() || ended_ || stops_) && !waits_;
    }
    /// Behind the end of the program: the next line that was not executed as part of a subprogram. False: none.
    bool next_unread(SourceLine& out);
    /// Whether the program has ended itself by M99 or an alarm: next() gives no more.
    [[nodiscard]] bool has_ended() const noexcept { return stops_; }
    /// How often the main program has begun.
    [[nodiscard]] std::uint64_t runs() const noexcept { return runs_; }

private:
    struct Repeat {
        std::size_t begin = 0; // its line
        std::int64_t left = 0;
    };
    enum class Call : std::uint8_t {
        none,
        sub,     ///< it has parameters of its own
        program, ///< by M98 or M97
        macro,   ///< by G65: it has parameters of its own
    };
    /// A block that is executed from memory.
    struct Frame {
        std::shared_ptr<const FlowBlock> code{};
        std::size_t at = 0;
        Call call = Call::none;
        std::vector<Repeat> repeats{}; // those around `at`
        std::int64_t more = 0;         // times that the program is to run again
        std::optional<SavedModes> modes{};
        bool lends = false;      // the modes are put back at its end
        std::size_t again = 1;   // its first line when it runs again
        MacroLocals arguments{}; // of a macro
    };
    struct Sub {
        std::shared_ptr<const FlowBlock> code;
        std::uint64_t source = 0; // where it was read: number of the block, and line in it
        std::size_t line = 0;
    };

    /// A line of a block that cannot run, to be read once more without the words that are wrong.
    struct Again {
        SourceLine line;
        std::optional<FlowWord> word;
    };

    /// A call or a jump that waits for the rest of the input.
    struct Waiting {
        FlowWord word;
        SourceLine line;
    };

    /// What is wrong with an O word, in contrast to an input that cannot be read.
    struct WordError : InputError {
        using InputError::InputError;
    };

    [[nodiscard]] bool runs_block() const noexcept { return !frames_.empty() && !collects_; }
    [[nodiscard]] bool next_line(SourceLine& out, std::optional<FlowWord>& word);
    [[nodiscard]] bool is_deleted(std::string_view text) const noexcept {
        return rules_.block_delete && TextCursor(text).peek() == '/';
    }
    /// :1000 is a number of a program where macros are Fanuc's.
    [[nodiscard]] bool has_o_word(std::string_view text) const noexcept {
        return (has_flow_word(text) || (rules_.macros && is_program_number(text))) && !is_deleted(text);
    }
    [[nodiscard]] bool has_word(std::string_view text) const {
        return has_o_word(text) || has_statement(text) || read_flow_code(text, rules_).has_value();
    }
    [[nodiscard]] bool has_statement(std::string_view text) const noexcept {
        return rules_.macros && has_macro_word(text) && !is_deleted(text);
    }
    Step take_word(SourceLine& line, const std::optional<FlowWord>& known);
    Step collect(const SourceLine& line, const std::optional<FlowWord>& known);
    void end_block();
    [[nodiscard]] std::deque<Again> without_wrong(const FlowBlock& block);
    void begin(const FlowWord& word, const SourceLine& line);
    void begin_stray(const FlowWord& word, const SourceLine& line);
    void go_on_behind(const FlowBlock::Place& place, bool is_new);
    void leave_frame();
    void abandon();
    Step next_in_memory(SourceLine& out);
    Step end_of_block();
    void count_word(const SourceLine& line);
    /// Throws, unless problems are collected. False: it is known.
    bool report(const InputError& error, const SourceLine& line);
    [[nodiscard]] const std::string& file_of(const SourceLine& line) const noexcept {
        return line.file != nullptr ? *line.file : file_;
    }
    void execute(const FlowBlock::Place& place, const SourceLine& line);
    void execute_if(const FlowBlock::Place& place, const SourceLine& line);
    void execute_call(const FlowWord& word, const SourceLine& line);
    void execute_repeat(const FlowBlock::Place& place, const SourceLine& line);
    void end_repeat(const FlowBlock::Place& place);
    void leave_sub(const FlowWord& word, const SourceLine& line);
    // Modes: program_flow_modes.cpp.
    void execute_modes(const FlowWord& word, const SourceLine& line);
    [[nodiscard]] SavedModes modes() const;
    void put_back(const SavedModes& saved, const SourceLine& line);
    // Macros: program_flow_macros.cpp.
    void begin_program();
    [[nodiscard]] bool keeps_program(const FlowWord& word, const SourceLine& line);
    void load_program();
    void execute_loop(const FlowBlock::Place& place, const SourceLine& line);
    void jump(const FlowWord& word, const SourceLine& line, std::size_t at);
    void jump_to(std::uint32_t number, const SourceLine& line, std::size_t at);
    [[nodiscard]] const FlowBlock::Label& find_label(std::uint32_t number, const SourceLine& line,
                                                     std::size_t at) const;
    void execute_jump_if(const FlowWord& word, const SourceLine& line);
    void execute_then(const FlowWord& word, const SourceLine& line);
    void execute_stop(const FlowWord& word, const SourceLine& line);
    void execute_line_call(const FlowWord& word, const SourceLine& line);
    void execute_macro_call(const FlowWord& word, const SourceLine& line);
    void end_main(const FlowWord& word, const SourceLine& line);
    void begin_again(const SourceLine& line);
    void return_to(const FlowWord& word, const SourceLine& line);
    void require_same_locals(const FlowWord& word, const SourceLine& line) const;
    struct MacroCall {
        std::string number; // of the program
        std::int64_t times = 1;
        MacroLocals locals{};
    };
    [[nodiscard]] MacroCall macro_call(const FlowWord& word, const SourceLine& line);
    void read_argument(TextCursor& text, const SourceLine& line, MacroCall& out, std::string& letters);
    [[nodiscard]] std::uint32_t whole(std::size_t& at, const SourceLine& line);
    [[nodiscard]] std::size_t program_end(std::size_t begin) const;
    [[nodiscard]] std::shared_ptr<FlowBlock> rest_of(const FlowBlock& block, std::size_t& at);
    void add_to(FlowBlock& block, const SourceLine& line);
    void note_passed(const SourceLine& line);
    // Subprograms: program_flow_calls.cpp.
    [[nodiscard]] std::shared_ptr<const FlowBlock> find_program(const std::string& number, const FlowWord& word,
                                                                const SourceLine& line);
    void execute_program_call(const FlowWord& word, const SourceLine& line);
    void leave_program(const FlowWord& word, const SourceLine& line);
    void leave_to(Call call, const FlowWord& word, const SourceLine& line, std::string_view text);
    using Lines = std::vector<SourceLine>;
    [[nodiscard]] std::shared_ptr<const FlowBlock> find_sub(const std::string& label);
    [[nodiscard]] std::shared_ptr<const FlowBlock> find_file(const std::string& label);
    [[nodiscard]] std::vector<std::string> file_names(const std::string& label) const;
    [[nodiscard]] std::shared_ptr<const FlowBlock> find_in(const Lines& lines, std::size_t begin,
                                                           const std::string& label);
    [[nodiscard]] std::shared_ptr<const FlowBlock> block_of(const Lines& lines, std::size_t begin, std::size_t end);
    [[nodiscard]] std::optional<FlowWord> o_word(const std::string& text) const;
    [[nodiscard]] std::size_t end_in(const Lines& lines, std::size_t begin, const FlowWord& first) const;
    bool wait_for_input(const FlowWord& word, const SourceLine& line);
    Step read_ahead(SourceLine& out);
    [[nodiscard]] Step give_others(const FlowWord& word, SourceLine& out);
    [[nodiscard]] bool report_problems(const FlowBlock& block, const std::vector<FlowBlock::Problem>& problems);
    void define(const FlowBlock::Place& place, const SourceLine& line);
    void keep(const std::string& label, const Sub& sub);
    void go_to(std::size_t line);
    [[nodiscard]] FlowWord word_of(const SourceLine& line) const;
    [[nodiscard]] std::string label_of(const FlowWord& word, const SourceLine& line);
    [[nodiscard]] Decimal value(std::string_view text, std::size_t& at, const SourceLine& line);
    [[nodiscard]] bool condition(const FlowWord& word, const SourceLine& line);
    void require_end(const SourceLine& line, std::size_t at) const;
    [[noreturn]] void fail(const SourceLine& line, std::size_t at, std::string_view text) const;
    template <class First, class... Rest>
    [[noreturn]] void fail(const SourceLine& line, std::size_t at, fmt::format_string<First, Rest...> text,
                           First&& first, Rest&&... rest) const {
        fail(line, at, fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
    }

    SourceLines* lines_;
    std::string file_;
    WordEvaluator* evaluator_;
    const BlockInterpreter* system_;
    ParameterMemory* parameters_;
    std::map<std::string, Sub> subs_;
    std::vector<Frame> frames_;
    ProblemList* problems_;
    FlowRules rules_;
    SubprogramFiles files_;
    std::deque<Again> again_;
    Lines ahead_;                                             // the rest of the input, once a call has asked for it
    std::size_t ahead_at_ = 0;                                // the next one of them
    std::vector<std::pair<std::size_t, std::size_t>> called_; // parts of it that were called
    std::optional<Waiting> waits_;
    std::optional<SavedModes> modes_;          // of the main program
    std::deque<SourceLine> restoring_;         // lines that put modes back
    bool ended_ = false;                       // all of the input has been read
    std::set<std::string> lost_;               // labels whose structure was wrong: what else names them is not told
    bool begun_ = false;                       // there was a block: a number of the program would have come before it
    bool collects_ = false;                    // a block is read to its end
    bool stops_ = false;                       // the program has ended itself
    bool passed_program_ = false;              // another numbered program begins behind the first one
    std::deque<SourceLine> passed_;            // lines of the program before ahead_, for jumps back
    std::size_t passed_text_ = 0;              // their characters
    bool passed_lost_ = false;                 // they were too many
    std::size_t ahead_program_ = 0;            // where in ahead_ the program begins or goes on
    std::shared_ptr<const FlowBlock> program_; // all of it, if it runs from memory
    std::uint64_t runs_ = 1;                   // of it that have begun
    std::string given_;                        // what is to be executed in the place of a line
    std::shared_ptr<FlowBlock> block_;
    std::string block_label_;
    FlowKind block_kind_ = FlowKind::sub;
    std::size_t block_depth_ = 0; // structures of the same kind and label around a line of it
    std::size_t kept_ = 0;        // lines of subprograms
    std::uint64_t words_ = 0;
    std::uint64_t repeated_ = 0; // problems that were told before
    std::uint64_t blocks_ = 0;   // that have been read
};

} // namespace splinefeed::host
