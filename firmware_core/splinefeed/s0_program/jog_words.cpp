// SPDX-License-Identifier: MIT
// BlockInterpreter: jogs, moves that leave no modes behind.
#include "splinefeed/s0_program/block_interpreter.hpp"

namespace splinefeed {

// The first word that a jog does not have.
BlockStatus BlockInterpreter::check_jog() const noexcept {
    for (unsigned group = 0; group < code_groups; ++group) {
        const auto code = static_cast<CodeGroup>(group);
        const bool machine = code == CodeGroup::non_modal && block_.code(code) == 530; // G53
        const bool belongs = machine || code == CodeGroup::units || code == CodeGroup::distance;
        if (block_.has(code) && !belongs) {
            return block_.at(ProgramError::jog_word_unsuited, code);
        }
    }
    const std::uint32_t others = block_.letters() & ~(letters_.bits() | Block::bits("fn"));
    for (char letter = 'a'; letter <= 'z'; ++letter) {
        if ((others & Block::letter_bit(letter)) != 0) {
            return block_.at(ProgramError::jog_word_unsuited, letter);
        }
    }
    if ((block_.letters() & letters_.bits()) == 0) {
        return {ProgramError::axis_words_missing, 0, 0};
    }
    return {};
}

BlockStatus BlockInterpreter::push_jog(std::string_view text, std::uint32_t line_number) noexcept {
    if (has_steps() || in_pieces_) {
        return {ProgramError::block_pending, 0, 0};
    }
    const ModalState modal = modal_;
    const bool ended = has_ended();
    modal_.motion = 10;
    modal_.feed = {};
    modal_.inverse_time = modal_.per_turn = false;
    modal_.path_mode = PathMode::exact_path;
    LineKind kind = LineKind::block;
    BlockStatus status = read_block(text, line_number, kind);
    if (status.ok()) {
        status = kind == LineKind::block ? check_jog() : BlockStatus{ProgramError::jog_word_unsuited, 0, 1};
    }
    if (status.ok()) {
        status = execute();
    }
    modal_ = modal;
    progress_ = ended ? Progress::ended : progress_;
    if (!status.ok()) {
        plan_.clear();
        stage_ = all_done;
    }
    return status;
}

} // namespace splinefeed
