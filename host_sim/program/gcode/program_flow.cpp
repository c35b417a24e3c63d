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

// The next line of the frame with the label and one of the kinds.
std::size_t ProgramFlow::find(std::size_t from, const std::string& label, std::initializer_list<FlowKind> kinds,
                              const SourceLine& line) const {
    const Code& code = *frames_.back().code;
    for (std::size_t i = from; i < code.size(); ++i) {
        if (has_flow_word(code[i].text)) {
            const FlowWord word = word_of(code[i]);
            if (word.label == label && std::find(kinds.begin(), kinds.end(), word.kind) != kinds.end()) {
                return i;
            }
        }
    }
    fail(line, 0, fmt::format("o{} has no end", label));
}

std::size_t ProgramFlow::find_back(const std::string& label, FlowKind kind, const SourceLine& line) const {
    const Frame& frame = frames_.back();
    for (std::size_t i = frame.at; i-- > 0;) {
        if (has_flow_word((*frame.code)[i].text)) {
            const FlowWord word = word_of((*frame.code)[i]);
            if (word.label == label && word.kind == kind) {
                return i;
            }
        }
    }
    fail(line, 0, fmt::format("o{} has no begin", label));
}

// Whether a while is the end of a do.
bool ProgramFlow::ends_do(const FlowWord& word) const {
    const Frame& frame = frames_.back();
    for (std::size_t i = 0; i + 1 < frame.at; ++i) {
        if (has_flow_word((*frame.code)[i].text)) {
            const FlowWord other = word_of((*frame.code)[i]);
            if (other.label == word.label && other.kind == FlowKind::do_) {
                return true;
            }
        }
    }
    return false;
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
        block_ = std::make_shared<Code>(1, line);
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
    block_->push_back(line);
    if (!has_flow_word(line.text)) {
        return Step::nothing;
    }
    const FlowWord word = word_of(line);
    const FlowKind end = block_kind_ == FlowKind::sub      ? FlowKind::endsub
                         : block_kind_ == FlowKind::if_    ? FlowKind::endif
                         : block_kind_ == FlowKind::repeat ? FlowKind::endrepeat
                         : block_kind_ == FlowKind::do_    ? FlowKind::while_
                                                           : FlowKind::endwhile;
    if (word.label != block_label_ || word.kind != end) {
        return Step::nothing;
    }
    collects_ = false;
    if (block_kind_ == FlowKind::sub) {
        kept_ += block_->size();
        subs_[block_label_] = block_;
    } else {
        frames_.push_back({block_, 0, false, {}});
    }
    block_.reset();
    return Step::nothing;
}

// A subprogram within a block that runs.
void ProgramFlow::define(const FlowWord& word, const SourceLine& line) {
    Frame& frame = frames_.back();
    const std::size_t end = find(frame.at, word.label, {FlowKind::endsub}, line);
    const auto from = frame.code->begin() + static_cast<std::ptrdiff_t>(frame.at) - 1;
    subs_[word.label] = std::make_shared<const Code>(from, frame.code->begin() + static_cast<std::ptrdiff_t>(end) + 1);
    frame.at = end + 1;
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
    frames_.push_back({sub->second, 1, true, {}});
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

void ProgramFlow::execute_if(const FlowWord& word, const SourceLine& line) {
    Frame& frame = frames_.back();
    bool taken = condition(word, line);
    const SourceLine* here = &line;
    while (!taken) {
        frame.at = find(frame.at, word.label, {FlowKind::elseif, FlowKind::else_, FlowKind::endif}, *here) + 1;
        here = &(*frame.code)[frame.at - 1];
        const FlowWord next = word_of(*here);
        taken = next.kind != FlowKind::elseif || condition(next, *here);
    }
}

void ProgramFlow::execute_repeat(const FlowWord& word, const SourceLine& line) {
    Frame& frame = frames_.back();
    std::size_t at = word.rest;
    if (at >= line.text.size() || line.text[at] != '[') {
        fail(line, std::min(at, line.text.size()), "repeat needs a number in brackets, like [5]");
    }
    const std::int64_t count = value(line.text, at, line).raw / Decimal::one;
    if (count <= 0) {
        frame.at = find(frame.at, word.label, {FlowKind::endrepeat}, line) + 1;
    } else {
        frame.loops.push_back({word.label, count});
    }
}

void ProgramFlow::execute(const FlowWord& word, const SourceLine& line) {
    Frame& frame = frames_.back();
    const std::size_t here = frame.at - 1;
    const auto drop_loop = [&] {
        const auto same = [&](const Loop& loop) {
            return loop.label == word.label;
        };
        frame.loops.erase(std::remove_if(frame.loops.begin(), frame.loops.end(), same), frame.loops.end());
    };
    switch (word.kind) {
    case FlowKind::sub: define(word, line); break;
    case FlowKind::endsub:
    case FlowKind::return_: leave_sub(word, line); break;
    case FlowKind::call: execute_call(word, line); break;
    case FlowKind::if_: execute_if(word, line); break;
    case FlowKind::elseif:
    case FlowKind::else_: frame.at = find(frame.at, word.label, {FlowKind::endif}, line) + 1; break;
    case FlowKind::endif:
    case FlowKind::do_: break;
    case FlowKind::while_:
        if (ends_do(word)) {
            frame.at = condition(word, line) ? find_back(word.label, FlowKind::do_, line) + 1 : frame.at;
        } else if (!condition(word, line)) {
            frame.at = find(frame.at, word.label, {FlowKind::endwhile}, line) + 1;
        }
        break;
    case FlowKind::endwhile: frame.at = find_back(word.label, FlowKind::while_, line); break;
    case FlowKind::repeat: execute_repeat(word, line); break;
    case FlowKind::endrepeat:
        if (frame.loops.empty() || frame.loops.back().label != word.label) {
            fail(line, word.label_at, fmt::format("o{} has no begin", word.label));
        }
        if (--frame.loops.back().left > 0) {
            frame.at = find_back(word.label, FlowKind::repeat, line) + 1;
        } else {
            frame.loops.pop_back();
        }
        break;
    case FlowKind::break_:
        frame.at = find(here + 1, word.label, {FlowKind::endwhile, FlowKind::endrepeat, FlowKind::while_}, line) + 1;
        drop_loop();
        break;
    case FlowKind::continue_:
        frame.at = find(here + 1, word.label, {FlowKind::endwhile, FlowKind::endrepeat, FlowKind::while_}, line);
        break;
    }
}

ProgramFlow::Step ProgramFlow::next(SourceLine& out) {
    const bool from_memory = !frames_.empty() && !collects_;
    if (from_memory) {
        Frame& frame = frames_.back();
        if (frame.at >= frame.code->size()) {
            frames_.pop_back();
            return Step::nothing;
        }
        out = (*frame.code)[frame.at++];
    } else if (!lines_->next(out)) {
        if (collects_) {
            fail(block_->front(), 0, fmt::format("o{} has no end", block_label_));
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
    if (++jumps_ > most_jumps) {
        fail(out, 0, fmt::format("the program has executed {} O words; does it ever end?", most_jumps));
    }
    const FlowWord word = word_of(out);
    const SourceLine line = out; // the frame that it came from may go
    from_memory ? execute(word, line) : begin(word, line);
    return Step::nothing;
}

} // namespace splinefeed::host
