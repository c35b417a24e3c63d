// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/block_reader.hpp"

#include "splinefeed/s0_program/decimal_text.hpp"

namespace splinefeed {

using namespace std::string_view_literals; // without strlen

namespace {

constexpr bool is_letter(char c) noexcept {
    return c >= 'a' && c <= 'z';
}

} // namespace

bool BlockReader::has_axes(const Block& block) const noexcept {
    for (int k = 0; k < settings_->axes; ++k) {
        if (block.has(lower_case(settings_->letters[static_cast<unsigned>(k)]))) {
            return true;
        }
    }
    return false;
}

// Whether the block does something besides the word that is ignored.
bool BlockReader::has_others(const Block& block) const noexcept {
    if (has_axes(block)) {
        return true;
    }
    for (unsigned group = 0; group < code_groups; ++group) {
        if (block.has(static_cast<CodeGroup>(group))) {
            return true;
        }
    }
    return false;
}

BlockStatus BlockReader::read(std::string_view text, const BlockInterpreter& control, Block& out,
                              LineKind& kind) noexcept {
    out.clear();
    kind = LineKind::block;
    ignored_code_ = ignored_word_ = false;
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) {
        text.remove_suffix(1);
    }
    if (text.size() > longest_line) {
        return {ProgramError::line_too_long, 0, longest_line + 1};
    }
    TextCursor cursor(text);
    if (cursor.take('%')) {
        kind = LineKind::percent;
        return cursor.at_end() ? BlockStatus{} : BlockStatus{ProgramError::character_invalid, 1, cursor.column()};
    }
    if (settings_->dialect == Dialect::grbl && cursor.peek() == '$') {
        const std::uint16_t column = cursor.column();
        kind = LineKind::homing;
        const bool homing = cursor.take("$h"sv) && cursor.at_end();
        return homing ? BlockStatus{} : BlockStatus{ProgramError::grbl_command_unsupported, 0, column};
    }
    if (cursor.take('/') && settings_->block_delete) {
        kind = LineKind::left_out;
        return {};
    }
    const ProgramStatus status = read_words(cursor, control, out);
    if (ignored_word_ && !has_axes(out) && out.code(CodeGroup::non_modal) == 920) { // a printer's G92 E0 without E
        kind = LineKind::left_out;
        return {};
    }
    if (ignored_code_ && !has_others(out)) { // its words are not another code's, whatever they are
        kind = LineKind::left_out;
        return {};
    }
    return status.ok() ? BlockStatus{} : BlockStatus{status.error(), 0, cursor.column()};
}

ProgramStatus BlockReader::read_words(TextCursor& text, const BlockInterpreter& control, Block& out) noexcept {
    while (!text.at_end()) {
        const char c = text.peek();
        if (c == ';') {
            return {};
        }
        if (c == '*' && settings_->dialect == Dialect::marlin) {
            return read_checksum(text);
        }
        ProgramStatus status;
        if (c == '(') {
            status = read_comment(text, out);
        } else if (c == '#') {
            status = evaluator_ != nullptr ? evaluator_->assignment(text, control)
                                           : ProgramStatus(ProgramError::expression_unsupported);
        } else if (is_letter(c)) {
            status = read_word(text, control, out);
        } else {
            status = c == '@' || c == '^' ? ProgramError::polar_unsupported : ProgramError::character_invalid;
        }
        if (!status.ok()) {
            return status;
        }
        if (out.code(CodeGroup::printer) == 117) {
            out.set_comment(CommentKind::none, TextCursor::place(text.at(), text.find(';', text.at())));
            return {};
        }
    }
    return {};
}

ProgramStatus BlockReader::read_word(TextCursor& text, const BlockInterpreter& control, Block& out) noexcept {
    const std::size_t column = text.column();
    const char letter = text.peek();
    if (letter == 'o') {
        return ProgramError::o_word;
    }
    const TextCursor word = text;
    text.step();
    Decimal value;
    const char first = text.peek();
    if (const ProgramStatus status = read_value(text, control, value); !status.ok()) {
        if (first != '#' && first != '[' && !is_letter(first)) {
            text = word; // a plain number: the word is wrong; else the place within the expression is
        }
        return status;
    }
    if (letter == 'n') {
        return {};
    }
    if (letter == 'g' || letter == 'm') {
        const ProgramStatus status = add_code(letter, value, column, out);
        if (!status.ok()) {
            text = word; // the word is wrong, not what follows it
        }
        return status;
    }
    if (is_ignored(upper_case(letter), value)) {
        ignored_word_ = true;
        return {};
    }
    if (out.has(letter)) {
        text = word;
        return ProgramError::word_repeated;
    }
    out.set(letter, value, column);
    return {};
}

ProgramStatus BlockReader::read_value(TextCursor& text, const BlockInterpreter& control, Decimal& out) noexcept {
    const char c = text.peek();
    const bool sign = c == '-' || c == '+';
    const char first = sign ? text.peek_second() : c;
    if (first != '#' && first != '[' && !is_letter(first)) {
        return read_decimal(text, out);
    }
    if (evaluator_ == nullptr) {
        return is_letter(first) ? ProgramError::number_invalid : ProgramError::expression_unsupported;
    }
    if (sign) {
        text.step();
    }
    const TextCursor start = text;
    ProgramStatus status = evaluator_->value(text, control, out);
    if (status.ok() && (out.raw > largest_number * Decimal::one || out.raw < -largest_number * Decimal::one)) {
        text = start;
        status = ProgramError::number_out_of_range;
    }
    out = c == '-' ? -out : out;
    return status;
}

ProgramStatus BlockReader::add_code(char letter, Decimal value, std::size_t column, Block& out) noexcept {
    if (is_ignored(upper_case(letter), value)) {
        ignored_code_ = true;
        return {};
    }
    std::int32_t code = 0;
    const bool is_g = letter == 'g';
    const ProgramError unknown = is_g ? ProgramError::g_code_unknown : ProgramError::m_code_unknown;
    if (value.raw < 0 || value > Decimal::from_integer(1000) ||
        !to_integer(is_g ? Decimal{value.raw * 10} : value, code)) {
        return unknown;
    }
    const CodeInfo info = is_g ? find_g_code(code, settings_->dialect) : find_m_code(code, settings_->dialect);
    if (info.refusal != ProgramError::none) {
        return info.refusal;
    }
    if (info.group == CodeGroup::none) {
        return unknown;
    }
    if (out.has(info.group)) {
        return ProgramError::modal_group_conflict;
    }
    out.set_code(info.group, code, column);
    return {};
}

ProgramStatus BlockReader::read_comment(TextCursor& text, Block& out) noexcept {
    const std::string_view line = text.text();
    const std::size_t begin = text.at() + 1;
    std::size_t end = begin;
    while (end < line.size() && line[end] != ')') {
        if (line[end] == '(') {
            text.go_to(end);
            return ProgramError::comment_nested;
        }
        ++end;
    }
    if (end == line.size()) {
        return ProgramError::comment_not_closed;
    }
    TextCursor inside(text.part(begin, end));
    CommentKind kind = CommentKind::none;
    if (inside.take("msg,"sv)) {
        kind = CommentKind::message;
    } else if (inside.take("print,"sv)) {
        kind = CommentKind::print;
    } else if (inside.take("debug,"sv)) {
        kind = CommentKind::debug;
    }
    if (kind != CommentKind::none) { // as in LinuxCNC, the last one of a line counts
        out.set_comment(kind, TextCursor::place(begin + inside.at(), end));
    }
    text.go_to(end + 1);
    return {};
}

// "*71": the exclusive or of all characters before it.
ProgramStatus BlockReader::read_checksum(TextCursor& text) noexcept {
    unsigned sum = 0;
    for (const char c : text.part(0, text.at())) {
        sum ^= static_cast<unsigned char>(c);
    }
    const TextCursor start = text;
    text.step();
    Decimal stated;
    std::int32_t number = 0;
    const ProgramStatus status = read_decimal(text, stated);
    if (!status.ok() || !to_integer(stated, number) || number != static_cast<std::int32_t>(sum)) {
        text = start;
        return ProgramError::checksum_wrong;
    }
    return text.at_end() || text.peek() == ';' ? ProgramStatus{} : ProgramStatus(ProgramError::character_invalid);
}

bool BlockReader::is_ignored(char letter, Decimal value) const noexcept {
    for (std::size_t i = 0; i < settings_->ignored_count; ++i) {
        const IgnoredWord& word = settings_->ignored[i];
        if (word.letter == letter &&
            (word.tenths == IgnoredWord::any || value.raw == word.tenths * (Decimal::one / 10))) {
            return true;
        }
    }
    return false;
}

} // namespace splinefeed
