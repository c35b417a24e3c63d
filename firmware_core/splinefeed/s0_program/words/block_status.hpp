// SPDX-License-Identifier: MIT
// BlockStatus: what is wrong with a block, and where.
#pragma once

#include "splinefeed/s0_program/text/program_errors.hpp"

namespace splinefeed {

/// Success, or the error with the place in the line. `describe(status.error)` is the sentence; the text at `column` is
/// the word that it is about.
struct [[nodiscard]] BlockStatus {
    ProgramError error = ProgramError::none;
    std::uint8_t length = 0;  ///< characters of the word that is wrong, e.g. 3 for G41; 0: unknown
    std::uint16_t column = 0; ///< of the first character that is wrong, from 1; 0: the block as a whole

    [[nodiscard]] constexpr bool ok() const noexcept { return error == ProgramError::none; }
};

} // namespace splinefeed
