// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/program_call.hpp"

namespace splinefeed::host {

namespace {

/// A word of the line, or a comment.
struct Part {
    char letter = 0;        // '(': a comment
    std::size_t begin = 0;  // of the word
    std::size_t number = 0; // of what stands behind the letter
    std::size_t end = 0;    // behind it
};

Part next_part(TextCursor& text) {
    Part out{.letter = text.peek(), .begin = text.at()};
    text.step();
    out.number = text.at();
    if (out.letter == '(' || out.letter == '<') {
        text.go_to(text.find(out.letter == '(' ? ')' : '>', out.begin));
        text.step();
    } else {
        skip_value(text);
    }
    out.end = std::min(text.at(), text.text().size());
    return out;
}

// 98, 99, or 0.
int number_of_call(const Part& part, std::string_view text) {
    TextCursor number(text.substr(0, part.end));
    number.go_to(part.number);
    while (number.take('0')) {
    }
    const bool is_call = part.letter == 'm' && number.take('9') && (number.peek() == '8' || number.peek() == '9');
    const int out = !is_call ? 0 : number.peek() == '8' ? 98 : 99;
    number.step();
    return number.at_end() ? out : 0;
}

// Whether it is worth while to read the words.
bool may_call(std::string_view text) noexcept {
    for (std::size_t at = text.find_first_of("mM"); at != std::string_view::npos;
         at = text.find_first_of("mM", at + 1)) {
        TextCursor cursor(text);
        cursor.go_to(at + 1);
        while (cursor.peek() == '0') {
            cursor.step();
        }
        if (cursor.take('9') && (cursor.peek() == '8' || cursor.peek() == '9')) {
            return true;
        }
    }
    return false;
}

} // namespace

std::optional<FlowWord> read_program_call(std::string_view text, const FlowRules& rules) {
    TextCursor cursor(text);
    if (rules.programs == NumberedPrograms::none || !may_call(text) || (cursor.take('/') && rules.block_delete)) {
        return std::nullopt;
    }
    std::optional<FlowWord> out;
    std::string others(text);
    bool has_others = false;
    const auto take = [&](const Part& part) {
        others.replace(part.begin, part.end - part.begin, part.end - part.begin, ' ');
    };
    while (!cursor.at_end() && cursor.peek() != ';') {
        const Part part = next_part(cursor);
        const bool in_call = out && out->kind == FlowKind::call_program;
        if (const int number = number_of_call(part, text); number > 0 && !out) {
            out.emplace();
            out->kind = number == 98 ? FlowKind::call_program : FlowKind::end_program;
            out->label_at = part.begin;
            out->rest = 0;
            take(part);
        } else if (out && part.letter == 'p' && !out->has_number) {
            out->label_at = part.number;
            out->has_number = true;
            take(part);
        } else if (in_call && part.letter == 'l' && out->rest == 0) {
            out->rest = part.number;
            take(part);
        } else {
            has_others = has_others || (part.letter != '(' && part.letter != 'n');
        }
        if (!out && rules.programs == NumberedPrograms::linuxcnc && has_others) {
            return std::nullopt; // it is not the first word
        }
    }
    if (out && has_others) {
        out->others = std::move(others);
    }
    return out;
}

} // namespace splinefeed::host
