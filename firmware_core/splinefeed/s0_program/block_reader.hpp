// SPDX-License-Identifier: MIT
// BlockReader: one line of text to the words of a block.
#pragma once

#include "splinefeed/s0_program/block.hpp"
#include "splinefeed/s0_program/program_settings.hpp"
#include "splinefeed/s0_program/word_evaluator.hpp"

namespace splinefeed {

/// What a line is as a whole.
enum class LineKind : std::uint8_t {
    block,
    left_out, ///< by block delete or as ignored
    percent,  ///< the line that begins or ends a program
    homing,   ///< grbl's $H
};

/// Reads words in any case and with spaces anywhere, comments in ( ) and behind ;, and checks each word by itself:
/// number, known code, one word of each letter and group. What words mean together is not checked here.
class BlockReader {
public:
    static constexpr std::size_t longest_line = 256;

    BlockReader(const ProgramSettings& settings, WordEvaluator* evaluator) noexcept
        : settings_(&settings), evaluator_(evaluator) {}

    /// @param text  without the end of the line, or with it
    BlockStatus read(std::string_view text, const BlockInterpreter& control, Block& out, LineKind& kind) noexcept;

private:
    ProgramStatus read_words(TextCursor& text, const BlockInterpreter& control, Block& out) noexcept;
    ProgramStatus read_word(TextCursor& text, const BlockInterpreter& control, Block& out) noexcept;
    ProgramStatus read_value(TextCursor& text, const BlockInterpreter& control, Decimal& out) noexcept;
    static ProgramStatus read_comment(TextCursor& text, Block& out) noexcept;
    static ProgramStatus read_checksum(TextCursor& text) noexcept;
    ProgramStatus add_code(char letter, Decimal value, std::size_t column, Block& out) noexcept;
    [[nodiscard]] bool has_axes(const Block& block) const noexcept;
    [[nodiscard]] bool has_others(const Block& block) const noexcept;
    [[nodiscard]] bool is_ignored(char letter, Decimal value) const noexcept;

    const ProgramSettings* settings_;
    WordEvaluator* evaluator_;
    bool ignored_code_ = false; // the block has a G or M word that is left out
    bool ignored_word_ = false; // the block has another one
};

} // namespace splinefeed
