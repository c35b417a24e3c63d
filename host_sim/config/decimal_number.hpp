// SPDX-License-Identifier: MIT
// decimal_number: the numbers of programs and state files as double, and back.
#pragma once

#include "splinefeed/s0_program/text/decimal.hpp"

#include <cmath>

namespace splinefeed::host {

/// The nearest double. Up to 2^20 decimal_of() brings it back.
[[nodiscard]] inline double number_of(Decimal value) noexcept {
    return static_cast<double>(value.raw) / static_cast<double>(Decimal::one);
}

/// The nearest Decimal. @pre |value| is below 9.2e9
[[nodiscard]] inline Decimal decimal_of(double value) noexcept {
    return {std::llround(value * static_cast<double>(Decimal::one))};
}

} // namespace splinefeed::host
