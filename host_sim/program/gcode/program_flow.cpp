// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/program_flow.hpp"

#include "host_sim/base/input_error.hpp"

#include "splinefeed/base/status.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace splinefeed::host {

void ProgramFlow::fail(const SourceLine& line, std::size_t at, std::string_view text) const {
    throw InputError(file_, line.number, std::uint64_t{at} + 1U, text);
}

FlowWord ProgramFlow::word_of(const SourceLine& line) const {
    std::size_t wrong = 0;
    const auto word = read_flow_word(line.text, wrong);
    if (!word) {
        fail(line, wrong,
             "an O word has a number or a <name>, and then sub, endsub, call, return, if, elseif, else, endif, while, "
             "endwhile, do, repeat, endrepeat, break or continue");
    }
    return *word;
}

Decimal ProgramFlow::value(std::string_view text, std::size_t& at, const SourceLine& line) {
    TextCursor cursor(text);
    cursor.go_to(at);
    Decimal out;
    const Status status = evaluator_->value(cursor, *system_, out);
    at = cursor.at();
    if (!status.ok()) {
        fail(line, at, describe(status.error()));
    }
    return out;
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
    return value(line.text, at, line).raw != 0;
}

// A block of the input is read to its end before it runs: loops go back, and conditions go forward.
void ProgramFlow::begin(const FlowWord& word, const SourceLine& line) {
    switch (word.kind) {
    case FlowKind::sub:
    case FlowKind::if_:
    case FlowKind::while_:
    case FlowKind::do_:
    case FlowKind::repeat:
        if (word.label.empty()) {
            fail(line, word.label_at, "only call takes an expression as its number");
        }
        collects_ = true;
        block_ = std::make_shared<FlowBlock>(++blocks_);
        block_->add(line, word);
        block_label_ = word.label;
        block_kind_ = word.kind;
        break;
    case FlowKind::call: execute_call(word, line); break;
    default: fail(line, word.label_at, fmt::format("o{} has no begin", word.label));
    }
}

ProgramFlow::Step ProgramFlow::collect(SourceLine& line) {
    if (block_->size() + kept_ >= most_lines) {
        fail(line, 0, fmt::format("subprograms and loops have more than {} lines", most_lines));
    }
    if (!has_flow_word(line.text)) {
        block_->add(line);
        return Step::nothing;
    }
    const FlowWord word = word_of(line);
    block_->add(line, word);
    const FlowKind end = block_kind_ == FlowKind::sub      ? FlowKind::endsub
                         : block_kind_ == FlowKind::if_    ? FlowKind::endif
                         : block_kind_ == FlowKind::repeat ? FlowKind::endrepeat
                         : block_kind_ == FlowKind::do_    ? FlowKind::while_
                                                           : FlowKind::endwhile;
    if (word.label != block_label_ || word.kind != end) {
        return Step::nothing;
    }
    collects_ = false;
    if (const FlowBlock::Problem problem = block_->link(); !problem.text.empty()) {
        fail(block_->line(problem.line), problem.at, problem.text);
    }
    if (block_kind_ == FlowKind::sub) {
        keep(block_label_, {block_, block_->number(), 0});
    } else {
        frames_.push_back({block_, 0, false, {}});
    }
    block_.reset();
    return Step::nothing;
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
            fail(line, 0, fmt::format("subprograms and loops have more than {} lines", most_lines));
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

void ProgramFlow::execute_call(const FlowWord& word, const SourceLine& line) {
    const std::string label = label_of(word, line);
    const auto sub = subs_.find(label);
    if (sub == subs_.end()) {
        fail(line, word.label_at,
             fmt::format("there is no subprogram o{} before this line; those of other files are not read", label));
    }
    if (frames_.size() >= deepest) {
        fail(line, word.label_at, fmt::format("calls are nested more than {} deep", deepest));
    }
    std::vector<Decimal> arguments;
    for (std::size_t at = word.rest; at < line.text.size() && line.text[at] == '[';) {
        if (arguments.size() == most_arguments) {
            fail(line, at, fmt::format("a call has at most {} arguments", most_arguments));
        }
        arguments.push_back(value(line.text, at, line));
    }
    parameters_->enter(arguments);
    frames_.push_back({sub->second.code, 1, true, {}});
}

void ProgramFlow::leave_sub(const FlowWord& word, const SourceLine& line) {
    std::size_t at = word.rest;
    const bool has_value = at < line.text.size() && line.text[at] == '[';
    const Decimal result = has_value ? value(line.text, at, line) : Decimal{};
    while (!frames_.empty() && !frames_.back().called) {
        frames_.pop_back();
    }
    if (frames_.empty()) {
        fail(line, word.label_at, "return stands in a subprogram");
    }
    frames_.pop_back();
    parameters_->leave();
    parameters_->write("_value", result);
    parameters_->write("_value_returned", Decimal::from_integer(has_value ? 1 : 0));
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
    case FlowKind::do_: break;
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
    case FlowKind::break_: go_to(code.place(place.begin)->end + 1); break;
    case FlowKind::continue_: go_to(code.place(place.begin)->end); break;
    }
}

ProgramFlow::Step ProgramFlow::next(SourceLine& out) {
    if (in_memory()) {
        return next_in_memory(out);
    }
    if (!lines_->next(out)) {
        if (collects_) {
            fail(block_->line(0), 0, fmt::format("o{} has no end", block_label_));
        }
        return Step::end;
    }
    if (collects_) {
        return collect(out);
    }
    if (!has_flow_word(out.text)) {
        const char first = TextCursor(out.text).peek();
        begun_ = begun_ || (first >= 'a' && first <= 'z');
        return Step::line;
    }
    if (!begun_ && is_program_number(out.text)) {
        return Step::nothing;
    }
    begun_ = true;
    if (!out.whole) {
        throw InputError(file_, out.number, cut_line);
    }
    count_word(out);
    begin(word_of(out), out);
    return Step::nothing;
}

ProgramFlow::Step ProgramFlow::next_in_memory(SourceLine& out) {
    Frame& frame = frames_.back();
    if (frame.at >= frame.code->size()) {
        frames_.pop_back();
        return Step::nothing;
    }
    const std::shared_ptr<const FlowBlock> code = frame.code; // the frame may go
    const std::size_t at = frame.at++;
    const FlowBlock::Place* const place = code->place(at);
    out = code->line(at);
    if (place == nullptr) {
        return Step::line;
    }
    count_word(out);
    execute(*place, code->line(at));
    return Step::nothing;
}

void ProgramFlow::count_word(const SourceLine& line) {
    if (++words_ > most_words) {
        fail(line, 0, fmt::format("the program has executed {} O words; does it ever end?", most_words));
    }
}

} // namespace splinefeed::host
