// SPDX-License-Identifier: MIT
// trimmed: a text without the blanks around it.
#pragma once

#include <string_view>

namespace splinefeed::host {

/// Without spaces, tabs and carriage returns at its ends.
[[nodiscard]] constexpr std::string_view trimmed(std::string_view text) noexcept {
    constexpr std::string_view blanks = " \t\r";
    const std::size_t first = text.find_first_not_of(blanks);
    return first == std::string_view::npos ? std::string_view{}
                                           : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

} // namespace splinefeed::host
