// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/flow_block.hpp"

#include <fmt/format.h>
#include <utility>

namespace splinefeed::host {

namespace {

// What a word ends or divides.
FlowKind begin_of(FlowKind kind) {
    switch (kind) {
    case FlowKind::endsub: return FlowKind::sub;
    case FlowKind::endwhile: return FlowKind::while_;
    case FlowKind::endrepeat: return FlowKind::repeat;
    case FlowKind::while_: return FlowKind::do_;
    default: return FlowKind::if_;
    }
}

bool ends(FlowKind kind) {
    return kind == FlowKind::endsub || kind == FlowKind::endif || kind == FlowKind::endwhile ||
           kind == FlowKind::endrepeat || kind == FlowKind::while_; // of do
}

// Whether it is of no use without its structure.
bool belongs(FlowKind kind) {
    return kind != FlowKind::call && kind != FlowKind::return_ && kind < FlowKind::program;
}

std::string_view end_of(FlowKind begin) {
    return begin == FlowKind::sub      ? "endsub"
           : begin == FlowKind::if_    ? "endif"
           : begin == FlowKind::repeat ? "endrepeat"
           : begin == FlowKind::do_    ? "while [...]"
                                       : "endwhile";
}

} // namespace

void FlowBlock::add(SourceLine line) {
    lines_.push_back(std::move(line));
    place_of_.push_back(0);
}

void FlowBlock::add(SourceLine line, FlowWord word) {
    add(std::move(line));
    places_.push_back({.word = std::move(word)});
    place_of_.back() = static_cast<std::uint32_t>(places_.size());
}

FlowBlock FlowBlock::part(std::size_t from, std::uint64_t number) const {
    FlowBlock out(number);
    const std::size_t end = place(from)->end;
    for (std::size_t i = from; i <= end; ++i) {
        if (const Place* const of = place(i); of != nullptr) {
            out.places_.push_back({of->word, of->begin - from, of->end - from, of->next - from});
        }
        out.lines_.push_back(lines_[i]);
        out.place_of_.push_back(place(i) != nullptr ? static_cast<std::uint32_t>(out.places_.size()) : 0);
    }
    return out;
}

void FlowBlock::add_problem(std::size_t line, std::size_t at, std::string text) {
    problems_.push_back({line, at, std::move(text)});
}

void FlowBlock::add_stray(std::size_t line) {
    const FlowWord& word = known(line).word;
    known(line).wrong = true;
    add_problem(line, word.label_at,
                open_.empty() ? fmt::format("o{} has no begin", word.label)
                              : fmt::format("o{} has no begin; what is open here is o{} of line {}", word.label,
                                            known(open_.back()).word.label, lines_[open_.back()].number));
}

void FlowBlock::enter(std::size_t line) {
    known(line).begin = line;
    open_.push_back(line);
}

// Its index in open_; behind the last one: there is none.
std::size_t FlowBlock::open_place(FlowKind begin, const std::string& label) const {
    for (std::size_t i = open_.size(); i-- > 0;) {
        const FlowWord& word = place(open_[i])->word;
        if (word.kind == begin && word.label == label) {
            return i;
        }
    }
    return open_.size();
}

bool FlowBlock::ends_behind(std::size_t begin, std::size_t line) const {
    const FlowWord& first = place(begin)->word;
    for (std::size_t i = line + 1; i < lines_.size(); ++i) {
        const FlowWord* const word = place(i) != nullptr ? &place(i)->word : nullptr;
        if (word != nullptr && word->label == first.label && ends(word->kind) && begin_of(word->kind) == first.kind) {
            return true;
        }
    }
    return false;
}

void FlowBlock::give_up(std::size_t begin, std::size_t last_line) {
    for (std::size_t i = begin; i <= last_line; ++i) {
        if (place_of_[i] > 0 && known(i).begin == begin && belongs(known(i).word.kind)) {
            known(i).wrong = true;
        }
    }
}

// With a label that is not open an end may be that of the innermost structure, with a wrong name.
void FlowBlock::end_or_branch(std::size_t line) {
    FlowWord& word = known(line).word;
    const FlowKind begin = begin_of(word.kind);
    if (open_place(begin, word.label) == open_.size()) {
        add_stray(line);
        if (open_.empty() || !ends(word.kind) || known(open_.back()).word.kind != begin ||
            ends_behind(open_.back(), line)) {
            return;
        }
        known(line).wrong = false;
        word.label = known(open_.back()).word.label;
    }
    for (const std::size_t at = open_place(begin, word.label); open_.size() > at + 1; open_.pop_back()) {
        const std::size_t inner = open_.back();
        add_problem(
            line, word.label_at,
            fmt::format("o{} of line {} has no end before this one", known(inner).word.label, lines_[inner].number));
        give_up(inner, line);
    }
    ends(word.kind) ? close(line) : branch(line);
}

void FlowBlock::close(std::size_t line) {
    const std::size_t first = open_.back();
    if (known(first).word.kind == FlowKind::if_) {
        const std::size_t last_branch = known(first).end > 0 ? known(first).end : first;
        known(last_branch).next = line;
        for (std::size_t i = first; i != line; i = known(i).next) {
            known(i).end = line;
        }
    }
    known(line).begin = first;
    known(first).end = known(line).end = line;
    open_.pop_back();
}

// `end` of the first word is the last branch so far, until endif is there.
void FlowBlock::branch(std::size_t line) {
    const std::size_t first = open_.back();
    const std::size_t last_branch = known(first).end > 0 ? known(first).end : first;
    if (known(last_branch).word.kind == FlowKind::else_) {
        known(line).wrong = true;
        add_problem(line, known(line).word.label_at,
                    fmt::format("o{} has its else in line {}; it has one, behind each elseif", known(line).word.label,
                                lines_[last_branch].number));
        return;
    }
    known(line).begin = first;
    known(first).end = known(last_branch).next = line;
}

// break and continue: the loop that they name is around them, in the same subprogram.
void FlowBlock::leave(std::size_t line) {
    Place& word = known(line);
    for (std::size_t i = open_.size(); i-- > 0;) {
        const FlowWord& around = known(open_[i]).word;
        if (around.kind == FlowKind::sub) {
            break;
        }
        if (around.kind != FlowKind::if_ && around.label == word.word.label) {
            word.begin = open_[i];
            return;
        }
    }
    word.wrong = true;
    add_problem(line, word.word.label_at, fmt::format("there is no loop o{} around this line", word.word.label));
}

void FlowBlock::link_word(std::size_t line) {
    const FlowWord& word = known(line).word;
    if (word.label.empty() && word.kind != FlowKind::call && belongs(word.kind)) {
        known(line).wrong = true;
        add_problem(line, word.label_at, "only call takes an expression as its number");
        return;
    }
    switch (word.kind) {
    case FlowKind::sub:
    case FlowKind::if_:
    case FlowKind::do_:
    case FlowKind::repeat: enter(line); break;
    case FlowKind::while_:
        open_place(FlowKind::do_, word.label) < open_.size() ? end_or_branch(line) : enter(line);
        break;
    case FlowKind::elseif:
    case FlowKind::else_:
    case FlowKind::endif:
    case FlowKind::endwhile:
    case FlowKind::endrepeat:
    case FlowKind::endsub: end_or_branch(line); break;
    case FlowKind::break_:
    case FlowKind::continue_: leave(line); break;
    case FlowKind::call:
    case FlowKind::program:
    case FlowKind::call_program:
    case FlowKind::call_lines:
    case FlowKind::end_program:
    case FlowKind::save_modes:
    case FlowKind::forget_modes:
    case FlowKind::restore_modes:
    case FlowKind::lend_modes:
    case FlowKind::return_: break;
    }
}

std::vector<FlowBlock::Problem> FlowBlock::link() {
    open_.clear();
    problems_.clear();
    for (std::size_t i = 0; i < lines_.size() && problems_.size() < most_problems; ++i) {
        if (place_of_[i] > 0) {
            link_word(i);
        }
        if (open_.size() > deepest) {
            add_problem(i, known(i).word.label_at, fmt::format("O words are nested more than {} deep", deepest));
            open_.clear();
            for (Place& word : places_) {
                word.wrong = true;
            }
            return problems_;
        }
    }
    for (const std::size_t begin : open_) {
        const FlowWord& word = known(begin).word;
        add_problem(begin, 0,
                    fmt::format("o{} has no end; write o{} {} behind its last line", word.label, word.label,
                                end_of(word.kind)));
        give_up(begin, lines_.size() - 1);
    }
    return problems_;
}

} // namespace splinefeed::host
