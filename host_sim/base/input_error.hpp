// SPDX-License-Identifier: MIT
// InputError and UsageError: bad input and a wrong command line, each reported in one line; the tool then exits with
// status 2. Errors take what fmt::format takes, too.
#pragma once

#include <cstdint>
#include <fmt/core.h>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace splinefeed::host {

/// The text on one line of a terminal: control characters become \xNN.
[[nodiscard]] std::string printable(std::string_view text);

/// printable(), in single quotes, shortened to the part that helps to find the place.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// "FILE:LINE: what is wrong, what would be right". Without a line (0) or a file (empty) that part is left out.
struct InputError : std::runtime_error {
    InputError(std::string_view file, std::uint64_t line, std::string_view text);
    template <class First, class... Rest>
    InputError(std::string_view file, std::uint64_t line, fmt::format_string<First, Rest...> text, First&& first,
               Rest&&... rest)
        : InputError(file, line, fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...)) {}
    /// "FILE:LINE:COLUMN: ..."; a column of 0 is left out.
    InputError(std::string_view file, std::uint64_t line, std::uint64_t column, std::string_view text);
};

/// What is wrong with the command line, and what would be right.
struct UsageError : std::runtime_error {
    explicit UsageError(std::string_view text) : std::runtime_error(printable(text)) {}
    template <class First, class... Rest>
    explicit UsageError(fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest)
        : UsageError(fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...)) {}
};

/// The base of errors of other kinds.
struct TextError : std::runtime_error {
    explicit TextError(const std::string& text) : std::runtime_error(text) {}
    template <class First, class... Rest>
    explicit TextError(fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest)
        : TextError(fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...)) {}
};

} // namespace splinefeed::host
