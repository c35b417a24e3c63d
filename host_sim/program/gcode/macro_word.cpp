// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/macro_word.hpp"

namespace splinefeed::host {

namespace {

constexpr std::string_view first_words[] = {"if", "goto", "while", "do", "end"};

bool is_macro_digit(char c) noexcept {
    return c >= '0' && c <= '9';
}

// Up to 9 digits; more, or none: nothing.
std::optional<std::uint32_t> read_digits(TextCursor& text) noexcept {
    constexpr int most_digits = 9;
    std::uint32_t out = 0;
    int digits = 0;
    for (; is_macro_digit(text.peek()) && digits < most_digits; text.step(), ++digits) {
        out = 10U * out + static_cast<std::uint32_t>(text.peek() - '0');
    }
    return digits > 0 && !is_macro_digit(text.peek()) && text.peek() != '.' ? std::optional(out) : std::nullopt;
}

// Behind / and N.
TextCursor statement_of(std::string_view line) noexcept {
    TextCursor text(line);
    text.take('/');
    if (text.peek() == 'n') {
        text.step();
        while (is_macro_digit(text.peek()) || text.peek() == '.') {
            text.step();
        }
    }
    return text;
}

// #3000= or #3006=, which is stepped over.
bool take_stop(TextCursor& text, FlowKind& kind) noexcept {
    if (!text.take('#')) {
        return false;
    }
    constexpr std::uint32_t alarm = 3000;
    constexpr std::uint32_t message = 3006;
    const std::uint32_t number = read_digits(text).value_or(0);
    kind = number == alarm ? FlowKind::alarm : FlowKind::message;
    return (number == alarm || number == message) && text.take('=');
}

bool take_g65(TextCursor& text) noexcept {
    return text.take('g') && read_digits(text) == 65U;
}

bool ends(const TextCursor& text) noexcept {
    return text.at_end() || text.peek() == '(' || text.peek() == ';';
}

/// Reads a statement; holds where it is wrong.
class Statement {
public:
    explicit Statement(std::string_view line) noexcept : text_(statement_of(line)) { out_.label_at = text_.at(); }

    [[nodiscard]] std::size_t at() const noexcept { return text_.at(); }
    [[nodiscard]] std::string_view right() const noexcept { return right_; }

    std::optional<FlowWord> read() {
        const TextCursor begin = text_;
        if (take_g65(text_)) {
            out_.kind = FlowKind::call_macro;
            out_.rest = text_.at();
            return out_;
        }
        text_ = begin;
        if (take_stop(text_, out_.kind)) {
            out_.rest = text_.at();
            return out_;
        }
        text_ = begin;
        return read_keyword() ? std::optional(out_) : std::nullopt;
    }

private:
    bool read_keyword() {
        if (text_.take(std::string_view("goto"))) {
            out_.kind = FlowKind::jump;
            out_.rest = text_.at();
            skip_value(text_);
            return require(ends(text_), "behind GOTO stands the number N of a block, and nothing else");
        }
        if (text_.take(std::string_view("end"))) {
            out_.kind = FlowKind::end_loop;
            return read_loop();
        }
        const bool decides = text_.take(std::string_view("if"));
        if (decides || text_.take(std::string_view("while"))) {
            out_.rest = text_.at();
            if (!require(text_.peek() == '[', "a condition stands in brackets, like [#1 LT 5]")) {
                return false;
            }
            skip_value(text_);
        }
        out_.kind = FlowKind::loop;
        return decides
                   ? read_branch()
                   : require(text_.take(std::string_view("do")), "behind its condition WHILE has DO1, DO2 or DO3") &&
                         read_loop();
    }

    bool read_loop() {
        const char number = text_.peek();
        const bool known = number >= '1' && number <= '3';
        text_.step();
        out_.label = std::string("DO").append(1, number);
        return require(known && ends(text_), "DO and END have the number 1, 2 or 3, and nothing stands behind it");
    }

    bool read_branch() {
        const bool jumps = text_.take(std::string_view("goto"));
        out_.kind = jumps ? FlowKind::jump_if : FlowKind::then;
        if (!require(jumps || text_.take(std::string_view("then")), "behind its condition IF has GOTO or THEN")) {
            return false;
        }
        out_.behind = text_.at();
        if (!jumps) {
            return require(text_.peek() == '#',
                           "behind THEN a variable is set, like #1=5, and nothing else stands there");
        }
        skip_value(text_);
        return require(ends(text_), "behind GOTO stands the number N of a block, and nothing else");
    }

    bool require(bool holds, std::string_view right) noexcept {
        right_ = holds ? right_ : right;
        return holds;
    }

    TextCursor text_;
    FlowWord out_{};
    std::string_view right_;
};

} // namespace

bool has_macro_word(std::string_view line) noexcept {
    TextCursor text = statement_of(line);
    const char first = text.peek();
    FlowKind kind{};
    if (first == '#') {
        return take_stop(text, kind);
    }
    if (TextCursor code = text; first == 'g' && take_g65(code)) {
        return true;
    }
    for (const std::string_view keyword : first_words) {
        if (TextCursor word = text; word.take(keyword)) {
            return true;
        }
    }
    return false;
}

std::optional<FlowWord> read_macro_word(std::string_view line, std::size_t& wrong, std::string_view& right) {
    Statement statement(line);
    std::optional<FlowWord> out = statement.read();
    wrong = std::min(statement.at(), line.size());
    right = statement.right();
    return out;
}

std::optional<std::uint32_t> line_label(std::string_view line) noexcept {
    TextCursor text(line);
    text.take('/');
    return text.take('n') ? read_digits(text) : std::nullopt;
}

std::int32_t argument_number(char letter) noexcept {
    constexpr std::string_view letters = "abcijkdef?h?m???qrstuvwxyz"; // in the order of their variables
    const std::size_t at = letters.find(letter);
    return at == std::string_view::npos || letter == '?' ? 0 : static_cast<std::int32_t>(at + 1);
}

std::string_view comment_of(std::string_view line) noexcept {
    const std::size_t begin = std::min(line.find('('), line.size());
    const std::string_view text = line.substr(std::min(begin + 1, line.size()));
    return text.substr(0, text.find(')'));
}

} // namespace splinefeed::host
