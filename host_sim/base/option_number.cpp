// SPDX-License-Identifier: MIT
#include "host_sim/base/option_number.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/number_text.hpp"

#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

double read_option_number(std::string_view option, std::string_view text, double low, double high,
                          std::string_view what) {
    double value = 0.0;
    if (const NumberText result = read_number(text, value); result != NumberText::number) {
        throw UsageError(fmt::format("{} {} {}", option, in_quotes(text), why_no_number(result)));
    }
    if (value < low || value > high) {
        throw UsageError(fmt::format("{} {} is out of range; {} must lie between {} and {}", option, in_quotes(text),
                                     what, low, high));
    }
    return value;
}

int read_option_integer(std::string_view option, std::string_view text, int low, int high) {
    const double value = read_option_number(option, text, low, high);
    if (value != std::floor(value)) {
        throw UsageError(
            fmt::format("{} {}: it must be a whole number from {} to {}", option, in_quotes(text), low, high));
    }
    return static_cast<int>(value);
}

} // namespace splinefeed::host
