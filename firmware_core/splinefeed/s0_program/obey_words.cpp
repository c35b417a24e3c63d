// SPDX-License-Identifier: MIT
// BlockInterpreter: what a refused block does nevertheless, for whoever looks for further errors.
#include "splinefeed/s0_program/block_interpreter.hpp"

namespace splinefeed {

namespace {

constexpr int most_words = 26;                                 // that may be wrong
constexpr Decimal stand_in_feed = Decimal::from_integer(1000); // where F is wrong or missing [mm/min]

// The letter at a column of the block; 0: there is none.
char letter_at(const Block& block, std::uint16_t column) noexcept {
    for (char letter = 'a'; letter <= 'z'; ++letter) {
        if (column > 0 && block.has(letter) && block.at(ProgramError::none, letter).column == column) {
            return letter;
        }
    }
    return 0;
}

} // namespace

// The words are executed without the one that is wrong, until they are right or no word can be left out.
void BlockInterpreter::obey_refused() noexcept {
    const bool executes =
        !modal_.cutter.applies() && !nurbs_.is_open() && block_.code(CodeGroup::motion) != ModalState::lost_motion;
    const bool states_feed = block_.has('f');
    BlockStatus status{ProgramError::word_unused, 0, 0};
    for (int tries = 0; executes && !status.ok() && tries < most_words; ++tries) {
        status = execute();
        const char letter = letter_at(block_, status.column);
        if (status.error == ProgramError::feed_missing) {
            modal_.feed = stand_in_feed;
        } else if (!status.ok() && letter == 0) {
            break;
        } else if (!status.ok()) {
            block_.keep(~Block::letter_bit(letter));
        }
    }
    if (status.ok()) {
        static_cast<void>(finish_assignments());
        emitted_ = place_.machine;
    } else {
        obey_modes();
    }
    if (states_feed && modal_.feed.raw == 0) {
        modal_.feed = stand_in_feed;
    }
    plan_.clear();
    stage_ = all_done;
    curve_ = CurveState::none; // its next point may be lost
    block_.clear();
}

// Modes, and where the block would have led.
void BlockInterpreter::obey_modes() noexcept {
    for (const char letter : {'f', 's', 't', 'p', 'q'}) {
        if (modal_.apply(block_, settings_).ok()) {
            break;
        }
        block_.keep(~Block::letter_bit(letter));
    }
    if (block_.has(CodeGroup::motion)) { // holes without the words of their cycle are not judged
        const std::int16_t motion = block_.code(CodeGroup::motion);
        modal_.set_motion(motion, rules());
        modal_.motion = is_cycle(motion) ? ModalState::lost_motion : modal_.motion;
    }
    const std::int16_t modeless = block_.code(CodeGroup::non_modal);
    const bool moves = (modeless == Block::no_code || modeless == 530) && modal_.motion != ModalState::no_motion &&
                       modal_.motion != ModalState::lost_motion;
    if (!moves || is_cycle(modal_.motion) || nurbs_.is_open()) {
        return;
    }
    if (const Place end = find_end(); check_reach(end.machine).ok()) {
        place_ = end;
        emitted_ = end.machine;
    }
}

} // namespace splinefeed
