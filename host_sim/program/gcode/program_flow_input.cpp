// SPDX-License-Identifier: MIT
// How ProgramFlow takes the blocks of its input.
#include "host_sim/program/gcode/program_flow.hpp"

namespace splinefeed::host {

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
        block_depth_ = 1;
        break;
    case FlowKind::call: execute_call(word, line); break;
    case FlowKind::call_program: execute_program_call(word, line); break;
    case FlowKind::end_program: leave_program(word, line); break;
    case FlowKind::program: begin_program(); break; // its name
    case FlowKind::call_line: execute_line_call(word, line); break;
    case FlowKind::call_macro: execute_macro_call(word, line); break;
    case FlowKind::jump: jump(word, line, word.rest); break;
    case FlowKind::jump_if: execute_jump_if(word, line); break;
    case FlowKind::then: execute_then(word, line); break;
    case FlowKind::alarm:
    case FlowKind::message: execute_stop(word, line); break;
    case FlowKind::loop: // it runs from memory
    case FlowKind::end_loop:
        if (keeps_program(word, line)) {
            --frames_.back().at;
        }
        break;
    case FlowKind::save_modes:
    case FlowKind::forget_modes:
    case FlowKind::restore_modes:
    case FlowKind::lend_modes: execute_modes(word, line); break;
    default: begin_stray(word, line);
    }
}

void ProgramFlow::begin_stray(const FlowWord& word, const SourceLine& line) {
    if (lost_.contains(word.label)) {
        return;
    }
    if (word.kind == FlowKind::break_ || word.kind == FlowKind::continue_) {
        fail(line, word.label_at, "there is no loop o{} around this line", word.label);
    }
    if (word.kind == FlowKind::return_) {
        fail(line, word.label_at, "return stands in a subprogram");
    }
    fail(line, word.label_at, "o{} has no begin", word.label);
}

ProgramFlow::Step ProgramFlow::collect(const SourceLine& line, const std::optional<FlowWord>& known) {
    if (block_->size() + kept_ >= most_lines) {
        throw InputError(file_, line.number, "subprograms and loops have more than {} lines", most_lines);
    }
    if (!known && !has_word(line.text)) {
        block_->add(line);
        return Step::nothing;
    }
    const FlowWord word = known ? *known : word_of(line);
    block_->add(line, word);
    const FlowKind end = block_kind_ == FlowKind::sub      ? FlowKind::endsub
                         : block_kind_ == FlowKind::if_    ? FlowKind::endif
                         : block_kind_ == FlowKind::repeat ? FlowKind::endrepeat
                         : block_kind_ == FlowKind::do_    ? FlowKind::while_
                                                           : FlowKind::endwhile;
    if (word.label != block_label_) {
        return Step::nothing;
    }
    block_depth_ += word.kind == block_kind_ ? 1U : 0U;
    block_depth_ -= word.kind == end ? 1U : 0U;
    if (block_depth_ == 0) {
        end_block();
    }
    return Step::nothing;
}

// What else names the structures of words that are wrong is not told.
std::deque<ProgramFlow::Again> ProgramFlow::without_wrong(const FlowBlock& block) {
    std::deque<Again> rest;
    for (std::size_t i = 0; i < block.size(); ++i) {
        const FlowBlock::Place* const place = block.place(i);
        if (place == nullptr) {
            rest.push_back({block.line(i), std::nullopt});
        } else if (place->wrong) {
            lost_.insert(place->word.label);
        } else {
            rest.push_back({block.line(i), place->word});
        }
    }
    return rest;
}

// A block that is wrong is read again without the words that are.
void ProgramFlow::end_block() {
    collects_ = false;
    const std::shared_ptr<FlowBlock> block = std::move(block_);
    if (!report_problems(*block, block->link())) {
        const std::deque<Again> rest = without_wrong(*block);
        again_.insert(again_.begin(), rest.begin(), rest.end());
    } else if (block_kind_ == FlowKind::sub) {
        keep(block_label_, {block, block->number(), 0});
    } else {
        frames_.push_back({.code = block});
    }
}

// False: there are some.
bool ProgramFlow::report_problems(const FlowBlock& block, const std::vector<FlowBlock::Problem>& problems) {
    for (const FlowBlock::Problem& problem : problems) {
        const SourceLine& line = block.line(problem.line);
        report({file_of(line), line.number, std::uint64_t{problem.at} + 1U, problem.text}, line);
    }
    return problems.empty();
}

// From the input, or from a block that was wrong.
bool ProgramFlow::next_line(SourceLine& out, std::optional<FlowWord>& word) {
    word.reset();
    if (again_.empty() && ended_) {
        const bool is_there = ahead_at_ < ahead_.size();
        out = is_there ? ahead_[ahead_at_++] : SourceLine{};
        return is_there;
    }
    if (again_.empty()) {
        out.file = nullptr;
        const bool is_there = lines_->next(out);
        if (is_there && (rules_.macros || rules_.runs > 1)) {
            note_passed(out);
        }
        return is_there;
    }
    out = std::move(again_.front().line);
    word = std::move(again_.front().word);
    again_.pop_front();
    return true;
}

ProgramFlow::Step ProgramFlow::take_word(SourceLine& line, const std::optional<FlowWord>& known) {
    try {
        if (collects_) {
            return collect(line, known);
        }
        if (!begun_ && !known && is_program_number(line.text)) {
            return Step::nothing;
        }
        begun_ = true;
        if (!line.whole) {
            return Step::line;
        }
        count_word(line);
        const FlowWord word = known ? *known : word_of(line);
        begin(word, line);
        return give_others(word, line);
    } catch (const WordError& error) {
        report(error, line);
    }
    return Step::nothing;
}

} // namespace splinefeed::host
