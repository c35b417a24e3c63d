// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/program_flow.hpp"

#include "host_sim/base/input_error.hpp"

#include "splinefeed/s0_program/text/macro_operation.hpp"
#include "splinefeed/s0_program/text/program_errors.hpp"

#include <algorithm>

namespace splinefeed::host {

void ProgramFlow::fail(const SourceLine& line, std::size_t at, std::string_view text) const {
    throw WordError(file_of(line), line.number, std::uint64_t{at} + 1U, text);
}

bool ProgramFlow::report(const InputError& error, const SourceLine& line) {
    if (problems_ == nullptr) {
        throw InputError(error);
    }
    return problems_->add(error, line.number, {}, file_of(line));
}

FlowWord ProgramFlow::word_of(const SourceLine& line) const {
    std::size_t wrong = 0;
    if (has_statement(line.text)) {
        std::string_view right;
        auto statement = read_macro_word(line.text, wrong, right);
        if (!statement) {
            fail(line, wrong, right);
        }
        return std::move(*statement);
    }
    if (auto call = read_flow_code(line.text, rules_)) {
        return std::move(*call);
    }
    const auto word = read_flow_word(line.text, wrong);
    if (!word || (word->kind == FlowKind::program && rules_.programs == NumberedPrograms::none)) {
        fail(line, wrong,
             "an O word has a number or a <name>, and then sub, endsub, call, return, if, elseif, else, endif, while, "
             "endwhile, do, repeat, endrepeat, break or continue");
    }
    const bool takes_value = word->kind == FlowKind::call || word->kind == FlowKind::return_ ||
                             word->kind == FlowKind::endsub || word->kind == FlowKind::if_ ||
                             word->kind == FlowKind::elseif || word->kind == FlowKind::while_ ||
                             word->kind == FlowKind::repeat;
    if (!takes_value) {
        require_end(line, word->rest);
    }
    return *word;
}

// Words behind an O word would be left out.
void ProgramFlow::require_end(const SourceLine& line, std::size_t at) const {
    TextCursor cursor(line.text);
    cursor.go_to(at);
    if (!cursor.at_end() && cursor.peek() != '(' && cursor.peek() != ';') {
        fail(line, cursor.at(), "behind an O word there may be a comment only; write the rest on a line of its own");
    }
}

Decimal ProgramFlow::value(std::string_view text, std::size_t& at, const SourceLine& line) {
    TextCursor cursor(text);
    cursor.go_to(at);
    Decimal out;
    const ProgramStatus status = evaluator_->value(cursor, *system_, out);
    at = cursor.at();
    if (!status.ok()) {
        fail(line, at, describe(status.error()));
    }
    return value_or_zero(out);
}

std::string ProgramFlow::label_of(const FlowWord& word, const SourceLine& line) {
    if (!word.label.empty()) {
        return word.label;
    }
    std::size_t at = word.label_at;
    const Decimal number = value(line.text, at, line);
    if (number.raw < 0 || number.raw % Decimal::one != 0) {
        fail(line, word.label_at, "the number of an O word must be a whole number");
    }
    return std::to_string(number.raw / Decimal::one);
}

bool ProgramFlow::condition(const FlowWord& word, const SourceLine& line) {
    std::size_t at = word.rest;
    if (at >= line.text.size() || line.text[at] != '[') {
        fail(line, std::min(at, line.text.size()), "a condition stands in brackets, like [#1 LT 5]");
    }
    const Decimal out = value(line.text, at, line);
    require_end(line, at);
    return out.raw != 0;
}

// In the place of one that had the same number.
void ProgramFlow::keep(const std::string& label, const Sub& sub) {
    Sub& place = subs_[label];
    kept_ -= place.code ? place.code->size() : 0;
    kept_ += sub.code->size();
    place = sub;
}

// A subprogram within a block that runs.
void ProgramFlow::define(const FlowBlock::Place& place, const SourceLine& line) {
    const FlowBlock& code = *frames_.back().code;
    const auto known = subs_.find(place.word.label);
    if (known == subs_.end() || known->second.source != code.number() || known->second.line != place.begin) {
        if (kept_ + (place.end - place.begin) >= most_lines) {
            fail(line, 0, "subprograms and loops have more than {} lines", most_lines);
        }
        auto part = std::make_shared<const FlowBlock>(code.part(place.begin, ++blocks_));
        keep(place.word.label, {std::move(part), code.number(), place.begin});
    }
    go_to(place.end + 1);
}

// Within the frame. Repeats that are left end.
void ProgramFlow::go_to(std::size_t line) {
    Frame& frame = frames_.back();
    const auto leaves = [&](const Repeat& loop) {
        return line <= loop.begin || line > frame.code->place(loop.begin)->end;
    };
    while (!frame.repeats.empty() && leaves(frame.repeats.back())) {
        frame.repeats.pop_back();
    }
    frame.at = line;
}

void ProgramFlow::execute_if(const FlowBlock::Place& place, const SourceLine& line) {
    const FlowBlock& code = *frames_.back().code;
    const FlowBlock::Place* at = &place;
    bool taken = condition(place.word, line);
    while (!taken) {
        const std::size_t next = at->next;
        go_to(next + 1);
        at = code.place(next);
        taken = at->word.kind != FlowKind::elseif || condition(at->word, code.line(next));
    }
}

void ProgramFlow::execute_repeat(const FlowBlock::Place& place, const SourceLine& line) {
    std::size_t at = place.word.rest;
    if (at >= line.text.size() || line.text[at] != '[') {
        fail(line, std::min(at, line.text.size()), "repeat needs a number in brackets, like [5]");
    }
    const std::int64_t count = value(line.text, at, line).raw / Decimal::one;
    require_end(line, at);
    if (count <= 0) {
        go_to(place.end + 1);
    } else {
        frames_.back().repeats.push_back({place.begin, count});
    }
}

void ProgramFlow::end_repeat(const FlowBlock::Place& place) {
    Repeat& repeat = frames_.back().repeats.back();
    go_to(--repeat.left > 0 ? place.begin + 1 : place.end + 1);
}

void ProgramFlow::execute(const FlowBlock::Place& place, const SourceLine& line) {
    const FlowBlock& code = *frames_.back().code;
    switch (place.word.kind) {
    case FlowKind::sub: define(place, line); break;
    case FlowKind::endsub:
    case FlowKind::return_: leave_sub(place.word, line); break;
    case FlowKind::call: execute_call(place.word, line); break;
    case FlowKind::if_: execute_if(place, line); break;
    case FlowKind::elseif:
    case FlowKind::else_: go_to(place.end + 1); break; // behind a branch that was taken
    case FlowKind::endif:
    case FlowKind::program: // another one goes on in it
    case FlowKind::do_: break;
    case FlowKind::call_program: execute_program_call(place.word, line); break;
    case FlowKind::end_program: leave_program(place.word, line); break;
    case FlowKind::save_modes:
    case FlowKind::forget_modes:
    case FlowKind::restore_modes:
    case FlowKind::lend_modes: execute_modes(place.word, line); break;
    case FlowKind::while_:
        if (code.place(place.begin)->word.kind == FlowKind::do_) {
            if (condition(place.word, line)) {
                go_to(place.begin + 1);
            }
        } else if (!condition(place.word, line)) {
            go_to(place.end + 1);
        }
        break;
    case FlowKind::endwhile: go_to(place.begin); break;
    case FlowKind::repeat: execute_repeat(place, line); break;
    case FlowKind::endrepeat: end_repeat(place); break;
    case FlowKind::call_line: execute_line_call(place.word, line); break;
    case FlowKind::call_macro: execute_macro_call(place.word, line); break;
    case FlowKind::jump: jump(place.word, line, place.word.rest); break;
    case FlowKind::jump_if: execute_jump_if(place.word, line); break;
    case FlowKind::then: execute_then(place.word, line); break;
    case FlowKind::alarm:
    case FlowKind::message: execute_stop(place.word, line); break;
    case FlowKind::loop: execute_loop(place, line); break;
    case FlowKind::end_loop: go_to(place.begin); break;
    case FlowKind::break_: go_to(code.place(place.begin)->end + 1); break;
    case FlowKind::continue_: go_to(code.place(place.begin)->end); break;
    }
}

void ProgramFlow::leave_frame() {
    const Frame& frame = frames_.back();
    if (frame.call == Call::sub || frame.call == Call::macro) {
        parameters_->leave();
    }
    if (frame.lends && frame.modes) {
        put_back(*frame.modes, frame.code->line(std::min(frame.at, frame.code->size()) - 1));
    }
    frames_.pop_back();
}

// The program goes on behind the block that runs.
void ProgramFlow::abandon() {
    while (!frames_.empty()) {
        leave_frame();
    }
    words_ = repeated_ = 0;
}

// A word was wrong: what is in its structure runs once.
void ProgramFlow::go_on_behind(const FlowBlock::Place& place, bool is_new) {
    switch (place.word.kind) {
    case FlowKind::loop:
    case FlowKind::while_:
        if (!is_new && place.end > place.begin && frames_.back().code->place(place.begin)->word.kind != FlowKind::do_) {
            go_to(place.end + 1);
        }
        break;
    case FlowKind::repeat: frames_.back().repeats.push_back({place.begin, 1}); break;
    case FlowKind::call: // calls that go on for ever
    case FlowKind::call_program:
    case FlowKind::call_line:
    case FlowKind::call_macro:
        if (frames_.size() >= deepest) {
            abandon();
        }
        break;
    default: break;
    }
}

ProgramFlow::Step ProgramFlow::next(SourceLine& out) {
    if (!restoring_.empty()) {
        out = std::move(restoring_.front());
        restoring_.pop_front();
        return Step::line;
    }
    if (stops_) {
        return Step::end;
    }
    if (waits_) {
        return read_ahead(out);
    }
    if (runs_block()) {
        return next_in_memory(out);
    }
    std::optional<FlowWord> known;
    if (!next_line(out, known)) {
        if (!collects_) {
            return Step::end;
        }
        end_block();
        return Step::nothing;
    }
    if (collects_ || known || has_word(out.text)) {
        return take_word(out, known);
    }
    const char first = TextCursor(out.text).peek();
    begun_ = begun_ || (first >= 'a' && first <= 'z');
    return Step::line;
}

ProgramFlow::Step ProgramFlow::next_in_memory(SourceLine& out) {
    Frame& frame = frames_.back();
    if (frame.at >= frame.code->size()) {
        return end_of_block();
    }
    const std::shared_ptr<const FlowBlock> code = frame.code; // the frame may go
    const std::size_t at = frame.at++;
    const FlowBlock::Place* const place = code->place(at);
    out = code->line(at);
    if (place == nullptr) {
        return Step::line;
    }
    try {
        count_word(out);
        execute(*place, code->line(at));
    } catch (const WordError& error) {
        const bool is_new = report(error, out);
        repeated_ += is_new ? 0U : 1U;
        if (words_ > most_words || repeated_ > most_repeated) {
            abandon();
        } else {
            go_on_behind(*place, is_new);
        }
    }
    return give_others(place->word, out);
}

ProgramFlow::Step ProgramFlow::end_of_block() {
    const Frame& frame = frames_.back();
    if (frame.call == Call::program || frame.call == Call::macro) {
        const SourceLine& first = frame.code->line(frame.again == 1 ? 0 : frame.again);
        report(InputError(file_of(first), first.number, std::uint64_t{1},
                          "the subprogram that begins here has no M99 at its end"),
               first);
    }
    leave_frame();
    return Step::nothing;
}

void ProgramFlow::count_word(const SourceLine& line) {
    if (++words_ > most_words) {
        fail(line, 0, "the program has executed {} {}; does it ever end?", most_words,
             rules_.macros ? "jumps, loops and calls" : "O words");
    }
}

} // namespace splinefeed::host
