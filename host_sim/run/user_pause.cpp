// SPDX-License-Identifier: MIT
#include "host_sim/run/user_pause.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/standard_streams.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace splinefeed::host {

UserPause::UserPause(int terminal) : terminal_(terminal >= 0 && isatty(terminal) == 1 ? terminal : -1) {}

void UserPause::ask(const std::string& why) {
    answered_ = false;
    if (terminal_ >= 0) {
        static_cast<void>(tcflush(terminal_, TCIFLUSH));
    }
    tell("splinefeed: {}; to go on {}kill -USR2 {}\n", printable(why), terminal_ >= 0 ? "press Enter, or " : "",
         getpid());
}

// In the background a terminal belongs to others: reading it would stop the process.
bool UserPause::answered() {
    const pid_t foreground = terminal_ >= 0 && !answered_ ? tcgetpgrp(terminal_) : 0;
    if (terminal_ < 0 || answered_ || (foreground > 0 && foreground != getpgrp())) {
        return answered_;
    }
    pollfd waiting{.fd = terminal_, .events = POLLIN, .revents = 0};
    if (poll(&waiting, 1, 0) == 1) {
        std::array<char, 256> line{};
        const ssize_t count = read(terminal_, line.data(), line.size());
        if (count <= 0) {
            terminal_ = -1; // it is gone; the signal is left
        } else {
            answered_ = std::find(line.begin(), line.begin() + count, '\n') != line.begin() + count;
        }
    }
    return answered_;
}

} // namespace splinefeed::host
