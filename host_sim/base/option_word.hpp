// SPDX-License-Identifier: MIT
// option_word: what a command-line option takes that takes one of a few words.
#pragma once

#include <initializer_list>
#include <string_view>

namespace splinefeed::host {

/// Throws a UsageError that names the option, the words and the nearest one, unless the value is one of them.
void require_word(std::string_view option, std::string_view value, std::initializer_list<std::string_view> words);

} // namespace splinefeed::host
