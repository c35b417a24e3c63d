// SPDX-License-Identifier: MIT
// standard_streams: messages on standard error, texts on standard output, and standard streams that the process was
// started without.
#pragma once

#include <chrono>
#include <fmt/format.h>
#include <memory>
#include <string_view>
#include <thread>
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

/// While an object exists, tell() hands its text to a thread and never waits: who stops a machine must not wait until
/// somebody reads. At most `most_waiting` texts wait; then the oldest is dropped, and a line says how many were.
/// One object at a time.
class BackgroundTelling {
public:
    static constexpr std::size_t most_waiting = 1000;

    BackgroundTelling();
    BackgroundTelling(const BackgroundTelling&) = delete;
    BackgroundTelling& operator=(const BackgroundTelling&) = delete;
    /// Waits a second at most for what was told. Where nobody has read it, tell() does nothing from then on.
    ~BackgroundTelling();

private:
    struct Shared;
    friend void tell(std::string_view text) noexcept;
    friend void await_told(std::chrono::milliseconds most) noexcept;

    static void work(const std::shared_ptr<Shared>& shared) noexcept;
    [[nodiscard]] static std::shared_ptr<Shared> present() noexcept;

    static std::shared_ptr<Shared> present_; // null: there is no object
    std::thread thread_;
};

/// Waits until all that was told is written, but no longer than that.
void await_told(std::chrono::milliseconds most) noexcept;

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
