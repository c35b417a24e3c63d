// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/flow_word.hpp"

namespace splinefeed::host {

namespace {

struct Keyword {
    std::string_view text;
    FlowKind kind;
};

// Of two where one begins with the other, the longer one first.
constexpr Keyword keywords[] = {
    {"sub", FlowKind::sub},        {"endsub", FlowKind::endsub}, {"call", FlowKind::call},
    {"return", FlowKind::return_}, {"elseif", FlowKind::elseif}, {"else", FlowKind::else_},
    {"endif", FlowKind::endif},    {"if", FlowKind::if_},        {"endwhile", FlowKind::endwhile},
    {"while", FlowKind::while_},   {"do", FlowKind::do_},        {"endrepeat", FlowKind::endrepeat},
    {"repeat", FlowKind::repeat},  {"break", FlowKind::break_},  {"continue", FlowKind::continue_},
};

bool is_digit(char c) noexcept {
    return c >= '0' && c <= '9';
}

void skip_number(TextCursor& text) noexcept {
    while (is_digit(text.peek()) || text.peek() == '.') {
        text.step();
    }
}

// Behind a / that does not leave the line out, and an N number.
void skip_block_number(TextCursor& text) noexcept {
    static_cast<void>(text.take('/'));
    if (text.take('n')) {
        skip_number(text);
    }
}

// Without zeros in front.
std::string read_label(TextCursor& text) {
    std::string out;
    while (is_digit(text.peek())) {
        out += text.peek();
        text.step();
    }
    out.erase(0, std::min(out.find_first_not_of('0'), out.size() - 1));
    return out;
}

} // namespace

void skip_value(TextCursor& text) noexcept {
    while (text.take('#') || text.take('-') || text.take('+')) {
    }
    if (text.peek() != '[') {
        skip_number(text);
        return;
    }
    int deep = 0;
    do {
        deep += text.peek() == '[' ? 1 : text.peek() == ']' ? -1 : 0;
        text.step();
    } while (deep > 0 && !text.at_end());
}

std::string program_label(std::string_view number) {
    return std::string("O").append(number);
}

bool has_flow_word(std::string_view text) noexcept {
    TextCursor cursor(text);
    skip_block_number(cursor);
    return cursor.peek() == 'o';
}

bool is_program_number(std::string_view text) noexcept {
    TextCursor cursor(text);
    skip_block_number(cursor);
    if (!(cursor.take('o') || cursor.take(':')) || !is_digit(cursor.peek())) {
        return false;
    }
    skip_number(cursor);
    return cursor.at_end() || cursor.peek() == '(' || cursor.peek() == ';';
}

std::optional<FlowWord> read_flow_word(std::string_view text, std::size_t& wrong) {
    TextCursor cursor(text);
    skip_block_number(cursor);
    wrong = cursor.at();
    cursor.step(); // the O
    FlowWord out{};
    out.label_at = cursor.at();
    if (cursor.take('<')) {
        while (!cursor.at_end() && cursor.peek() != '>') {
            out.label += cursor.peek();
            cursor.step();
        }
        if (!cursor.take('>') || out.label.empty()) {
            return std::nullopt;
        }
    } else if (is_digit(cursor.peek())) {
        out.label = read_label(cursor);
    } else if (cursor.peek() == '#' || cursor.peek() == '[') {
        skip_value(cursor);
    } else {
        return std::nullopt;
    }
    wrong = cursor.at();
    if (is_program_number(text)) {
        out.kind = FlowKind::program;
        out.label = program_label(out.label);
        out.rest = cursor.at();
        return out;
    }
    for (const Keyword& keyword : keywords) {
        if (cursor.take(keyword.text)) {
            out.kind = keyword.kind;
            out.rest = cursor.at();
            return out;
        }
    }
    return std::nullopt;
}

} // namespace splinefeed::host
