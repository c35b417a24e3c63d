// SPDX-License-Identifier: MIT
// standard_streams: messages on standard error, texts on standard output, and standard streams that the process was
// started without.
#pragma once

#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace splinefeed::host {

/// To be called before anything is opened. A file that is opened gets the lowest free number: where a standard stream
/// is closed, messages would go into an output. Such a stream is then one that cannot be read or written; what is
/// written to standard error is dropped.
void keep_standard_streams() noexcept;

/// Draws over the line of a terminal where its cursor is; empty: erases it. What the terminal does not take is dropped.
void draw_line(int descriptor, std::string_view text) noexcept;
/// Erases the line that was drawn, so that a message does not stand behind it.
void erase_drawn_line() noexcept;

/// Writes to standard error, behind a drawn line. What cannot be written is dropped: a full disk must not end a run
/// that moves a machine.
void tell(std::string_view text) noexcept;

/// A sentence that the user should know, as a line. Nothing where it is empty.
void tell_note(std::string_view note);

/// As tell(fmt::format(...)).
template <class... T>
void tell(fmt::format_string<T...> format, T&&... values) {
    tell(std::string_view(fmt::format(format, std::forward<T>(values)...)));
}

/// Writes the text and flushes. Throws OutputError where not all of it could be written. @param what  "the summary"
void print_whole(std::string_view text, std::string_view what);

} // namespace splinefeed::host
