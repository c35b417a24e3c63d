// SPDX-License-Identifier: MIT
// How ProgramFlow follows the statements of Fanuc's custom macro B: jumps, loops, calls of macros and lines, alarms.
#include "host_sim/program/gcode/program_flow.hpp"

#include "splinefeed/s0_program/block_interpreter.hpp"

#include <algorithm>

namespace splinefeed::host {

namespace {

// A number without a decimal point, where such ones count increments: of lengths and angles, as in words.
Decimal counted(Decimal value, char letter, bool inches) noexcept {
    constexpr std::string_view lengths = "ijkqruvwxyz";
    constexpr std::string_view angles = "abc";
    const bool length = lengths.find(letter) != std::string_view::npos;
    const bool angle = angles.find(letter) != std::string_view::npos;
    return {value.raw / (length && inches ? 10'000 : length || angle ? 1'000 : 1)};
}

} // namespace

// A numbered program begins, and what was before it is another one.
void ProgramFlow::begin_program() {
    passed_program_ = true;
    passed_.clear();
    passed_text_ = 0;
    passed_lost_ = false;
    ahead_program_ = ahead_at_;
}

void ProgramFlow::note_passed(const SourceLine& line) {
    if (TextCursor(line.text).peek() == '%') { // a second one would end the program
        return;
    }
    passed_.push_back(line);
    passed_text_ += line.text.size();
    const bool whole = rules_.runs > 1; // and not for jumps back alone
    while (passed_.size() > (whole ? most_lines : most_lines_back) || (!whole && passed_text_ > most_text_back)) {
        passed_text_ -= passed_.front().text.size();
        passed_.pop_front();
        passed_lost_ = true;
    }
}

// Whether the program runs from memory. False: the rest of the input is read before.
bool ProgramFlow::keeps_program(const FlowWord& word, const SourceLine& line) {
    if (frames_.empty() && wait_for_input(word, line)) {
        return false;
    }
    if (frames_.empty()) {
        load_program();
    }
    return true;
}

void ProgramFlow::add_to(FlowBlock& block, const SourceLine& line) {
    try {
        line.whole&& has_word(line.text) ? block.add(line, word_of(line)) : block.add(line);
    } catch (const WordError& error) {
        report(error, line);
    }
}

// Behind the last line of the numbered program that goes on there.
std::size_t ProgramFlow::program_end(std::size_t begin) const {
    while (begin < ahead_.size() && TextCursor(ahead_[begin].text).peek() != '%' &&
           !is_program_number(ahead_[begin].text)) {
        ++begin;
    }
    return begin;
}

// From its begin to its end. It goes on behind the line that was read last.
void ProgramFlow::load_program() {
    again_.clear();
    const std::size_t end = program_end(ahead_at_);
    if (passed_.size() + (end - ahead_program_) + kept_ > most_lines) {
        throw InputError(file_, passed_.empty() ? 0 : passed_.back().number,
                         "a program with jumps has more than {} lines", most_lines);
    }
    auto block = std::make_shared<FlowBlock>(++blocks_);
    for (const SourceLine& line : passed_) {
        add_to(*block, line);
    }
    std::size_t at = block->size();
    for (std::size_t i = ahead_program_; i < end; ++i) {
        at = i == ahead_at_ ? block->size() : at;
        add_to(*block, ahead_[i]);
    }
    at = ahead_at_ == end ? block->size() : at;
    ahead_at_ = end;
    if (!report_problems(*block, block->link())) {
        block = rest_of(*block, at);
    }
    program_ = block;
    frames_.push_back({.code = std::move(block), .at = at});
}

// Without the words that are wrong. @param at  a line of it, and then the same one of the rest
std::shared_ptr<FlowBlock> ProgramFlow::rest_of(const FlowBlock& block, std::size_t& at) {
    auto rest = std::make_shared<FlowBlock>(++blocks_);
    std::size_t rest_at = 0;
    for (std::size_t i = 0; i < block.size(); ++i) {
        const FlowBlock::Place* const place = block.place(i);
        rest_at = i == at ? rest->size() : rest_at;
        if (place == nullptr) {
            rest->add(block.line(i));
        } else if (place->wrong) {
            lost_.insert(place->word.label);
        } else {
            rest->add(block.line(i), place->word);
        }
    }
    at = at >= block.size() ? rest->size() : rest_at;
    static_cast<void>(rest->link());
    return rest;
}

// A whole number from 0, as that of a block.
std::uint32_t ProgramFlow::whole(std::size_t& at, const SourceLine& line) {
    constexpr std::int64_t most = 999'999'999;
    const std::size_t begin = at;
    const Decimal number = value(line.text, at, line);
    if (number.raw < 0 || number.raw % Decimal::one != 0 || number.raw / Decimal::one > most) {
        fail(line, begin, "the number N of a block is a whole number from 0");
    }
    return static_cast<std::uint32_t>(number.raw / Decimal::one);
}

// Of the program that runs.
const FlowBlock::Label& ProgramFlow::find_label(std::uint32_t number, const SourceLine& line, std::size_t at) const {
    const Frame& frame = frames_.back();
    const FlowBlock::Label* const label = frame.code->label(number);
    if (label == nullptr) {
        fail(line, at, "there is no block N{} in this program{}", number,
             passed_lost_ ? fmt::format("; jumps back lead over at most {} lines before the first one", most_lines_back)
                          : "");
    }
    if (label->count > 1) {
        fail(line, at, "N{} stands in {} blocks of this program; a jump needs one", number, label->count);
    }
    return *label;
}

void ProgramFlow::jump_to(std::uint32_t number, const SourceLine& line, std::size_t at) {
    const FlowBlock::Label& label = find_label(number, line, at);
    const Frame& frame = frames_.back();
    if (!frame.code->leads(frame.at > 0 ? frame.at - 1 : 0, label)) {
        fail(line, at, "N{} stands in a loop, and a jump from outside does not lead there", number);
    }
    go_to(label.line);
}

void ProgramFlow::jump(const FlowWord& word, const SourceLine& line, std::size_t at) {
    if (keeps_program(word, line)) {
        std::size_t end = at;
        const std::uint32_t number = whole(end, line);
        jump_to(number, line, at);
    }
}

void ProgramFlow::execute_jump_if(const FlowWord& word, const SourceLine& line) {
    std::size_t at = word.rest;
    if (value(line.text, at, line).raw != 0) {
        jump(word, line, word.behind);
    }
}

void ProgramFlow::execute_loop(const FlowBlock::Place& place, const SourceLine& line) {
    std::size_t at = place.word.rest;
    if (at > 0 && value(line.text, at, line).raw == 0) {
        go_to(place.end + 1);
    }
}

void ProgramFlow::execute_then(const FlowWord& word, const SourceLine& line) {
    std::size_t at = word.rest;
    if (value(line.text, at, line).raw == 0) {
        return;
    }
    SourceLine rest = line;
    rest.text.replace(0, word.behind, word.behind, ' ');
    if (has_macro_word(rest.text)) {
        execute_stop(word_of(rest), rest);
    } else {
        given_ = std::move(rest.text);
    }
}

// #3000 and #3006.
void ProgramFlow::execute_stop(const FlowWord& word, const SourceLine& line) {
    constexpr std::size_t longest = 200;
    std::size_t at = word.rest;
    const std::int64_t number = value(line.text, at, line).raw / Decimal::one;
    require_end(line, at);
    const std::string_view text = comment_of(line.text).substr(0, longest);
    if (word.kind == FlowKind::message) {
        given_ = fmt::format("M0 (MSG,{})", text);
        return;
    }
    stops_ = true;
    fail(line, word.label_at, "the program ends itself by #3000={} ({})", number, text);
}

// M97: lines of the same program, to M99.
void ProgramFlow::execute_line_call(const FlowWord& word, const SourceLine& line) {
    if (!word.has_number) {
        fail(line, word.label_at, "M97 needs P, the number N of a block: M97 P100, and L for how often");
    }
    if (!keeps_program(word, line)) {
        return;
    }
    std::size_t at = word.label_at;
    const std::uint32_t number = whole(at, line);
    at = word.rest;
    const std::int64_t times = at > 0 ? value(line.text, at, line).raw / Decimal::one : 1;
    const FlowBlock::Label& label = find_label(number, line, word.label_at);
    if (label.around != FlowBlock::no_line) {
        fail(line, word.label_at, "N{} stands in a loop, and a call does not lead there", number);
    }
    if (frames_.size() >= deepest) {
        fail(line, word.label_at, "calls are nested more than {} deep", deepest);
    }
    if (times > 0) {
        frames_.push_back({.code = frames_.back().code,
                           .at = label.line,
                           .call = Call::program,
                           .more = times - 1,
                           .again = label.line});
    }
}

// An argument, P or L.
void ProgramFlow::read_argument(TextCursor& text, const SourceLine& line, MacroCall& out, std::string& letters) {
    const std::size_t begin = text.at();
    const char letter = text.peek();
    const std::int32_t variable = argument_number(letter);
    if (variable == 0 && letter != 'p' && letter != 'l') {
        fail(line, begin,
             "G65 takes P, L and the arguments A to F, H to K, M and Q to Z, and stands first in its line");
    }
    const bool in_order = letter < 'i' || letter > 'k' || letters.find_first_of("ijk") == std::string::npos ||
                          letters[letters.find_last_of("ijk")] < letter;
    if (!in_order) {
        fail(line, begin, "I, J and K of G65 stand once, in this order; several sets of them are not supported");
    }
    if (letters.find(letter) != std::string::npos) {
        fail(line, begin, "the letter stands twice");
    }
    letters += letter;
    text.step();
    const std::size_t number = text.at();
    Decimal result;
    if (const ProgramStatus status = evaluator_->value(text, *system_, result); !status.ok()) {
        fail(line, text.at(), describe(status.error()));
    }
    if (variable > 0) {
        const bool plain = line.text.substr(number, text.at() - number).find_first_of(".#[") == std::string::npos;
        out.locals[static_cast<std::size_t>(variable - 1)] =
            rules_.increments && plain ? counted(result, letter, system_->modal().inches) : result;
    } else if (result == vacant || result.raw < 0 || result.raw % Decimal::one != 0) {
        fail(line, number, "P and L of G65 are whole numbers");
    } else if (letter == 'p') {
        out.number = std::to_string(result.raw / Decimal::one);
    } else {
        out.times = result.raw / Decimal::one;
    }
}

ProgramFlow::MacroCall ProgramFlow::macro_call(const FlowWord& word, const SourceLine& line) {
    MacroCall out;
    out.locals.fill(vacant);
    std::string letters;
    TextCursor text(line.text);
    text.go_to(word.rest);
    while (!text.at_end() && text.peek() != ';') {
        if (text.peek() == '(') {
            text.go_to(text.find(')', text.at()));
            text.step();
        } else {
            read_argument(text, line, out, letters);
        }
    }
    if (out.number.empty()) {
        fail(line, word.label_at, "G65 needs P, the number of the macro: G65 P9010 A1.5 B2");
    }
    return out;
}

// G65: #1 to #33 are those of the macro.
void ProgramFlow::execute_macro_call(const FlowWord& word, const SourceLine& line) {
    MacroCall call = macro_call(word, line);
    const auto code = find_program(call.number, word, line);
    if (code != nullptr && call.times > 0) {
        parameters_->enter_macro(call.locals);
        frames_.push_back(
            {.code = code, .at = 1, .call = Call::macro, .more = call.times - 1, .arguments = call.locals});
    }
}

// Haas' controls keep what a macro has set for its next repetition; of others it is not known.
void ProgramFlow::require_same_locals(const FlowWord& word, const SourceLine& line) const {
    const Frame& frame = frames_.back();
    if (frame.call == Call::macro && parameters_->locals() != frame.arguments) {
        fail(line, word.label_at,
             "the macro is to run again (L) and has set some of #1 to #33, which controls take in different ways; "
             "write a loop around G65");
    }
}

// M99 at the end of the main program, where controls begin it again.
void ProgramFlow::end_main(const FlowWord& word, const SourceLine& line) {
    given_ = word.others;
    if (runs_ < rules_.runs) {
        begin_again(line);
        return;
    }
    stops_ = true;
    if (rules_.left_out != nullptr && rules_.runs == 1) {
        rules_.left_out->at_line(line.number);
        rules_.left_out->add("M99");
    }
}

void ProgramFlow::begin_again(const SourceLine& line) {
    if (passed_lost_) {
        fail(line, 0, "a program that is to run again has more than {} lines", most_lines);
    }
    while (!frames_.empty()) {
        leave_frame();
    }
    if (program_ == nullptr) {
        load_program();
        frames_.clear();
    }
    frames_.push_back({.code = program_});
    ++runs_;
}

// M99 P: Fanuc's controls go on in the caller, Haas' in the subprogram itself.
void ProgramFlow::return_to(const FlowWord& word, const SourceLine& line) {
    std::size_t at = word.label_at;
    const std::uint32_t number = whole(at, line);
    if (frames_.back().code->label(number) != nullptr) {
        fail(line, word.label_at,
             "N{} stands in the subprogram itself, too, where Haas goes on, and Fanuc in the caller; write GOTO, or "
             "give the block another number",
             number);
    }
    if (frames_.back().more > 0) {
        fail(line, word.label_at,
             "M99 P leaves a call that is to run again (L), which controls take in different ways");
    }
    leave_frame();
    if (frames_.empty()) {
        load_program();
    }
    jump_to(number, line, word.label_at);
}

} // namespace splinefeed::host
