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
    std::array<char, 256> line{};
    const auto end = fmt::format_to_n(line.data(), line.size(), "\r{}\x1b[K", text);
    [[maybe_unused]] const ssize_t written = write(descriptor, line.data(), std::min(end.size, line.size()));
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
