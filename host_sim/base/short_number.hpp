// SPDX-License-Identifier: MIT
// short_number: a number as a person writes it.
#pragma once

#include <fmt/format.h>

#include <string>

namespace splinefeed::host {

/// With six decimals at most, and no more than it needs.
[[nodiscard]] inline std::string short_number(double value) {
    std::string text = fmt::format("{:.6f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') {
        text.pop_back();
    }
    return text == "-0" ? "0" : text;
}

} // namespace splinefeed::host
