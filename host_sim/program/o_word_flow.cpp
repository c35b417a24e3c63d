// SPDX-License-Identifier: MIT
#include "host_sim/program/o_word_flow.hpp"

#include "host_sim/base/input_error.hpp"

#include "splinefeed/s0_program/decimal_text.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr std::size_t most_arguments = 30;

std::string plain(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c != ' ' && c != '\t') {
            out += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
        }
    }
    return out;
}

} // namespace

OWordFlow::OWordFlow(std::string file, const std::vector<std::string>& lines, ProgramParameters& parameters,
                     Expression& expression, BlockInterpreter& interpreter, std::uint64_t most_steps)
    : file_(std::move(file)), lines_(&lines), parameters_(&parameters), expression_(&expression),
      interpreter_(&interpreter), most_steps_(most_steps) {
    read_statements();
    pair_statements();
}

bool OWordFlow::has_o_word(std::string_view line) {
    TextCursor text(line);
    if (text.take('n')) {
        while ((text.peek() >= '0' && text.peek() <= '9') || text.peek() == '.') {
            text.step();
        }
    }
    return text.peek() == 'o';
}

void OWordFlow::fail(std::size_t line, std::string_view what) const {
    throw InputError(file_, line + 1, what);
}

OWordFlow::Statement OWordFlow::parse(std::string_view line) {
    struct Row {
        std::string_view text;
        Word word;
    };
    static constexpr Row rows[] = {{"sub", Word::sub},
                                   {"endsub", Word::endsub},
                                   {"call", Word::call},
                                   {"return", Word::give_back},
                                   {"if", Word::if_},
                                   {"elseif", Word::elseif},
                                   {"else", Word::else_},
                                   {"endif", Word::endif},
                                   {"while", Word::while_},
                                   {"endwhile", Word::endwhile},
                                   {"do", Word::do_},
                                   {"repeat", Word::repeat},
                                   {"endrepeat", Word::endrepeat},
                                   {"break", Word::break_},
                                   {"continue", Word::continue_}};
    Statement out;
    TextCursor text(line);
    while (text.peek() != 'o') { // N and its number
        text.step();
    }
    text.step();
    if (text.peek() == '<') {
        const std::size_t end = text.find('>', text.at());
        out.label = plain(text.part(text.at() + 1, end));
        text.go_to(end == line.size() ? end : end + 1);
    } else {
        while (text.peek() >= '0' && text.peek() <= '9') {
            out.label += text.peek();
            text.step();
        }
    }
    std::size_t longest = 0; // "else" begins "elseif"
    for (const Row& row : rows) {
        TextCursor ahead = text;
        if (row.text.size() > longest && ahead.take(row.text)) {
            longest = row.text.size();
            out.word = row.word;
            out.rest = ahead.at();
        }
    }
    return out;
}

void OWordFlow::read_statements() {
    for (std::size_t i = 0; i < lines_->size(); ++i) {
        if (!has_o_word((*lines_)[i])) {
            continue;
        }
        Statement statement = parse((*lines_)[i]);
        if (statement.label.empty()) {
            fail(i, "an O word has a number or a name: o100 or o<name>");
        }
        if (statement.word == Word::none) {
            fail(i, "behind an O word stands sub, endsub, call, return, if, elseif, else, endif, while, endwhile, do, "
                    "repeat, endrepeat, break or continue");
        }
        if (statement.word == Word::sub && !subs_.emplace(statement.label, i).second) {
            fail(i, fmt::format("there are two subroutines o{}; each needs a name of its own", statement.label));
        }
        statements_.emplace(i, std::move(statement));
    }
}

// Each branch gets the line of the next one, each end its begin, each begin its end.
void OWordFlow::pair_statements() {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < lines_->size(); ++i) {
        const auto found = statements_.find(i);
        if (found == statements_.end()) {
            continue;
        }
        Statement& here = found->second;
        Statement* top = open.empty() ? nullptr : &statements_.at(open.back());
        const bool same = top != nullptr && top->label == here.label;
        const auto continues = [&](bool fits, bool ends) {
            if (!same || !fits) {
                fail(i, fmt::format("o{} ends or continues nothing that is open here; begin and end need one label and "
                                    "must not overlap others",
                                    here.label));
            }
            here.partner = open.back();
            top->partner = i;
            open.pop_back();
            if (!ends) {
                open.push_back(i);
            }
        };
        switch (here.word) {
        case Word::while_:
            if (same && top->word == Word::do_) {
                here.word = Word::while_end;
                continues(true, true);
                break;
            }
            open.push_back(i);
            break;
        case Word::sub:
            if (!open.empty()) {
                fail(i, "a subroutine cannot begin within another block");
            }
            open.push_back(i);
            break;
        case Word::if_:
        case Word::do_:
        case Word::repeat: open.push_back(i); break;
        case Word::endsub: continues(same && top->word == Word::sub, true); break;
        case Word::elseif:
        case Word::else_: continues(same && (top->word == Word::if_ || top->word == Word::elseif), false); break;
        case Word::endif:
            continues(same && (top->word == Word::if_ || top->word == Word::elseif || top->word == Word::else_), true);
            break;
        case Word::endwhile: continues(same && top->word == Word::while_, true); break;
        case Word::endrepeat: continues(same && top->word == Word::repeat, true); break;
        case Word::break_:
        case Word::continue_: {
            std::size_t k = open.size();
            const auto is_loop = [&](const Statement& s) {
                return s.label == here.label &&
                       (s.word == Word::while_ || s.word == Word::do_ || s.word == Word::repeat);
            };
            while (k > 0 && !is_loop(statements_.at(open[k - 1]))) {
                --k;
            }
            if (k == 0) {
                fail(i, fmt::format("break and continue need a loop o{} around them", here.label));
            }
            here.partner = open[k - 1];
            break;
        }
        default: break;
        }
    }
    if (!open.empty()) {
        fail(open.back(), "the end of this O word is missing");
    }
}

Decimal OWordFlow::value(std::size_t line, TextCursor& text) const {
    Decimal out;
    if (const Status status = expression_->value(text, *interpreter_, out); !status.ok()) {
        fail(line, fmt::format("column {}: {}", text.column(), describe(status.error())));
    }
    return out;
}

bool OWordFlow::condition(std::size_t line) const {
    TextCursor text((*lines_)[line]);
    text.go_to(statements_.at(line).rest);
    if (text.peek() != '[') {
        fail(line, "a condition stands in brackets: [#1 LT 5]");
    }
    return value(line, text).raw != 0;
}

std::optional<OWordFlow::Line> OWordFlow::next() {
    while (at_ < lines_->size()) {
        if (++steps_ > most_steps_) {
            fail(at_, fmt::format("{} lines have been executed; a loop that never ends?", most_steps_));
        }
        const std::size_t line = at_;
        if (!statements_.contains(line)) {
            ++at_;
            return Line{(*lines_)[line], static_cast<std::uint32_t>(line + 1)};
        }
        execute(line);
    }
    return std::nullopt;
}

void OWordFlow::execute(std::size_t line) {
    const Statement& here = statements_.at(line);
    at_ = line + 1;
    switch (here.word) {
    case Word::sub: at_ = here.partner + 1; break; // it is executed by its calls
    case Word::call: call(line); break;
    case Word::endsub:
    case Word::give_back: give_back(line); break;
    case Word::if_: {
        std::size_t branch = line;
        while (!condition(branch)) {
            branch = statements_.at(branch).partner;
            if (statements_.at(branch).word != Word::elseif) {
                break;
            }
        }
        at_ = branch + 1;
        break;
    }
    case Word::elseif:
    case Word::else_: // the branch before it was taken
        at_ = line;
        while (statements_.at(at_).word != Word::endif) {
            at_ = statements_.at(at_).partner;
        }
        break;
    case Word::while_: at_ = condition(line) ? line + 1 : here.partner + 1; break;
    case Word::endwhile: at_ = here.partner; break;
    case Word::while_end: at_ = condition(line) ? here.partner + 1 : line + 1; break;
    case Word::repeat:
    case Word::endrepeat: repeat(line); break;
    case Word::break_:
        calls_.back().repeats.erase(here.partner);
        at_ = statements_.at(here.partner).partner + 1;
        break;
    case Word::continue_: {
        const Statement& loop = statements_.at(here.partner);
        at_ = loop.word == Word::while_ ? here.partner : loop.partner;
        break;
    }
    default: break;
    }
}

void OWordFlow::call(std::size_t line) {
    const Statement& here = statements_.at(line);
    const auto sub = subs_.find(here.label);
    if (sub == subs_.end()) {
        fail(line,
             fmt::format("there is no subroutine o{} in this file; those of other files are not read", here.label));
    }
    if (calls_.size() > deepest_call) {
        fail(line, fmt::format("calls are more than {} deep", deepest_call));
    }
    std::vector<Decimal> arguments;
    TextCursor text((*lines_)[line]);
    text.go_to(here.rest);
    while (text.peek() == '[') {
        if (arguments.size() == most_arguments) {
            fail(line, "a call has at most 30 arguments");
        }
        arguments.push_back(value(line, text));
    }
    parameters_->enter(arguments);
    calls_.push_back({line + 1, here.label, {}});
    at_ = sub->second + 1;
}

void OWordFlow::give_back(std::size_t line) {
    if (calls_.size() == 1) {
        fail(line, "return stands in no subroutine that was called");
    }
    TextCursor text((*lines_)[line]);
    text.go_to(statements_.at(line).rest);
    const bool has_value = text.peek() == '[';
    const Decimal result = has_value ? value(line, text) : Decimal{};
    parameters_->leave();
    parameters_->write("_value", result);
    parameters_->write("_value_returned", Decimal::from_integer(has_value ? 1 : 0));
    at_ = calls_.back().back_to;
    calls_.pop_back();
}

void OWordFlow::repeat(std::size_t line) {
    const Statement& here = statements_.at(line);
    auto& repeats = calls_.back().repeats;
    const bool begins = here.word == Word::repeat;
    const std::size_t begin = begins ? line : here.partner;
    if (begins) {
        TextCursor text((*lines_)[line]);
        text.go_to(here.rest);
        std::int32_t count = 0;
        if (text.peek() != '[' || !to_integer(value(line, text), count) || count < 0) {
            fail(line, "repeat needs a whole number of at least 0, in brackets");
        }
        repeats[begin] = count;
    } else {
        --repeats[begin];
    }
    const bool more = repeats[begin] > 0;
    if (!more) {
        repeats.erase(begin);
    }
    at_ = more ? begin + 1 : (begins ? here.partner : line) + 1;
}

} // namespace splinefeed::host
