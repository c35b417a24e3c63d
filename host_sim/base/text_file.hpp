// SPDX-License-Identifier: MIT
// text_file: a whole file, or all of standard input, as a string.
#pragma once

#include <cstddef>
#include <string>

namespace splinefeed::host {

/// Reads the file; "-" is standard input. Throws InputError where it cannot be opened or read or is larger than that.
[[nodiscard]] std::string read_text_file(const std::string& path, std::size_t largest);

/// Whether the path names a regular file, which can be read twice; false for a pipe, a terminal, or nothing at all.
[[nodiscard]] bool is_regular_file(const std::string& path);

} // namespace splinefeed::host
