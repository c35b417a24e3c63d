// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/words/block_reader.hpp"
#include "splinefeed/s0_program/text/decimal_text.hpp"
#include "splinefeed/s0_program/words/line_checksum.hpp"
#include "splinefeed/s0_program/words/modal_state.hpp"
#include "splinefeed/s0_program/words/program_comment.hpp"
#include "splinefeed/s0_program/words/word_extension.hpp"

#include <algorithm>

namespace splinefeed {

using namespace std::string_view_literals; // without strlen

namespace {

constexpr std::uint32_t coordinate_bits = Block::bits("xyzabcuvwijkrf");
constexpr std::uint32_t axis_letters = Block::bits("xyzabcuvwe");

constexpr bool is_letter(char c) noexcept {
    return c >= 'a' && c <= 'z';
}

constexpr bool is_part_of_number(char c) noexcept {
    return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+';
}

// "2.4e-16", with the cursor at the e: no control reads the two as one number, and nobody means two words.
constexpr bool is_exponent(const TextCursor& text) noexcept {
    TextCursor next = text;
    next.step();
    const std::size_t at = text.at();
    return text.peek() == 'e' && at > 0 && is_part_of_number(text.text()[at - 1]) && next.at() == at + 1 &&
           is_part_of_number(next.peek()) && next.peek() != '.';
}

} // namespace

std::uint32_t BlockReader::axes() const noexcept {
    std::uint32_t all = 0;
    for (int k = 0; k < settings_->axes; ++k) {
        all |= Block::letter_bit(lower_case(settings_->letters[static_cast<unsigned>(k)]));
    }
    return all;
}

// Whether the block does something besides the word that is ignored.
bool BlockReader::has_others(const Block& block) const noexcept {
    return block.has_any(axes()) || block.has_codes();
}

// The words of codes that are left out go with them, if no other word takes them.
void BlockReader::leave_axes_out(Block& out) const noexcept {
    const std::int16_t modeless = out.code(CodeGroup::non_modal);
    const bool taken = modeless != Block::no_code && modeless != 40 && modeless != 530;
    if (left_out_.axes && !taken && !out.has(CodeGroup::motion)) {
        out.keep(Block::bits("fst"));
    }
    if (left_out_.code) {
        out.set_left_out();
    }
}

BlockStatus BlockReader::read(std::string_view text, const BlockInterpreter& control, Block& out,
                              LineKind& kind) noexcept {
    out.clear();
    kind = LineKind::block;
    left_out_ = {};
    has_command_ = false;
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
    if (rules_->dollar_lines && cursor.peek() == '$') {
        const std::uint16_t column = cursor.column();
        kind = LineKind::homing;
        const bool homing = cursor.take("$h"sv) && cursor.at_end();
        return homing ? BlockStatus{} : BlockStatus{ProgramError::grbl_command_unsupported, 0, column};
    }
    if (cursor.take('/') && settings_->block_delete) {
        kind = LineKind::left_out;
        return {};
    }
    if (rules_->skips_unknown && cursor.peek() == 'p') { // P0 of a changer: to the others it is unknown
        note(cursor.part(cursor.at(), std::min(cursor.at() + 2, text.size())));
        kind = LineKind::left_out;
        return {};
    }
    const ProgramStatus status = read_words(cursor, control, out);
    if (!status.ok()) {
        read_rest(cursor, control, out);
    }
    const std::int16_t modeless = out.code(CodeGroup::non_modal);
    out.keep(~left_out_.bare | (modeless == 280 ? left_out_.bare & axes() : 0U)); // G28 X W
    if (modeless == 280 && rules_->g28_homes) {                                   // how it homes is the printer's
        out.keep(axes() | Block::letter_bit('n'));
    }
    leave_axes_out(out);
    // A printer's G92 E0 without E, and G28 A0 without A: no other axis is meant.
    const bool is_of_axes = modeless == 300 || modeless == 920 || (modeless == 280 && !rules_->g28_homes);
    const bool no_shift = left_out_.axis && !out.has_any(axes()) && is_of_axes;
    // The words of a code that is left out are not another code's, whatever they are.
    if (left_out_.command || no_shift || (left_out_.code && !has_others(out))) {
        kind = LineKind::left_out;
        return {};
    }
    return status.ok() ? BlockStatus{} : BlockStatus{status.error(), 0, cursor.column()};
}

ProgramStatus BlockReader::read_words(TextCursor& text, const BlockInterpreter& control, Block& out) noexcept {
    while (!text.at_end() && text.peek() != ';') {
        if (text.peek() == '*' && rules_->checksums) {
            return read_checksum(text);
        }
        if (const ProgramStatus status = read_part(text, control, out); !status.ok()) {
            return status;
        }
        const std::int16_t printer = out.code(CodeGroup::printer);
        const bool pauses = rules_->one_command && out.has(CodeGroup::stop);          // M0 S5 Click to go on
        const bool selects = rules_->one_command && out.has('t') && !out.has_codes(); // T0 S1 L0 D0 M1
        if (printer == 117) {
            out.set_comment(CommentKind::none, TextCursor::place(text.at(), text.find(';', text.at())));
            return {};
        }
        if (printer != Block::no_code || left_out_.command || pauses || selects) {
            read_free_words(text, out);
            out.keep(pauses ? Block::bits("s") : selects ? ~Block::bits("dlms") : ~0U);
        }
    }
    return {};
}

// A word, a comment or an assignment.
ProgramStatus BlockReader::read_part(TextCursor& text, const BlockInterpreter& control, Block& out) noexcept {
    const char c = text.peek();
    if (c == '(') {
        ProgramComment comment;
        const ProgramStatus status = read_comment(text, rules_->open_comments, comment);
        if (comment.kind != CommentKind::none) { // as in LinuxCNC, the last one of a line counts
            out.set_comment(comment.kind, comment.text);
        }
        return status;
    }
    if (c == '#') {
        return evaluator_ != nullptr ? evaluator_->assignment(text, control)
                                     : ProgramStatus(ProgramError::expression_unsupported);
    }
    const bool is_polar = c == '@' || c == '^';
    if (is_letter(c) || (is_polar && rules_->polar_words)) {
        return read_word(text, control, out);
    }
    return is_polar ? ProgramError::polar_unsupported : ProgramError::character_invalid;
}

// Behind a word that is wrong: whoever looks for all errors wants to know what the others do.
void BlockReader::read_rest(TextCursor text, const BlockInterpreter& control, Block& out) noexcept {
    while (!text.at_end() && text.peek() != ';') {
        text.step();
        while (is_part_of_number(text.peek())) {
            text.step();
        }
        while (is_letter(text.peek())) {
            TextCursor word = text;
            if (!read_word(word, control, out).ok()) {
                break;
            }
            text = word;
        }
        if (text.peek() == '#' || text.peek() == '[') {
            return;
        }
    }
}

// The words of a printer's M word are its own. What is no number is passed over, as in M115 U3.8.1 and P "MK3".
void BlockReader::read_free_words(TextCursor& text, Block& out) const noexcept {
    while (!text.at_end() && text.peek() != ';' && !(text.peek() == '*' && rules_->checksums)) {
        const char letter = text.peek();
        if (letter == '"') {
            text.go_to(text.find('"', text.at() + 1));
        }
        const std::size_t column = text.column();
        text.step();
        Decimal value;
        TextCursor number = text;
        if (is_letter(letter) && read_decimal(number, value).ok()) {
            text = number;
            if (!out.has(letter)) {
                out.set(letter, value, column);
            }
        }
    }
}

// Whether a letter has no number, where that is a word. SIN[ is none.
bool BlockReader::is_bare(const TextCursor& text) const noexcept {
    TextCursor cursor = text;
    if (!rules_->bare_letters || (!cursor.at_end() && !is_letter(cursor.peek()) && cursor.peek() != ';' &&
                                  cursor.peek() != '*' && cursor.peek() != '(')) {
        return false;
    }
    while (is_letter(cursor.peek())) {
        cursor.step();
    }
    return cursor.peek() != '[';
}

ProgramStatus BlockReader::read_word(TextCursor& text, const BlockInterpreter& control, Block& out) noexcept {
    const std::size_t column = text.column();
    const char letter = text.peek();
    if (letter == 'o' && !rules_->bare_letters) {
        return ProgramError::o_word;
    }
    const TextCursor word = text;
    text.step();
    Decimal value;
    const char first = text.peek();
    if (letter != 'g' && letter != 'm' && is_bare(text)) {
        left_out_.bare |= Block::letter_bit(letter);
        if (!out.has(letter)) {
            out.set(letter, {}, column);
        }
        return {};
    }
    if (const ProgramStatus status = read_value(text, control, letter, value); !status.ok()) {
        if (first != '#' && first != '[' && !is_letter(first)) {
            text = word; // a plain number: the word is wrong; else the place within the expression is
        }
        if (letter == 'f' && !out.has(letter)) {
            out.set(letter, {}, column); // it was stated
        }
        return status;
    }
    if (value == vacant || (letter == 'n' && out.has(letter))) {
        return {}; // it is left out; the first N counts
    }
    const std::string_view as_it_stands = text.part(word.at(), text.at());
    if (!rules_->extruder && (Block::letter_bit(letter) & coordinate_bits) != 0 && is_exponent(text)) {
        text = word;
        return ProgramError::number_has_exponent;
    }
    if (letter == 'g' || letter == 'm') {
        bool left_out = false;
        const ProgramStatus status = add_code(letter, value, column, out, left_out);
        if (!status.ok()) {
            text = word; // the word is wrong, not what follows it
        }
        if (left_out) {
            note(as_it_stands);
        }
        return status;
    }
    if (find_ignored(upper_case(letter), value) != Ignored::no && !is_taken(letter, value, out)) {
        if (!may_leave_out(letter)) {
            text = word;
            return ProgramError::ignored_word_counts;
        }
        left_out_.axis = left_out_.axis || (Block::letter_bit(letter) & axis_letters) != 0;
        note(as_it_stands);
        return {};
    }
    if (out.has(letter)) {
        text = word;
        return ProgramError::word_repeated;
    }
    out.set(letter, value, column);
    if (first != '#' && first != '[') {
        out.set_point(letter, std::ranges::count(as_it_stands, '.') > 0);
    }
    if (letter == 't' && first == '0') {
        out.set_padded_tool();
    }
    return {};
}

void BlockReader::note(std::string_view word) const noexcept {
    while (!word.empty() && (word.back() == ' ' || word.back() == '\t')) {
        word.remove_suffix(1);
    }
    if (settings_->left_out != nullptr) {
        settings_->left_out->add(word);
    }
}

ProgramStatus BlockReader::read_value(TextCursor& text, const BlockInterpreter& control, char letter,
                                      Decimal& out) noexcept {
    const char c = text.peek();
    const bool sign = c == '-' || c == '+';
    const char first = sign ? text.peek_second() : c;
    if (first != '#' && first != '[' && !is_letter(first)) {
        return read_decimal(text, out);
    }
    if (evaluator_ == nullptr) {
        return is_letter(first) ? ProgramError::number_invalid : ProgramError::expression_unsupported;
    }
    text.go_to(text.at() + (sign ? 1U : 0U));
    const TextCursor start = text;
    const ProgramStatus status = evaluator_->value(text, control, out, letter);
    constexpr std::int64_t most = largest_number * Decimal::one;
    if (status.ok() && out != vacant && (out.raw > most || out.raw < -most)) {
        text = start;
        return ProgramError::number_out_of_range;
    }
    out = c == '-' && out != vacant ? -out : out;
    return status;
}

ProgramStatus BlockReader::add_code(char letter, Decimal value, std::size_t column, Block& out,
                                    bool& left_out) noexcept {
    const bool is_g = letter == 'g';
    std::int32_t code = 0;
    const bool is_number = value.raw >= 0 && value <= Decimal::from_integer(is_g ? 1000 : 10000) &&
                           to_integer(is_g ? Decimal{value.raw * 10} : value, code);
    constexpr std::int32_t none = 30000;
    code = is_number ? code : none;
    CodeInfo info = is_g ? find_g_code(code, settings_->dialect) : find_m_code(code, settings_->dialect);
    if (is_g && settings_->extension != nullptr) {
        settings_->extension->take(code, out, info);
    } else if (info.group == CodeGroup::extension) {
        info.refusal = ProgramError::coordinates_unsupported;
    }
    if (info.group == CodeGroup::none) {
        info.refusal = is_g ? ProgramError::g_code_unknown : ProgramError::m_code_unknown;
    }
    const bool is_first = !has_command_;
    has_command_ = true;
    const bool is_unknown =
        info.refusal == ProgramError::g_code_unknown || info.refusal == ProgramError::m_code_unknown ||
        info.refusal == ProgramError::user_code_unsupported || info.refusal == ProgramError::not_in_dialect;
    if (rules_->one_command && !is_g && (!is_first || (is_unknown && rules_->skips_unknown))) {
        left_out_.command = left_out_.command || is_first;
        left_out = true;
        return {};
    }
    const Ignored ignored = find_ignored(upper_case(letter), value);
    if (may_be_left_out(info.effect) && (ignored != Ignored::no || (is_unknown && settings_->ignores_unknown))) {
        left_out_.code = left_out = true;
        left_out_.command = left_out_.command || (rules_->one_command && is_first);
        left_out_.axes = left_out_.axes || (info.group == CodeGroup::non_modal && code != 40);
        return {};
    }
    if (info.refusal != ProgramError::none || ignored == Ignored::by_name) {
        if (info.group == CodeGroup::motion) {
            out.set_code(info.group, ModalState::lost_motion, column);
        }
        return info.refusal != ProgramError::none ? info.refusal : ProgramError::ignored_word_counts;
    }
    if (info.group == CodeGroup::motion && out.has(info.group) &&
        (code == ModalState::no_motion ||
         out.code(info.group) == ModalState::no_motion)) { // G80 beside another motion ends cycles only
        if (code == ModalState::no_motion) {
            return {};
        }
    } else if (out.has(info.group) && info.group != CodeGroup::without_effect) {
        return ProgramError::modal_group_conflict;
    }
    out.set_code(info.group, code, column);
    return {};
}

BlockReader::Ignored BlockReader::find_ignored(char letter, Decimal value) const noexcept {
    Ignored out = Ignored::no;
    for (std::size_t i = 0; i < settings_->ignored_count; ++i) {
        const IgnoredWord& word = settings_->ignored[i];
        const bool is_any = word.tenths == IgnoredWord::any;
        if (word.letter == letter && (is_any || value.raw == word.tenths * (Decimal::one / 10))) {
            out = std::max(out, is_any ? Ignored::by_letter : Ignored::by_name);
        }
    }
    return out;
}

// Whether it is more than a speed, a tool or an axis: a word before it takes the letter, or T names an offset, too.
bool BlockReader::is_taken(char letter, Decimal value, const Block& out) const noexcept {
    switch (letter) {
    case 's':
        return rules_->mills_only ? out.code(CodeGroup::without_effect) == 500
                                  : rules_->dwell_speed && out.code(CodeGroup::non_modal) == 40;
    case 't': return rules_->mills_only && value >= Decimal::from_integer(100);
    case 'e': return out.code(CodeGroup::motion) == 760 || out.has(CodeGroup::input_output);
    default: return false;
    }
}

// Of words that are no codes: those of the machine, and axes that it does not have.
bool BlockReader::may_leave_out(char letter) const noexcept {
    const std::uint32_t bit = Block::letter_bit(letter);
    const std::uint32_t steps = rules_->uvw_steps ? Block::bits("uvw") : 0U;
    const std::uint32_t others = axis_letters & ~steps & ~axes();
    return ((Block::bits("nst") | others) & bit) != 0;
}

} // namespace splinefeed
