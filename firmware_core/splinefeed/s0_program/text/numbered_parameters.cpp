// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/text/numbered_parameters.hpp"

namespace splinefeed {

NumberedParameters::NumberedParameters(std::span<Decimal> values) noexcept : values_(values) {
    for (Decimal& value : values) {
        value = vacant;
    }
}

bool NumberedParameters::read(std::int32_t number, Decimal& out) const noexcept {
    if (!holds(number) || at(number) == vacant) {
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
    static_cast<void>(write(number, vacant));
}

bool NumberedParameters::read(std::string_view /*name*/, Decimal& /*out*/) const noexcept {
    return false;
}

bool NumberedParameters::write(std::string_view /*name*/, Decimal /*value*/) noexcept {
    return false;
}

void NumberedParameters::forget(std::string_view /*name*/) noexcept {}

} // namespace splinefeed
