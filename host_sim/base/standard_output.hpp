// SPDX-License-Identifier: MIT
// print_whole: a text on standard output, or an error.
#pragma once

#include <string_view>

namespace splinefeed::host {

/// Writes the text and flushes. Throws OutputError where not all of it could be written. @param what  "the summary"
void print_whole(std::string_view text, std::string_view what);

} // namespace splinefeed::host
