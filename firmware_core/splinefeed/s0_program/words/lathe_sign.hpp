// SPDX-License-Identifier: MIT
// lathe_sign: words that only a lathe's program has, so that it is not read as a mill's.
#pragma once

#include "splinefeed/s0_program/words/modal_state.hpp"

namespace splinefeed {

/// Fanuc's lathes have other words: X is a diameter, F often the way of a turn, and G90 and G92 are cycles. G50 limits
/// the spindle, and T0101 has the number of an offset. Where `mills_only`, one of them is enough. Elsewhere such a
/// cycle is one that stands behind such a T.
/// @param modal  before the block
/// Error: lathe_word, at the word.
BlockStatus check_lathe(const Block& block, const ModalState& modal, const DialectRules& rules) noexcept;

/// Whether T names a tool and its offset: T0101, T0200, T1212.
[[nodiscard]] bool has_tool_and_offset(const Block& block) noexcept;

} // namespace splinefeed
