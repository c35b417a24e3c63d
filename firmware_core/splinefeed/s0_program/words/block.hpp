// SPDX-License-Identifier: MIT
// Block: the words of one line.
#pragma once

#include "splinefeed/s0_program/dialects/code_table.hpp"
#include "splinefeed/s0_program/words/block_status.hpp"
#include "splinefeed/s0_program/words/program_comment.hpp"

#include <array>
#include <string_view>

namespace splinefeed {

/// Words by letter, G and M words by group. Letters are 'a' to 'z', and '@' and '^'.
class Block {
public:
    static constexpr std::int16_t no_code = -1;

    void clear() noexcept {
        present_ = steps_ = whole_ = 0;
        has_left_out_ = has_padded_tool_ = has_dwell_point_ = false;
        codes_.fill(no_code);
        comment_ = CommentKind::none;
        text_ = {};
    }

    void set(char letter, Decimal value, std::size_t column) noexcept {
        present_ |= letter_bit(letter);
        values_[index(letter)] = value;
        columns_[index(letter)] = static_cast<std::uint8_t>(column - 1);
    }
    /// As if the letter of a word were another one. @pre has(from), not has(to)
    void rename(char from, char to, Decimal value) noexcept {
        set(to, value, columns_[index(from)] + std::size_t{1});
        keep(present_ & ~letter_bit(from));
    }
    /// @pre has(letter)
    void change(char letter, Decimal value) noexcept { values_[index(letter)] = value; }
    /// Only these letters stay.
    void keep(std::uint32_t letters) noexcept { present_ &= letters; }
    /// The value of the axis is a step, in G90, too.
    void set_step(char axis) noexcept { steps_ |= letter_bit(axis); }
    [[nodiscard]] bool is_step(char axis) const noexcept { return (steps_ & letter_bit(axis)) != 0; }
    /// Whether the number was written with a decimal point; of an expression neither.
    void set_point(char letter, bool has_point) noexcept {
        whole_ |= has_point ? 0U : letter_bit(letter);
        has_dwell_point_ = has_dwell_point_ || (has_point && letter == 'p');
    }
    [[nodiscard]] bool is_whole(char letter) const noexcept { return (whole_ & letter_bit(letter)) != 0; }
    /// P has one.
    [[nodiscard]] bool has_dwell_point() const noexcept { return has_dwell_point_ && has('p'); }
    /// T begins with a 0.
    void set_padded_tool() noexcept { has_padded_tool_ = true; }
    [[nodiscard]] bool has_padded_tool() const noexcept { return has_padded_tool_; }
    /// A G or M word of the block was left out: letters that no other word uses were its own.
    void set_left_out() noexcept { has_left_out_ = true; }
    [[nodiscard]] bool has_left_out() const noexcept { return has_left_out_; }
    [[nodiscard]] bool has(char letter) const noexcept { return (present_ & letter_bit(letter)) != 0; }
    /// Whether it has one of the letters.
    [[nodiscard]] bool has_any(std::uint32_t letters) const noexcept { return (present_ & letters) != 0; }
    [[nodiscard]] std::uint32_t letters() const noexcept { return present_; }
    /// The value of a word; 0 if the block does not have it.
    [[nodiscard]] Decimal value(char letter) const noexcept { return has(letter) ? values_[index(letter)] : Decimal{}; }

    void set_code(CodeGroup group, std::int32_t code, std::size_t column) noexcept {
        codes_[static_cast<unsigned>(group)] = static_cast<std::int16_t>(code);
        code_columns_[static_cast<unsigned>(group)] = static_cast<std::uint8_t>(column - 1);
    }
    /// Ten times the number of a G word, the number of an M word; no_code.
    [[nodiscard]] std::int16_t code(CodeGroup group) const noexcept { return codes_[static_cast<unsigned>(group)]; }
    [[nodiscard]] bool has(CodeGroup group) const noexcept { return code(group) != no_code; }
    /// Whether it has a G or M word.
    [[nodiscard]] bool has_codes() const noexcept {
        for (const std::int16_t code : codes_) {
            if (code != no_code) {
                return true;
            }
        }
        return false;
    }

    void set_comment(CommentKind kind, TextPart text) noexcept {
        comment_ = kind;
        text_ = text;
    }
    [[nodiscard]] CommentKind comment() const noexcept { return comment_; }
    /// Of the comment, or of M117.
    [[nodiscard]] TextPart text() const noexcept { return text_; }

    /// An error at a word of the block.
    [[nodiscard]] BlockStatus at(ProgramError error, char letter) const noexcept {
        return {error, 0, static_cast<std::uint16_t>(has(letter) ? columns_[index(letter)] + 1 : 0)};
    }
    [[nodiscard]] BlockStatus at(ProgramError error, CodeGroup group) const noexcept {
        return {error, 0, static_cast<std::uint16_t>(has(group) ? code_columns_[static_cast<unsigned>(group)] + 1 : 0)};
    }

    [[nodiscard]] static constexpr std::uint32_t letter_bit(char letter) noexcept { return 1U << index(letter); }
    /// Of several letters.
    [[nodiscard]] static consteval std::uint32_t bits(std::string_view letters) noexcept {
        std::uint32_t all = 0;
        for (const char letter : letters) {
            all |= letter_bit(letter);
        }
        return all;
    }

private:
    [[nodiscard]] static constexpr unsigned index(char letter) noexcept {
        return letter == '@' ? 26U : letter == '^' ? 27U : static_cast<unsigned>(letter - 'a') % 26U;
    }

    std::uint32_t present_ = 0;
    std::uint32_t steps_ = 0;
    std::uint32_t whole_ = 0;
    bool has_left_out_ = false;
    bool has_padded_tool_ = false;
    bool has_dwell_point_ = false;
    CommentKind comment_ = CommentKind::none;
    std::array<Decimal, 28> values_{};
    std::array<std::uint8_t, 28> columns_{}; // from 0
    std::array<std::int16_t, code_groups> codes_{};
    std::array<std::uint8_t, code_groups> code_columns_{};
    TextPart text_{};
};

} // namespace splinefeed
