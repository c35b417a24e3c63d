// SPDX-License-Identifier: MIT
#include "host_sim/run/user_suspend.hpp"

#include "host_sim/base/signal_watch.hpp"
#include "host_sim/base/standard_streams.hpp"

#include <unistd.h>

namespace splinefeed::host {

using std::chrono::steady_clock;

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
