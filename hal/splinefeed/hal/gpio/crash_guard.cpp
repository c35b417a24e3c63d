// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/crash_guard.hpp"

#include <csignal>

namespace splinefeed::hal::gpio {

namespace {

/// All whose default is to end the program, but SIGKILL and the real-time signals.
constexpr std::array crashes{SIGSEGV, SIGBUS,  SIGFPE,  SIGILL,  SIGABRT, SIGQUIT,  SIGXCPU, SIGXFSZ,
                             SIGSYS,  SIGTRAP, SIGPIPE, SIGALRM, SIGTERM, SIGINT,   SIGHUP,  SIGVTALRM,
                             SIGPROF, SIGPOLL, SIGPWR,  SIGUSR1, SIGUSR2, SIGSTKFLT};

std::array<std::atomic<OutputPins*>, CrashGuard::most_chips> guarded{};
static_assert(std::atomic<OutputPins*>::is_always_lock_free);

// The thread that writes edges may continue during this handler; its last writes end when the kernel releases the
// lines.
extern "C" void make_lines_safe(int signal) {
    for (auto& lines : guarded) {
        if (OutputPins* const chip = lines.load(); chip != nullptr) {
            chip->make_safe();
        }
    }
    static_cast<void>(std::signal(signal, SIG_DFL));
    static_cast<void>(std::raise(signal));
}

void change_actions(void (*from)(int), void (*to)(int)) noexcept {
    for (const int signal : crashes) {
        struct sigaction action {};
        if (sigaction(signal, nullptr, &action) != 0 || (action.sa_flags & SA_SIGINFO) != 0 ||
            action.sa_handler != from) {
            continue;
        }
        action.sa_handler = to;
        action.sa_flags = SA_ONSTACK;
        static_cast<void>(sigaction(signal, &action, nullptr));
    }
}

} // namespace

CrashGuard::CrashGuard(std::span<OutputPins* const> chips) noexcept {
    std::size_t given = 0;
    for (std::size_t i = 0; i < most_chips && given < chips.size(); ++i) {
        if (guarded[i].load() == nullptr) {
            own_[i] = chips[given++];
            guarded[i].store(own_[i]);
        }
    }
    change_actions(SIG_DFL, make_lines_safe);
}

CrashGuard::~CrashGuard() {
    bool others = false;
    for (std::size_t i = 0; i < most_chips; ++i) {
        others = others || (own_[i] == nullptr && guarded[i].load() != nullptr);
    }
    if (!others) {
        change_actions(make_lines_safe, SIG_DFL);
    }
    for (std::size_t i = 0; i < most_chips; ++i) {
        if (own_[i] != nullptr) {
            guarded[i].store(nullptr);
        }
    }
}

} // namespace splinefeed::hal::gpio
