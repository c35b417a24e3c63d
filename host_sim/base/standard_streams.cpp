// SPDX-License-Identifier: MIT
#include "host_sim/base/standard_streams.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/output_file.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <unistd.h>

namespace splinefeed::host {

namespace {

constexpr int none_drawn = -1;
std::atomic<int> drawn{none_drawn}; // where there is a drawn line

} // namespace

// In the order of their numbers, so that each gets its own. Input that can only be written and output that can only be
// read are errors when they are used.
void keep_standard_streams() noexcept {
    constexpr int modes[] = {O_WRONLY, O_RDONLY, O_WRONLY};
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
        if (fcntl(stream, F_GETFD) == -1 && errno == EBADF) {
            static_cast<void>(open("/dev/null", modes[stream])); // NOLINT(cppcoreguidelines-pro-type-vararg)
        }
    }
}

void draw_line(int descriptor, std::string_view text) noexcept {
    drawn.store(text.empty() ? none_drawn : descriptor);
    constexpr std::string_view erase_rest = "\x1b[K"; // of the line
    std::array<char, 256> line{'\r'};
    const std::string_view shown = text.substr(0, std::min(text.size(), line.size() - 1 - erase_rest.size()));
    char* const end = std::ranges::copy(erase_rest, std::ranges::copy(shown, &line[1]).out).out;
    [[maybe_unused]] const ssize_t written =
        write(descriptor, line.data(), static_cast<std::size_t>(end - line.data()));
}

void erase_drawn_line() noexcept {
    if (const int descriptor = drawn.load(); descriptor != none_drawn) {
        draw_line(descriptor, {});
    }
}

void tell(std::string_view text) noexcept {
    erase_drawn_line();
    while (!text.empty()) {
        const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
        if (written > 0) {
            text.remove_prefix(static_cast<std::size_t>(written));
        } else if (written == 0 || errno != EINTR) {
            return;
        }
    }
}

void print_whole(std::string_view text, std::string_view what) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
        throw OutputError("standard output: {} cannot be written; keep its reader running to the end", what);
    }
}

void tell_note(std::string_view note) {
    if (!note.empty()) {
        tell("splinefeed: note: {}\n", printable(note));
    }
}

} // namespace splinefeed::host
