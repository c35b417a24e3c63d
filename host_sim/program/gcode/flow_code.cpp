// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/flow_code.hpp"

namespace splinefeed::host {

namespace {

bool is_number_part(char c) noexcept {
    return (c >= '0' && c <= '9') || c == '.';
}

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

struct Code {
    std::string_view digits;
    FlowKind kind;
};

constexpr Code codes[] = {
    {"98", FlowKind::call_program}, {"99", FlowKind::end_program},  {"97", FlowKind::call_line},
    {"70", FlowKind::save_modes},   {"71", FlowKind::forget_modes}, {"72", FlowKind::restore_modes},
    {"73", FlowKind::lend_modes},
};

bool has_code(const FlowRules& rules, FlowKind kind) noexcept {
    const bool of_programs = kind == FlowKind::call_program || kind == FlowKind::end_program;
    return kind == FlowKind::call_line ? rules.macros
           : of_programs               ? rules.programs != NumberedPrograms::none
                                       : rules.saves_modes;
}

// Behind the M.
const Code* code_at(TextCursor number, const FlowRules& rules) noexcept {
    while (number.take('0')) {
    }
    for (const Code& code : codes) {
        TextCursor behind = number;
        if (has_code(rules, code.kind) && behind.take(code.digits) && !is_number_part(behind.peek())) {
            return &code;
        }
    }
    return nullptr;
}

// Whether it is worth while to read the words.
bool may_have_code(std::string_view text, const FlowRules& rules) noexcept {
    for (std::size_t at = text.find_first_of("mM"); at != std::string_view::npos;
         at = text.find_first_of("mM", at + 1)) {
        TextCursor number(text);
        number.go_to(at + 1);
        if (code_at(number, rules) != nullptr) {
            return true;
        }
    }
    return false;
}

} // namespace

bool has_program_end(std::string_view text) {
    for (TextCursor cursor(text); !cursor.at_end() && cursor.peek() != ';';) {
        const Part part = next_part(cursor);
        TextCursor number(text.substr(0, part.end));
        number.go_to(part.number);
        while (part.letter == 'm' && number.take('0')) {
        }
        if (part.letter == 'm' && (number.take("30") || number.take("2")) && number.at_end()) {
            return true;
        }
    }
    return false;
}

std::optional<FlowWord> read_flow_code(std::string_view text, const FlowRules& rules) {
    TextCursor cursor(text);
    if (!may_have_code(text, rules) || (cursor.take('/') && rules.block_delete)) {
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
        const bool in_call = out && (out->kind == FlowKind::call_program || out->kind == FlowKind::call_line);
        TextCursor number(text);
        number.go_to(part.number);
        if (const Code* const code = part.letter == 'm' ? code_at(number, rules) : nullptr; code != nullptr && !out) {
            out.emplace();
            out->kind = code->kind;
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
        if (!out && rules.programs != NumberedPrograms::fanuc && has_others) {
            return std::nullopt; // it is not the first word
        }
    }
    if (out && has_others) {
        out->others = std::move(others);
    }
    return out;
}

} // namespace splinefeed::host
