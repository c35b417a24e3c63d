// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/text/macro_operation.hpp"

#include "splinefeed/s0_program/text/decimal_text.hpp"

namespace splinefeed {

namespace {

ProgramStatus apply_bits(Operator name, Decimal a, Decimal b, Decimal& out) noexcept {
    std::int32_t first = 0;
    std::int32_t second = 0;
    if (!to_integer(a, first) || !to_integer(b, second) || first < 0 || second < 0) {
        return ProgramError::integer_needed;
    }
    const auto x = static_cast<std::uint32_t>(first);
    const auto y = static_cast<std::uint32_t>(second);
    const std::uint32_t bits = name == Operator::logic_and ? x & y : name == Operator::logic_or ? x | y : x ^ y;
    out = Decimal::from_integer(static_cast<std::int32_t>(bits));
    return {};
}

// The multiple of `unit` below its size, or above it.
Decimal whole_units(Decimal x, Decimal unit, std::int64_t added) noexcept {
    const std::int64_t size = x.raw < 0 ? -x.raw : x.raw;
    const std::int64_t whole = (size + added) / unit.raw * unit.raw;
    return {x.raw < 0 ? -whole : whole};
}

} // namespace

ProgramStatus apply_macro(Operator name, Decimal a, Decimal b, Decimal& out) noexcept {
    const bool differs = (a == vacant) != (b == vacant);
    if (differs && (name == Operator::eq || name == Operator::ne)) {
        out = truth(name == Operator::ne);
        return {};
    }
    a = value_or_zero(a);
    b = value_or_zero(b);
    if (is_logic(name)) {
        return apply_bits(name, a, b, out);
    }
    if (name != Operator::modulo) {
        return apply(name, a, b, out);
    }
    if (b.raw == 0) {
        return ProgramError::division_by_zero;
    }
    if (a.raw % Decimal::one != 0 || b.raw % Decimal::one != 0) {
        return ProgramError::integer_needed;
    }
    out = {a.raw % b.raw};
    return {};
}

ProgramStatus apply_macro(Function name, Decimal x, Decimal unit, Decimal& out) noexcept {
    x = value_or_zero(x);
    switch (name) {
    case Function::round: out = whole_units(x, unit, unit.raw / 2); return {};
    case Function::fix: out = whole_units(x, {Decimal::one}, 0); return {};
    case Function::fup: out = whole_units(x, {Decimal::one}, Decimal::one - 1); return {};
    case Function::asin: {
        const ProgramStatus status = apply(name, x, out);
        out = positive_angle(out);
        return status;
    }
    default: return apply(name, x, out);
    }
}

} // namespace splinefeed
