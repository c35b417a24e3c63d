// SPDX-License-Identifier: MIT
#include "splinefeed/controller/block_conditions.hpp"

namespace splinefeed {

using namespace std::string_view_literals; // a firmware has no strlen

namespace {

BlockStatus wrong(ProgramError error, const TextCursor& at) noexcept {
    return {.error = error, .column = at.column()};
}

// FNV-1a of what names a condition: a number, or what stands in < >. 0: nothing does.
std::uint64_t take_label(TextCursor& text) noexcept {
    std::uint64_t hash = 0xcbf29ce484222325U;
    const auto add = [&] {
        hash = (hash ^ static_cast<unsigned char>(text.peek())) * 0x100000001b3U;
        text.step();
    };
    bool some = false;
    if (text.take('<')) {
        for (; !text.at_end() && text.peek() != '>'; some = true) {
            add();
        }
        return text.take('>') && some ? hash : 0;
    }
    while (text.peek() == '0') { // O010 is O10
        some = true;
        text.step();
    }
    for (; text.peek() >= '0' && text.peek() <= '9'; some = true) {
        add();
    }
    return some ? hash : 0;
}

bool at_end(const TextCursor& text) noexcept {
    return text.at_end() || text.peek() == '(' || text.peek() == ';';
}

enum class Word : std::uint8_t { if_, elseif, else_, endif, none };

Word take_word(TextCursor& text) noexcept {
    static constexpr std::string_view words[] = {"if"sv, "elseif"sv, "else"sv, "endif"sv}; // else behind elseif
    unsigned found = 0;
    while (found < 4 && !text.take(words[found])) {
        ++found;
    }
    return static_cast<Word>(found);
}

void step_over_number(TextCursor& text) noexcept {
    if (text.take('n')) {
        while ((text.peek() >= '0' && text.peek() <= '9') || text.peek() == '.') {
            text.step();
        }
    }
}

} // namespace

bool BlockConditions::executes() const noexcept {
    return count_ == 0 || open_[count_ - 1].branch == Branch::executes;
}

BlockStatus BlockConditions::take(std::string_view line, WordEvaluator& values, const BlockInterpreter& control,
                                  bool& executes) noexcept {
    TextCursor text(line);
    step_over_number(text);
    const TextCursor begin = text;
    executes = this->executes();
    if (!text.take('o')) {
        return {};
    }
    const bool outside = executes;
    executes = false;
    const std::uint64_t label = take_label(text);
    const Word word = take_word(text);
    if (label == 0 || word == Word::none) {
        return outside ? wrong(ProgramError::o_word, begin) : BlockStatus{}; // as any line that is left out
    }
    Condition* const last = count_ > 0 ? &open_[count_ - 1] : nullptr;
    if (word != Word::if_ && (last == nullptr || last->label != label || (last->has_else && word != Word::endif))) {
        return wrong(ProgramError::condition_not_open, begin);
    }
    if (word == Word::if_ && count_ == deepest) {
        return wrong(ProgramError::conditions_too_deep, begin);
    }
    const bool decides = word == Word::if_ ? outside : word == Word::elseif && last->branch == Branch::sought;
    bool holds = false;
    if (decides) {
        Decimal value;
        if (text.peek() != '[') {
            return wrong(ProgramError::bracket_missing, text);
        }
        if (const ProgramStatus status = values.value(text, control, value); !status.ok()) {
            return wrong(status.error(), text);
        }
        holds = value.raw != 0;
    }
    if ((decides || word == Word::else_ || word == Word::endif) && !at_end(text)) {
        return wrong(ProgramError::character_invalid, text);
    }
    switch (word) {
    case Word::if_:
        open_[count_++] = {label, !outside ? Branch::over : holds ? Branch::executes : Branch::sought, false};
        break;
    case Word::elseif: last->branch = holds ? Branch::executes : decides ? Branch::sought : Branch::over; break;
    case Word::else_:
        last->branch = last->branch == Branch::sought ? Branch::executes : Branch::over;
        last->has_else = true;
        break;
    case Word::endif: --count_; break;
    case Word::none: break;
    }
    return {};
}

} // namespace splinefeed
