// SPDX-License-Identifier: MIT
#include "host_sim/base/option_number.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/base/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <span>

namespace splinefeed::host {

double read_option_number(std::string_view option, std::string_view text, double low, double high,
                          std::string_view what) {
    double value = 0.0;
    if (const NumberText result = read_number(text, value); result != NumberText::number) {
        throw UsageError("{} {} {}", option, in_quotes(text), why_no_number(result));
    }
    if (value < low || value > high) {
        throw UsageError("{} {} is out of range; {} must lie between {} and {}", option, in_quotes(text), what, low,
                         high);
    }
    return value;
}

int read_option_integer(std::string_view option, std::string_view text, int low, int high) {
    const double value = read_option_number(option, text, low, high);
    if (value != std::floor(value)) {
        throw UsageError("{} {}: it must be a whole number from {} to {}", option, in_quotes(text), low, high);
    }
    return static_cast<int>(value);
}

std::size_t require_word(std::string_view option, std::string_view value,
                         std::initializer_list<std::string_view> words) {
    if (const auto* const found = std::ranges::find(words, value); found != words.end()) {
        return static_cast<std::size_t>(found - words.begin());
    }
    const std::span known(words.begin(), words.size());
    const std::string_view near = nearest_name(value, known);
    throw UsageError("{} {}: it must be one of {}{}", option, in_quotes(value), listed(known),
                     near.empty() ? "" : fmt::format("; did you mean '{}'?", near));
}

} // namespace splinefeed::host
