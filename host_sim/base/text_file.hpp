// SPDX-License-Identifier: MIT
// text_file: reads a whole file, or all of standard input, into a string.
#pragma once

#include <cstddef>
#include <string>

namespace splinefeed::host {

/// Reads the file; "-" is standard input. Throws InputError if it cannot be opened or read, or is larger than
/// `largest`, or no plain_text(). @param name  for messages; empty: the path
[[nodiscard]] std::string read_text_file(const std::string& path, std::size_t largest, const std::string& name = {});

/// Whether the path is a regular file, which can be read twice; false for a pipe, a terminal, or if nothing is there.
[[nodiscard]] bool is_regular_file(const std::string& path);

} // namespace splinefeed::host
