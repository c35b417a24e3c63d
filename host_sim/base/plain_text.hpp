// SPDX-License-Identifier: MIT
// plain_text: what counts as text, the same for every input: ASCII or UTF-8, in lines that end with \n or \r\n.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace splinefeed::host {

/// A line without its \n, as all inputs take it: without the mark of UTF-8 on the first line, the \r at its end and, on
/// the last one, the Ctrl-Z at its end, as DOS wrote it. Throws InputError for UTF-16, a NUL byte, and a CR alone.
/// @param last  the input ends with it
[[nodiscard]] std::string_view plain_line(std::string_view line, const std::string& file, std::uint64_t number,
                                          bool last);

/// A whole text by the same rules; line ends stay.
[[nodiscard]] std::string_view plain_text(std::string_view text, const std::string& file);

} // namespace splinefeed::host
