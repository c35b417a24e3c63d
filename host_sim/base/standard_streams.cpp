// SPDX-License-Identifier: MIT
#include "host_sim/base/standard_streams.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>

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
    char* const end = std::copy(erase_rest.begin(), erase_rest.end(), std::copy(shown.begin(), shown.end(), &line[1]));
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

} // namespace splinefeed::host
