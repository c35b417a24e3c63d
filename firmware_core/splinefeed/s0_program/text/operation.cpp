// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/text/operation.hpp"

#include "splinefeed/s0_program/text/elementary.hpp"

namespace splinefeed {

namespace {

constexpr Decimal equal_within{1000}; // 1e-6

constexpr OperatorRow operators[] = {
    OperatorRow{"**", Operator::power, strongest_level},
    OperatorRow{"*", Operator::times, 4},
    OperatorRow{"/", Operator::divided, 4},
    OperatorRow{"mod", Operator::modulo, 4},
    OperatorRow{"+", Operator::plus, 3},
    OperatorRow{"-", Operator::minus, 3},
    OperatorRow{"eq", Operator::eq, 2},
    OperatorRow{"ne", Operator::ne, 2},
    OperatorRow{"gt", Operator::gt, 2},
    OperatorRow{"ge", Operator::ge, 2},
    OperatorRow{"lt", Operator::lt, 2},
    OperatorRow{"le", Operator::le, 2},
    OperatorRow{"and", Operator::logic_and, 1},
    OperatorRow{"or", Operator::logic_or, 1},
    OperatorRow{"xor", Operator::logic_xor, 1},
};

constexpr FunctionRow functions[] = {
    FunctionRow{"sin", Function::sine},  FunctionRow{"cos", Function::cosine},    FunctionRow{"tan", Function::tangent},
    FunctionRow{"asin", Function::asin}, FunctionRow{"acos", Function::acos},     FunctionRow{"atan", Function::atan},
    FunctionRow{"sqrt", Function::root}, FunctionRow{"abs", Function::abs},       FunctionRow{"exp", Function::exp},
    FunctionRow{"ln", Function::ln},     FunctionRow{"round", Function::round},   FunctionRow{"fix", Function::fix},
    FunctionRow{"fup", Function::fup},   FunctionRow{"exists", Function::exists},
};

// Symmetric and below the range of the integers: signs change, and parts are cut off or rounded up, without overflow.
ProgramStatus checked(detail::Checked result, Decimal& out) noexcept {
    out.raw = result.raw;
    const bool fits = result.fits && result.raw <= Decimal::largest_raw && result.raw >= -Decimal::largest_raw;
    return fits ? ProgramStatus{} : ProgramStatus(ProgramError::result_out_of_range);
}

ProgramStatus divide_rounded(Decimal a, Decimal b, Decimal& out) noexcept {
    if (b.raw == 0) {
        return ProgramError::division_by_zero;
    }
    const detail::Checked size = product_quotient(a.raw, Decimal::one, detail::magnitude(b.raw));
    return checked({b.raw < 0 ? -size.raw : size.raw, size.fits}, out);
}

bool near(Decimal a, Decimal b) noexcept {
    const detail::Checked apart = detail::checked_difference(a.raw, b.raw);
    return apart.raw < equal_within.raw && apart.raw > -equal_within.raw;
}

Decimal floor_of(Decimal x) noexcept {
    const std::int64_t rest = x.raw % Decimal::one;
    return {x.raw - rest - (rest < 0 ? Decimal::one : 0)};
}

} // namespace

const OperatorRow* take_operator(TextCursor& text) noexcept {
    for (const OperatorRow& row : operators) {
        if (text.take(row.text)) {
            return &row;
        }
    }
    return nullptr;
}

const FunctionRow* take_function(TextCursor& text) noexcept {
    for (const FunctionRow& row : functions) {
        if (text.take(row.text)) {
            return &row;
        }
    }
    return nullptr;
}

ProgramStatus apply(Operator name, Decimal a, Decimal b, Decimal& out) noexcept {
    switch (name) {
    case Operator::power: {
        const ProgramResult<Decimal> result = power(a, b);
        if (!result.has_value()) {
            return result.error();
        }
        return checked({result->raw, true}, out);
    }
    case Operator::times: return checked(product_quotient(a.raw, b.raw, static_cast<std::uint64_t>(Decimal::one)), out);
    case Operator::divided: return divide_rounded(a, b, out);
    case Operator::modulo:
        if (b.raw == 0) {
            return ProgramError::division_by_zero;
        }
        out.raw = a.raw % b.raw;
        out.raw += out.raw < 0 ? static_cast<std::int64_t>(detail::magnitude(b.raw)) : 0;
        return {};
    case Operator::plus: return checked(detail::checked_sum(a.raw, b.raw), out);
    case Operator::minus: return checked(detail::checked_difference(a.raw, b.raw), out);
    case Operator::eq: out = truth(near(a, b)); return {};
    case Operator::ne: out = truth(!near(a, b)); return {};
    case Operator::gt: out = truth(a > b); return {};
    case Operator::ge: out = truth(a > b || near(a, b)); return {};
    case Operator::lt: out = truth(a < b); return {};
    case Operator::le: out = truth(a < b || near(a, b)); return {};
    case Operator::logic_and: out = truth(a.raw != 0 && b.raw != 0); return {};
    case Operator::logic_or: out = truth(a.raw != 0 || b.raw != 0); return {};
    case Operator::logic_xor: out = truth((a.raw != 0) != (b.raw != 0)); return {};
    case Operator::none: break;
    }
    return ProgramError::operator_unknown;
}

ProgramStatus apply(Function name, Decimal x, Decimal& out) noexcept {
    constexpr Decimal one{Decimal::one};
    switch (name) {
    case Function::sine: out = turned(one, sine_cosine(x).sine); return {};
    case Function::cosine: out = turned(one, sine_cosine(x).cosine); return {};
    case Function::tangent: {
        const SineCosine at = sine_cosine(x);
        if (at.cosine == 0) {
            return ProgramError::result_out_of_range;
        }
        const detail::Checked size = product_quotient(at.sine, Decimal::one, detail::magnitude(at.cosine));
        return checked({at.cosine < 0 ? -size.raw : size.raw, size.fits}, out);
    }
    case Function::asin:
    case Function::acos: {
        if (x > one || x < -one) {
            return ProgramError::arc_function_argument;
        }
        // sqrt(1 - x^2) in units of 1e-9, from the exact square
        const std::uint64_t size = detail::magnitude(x.raw);
        const std::uint64_t square =
            static_cast<std::uint64_t>(Decimal::one) * static_cast<std::uint64_t>(Decimal::one);
        // both scaled by 2^30: the root keeps its digits near +-1
        const Wide rest = shift_left(Wide{0U, square - size * size}, 60);
        const Decimal other{static_cast<std::int64_t>(square_root_rounded(rest))};
        const Decimal scaled{x.raw * (std::int64_t{1} << 30)};
        out = name == Function::asin ? angle_of(other, scaled) : angle_of(scaled, other);
        return {};
    }
    case Function::root:
        if (x.raw < 0) {
            return ProgramError::root_of_negative;
        }
        out = square_root(x);
        return {};
    case Function::abs: out.raw = x.raw < 0 ? -x.raw : x.raw; return {};
    case Function::exp: {
        const ProgramResult<Decimal> result = exponential(x);
        if (!result.has_value()) {
            return result.error();
        }
        return checked({result->raw, true}, out);
    }
    case Function::ln:
        if (x.raw <= 0) {
            return ProgramError::logarithm_argument;
        }
        out = logarithm(x);
        return {};
    case Function::round:
        out.raw = (x.raw + (x.raw < 0 ? -(Decimal::one / 2) : Decimal::one / 2)) / Decimal::one * Decimal::one;
        return {};
    case Function::fix: out = floor_of(x); return {};
    case Function::fup: out = -floor_of(-x); return {};
    case Function::atan:
    case Function::exists: break;
    }
    return ProgramError::function_unknown;
}

} // namespace splinefeed
