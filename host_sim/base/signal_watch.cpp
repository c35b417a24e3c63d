// SPDX-License-Identifier: MIT
#include "host_sim/base/signal_watch.hpp"

#include <algorithm>
#include <array>

#include <cerrno>
#include <ctime>
#include <pthread.h>
#include <unistd.h>

namespace splinefeed::host {

namespace {

constexpr std::array end_signals{SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU};
constexpr std::array steering_signals{SIGUSR1, SIGUSR2, SIGTSTP, SIGCONT, SIGTTIN, SIGTTOU};
constexpr int wake_up = SIGURG; // ends the thread; its default is to be ignored

bool ignored(int signal) {
    struct sigaction action {};
    return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

UserSteering steering_of(int signal) {
    switch (signal) {
    case SIGUSR1: return UserSteering::hold;
    case SIGUSR2: return UserSteering::resume;
    case SIGTSTP: return UserSteering::suspend;
    case SIGCONT: return UserSteering::held;
    default: return UserSteering::none;
    }
}

} // namespace

std::atomic<int> SignalWatch::interrupts_{0};
std::atomic<bool> SignalWatch::may_suspend_{false};

SignalWatch::SignalWatch(std::function<void()> at_once) : at_once_(std::move(at_once)) {
    interrupts_.store(0);
    may_suspend_.store(false);
    sigemptyset(&taken_);
    sigaddset(&taken_, wake_up);
    const auto take = [this](int signal) {
        if (!ignored(signal)) {
            sigaddset(&taken_, signal);
        }
    };
    std::ranges::for_each(end_signals, take);
    std::ranges::for_each(steering_signals, take);
    pthread_sigmask(SIG_BLOCK, &taken_, &before_);
    telling_.emplace();
    thread_ = std::thread([this] { work(); });
}

SignalWatch::~SignalWatch() {
    ends_.store(true);
    pthread_kill(thread_.native_handle(), wake_up);
    thread_.join();
    telling_.reset();
    for (const int signal : end_signals) {
        if (sigismember(&taken_, signal) == 1) {
            sigaddset(&before_, signal);
        }
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void SignalWatch::at_once(std::function<void()> action) {
    const std::lock_guard lock(mutex_);
    at_once_ = std::move(action);
}

// A signal that the thread was not woken for is still pending. SIGSTOP would discard a SIGCONT among them.
bool SignalWatch::suspend_now() noexcept {
    sigset_t pending;
    sigpending(&pending);
    const auto waits = [&](int signal) {
        return sigismember(&pending, signal) == 1;
    };
    if (!may_suspend_.load() || waits(SIGCONT) || std::ranges::any_of(end_signals, waits)) {
        return false;
    }
    await_told(std::chrono::milliseconds(100));
    return kill(getpid(), SIGSTOP) == 0;
}

void SignalWatch::steer(int signal) noexcept {
    const UserSteering steering = steering_of(signal);
    const std::lock_guard lock(mutex_);
    if (steering != UserSteering::none && steering != UserSteering::hold) {
        may_suspend_.store(steering == UserSteering::suspend);
    }
    if (steering == UserSteering::suspend && at_once_) {
        static_cast<void>(suspend_now());
    } else if (steering != UserSteering::none && !(steering == UserSteering::held && at_once_)) {
        asked_to_suspend_ = steering == UserSteering::suspend;
        steering_.store(steering);
    }
}

void SignalWatch::work() noexcept {
    while (!ends_.load()) {
        constexpr timespec soon{.tv_sec = 1, .tv_nsec = 0};
        const bool asks = asked_to_suspend_ && steering_.load() == UserSteering::suspend;
        const int signal = asks ? sigtimedwait(&taken_, nullptr, &soon) : sigwaitinfo(&taken_, nullptr);
        if (signal < 0 && errno == EAGAIN && steering_.load() == UserSteering::suspend) {
            asked_to_suspend_ = false; // told once
            tell("splinefeed: the machine is not held yet, since it is made ready or looks for its references; the "
                 "process stops as soon as it is held; Ctrl-C ends the run\n");
        }
        if (signal < 0 || signal == wake_up) {
            continue;
        }
        if (std::ranges::find(end_signals, signal) == end_signals.end()) {
            steer(signal);
            continue;
        }
        // Under the lock: whoever takes the request over sees the count, or at_once was called.
        const std::lock_guard lock(mutex_);
        may_suspend_.store(false);
        interrupts_.fetch_add(1);
        if (at_once_) {
            at_once_();
        }
    }
}

} // namespace splinefeed::host
