// SPDX-License-Identifier: MIT
// InputError and UsageError: bad input and a wrong command line, each reported in one line; the tool then exits with
// status 2.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace splinefeed::host {

/// The text on one line of a terminal: control characters become \xNN.
[[nodiscard]] std::string printable(std::string_view text);

/// printable(), in single quotes, shortened to the part that helps to find the place.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// "FILE:LINE: what is wrong, what would be right". Without a line (0) or a file (empty) that part is left out.
struct InputError : std::runtime_error {
    InputError(std::string_view file, std::uint64_t line, std::string_view text);
    /// "FILE:LINE:COLUMN: ..."; a column of 0 is left out.
    InputError(std::string_view file, std::uint64_t line, std::uint64_t column, std::string_view text);
};

/// What is wrong with the command line, and what would be right.
struct UsageError : std::runtime_error {
    explicit UsageError(std::string_view text) : std::runtime_error(printable(text)) {}
};

} // namespace splinefeed::host
