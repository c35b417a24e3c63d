// SPDX-License-Identifier: MIT
// option_number: the number behind an option of the command line.
#pragma once

#include <string_view>

namespace splinefeed::host {

/// A decimal number (number_text.hpp) from `low` to `high`; anything else is a UsageError that names the option.
/// @param what  the number, in "... is out of range; it must lie between ..."
[[nodiscard]] double read_option_number(std::string_view option, std::string_view text, double low, double high,
                                        std::string_view what = "it");

/// The same, whole.
[[nodiscard]] int read_option_integer(std::string_view option, std::string_view text, int low, int high);

} // namespace splinefeed::host
