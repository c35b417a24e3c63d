// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/flow_block.hpp"

#include "host_sim/program/gcode/macro_word.hpp"

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
    case FlowKind::end_loop: return FlowKind::loop;
    default: return FlowKind::if_;
    }
}

bool ends(FlowKind kind) {
    return kind == FlowKind::endsub || kind == FlowKind::endif || kind == FlowKind::endwhile ||
           kind == FlowKind::endrepeat || kind == FlowKind::while_ || // of do
           kind == FlowKind::end_loop;
}

// Whether it is of no use without its structure.
bool belongs(FlowKind kind) {
    return (kind != FlowKind::call && kind != FlowKind::return_ && kind < FlowKind::program) ||
           kind == FlowKind::loop || kind == FlowKind::end_loop;
}

std::string_view end_of(FlowKind begin) {
    return begin == FlowKind::sub      ? "endsub"
           : begin == FlowKind::if_    ? "endif"
           : begin == FlowKind::repeat ? "endrepeat"
           : begin == FlowKind::do_    ? "while [...]"
                                       : "endwhile";
}

// As it is written.
std::string name_of(const FlowWord& word) {
    return word.kind == FlowKind::loop       ? word.label
           : word.kind == FlowKind::end_loop ? "END" + word.label.substr(2)
                                             : "o" + word.label;
}

// What ends it.
std::string end_text(const FlowWord& begin) {
    return begin.kind == FlowKind::loop ? "END" + begin.label.substr(2)
                                        : fmt::format("o{} {}", begin.label, end_of(begin.kind));
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
                open_.empty() ? fmt::format("{} has no begin", name_of(word))
                              : fmt::format("{} has no begin; what is open here is {} of line {}", name_of(word),
                                            name_of(known(open_.back()).word), lines_[open_.back()].number));
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
            fmt::format("{} of line {} has no end before this one", name_of(known(inner).word), lines_[inner].number));
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
    case FlowKind::loop: enter_loop(line); break;
    case FlowKind::while_:
        open_place(FlowKind::do_, word.label) < open_.size() ? end_or_branch(line) : enter(line);
        break;
    case FlowKind::elseif:
    case FlowKind::else_:
    case FlowKind::endif:
    case FlowKind::endwhile:
    case FlowKind::endrepeat:
    case FlowKind::end_loop:
    case FlowKind::endsub: end_or_branch(line); break;
    case FlowKind::break_:
    case FlowKind::continue_: leave(line); break;
    case FlowKind::call:
    case FlowKind::program:
    case FlowKind::call_program:
    case FlowKind::end_program:
    case FlowKind::save_modes:
    case FlowKind::forget_modes:
    case FlowKind::restore_modes:
    case FlowKind::lend_modes:
    case FlowKind::call_macro:
    case FlowKind::then:
    case FlowKind::alarm:
    case FlowKind::message:
    case FlowKind::return_: break;
    case FlowKind::call_line:
    case FlowKind::jump:
    case FlowKind::jump_if: require_no_o_word(line); break;
    }
}

// A block of O words at the top of a program is all that is in memory.
bool FlowBlock::require_no_o_word(std::size_t line) {
    for (const std::size_t begin : open_) {
        if (known(begin).word.kind != FlowKind::loop) {
            known(line).wrong = true;
            add_problem(line, known(line).word.label_at,
                        fmt::format("GOTO, WHILE and M97 do not stand within O words; {} of line {} is open here",
                                    name_of(known(begin).word), lines_[begin].number));
            return false;
        }
    }
    return true;
}

void FlowBlock::enter_loop(std::size_t line) {
    if (!require_no_o_word(line)) {
        return;
    }
    if (open_place(FlowKind::loop, known(line).word.label) < open_.size()) {
        known(line).wrong = true;
        add_problem(
            line, known(line).word.label_at,
            fmt::format("{0} stands within {0}; loops within one another have other numbers", known(line).word.label));
        return;
    }
    enter(line);
}

void FlowBlock::find_labels() const {
    std::vector<std::size_t> around;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        if (const std::optional<std::uint32_t> number = line_label(lines_[i].text)) {
            const auto place_of = labels_.try_emplace(*number, Label{i, around.empty() ? no_line : around.back(), 0});
            ++place_of.first->second.count;
        }
        const Place* const word = place(i);
        if (word != nullptr && belongs(word->word.kind) && word->begin == i && word->end > i) {
            around.push_back(i);
        }
        if (!around.empty() && place(around.back())->end == i) {
            around.pop_back();
        }
    }
    has_labels_ = true;
}

const FlowBlock::Label* FlowBlock::label(std::uint32_t number) const {
    if (!has_labels_) {
        find_labels();
    }
    const auto found = labels_.find(number);
    return found != labels_.end() ? &found->second : nullptr;
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
                    fmt::format("{} has no end; write {} behind its last line", name_of(word), end_text(word)));
        give_up(begin, lines_.size() - 1);
    }
    return problems_;
}

} // namespace splinefeed::host
