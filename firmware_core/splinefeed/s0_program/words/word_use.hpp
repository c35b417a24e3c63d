// SPDX-License-Identifier: MIT
// word_use: whether the words of a block belong together.
#pragma once

#include "splinefeed/s0_program/words/axis_letters.hpp"
#include "splinefeed/s0_program/words/modal_state.hpp"

namespace splinefeed {

/// What a block does with its axis words.
enum class AxisUse : std::uint8_t {
    none,
    motion,  ///< of the motion word of the block, or the one in effect
    offsets, ///< G10 G28 G30 G52 G92 G43.1
};

struct BlockUse {
    AxisUse axes = AxisUse::none;
    std::int16_t motion = ModalState::no_motion; ///< to be made: ten times the G word
};

/// Finds what a block means, and every word of it that no other word uses. @param modal  before the block
/// Errors: axis_missing, axis_word_unused, axis_words_twice, axis_words_missing, word_unused, integer_needed, ...
BlockStatus find_use(const Block& block, const ModalState& modal, const AxisLetters& letters, const DialectRules& rules,
                     BlockUse& out) noexcept;

} // namespace splinefeed
