// SPDX-License-Identifier: MIT
// option_number: reads the number of a command-line option, or one of a few words.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string_view>

namespace splinefeed::host {

/// A decimal number (number_text.hpp) from `low` to `high`; otherwise throws a UsageError that names the option.
/// @param what  name of the number, in "... is out of range; it must lie between ..."
[[nodiscard]] double read_option_number(std::string_view option, std::string_view text, double low, double high,
                                        std::string_view what = "it");

/// The same for an integer.
[[nodiscard]] int read_option_integer(std::string_view option, std::string_view text, int low, int high);

/// The place of the value among the words. Throws a UsageError that names the option, the words and the nearest one if
/// it is none of them.
std::size_t require_word(std::string_view option, std::string_view value,
                         std::initializer_list<std::string_view> words);

} // namespace splinefeed::host
