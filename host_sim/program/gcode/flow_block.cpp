// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/flow_block.hpp"

#include <fmt/format.h>
#include <utility>

namespace splinefeed::host {

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

bool FlowBlock::enter(std::size_t line) {
    known(line).begin = line;
    open_.push_back(line);
    return open_.size() <= deepest;
}

bool FlowBlock::close(std::size_t line, FlowKind begin) {
    if (open_.empty()) {
        return false;
    }
    Place& first = known(open_.back());
    Place& last = known(line);
    if (first.word.kind != begin || first.word.label != last.word.label) {
        return false;
    }
    last.begin = open_.back();
    first.end = last.end = line;
    open_.pop_back();
    return true;
}

// elseif, else and endif: `end` of the first word is the last branch so far, until endif is there.
bool FlowBlock::branch(std::size_t line) {
    const std::size_t first = open_.empty() ? line : open_.back();
    const std::size_t last_branch = known(first).end > 0 ? known(first).end : first;
    if (known(line).word.kind != FlowKind::endif) {
        if (open_.empty() || known(first).word.kind != FlowKind::if_ ||
            known(first).word.label != known(line).word.label) {
            return false;
        }
        known(line).begin = first;
        known(first).end = known(last_branch).next = line;
        return true;
    }
    if (!close(line, FlowKind::if_)) {
        return false;
    }
    known(last_branch).next = line;
    for (std::size_t i = first; i != line; i = known(i).next) {
        known(i).end = line;
    }
    return true;
}

// break and continue: the loop that they name is around them, in the same subprogram.
bool FlowBlock::leave(std::size_t line) {
    for (std::size_t i = open_.size(); i-- > 0;) {
        const FlowWord& word = known(open_[i]).word;
        if (word.kind == FlowKind::sub) {
            return false;
        }
        if (word.kind != FlowKind::if_ && word.label == known(line).word.label) {
            known(line).begin = open_[i];
            return true;
        }
    }
    return false;
}

FlowBlock::Problem FlowBlock::link() {
    open_.clear();
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        if (place_of_[i] == 0) {
            continue;
        }
        const FlowWord& word = known(i).word;
        if (word.label.empty() && word.kind != FlowKind::call) {
            return {i, word.label_at, "only call takes an expression as its number"};
        }
        bool fits = true;
        switch (word.kind) {
        case FlowKind::sub:
        case FlowKind::if_:
        case FlowKind::do_:
        case FlowKind::repeat: fits = enter(i); break;
        case FlowKind::while_: fits = close(i, FlowKind::do_) || enter(i); break;
        case FlowKind::elseif:
        case FlowKind::else_:
        case FlowKind::endif: fits = branch(i); break;
        case FlowKind::endwhile: fits = close(i, FlowKind::while_); break;
        case FlowKind::endrepeat: fits = close(i, FlowKind::repeat); break;
        case FlowKind::endsub: fits = close(i, FlowKind::sub); break;
        case FlowKind::break_:
        case FlowKind::continue_:
            if (!leave(i)) {
                return {i, word.label_at, fmt::format("there is no loop o{} around this line", word.label)};
            }
            break;
        case FlowKind::call:
        case FlowKind::return_: break;
        }
        if (!fits && open_.size() > deepest) {
            return {i, word.label_at, fmt::format("O words are nested more than {} deep", deepest)};
        }
        if (!fits) {
            return {i, word.label_at,
                    open_.empty() ? fmt::format("o{} has no begin", word.label)
                                  : fmt::format("o{} has no begin, or o{} of line {} has no end before it", word.label,
                                                known(open_.back()).word.label, lines_[open_.back()].number)};
        }
    }
    if (!open_.empty()) {
        return {open_.back(), 0, fmt::format("o{} has no end", known(open_.back()).word.label)};
    }
    return {};
}

} // namespace splinefeed::host
