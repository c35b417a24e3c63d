// SPDX-License-Identifier: MIT
//
// Operators of one level associate to the left, from the strongest: **, then * / MOD, then + -, then comparisons, then
// AND OR XOR; the language of the RS274/NGC report with LinuxCNC's comparisons.
#include "splinefeed/s0_program/expression.hpp"

#include "splinefeed/s0_program/system_parameters.hpp"
#include "splinefeed/s0_program/text/decimal_text.hpp"
#include "splinefeed/s0_program/text/elementary.hpp"
#include "splinefeed/s0_program/text/operation.hpp"

namespace splinefeed {

namespace {

/// Reads values; holds what they refer to.
class Parser {
public:
    Parser(TextCursor& text, const BlockInterpreter& control, const ParameterTable& table) noexcept
        : text_(text), system_(control), table_(table) {}

    /// A value: a number, #..., [...] or a function, with a sign or without.
    ProgramStatus value(Decimal& out, int depth) noexcept {
        if (depth > Expression::deepest) {
            return ProgramError::expression_too_deep;
        }
        const char c = text_.peek();
        if (c == '[') {
            text_.step();
            return bracketed(out, depth);
        }
        if (c == '#') {
            return parameter(out, depth);
        }
        if (c >= 'a' && c <= 'z') {
            return function(out, depth);
        }
        if (c == '-' || c == '+') {
            const char next = text_.peek_second();
            if (next == '#' || next == '[' || (next >= 'a' && next <= 'z')) {
                text_.step();
                const ProgramStatus status = value(out, depth + 1);
                if (status.ok() && c == '-') {
                    out = -out;
                }
                return status;
            }
        }
        return read_decimal(text_, out);
    }

    /// #1, ##1, #[...]: the number of the parameter; #<name>: 0 and the name as it is written.
    ProgramStatus parameter_name(std::int32_t& number, std::string_view& name, int depth) noexcept {
        number = 0;
        text_.step(); // the #
        if (text_.peek() == '<') {
            const std::size_t begin = text_.at() + 1;
            const std::size_t end = text_.find('>', begin);
            if (end == text_.text().size() || end == begin) {
                return ProgramError::parameter_name_invalid;
            }
            name = text_.part(begin, end);
            text_.go_to(end + 1);
            return {};
        }
        Decimal value_of;
        const TextCursor start = text_;
        if (const ProgramStatus status = value(value_of, depth + 1); !status.ok()) {
            return status;
        }
        if (!to_integer(value_of, number) || number < 1 || number > most_parameters) {
            text_ = start;
            return ProgramError::parameter_out_of_range;
        }
        return {};
    }

private:
    static constexpr std::int32_t most_parameters = 5602;

    // Behind a [, up to its ].
    ProgramStatus bracketed(Decimal& out, int depth) noexcept {
        if (const ProgramStatus status = level(out, 1, depth + 1); !status.ok()) {
            return status;
        }
        return text_.take(']')
                   ? ProgramStatus{}
                   : ProgramStatus(text_.at_end() ? ProgramError::bracket_missing : ProgramError::operator_unknown);
    }

    // A value, and what operators of this level and stronger ones make of it.
    ProgramStatus level(Decimal& out, int lowest, int depth) noexcept {
        ProgramStatus status = value(out, depth);
        while (status.ok()) {
            TextCursor ahead = text_;
            const OperatorRow* found = take_operator(ahead);
            if (found == nullptr || found->level < lowest) {
                return status;
            }
            const TextCursor start = text_;
            text_ = ahead;
            Decimal right;
            status = level(right, found->level + 1, depth);
            if (status.ok()) {
                status = apply(found->name, out, right, out);
                if (!status.ok()) {
                    text_ = start;
                }
            }
        }
        return status;
    }

    ProgramStatus parameter(Decimal& out, int depth) noexcept {
        const TextCursor start = text_;
        std::int32_t number = 0;
        std::string_view name;
        if (const ProgramStatus status = parameter_name(number, name, depth); !status.ok()) {
            return status;
        }
        if (number > 0) {
            if (SystemParameters::owns(number)) {
                out = system_.read(number);
            } else if (!table_.read(number, out)) {
                out = {};
            }
        } else if (!system_.read(name, out) && !table_.read(name, out)) {
            text_ = start;
            return ProgramError::parameter_unset;
        }
        if (out.raw > Decimal::largest_raw || out.raw < -Decimal::largest_raw) { // a table may hold anything
            text_ = start;
            return ProgramError::number_out_of_range;
        }
        return {};
    }

    ProgramStatus function(Decimal& out, int depth) noexcept {
        const TextCursor start = text_;
        const FunctionRow* row = take_function(text_);
        if (row == nullptr) {
            return ProgramError::function_unknown;
        }
        if (!text_.take('[')) {
            return ProgramError::bracket_missing;
        }
        if (row->name == Function::exists) {
            return exists(out, depth);
        }
        Decimal argument;
        ProgramStatus status = bracketed(argument, depth);
        if (!status.ok()) {
            return status;
        }
        if (row->name == Function::atan) {
            Decimal other;
            if (!text_.take('/') || !text_.take('[')) {
                return ProgramError::atan_needs_two;
            }
            status = bracketed(other, depth);
            out = angle_of(other, argument);
            return status;
        }
        status = apply(row->name, argument, out);
        if (!status.ok()) {
            text_ = start;
        }
        return status;
    }

    ProgramStatus exists(Decimal& out, int depth) noexcept {
        if (text_.peek() != '#') {
            return ProgramError::parameter_name_invalid;
        }
        std::int32_t number = 0;
        std::string_view name;
        if (const ProgramStatus status = parameter_name(number, name, depth); !status.ok()) {
            return status;
        }
        Decimal unused;
        out = truth(number > 0 ? SystemParameters::owns(number) || table_.read(number, unused)
                               : system_.read(name, unused) || table_.read(name, unused));
        return text_.take(']') ? ProgramStatus{} : ProgramStatus(ProgramError::bracket_missing);
    }

    TextCursor& text_;
    SystemParameters system_;
    const ParameterTable& table_;
};

} // namespace

ProgramStatus Expression::value(TextCursor& text, const BlockInterpreter& control, Decimal& out) noexcept {
    return Parser(text, control, *table_).value(out, 0);
}

ProgramStatus Expression::assignment(TextCursor& text, const BlockInterpreter& control) noexcept {
    const TextCursor start = text;
    if (count_ == most_assignments) {
        return ProgramError::too_many_assignments;
    }
    Assignment& next = assignments_[static_cast<unsigned>(count_)];
    Parser parser(text, control, *table_);
    if (const ProgramStatus status = parser.parameter_name(next.number, next.name, 0); !status.ok()) {
        return status;
    }
    if (!text.take('=')) {
        return ProgramError::assignment_invalid;
    }
    if (const ProgramStatus status = parser.value(next.value, 0); !status.ok()) {
        return status;
    }
    Decimal unused;
    const bool owned = SystemParameters::owns(next.number);
    if (next.number > 0 ? owned && !SystemParameters::can_write(next.number)
                        : SystemParameters(control).read(next.name, unused)) {
        text = start;
        return ProgramError::parameter_read_only;
    }
    if (owned && !is_position(next.value)) {
        text = start;
        return ProgramError::position_out_of_range;
    }
    ++count_;
    return {};
}

// False: there is no room for it.
bool Expression::write(Assignment& of) noexcept {
    if (SystemParameters::owns(of.number)) {
        return true; // finish() does that
    }
    of.was_set = of.number > 0 ? table_->read(of.number, of.before) : table_->read(of.name, of.before);
    return of.number > 0 ? table_->write(of.number, of.value) : table_->write(of.name, of.value);
}

void Expression::take_back(const Assignment& of) noexcept {
    if (SystemParameters::owns(of.number)) {
        return;
    }
    if (!of.was_set) {
        of.number > 0 ? table_->forget(of.number) : table_->forget(of.name);
    } else {
        static_cast<void>(of.number > 0 ? table_->write(of.number, of.before) : table_->write(of.name, of.before));
    }
}

ProgramStatus Expression::commit() noexcept {
    int done = 0;
    while (done < count_ && write(assignments_[static_cast<unsigned>(done)])) {
        ++done;
    }
    const bool complete = done == count_;
    while (!complete && done > 0) {
        take_back(assignments_[static_cast<unsigned>(--done)]);
    }
    return complete ? ProgramStatus{} : ProgramStatus(ProgramError::parameter_storage_full);
}

void Expression::finish(BlockInterpreter& control) noexcept {
    for (int i = 0; i < count_; ++i) {
        const Assignment& of = assignments_[static_cast<unsigned>(i)];
        if (SystemParameters::owns(of.number)) {
            SystemParameters::write(control, of.number, of.value);
        }
    }
    count_ = 0;
}

} // namespace splinefeed
