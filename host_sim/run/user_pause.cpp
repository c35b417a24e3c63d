// SPDX-License-Identifier: MIT
#include "host_sim/run/user_pause.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/signal_watch.hpp"
#include "host_sim/base/standard_streams.hpp"

#include <algorithm>
#include <array>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace splinefeed::host {

using std::chrono::steady_clock;

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

void UserSuspend::ask() noexcept {
    since_ = steady_clock::now();
    stands_after_.reset();
}

void UserSuspend::follow(bool moves, std::uint64_t submitted, std::uint64_t executed, bool spindle_stands) {
    if (!since_) {
        return;
    }
    if (!moves && !stands_after_) {
        stands_after_ = submitted;
    }
    if (stands_after_ && executed >= *stands_after_) {
        forget();
        tell("splinefeed: the machine is held, and the process stops: until it continues nobody watches {}; fg or kill "
             "-CONT {} continues it, and then kill -USR2 {} the motion\n",
             spindle_stands ? "e-stop lines, switches and drives"
                            : "e-stop lines, switches, drives and the spindle, which turns on",
             getpid(), getpid());
        static_cast<void>(SignalWatch::suspend_now());
    } else if (steady_clock::now() > *since_ + most) {
        forget();
        tell("splinefeed: the machine does not come to a hold, so the process does not stop; Ctrl-C ends the run\n");
    }
}

void UserSuspend::tell_held() {
    tell("splinefeed: the machine is held; the motion goes on with kill -USR2 {}\n", getpid());
}

} // namespace splinefeed::host
