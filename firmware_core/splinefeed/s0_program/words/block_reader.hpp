// SPDX-License-Identifier: MIT
// BlockReader: one line of text to the words of a block.
#pragma once

#include "splinefeed/s0_program/dialects/dialect_rules.hpp"
#include "splinefeed/s0_program/dialects/program_settings.hpp"
#include "splinefeed/s0_program/text/word_evaluator.hpp"
#include "splinefeed/s0_program/words/block.hpp"

namespace splinefeed {

/// What a line is as a whole.
enum class LineKind : std::uint8_t {
    block,
    left_out, ///< by block delete or as ignored
    percent,  ///< the line that begins or ends a program
    homing,   ///< grbl's $H
};

/// Reads words in any case and with spaces anywhere, comments in ( ) and behind ;, and checks each word by itself:
/// number, known code, one word of each letter and group. What words mean together is not checked here. After an error
/// the block has what else the line says, up to an expression.
class BlockReader {
public:
    static constexpr std::size_t longest_line = 256;

    BlockReader(const ProgramSettings& settings, WordEvaluator* evaluator) noexcept
        : settings_(&settings), rules_(&rules_of(settings.dialect)), evaluator_(evaluator) {}

    /// @param text  without the end of the line, or with it
    BlockStatus read(std::string_view text, const BlockInterpreter& control, Block& out, LineKind& kind) noexcept;

private:
    ProgramStatus read_words(TextCursor& text, const BlockInterpreter& control, Block& out) noexcept;
    ProgramStatus read_part(TextCursor& text, const BlockInterpreter& control, Block& out) noexcept;
    void read_rest(TextCursor text, const BlockInterpreter& control, Block& out) noexcept;
    void read_free_words(TextCursor& text, Block& out) const noexcept;
    [[nodiscard]] bool is_bare(const TextCursor& text) const noexcept;
    void leave_axes_out(Block& out) const noexcept;
    ProgramStatus read_word(TextCursor& text, const BlockInterpreter& control, Block& out) noexcept;
    ProgramStatus read_value(TextCursor& text, const BlockInterpreter& control, char letter, Decimal& out) noexcept;
    ProgramStatus add_code(char letter, Decimal value, std::size_t column, Block& out, bool& left_out) noexcept;
    void note(std::string_view word) const noexcept;
    [[nodiscard]] std::uint32_t axes() const noexcept; // bits of the machine's letters
    [[nodiscard]] bool has_others(const Block& block) const noexcept;
    enum class Ignored : std::uint8_t { no, by_letter, by_name };
    [[nodiscard]] Ignored find_ignored(char letter, Decimal value) const noexcept;
    [[nodiscard]] bool is_taken(char letter, Decimal value, const Block& out) const noexcept;
    [[nodiscard]] bool may_leave_out(char letter) const noexcept;

    // What the block has that is left out.
    struct LeftOut {
        bool code = false;      // a G or M word
        bool axes = false;      // one that takes axis words
        bool axis = false;      // a word of an axis
        bool command = false;   // an M word that the controller does not know: its line
        std::uint32_t bare = 0; // letters without a number
    };

    const ProgramSettings* settings_;
    const DialectRules* rules_;
    WordEvaluator* evaluator_;
    LeftOut left_out_{};
    bool has_command_ = false; // the block has a G or M word
};

} // namespace splinefeed
