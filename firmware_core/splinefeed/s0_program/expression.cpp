// SPDX-License-Identifier: MIT
//
// Operators of one level associate to the left, from the strongest: **, then * / MOD, then + -, then comparisons, then
// AND OR XOR; the language of the RS274/NGC report with LinuxCNC's comparisons. In dialects with macros the same, where
// it is that of Fanuc's custom macro B, too: what differs is in macro_operation, and what is read otherwise is refused.
#include "splinefeed/s0_program/expression.hpp"

#include "splinefeed/s0_program/system_parameters.hpp"
#include "splinefeed/s0_program/text/decimal_text.hpp"
#include "splinefeed/s0_program/text/elementary.hpp"
#include "splinefeed/s0_program/text/macro_operation.hpp"

namespace splinefeed {

namespace {

constexpr std::int32_t most_parameters = 5602;

bool is_letter(char c) noexcept {
    return c >= 'a' && c <= 'z';
}

// What ROUND rounds to in dialects with macros: in the word of a coordinate the least one that a control is told.
Decimal unit_of(char letter, bool inches) noexcept {
    const bool angle = letter >= 'a' && letter <= 'c';
    const bool length = (letter >= 'i' && letter <= 'k') || letter == 'q' || letter == 'r' || letter >= 'u';
    return {length && inches ? Decimal::one / 10'000 : length || angle ? Decimal::one / 1'000 : Decimal::one};
}

/// Reads values; holds what they refer to. No function calls itself, so that the stack has a bound: what waits for a
/// value is kept beside.
class Parser {
public:
    Parser(TextCursor& text, const BlockInterpreter& control, const ParameterTable& table, Decimal unit) noexcept
        : text_(text), system_(control), table_(table), unit_(unit), macros_(control.rules().macros) {}

    /// A value: a number, #..., [...] or a function, with a sign or without. `depth`: of what it stands in.
    ProgramStatus value(Decimal& out, unsigned depth = 0) noexcept {
        depth_ = depth;
        bool complete = false;
        ProgramStatus status;
        do {
            status = complete ? use(out, complete) : begin(out, complete);
        } while (status.ok() && !(complete && count_ == 0));
        return status;
    }

    /// What is assigned: in dialects with macros an expression, too.
    ProgramStatus assigned(Decimal& out) noexcept {
        depth_ = 0;
        if (macros_) {
            wait(Kind::whole, text_.at());
        }
        return value(out);
    }

    /// #1, ##1, #[...]: the number of the parameter; #<name>: 0 and the name as it is written.
    ProgramStatus parameter_name(std::int32_t& number, std::string_view& name) noexcept {
        number = 0;
        name = {};
        text_.step(); // the #
        if (text_.peek() == '<') {
            return take_name(name);
        }
        Decimal value_of;
        const std::size_t start = text_.at();
        const ProgramStatus status = value(value_of, 1);
        return status.ok() ? to_number(value_of, start, number) : status;
    }

private:
    enum class Kind : std::uint8_t {
        minus,
        plus,
        operation, ///< its left side is known
        bracket,
        function,
        divisor,   ///< the second bracket of ATAN; the first one's value is `left`
        parameter, ///< the number behind #
        existence, ///< the same, in EXISTS
        whole,     ///< an expression without brackets
    };
    /// What waits for a value. Raw, since a Decimal would initialise all of them.
    struct Pending {
        std::int64_t left; // of an operation or a divisor
        std::uint16_t at;  // in the text
        Kind kind;
        std::uint8_t depth; // of the value
        std::uint8_t level; // of an operation, else 0
        Operator operation; // of brackets in dialects with macros: AND, OR or XOR stands in them, or another operator
        Function function;
    };
    // At each depth one, and if it is a bracket an operator of each level; at the last one none is read.
    static constexpr int most_pending = Expression::deepest * (1 + strongest_level) + 1;

    [[nodiscard]] unsigned depth() const noexcept { return count_ > 0 ? pending_[count_ - 1].depth : depth_; }

    Pending& wait(Kind kind, std::size_t at) noexcept {
        SPLINEFEED_ASSERT(count_ < pending_.size());
        const auto inside = static_cast<std::uint8_t>(depth() + (kind == Kind::operation ? 0U : 1U));
        return pending_[count_++] = {0, static_cast<std::uint16_t>(at), kind, inside, 0, {}, {}};
    }

    // What a value begins with: all of it, or what waits for the rest.
    ProgramStatus begin(Decimal& out, bool& complete) noexcept {
        if (depth() > Expression::deepest) {
            return ProgramError::expression_too_deep;
        }
        const char c = text_.peek();
        if (c == '#') {
            return begin_parameter(Kind::parameter, out, complete);
        }
        if (is_letter(c)) {
            return begin_function(out, complete);
        }
        const char next = c == '-' || c == '+' ? text_.peek_second() : '\0';
        if (c == '[' || next == '#' || next == '[' || is_letter(next)) {
            wait(c == '[' ? Kind::bracket : c == '-' ? Kind::minus : Kind::plus, text_.at());
            text_.step();
            return {};
        }
        complete = true;
        return read_decimal(text_, out);
    }

    ProgramStatus begin_parameter(Kind kind, Decimal& out, bool& complete) noexcept {
        const std::size_t start = text_.at();
        text_.step(); // the #
        if (text_.peek() != '<') {
            wait(kind, start);
            return {};
        }
        complete = true;
        std::string_view name;
        const ProgramStatus status = take_name(name);
        return status.ok() ? find(kind, start, 0, name, out) : status;
    }

    ProgramStatus begin_function(Decimal& out, bool& complete) noexcept {
        const std::size_t start = text_.at();
        const FunctionRow* row = take_function(text_);
        if (row == nullptr) {
            return ProgramError::function_unknown;
        }
        if (!text_.take('[')) {
            return ProgramError::bracket_missing;
        }
        if (row->name == Function::exists) {
            return text_.peek() == '#' ? begin_parameter(Kind::existence, out, complete)
                                       : ProgramStatus(ProgramError::parameter_name_invalid);
        }
        wait(Kind::function, start).function = row->name;
        return {};
    }

    // The value is complete: the newest that waits takes it, and makes of it another, or waits for more.
    ProgramStatus use(Decimal& out, bool& complete) noexcept {
        const Pending top = pending_[count_ - 1];
        switch (top.kind) {
        case Kind::minus: out = out == vacant ? out : -out; [[fallthrough]];
        case Kind::plus: --count_; return {};
        case Kind::parameter:
        case Kind::existence: --count_; return use_number(top, out);
        case Kind::operation:
        case Kind::bracket:
        case Kind::function:
        case Kind::divisor:
        case Kind::whole: break;
        }
        TextCursor ahead = text_;
        const OperatorRow* const next = take_operator(ahead);
        if (next != nullptr && macros_ && mixes_logic(next->name)) {
            return ProgramError::logic_ambiguous;
        }
        if (next != nullptr && next->level > top.level) {
            Pending& operation = wait(Kind::operation, text_.at());
            operation.operation = next->name;
            operation.level = static_cast<std::uint8_t>(next->level);
            operation.left = out.raw;
            text_ = ahead;
            complete = false;
            return {};
        }
        --count_;
        if (top.kind == Kind::whole) {
            return {};
        }
        return top.kind == Kind::operation ? placed(top, operate(top.operation, {top.left}, out))
                                           : close(top, out, complete);
    }

    ProgramStatus operate(Operator name, Decimal left, Decimal& out) const noexcept {
        return macros_ ? apply_macro(name, left, out, out) : apply(name, left, out, out);
    }

    ProgramStatus call(Function name, Decimal& out) const noexcept {
        return macros_ ? apply_macro(name, out, unit_, out) : apply(name, out, out);
    }

    // Controls do not agree on what binds more: AND, OR and XOR beside others within the same brackets.
    bool mixes_logic(Operator next) noexcept {
        std::size_t at = count_ - 1;
        while (at > 0 && pending_[at].kind == Kind::operation) {
            --at;
        }
        const Operator kind = is_logic(next) ? next : Operator::plus;
        Operator& known = pending_[at].operation;
        known = known == Operator::none ? kind : known;
        return known != kind;
    }

    // Its ].
    ProgramStatus close(const Pending& top, Decimal& out, bool& complete) noexcept {
        if (!text_.take(']')) {
            return text_.at_end() ? ProgramError::bracket_missing : ProgramError::operator_unknown;
        }
        if (top.kind == Kind::divisor) {
            out = angle_of(macros_ ? value_or_zero(out) : out, {top.left});
            out = macros_ ? positive_angle(out) : out;
        } else if (top.kind == Kind::function && top.function != Function::atan) {
            return placed(top, call(top.function, out));
        } else if (top.kind == Kind::function) {
            if (!text_.take('/') || !text_.take('[')) {
                return ProgramError::atan_needs_two;
            }
            wait(Kind::divisor, text_.at()).left = macros_ ? value_or_zero(out).raw : out.raw;
            complete = false;
        }
        return {};
    }

    // An error of what waited is at its beginning.
    ProgramStatus placed(const Pending& of, ProgramStatus status) noexcept {
        if (!status.ok()) {
            text_.go_to(of.at);
        }
        return status;
    }

    ProgramStatus take_name(std::string_view& name) noexcept {
        const std::size_t begin = text_.at() + 1;
        const std::size_t end = text_.find('>', begin);
        if (end == text_.text().size() || end == begin) {
            return ProgramError::parameter_name_invalid;
        }
        name = text_.part(begin, end);
        text_.go_to(end + 1);
        return {};
    }

    ProgramStatus to_number(Decimal value, std::size_t start, std::int32_t& number) noexcept {
        if (value == vacant || !to_integer(value, number) || number < (macros_ ? 0 : 1) ||
            (!macros_ && number > most_parameters)) {
            text_.go_to(start);
            return ProgramError::parameter_out_of_range;
        }
        return {};
    }

    ProgramStatus use_number(const Pending& top, Decimal& out) noexcept {
        TextCursor behind = text_;
        behind.go_to(top.at);
        behind.step();
        std::int32_t number = 0;
        const ProgramStatus status = to_number(out, behind.at(), number);
        return status.ok() ? find(top.kind, top.at, number, {}, out) : status;
    }

    // What the parameter is worth, or whether it has a value.
    ProgramStatus find(Kind kind, std::size_t start, std::int32_t number, std::string_view name,
                       Decimal& out) noexcept {
        const bool owned = SystemParameters::owns(number);
        if (macros_ && table_.refuses(number, ParameterAccess::read, owned)) {
            text_.go_to(start);
            return ProgramError::parameter_refused;
        }
        out = owned ? system_.read(number) : Decimal{};
        const bool is_set =
            owned || (name.empty() ? table_.read(number, out) : system_.read(name, out) || table_.read(name, out));
        if (macros_ && kind == Kind::parameter && (is_set ? out == vacant : name.empty())) {
            out = vacant;
            return {};
        }
        if (kind == Kind::existence) {
            out = truth(is_set && out != vacant);
            return text_.take(']') ? ProgramStatus{} : ProgramStatus(ProgramError::bracket_missing);
        }
        const bool fits =
            out.raw <= Decimal::largest_raw && out.raw >= -Decimal::largest_raw; // a table may hold anything
        if ((is_set || name.empty()) && fits) {
            return {};
        }
        text_.go_to(start);
        const bool of_linuxcnc = name.size() > 4 && name[4] == '['; // _hal[ and _ini[, without memchr on boards
        return !fits         ? ProgramError::number_out_of_range
               : of_linuxcnc ? ProgramError::parameter_of_linuxcnc
                             : ProgramError::parameter_unset;
    }

    TextCursor& text_;
    SystemParameters system_;
    const ParameterTable& table_;
    Decimal unit_; // of ROUND
    bool macros_;
    std::array<Pending, most_pending> pending_; // not initialised: a value needs hardly any of it
    std::size_t count_ = 0;
    unsigned depth_ = 0; // of the value that nothing waits for
};

} // namespace

ProgramStatus Expression::value(TextCursor& text, const BlockInterpreter& control, Decimal& out, char letter) noexcept {
    return Parser(text, control, *table_, unit_of(letter, control.modal().inches)).value(out);
}

ProgramStatus Expression::assignment(TextCursor& text, const BlockInterpreter& control) noexcept {
    const TextCursor start = text;
    if (count_ == most_assignments) {
        return ProgramError::too_many_assignments;
    }
    Assignment& next = assignments_[static_cast<unsigned>(count_)];
    Parser parser(text, control, *table_, {Decimal::one});
    if (const ProgramStatus status = parser.parameter_name(next.number, next.name); !status.ok()) {
        return status;
    }
    if (!text.take('=')) {
        return ProgramError::assignment_invalid;
    }
    if (const ProgramStatus status = parser.assigned(next.value); !status.ok()) {
        return status;
    }
    Decimal unused;
    const bool owned = SystemParameters::owns(next.number);
    const bool numbered = next.name.empty();
    if (numbered && control.rules().macros &&
        (next.number == 0 || table_->refuses(next.number, ParameterAccess::write, owned))) {
        text = start;
        return ProgramError::parameter_refused;
    }
    if (numbered ? owned && !SystemParameters::can_write(next.number)
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
