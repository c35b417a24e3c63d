// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/text/numbered_parameters.hpp"

#include <limits>

namespace splinefeed {

namespace {

constexpr Decimal unset{std::numeric_limits<std::int64_t>::min()}; // no value of a program

} // namespace

NumberedParameters::NumberedParameters(std::span<Decimal> values) noexcept : values_(values) {
    for (Decimal& value : values) {
        value = unset;
    }
}

bool NumberedParameters::read(std::int32_t number, Decimal& out) const noexcept {
    if (!holds(number) || at(number) == unset) {
        return false;
    }
    out = at(number);
    return true;
}

bool NumberedParameters::write(std::int32_t number, Decimal value) noexcept {
    if (!holds(number)) {
        return false;
    }
    at(number) = value;
    return true;
}

void NumberedParameters::forget(std::int32_t number) noexcept {
    static_cast<void>(write(number, unset));
}

bool NumberedParameters::read(std::string_view /*name*/, Decimal& /*out*/) const noexcept {
    return false;
}

bool NumberedParameters::write(std::string_view /*name*/, Decimal /*value*/) noexcept {
    return false;
}

void NumberedParameters::forget(std::string_view /*name*/) noexcept {}

} // namespace splinefeed
