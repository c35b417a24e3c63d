// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/gcode_moves.hpp"

#include "host_sim/config/decimal_number.hpp"
#include "host_sim/program/gcode/called_lines.hpp"
#include "host_sim/program/gcode/core_settings.hpp"
#include "host_sim/program/gcode/dialect_hint.hpp"
#include "host_sim/program/gcode/impossible_event.hpp"
#include "host_sim/program/gcode/line_history.hpp"
#include "host_sim/program/gcode/macro_variables.hpp"
#include "host_sim/program/gcode/program_flow.hpp"
#include "host_sim/program/gcode/program_items.hpp"
#include "host_sim/program/gcode/program_spindle.hpp"
#include "host_sim/program/gcode/short_line.hpp"
#include "host_sim/program/kept_line.hpp"
#include "host_sim/program/left_out_list.hpp"
#include "host_sim/program/line_filter.hpp"
#include "host_sim/program/problem_list.hpp"

#include "splinefeed/s0_program/expression.hpp"
#include "splinefeed/s0_program/text/text_cursor.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>
#include <thread>
#include <utility>

namespace splinefeed::host {

namespace {

class GcodeMoves final : public MoveSource {
public:
    GcodeMoves(const GcodeSettings& settings, std::string file, std::unique_ptr<SourceLines> lines, ScalarKind scalar,
               ProblemList* problems)
        : settings_(&settings), file_(std::move(file)), lines_(std::move(lines)), problems_(problems),
          tools_(settings.tools ? std::optional<MachineTools>(std::in_place, *settings.tools, settings.axes)
                                : std::nullopt),
          items_(program_items(scalar, core_settings(settings, tools_ ? &*tools_ : nullptr, fanuc_), expression_,
                               settings.max_feed_mm_s)),
          interpreter_(items_->interpreter()),
          flow_(*lines_, file_, expression_, interpreter_, parameters_, problems, flow_rules(settings, coolant_)) {}

    bool start(PerAxis<Position>& position) override {
        position = settings_->start;
        variables_.follow(interpreter_, &fanuc_);
        if (settings_->left_out != nullptr) {
            settings_->left_out->begin();
        }
        if (settings_->offsets) {
            interpreter_.restore(*settings_->offsets);
        }
        interpreter_.start(settings_->start);
        return true;
    }

    // One line at a time: whoever waits for a pipe wants to know after each.
    bool next(SourceStep& out) override {
        out.kind = StepKind::nothing;
        if (asked_) {
            return true;
        }
        if (!pending_) {
            const bool enough = settings_->most_moves > 0 && history_.moves() >= settings_->most_moves;
            if (interpreter_.has_ended() || aborted_ || enough) {
                require_runs();
                return false;
            }
            const ProgramFlow::Step step = cut_ == Cut::ahead ? ProgramFlow::Step::line : flow_.next(line_);
            called_.pass(line_);
            switch (step) {
            case ProgramFlow::Step::end:
                end_input();
                require_runs();
                is_last_ = true;
                break;
            case ProgramFlow::Step::nothing: return true;
            case ProgramFlow::Step::line:
                last_line_ = called_.in_program();
                cut_ = line_.whole ? Cut::no : cut_ == Cut::no ? Cut::ahead : Cut::read;
                cut_ == Cut::ahead ? end_input() : read_line();
                break;
            }
        }
        pending_ = items_->next(item_, out.exact_points) == Pull::item;
        if (pending_) {
            take(out);
        }
        return pending_ || !is_last_;
    }

    [[nodiscard]] bool wait(Patience patience) override {
        if (asked_) {
            std::this_thread::sleep_for(patience);
            return false;
        }
        return pending_ || flow_.in_memory() || interpreter_.has_ended() || aborted_ || lines_->wait(patience);
    }

    [[nodiscard]] bool awaits_answer() const noexcept override { return asked_.has_value(); }

    void answer(int value) override {
        interpreter_.report_input(Decimal::from_integer(value));
        asked_.reset();
    }

    [[nodiscard]] int expected_answer() const noexcept override {
        return asked_ == InputWait::rise || asked_ == InputWait::high ? 1 : 0;
    }
    void pushed(const SourceStep& step) override { history_.add(step.line); }

    [[nodiscard]] std::uint64_t rows() const noexcept override { return history_.moves(); }
    [[nodiscard]] std::uint32_t row_of(std::uint32_t move) const noexcept override { return move; }
    [[nodiscard]] std::uint64_t line_of_row(std::uint64_t row) const noexcept override { return history_.line_of(row); }
    [[nodiscard]] std::uint64_t number_of_move(std::uint64_t move) const noexcept override { return move + 1; }

    [[nodiscard]] std::string name_of_move(std::uint64_t /*move*/, std::uint64_t line) const override {
        return fmt::format("line {}", line);
    }

    [[nodiscard]] std::string name_of_row(std::uint32_t row) const override {
        const std::uint64_t line = history_.line_of(row);
        return line > 0 ? fmt::format("line {}", line) : fmt::format("move {}", row + std::uint64_t{1});
    }

    [[nodiscard]] InputError refusal(const SourceStep& /*step*/, std::string_view text) const override {
        return error_of_item(text);
    }

    [[nodiscard]] std::string without_moves(Error /*error*/) const override { return {}; }
    void passed(std::uint64_t row) noexcept override { history_.forget_before(row); }

    [[nodiscard]] UnreadLines unread() override {
        UnreadLines out{called_.in_program(), 0};
        while ((interpreter_.has_ended() || flow_.has_ended()) && flow_.next_unread(line_)) {
            TextCursor cursor(line_.text);
            const char first = cursor.peek();
            out.lines += first != '\0' && first != '(' && first != ';' && first != '%' ? 1 : 0;
        }
        return out;
    }

private:
    /// Whether a pipe ended within a line. Before it comes what the lines before it hold back.
    enum class Cut : std::uint8_t { no, ahead, read };

    void read_line() {
        if (line_.number >= CalledLines::first) {
            throw InputError(file_, line_.number, "the program has more than 2^31 lines; split it");
        }
        if (settings_->left_out != nullptr) {
            settings_->left_out->at_line(called_.in_program());
        }
        if (is_left_out()) {
            return;
        }
        short_.take(line_.text, rules_of(settings_->dialect).open_comments, BlockInterpreter::longest_line);
        BlockStatus status = interpreter_.push(short_.text(), called_.take(line_));
        const std::size_t at = status.column > 0 ? status.column - 1U : 0U;
        status.column = static_cast<std::uint16_t>(status.column > 0 ? short_.place(at) + 1 : 0);
        if (status.error == ProgramError::program_aborted) {
            aborted_ = true;
            report({file_of_line(), line_.number, std::uint64_t{short_.comment_place(at)} + 1,
                    fmt::format("the program ends itself by (ABORT,{})", short_.comment(at))});
        } else if (!status.ok()) {
            report_block(status, line_.text);
            interpreter_.obey_refused();
        }
    }

    void end_input() {
        if (const BlockStatus status = interpreter_.end_of_input(); !status.ok()) {
            report({file_, last_line_, describe(status.error)});
        }
    }

    // A program that does not go back to its begin would run once, whatever the option says.
    void require_runs() {
        if (!flow_.has_ended() && !aborted_ && settings_->most_moves == 0 && flow_.runs() < settings_->runs) {
            report({file_, last_line_, "--repeat is of a program that M99 ends, and this one ends here; leave it out"});
        }
    }

    /// Throws, unless problems are collected. @param cause  as of ProblemList::add
    void report(const InputError& error, std::string_view cause = {}) {
        if (problems_ == nullptr) {
            throw InputError(error);
        }
        problems_->add(error, line_.number, cause, file_of_line());
    }

    [[nodiscard]] const std::string& file_of_line() const noexcept {
        return line_.file != nullptr ? *line_.file : file_;
    }

    [[nodiscard]] InputError error_of_item(std::string_view text) const {
        const LinePlace place = called_.place(item_.line);
        return {place.file != nullptr ? *place.file : file_, place.number, text};
    }

    void report_block(const BlockStatus& status, std::string_view text) {
        const std::string_view rest =
            text.substr(std::min<std::size_t>(status.column > 0 ? status.column - 1U : 0U, text.size()));
        const std::string sentence = cut_ == Cut::read ? std::string(cut_line)
                                     : status.error == ProgramError::coordinates_unsuited
                                         ? std::string(describe(fanuc_.fault()))
                                         : refusal_sentence(rest, status.error, *settings_);
        const bool says_dialect = sentence.find("--dialect") != std::string::npos;
        const std::string place = in_the_line(status);
        // Words of one letter share a cause, whatever their numbers; G and M words are their numbers.
        const char letter = rest.empty() ? ' ' : upper_case(rest.front());
        const bool is_code = letter == 'G' || letter == 'M';
        report({file_of_line(), line_.number, std::uint64_t{status.column},
                fmt::format("{}{}{}", place, sentence, says_dialect ? std::string_view() : guess())},
               (is_code || place.empty() ? place : std::string(1, letter)) + sentence);
    }

    // A line that is no G-code, or that the user wants to be left out. Macros that nobody speaks of are named.
    [[nodiscard]] bool is_left_out() {
        if (const std::optional<KeptLine> kept = kept_line(line_.text)) {
            report({file_of_line(), line_.number, splinefeed::host::refusal(*kept)}, kept->word);
            return true;
        }
        const std::string_view word = left_out_line(line_.text, *settings_);
        const std::string_view macro = macro_name(line_.text);
        if (!word.empty() && settings_->left_out != nullptr) {
            settings_->left_out->add_line(word);
        }
        if (word.empty() && !macro.empty() &&
            (has_macros(settings_->dialect) || macro.find('_') != std::string_view::npos)) {
            report(
                {file_of_line(), line_.number,
                 fmt::format("{}: it is a macro or an extended command of a printer; --ignore {} leaves its lines out, "
                             "--ignore unknown all of this kind{}",
                             in_quotes(macro), macro, guess())},
                macro);
            return true;
        }
        return !word.empty();
    }

    /// What the program looks like, once.
    [[nodiscard]] std::string_view guess() const noexcept {
        const bool is_first = problems_ == nullptr || problems_->empty();
        return is_first ? std::string_view(settings_->dialect_guess) : std::string_view();
    }

    void take(SourceStep& out) {
        const bool ends = item_.kind == ItemKind::event && (item_.event.kind == EventKind::program_end ||
                                                            item_.event.kind == EventKind::offsets_changed);
        if (cut_ == Cut::read && !ends) {
            throw InputError(file_, last_line_, cut_line);
        }
        out.line = called_.place(item_.line).in_program;
        out.stops = item_.stops_before;
        out.dwell_s = 0.0;
        switch (item_.kind) {
        case ItemKind::move:
            out.kind = StepKind::move;
            take_move(out);
            break;
        case ItemKind::dwell:
            out.kind = StepKind::dwell;
            out.dwell_s = number_of(item_.dwell_s);
            break;
        case ItemKind::event:
            out.kind = StepKind::event;
            take_event(out);
            break;
        }
    }

    void take_move(SourceStep& out) const {
        if (const std::string why = settings_->simulated ? "" : impossible_move(item_, settings_->dialect);
            !why.empty()) {
            throw error_of_item(why);
        }
        out.move = item_.element;
        out.rapid = item_.move == MoveKind::rapid || item_.move == MoveKind::home;
    }

    void take_event(SourceStep& out) {
        const ProgramEvent& event = item_.event;
        if (const std::string why = settings_->simulated ? std::string() : impossible(event, *settings_);
            !why.empty()) {
            throw error_of_item(why);
        }
        out.action.kind = event.kind;
        out.action.number = event.number;
        out.action.value = number_of(event.value);
        const bool is_comment =
            event.kind == EventKind::message || event.kind == EventKind::print || event.kind == EventKind::debug;
        out.action.text.assign(is_comment ? short_.comment(event.text.begin) : event.text.of(short_.text()));
        out.action.spindle.reset();
        note_coolant(event.kind);
        if (ProgramSpindle::is_of(event.kind)) {
            take_spindle(out, event.kind);
        } else if (event.kind == EventKind::tool_change || event.kind == EventKind::spindle_orient) {
            take_spindle(out, EventKind::spindle_stop); // as in LinuxCNC
        }
        out.offsets = event.kind == EventKind::offsets_changed
                          ? std::make_shared<const WorkOffsets>(interpreter_.offsets())
                          : nullptr;
        if (event.kind == EventKind::input_wait) {
            take_input(out);
        }
    }

    void note_coolant(EventKind kind) {
        const bool off = kind == EventKind::coolant_off;
        coolant_.mist = kind == EventKind::mist_on || (coolant_.mist && !off);
        coolant_.flood = kind == EventKind::flood_on || (coolant_.flood && !off);
    }

    // Inputs of the simulated machine are low, and stay so. Those of a real one are asked where it stands.
    void take_input(SourceStep& out) {
        const ProgramEvent& event = item_.event;
        if (!settings_->simulated) {
            out.action.wait = event.wait;
            asked_ = event.wait;
            return;
        }
        if (!event.analog && settings_->lines != nullptr && !settings_->lines->inputs.empty()) {
            if (const std::string why = impossible(event, *settings_); !why.empty()) {
                report(error_of_item(why));
            }
        }
        const bool met = event.wait == InputWait::now || event.wait == InputWait::low;
        out.dwell_s = met ? 0.0 : number_of(event.value);
        interpreter_.report_input(met ? Decimal{} : Decimal::from_integer(-1));
    }

    // A real spindle is waited for at standstill; the simulated one takes its time.
    void take_spindle(SourceStep& out, EventKind kind) {
        if (settings_->spindle == nullptr) {
            return;
        }
        const std::string problem = spindle_.take(kind, out.action.value, *settings_->spindle);
        if (!problem.empty()) {
            report(error_of_item(problem));
        }
        if (!problem.empty() || !spindle_.turn()) {
            return;
        }
        out.stops = true;
        if (settings_->simulated) {
            out.dwell_s = spindle_.change_s();
        } else {
            out.action.spindle = spindle_.turn();
        }
    }

    [[nodiscard]] std::string in_the_line(const BlockStatus& status) const {
        const std::size_t at = status.column > 0 ? status.column - 1U : 0U;
        if (status.length == 0 || at >= line_.text.size()) {
            return {};
        }
        return in_quotes(std::string_view(line_.text).substr(at, status.length)) + ": ";
    }

    const GcodeSettings* settings_;
    std::string file_;
    std::unique_ptr<SourceLines> lines_;
    ProblemList* problems_;
    std::optional<MachineTools> tools_;
    ParameterMemory parameters_;
    MacroVariables variables_{parameters_, settings_->axes};
    Expression expression_{variables_};
    std::array<WorkSystem, 99> further_{}; // of G54.1 and G154
    FanucWords fanuc_{further_};
    std::unique_ptr<ProgramItems> items_;
    BlockInterpreter& interpreter_; // theirs
    CoolantState coolant_;
    ProgramFlow flow_;
    CalledLines called_;
    SourceLine line_;
    ShortLine short_;
    ProgramItem<double> item_;
    LineHistory history_;
    ProgramSpindle spindle_;
    bool pending_ = false; // the block has more items
    bool is_last_ = false; // there are no more lines
    bool aborted_ = false; // the program has ended itself as failed
    Cut cut_ = Cut::no;
    std::uint64_t last_line_ = 0;    // the number of the newest one
    std::optional<InputWait> asked_; // nothing is interpreted before the input has answered
};

} // namespace

std::unique_ptr<MoveSource> gcode_moves(const GcodeSettings& settings, std::string file,
                                        std::unique_ptr<SourceLines> lines, ScalarKind scalar, ProblemList* problems) {
    return std::make_unique<GcodeMoves>(settings, std::move(file), std::move(lines), scalar, problems);
}

} // namespace splinefeed::host
