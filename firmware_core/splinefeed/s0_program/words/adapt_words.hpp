// SPDX-License-Identifier: MIT
// adapt_words: what a dialect writes otherwise than LinuxCNC, in LinuxCNC's words.
#pragma once

#include "splinefeed/s0_program/words/axis_letters.hpp"
#include "splinefeed/s0_program/words/modal_state.hpp"

namespace splinefeed {

/// Before a block is understood: dwells become seconds by P, Fanuc's U V W steps of X Y Z, its K the L of a cycle.
/// Where the settings say so, numbers without a decimal point become increments.
/// @param modal  before the block
/// Errors: word_repeated, where a block has a letter and the one that stands for it.
BlockStatus adapt_words(Block& block, const ModalState& modal, const AxisLetters& letters,
                        const ProgramSettings& settings) noexcept;

} // namespace splinefeed
