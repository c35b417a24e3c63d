// SPDX-License-Identifier: MIT
#include "host_sim/base/signal_watch.hpp"

#include <algorithm>
#include <array>

#include <pthread.h>

namespace splinefeed::host {

namespace {

constexpr std::array end_signals{SIGINT, SIGTERM, SIGHUP};
constexpr std::array steering_signals{SIGUSR1, SIGUSR2};
constexpr int wake_up = SIGURG; // ends the thread; its default is to be ignored

bool ignored(int signal) {
    struct sigaction action {};
    return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

} // namespace

std::atomic<int> SignalWatch::interrupts_{0};

SignalWatch::SignalWatch(std::function<void()> at_once) : at_once_(std::move(at_once)) {
    interrupts_.store(0);
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
    thread_ = std::thread([this] { work(); });
}

SignalWatch::~SignalWatch() {
    ends_.store(true);
    pthread_kill(thread_.native_handle(), wake_up);
    thread_.join();
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

void SignalWatch::work() noexcept {
    while (!ends_.load()) {
        int signal = 0;
        if (sigwait(&taken_, &signal) != 0 || signal == wake_up) {
            continue;
        }
        if (signal == SIGUSR1 || signal == SIGUSR2) {
            steering_.store(signal == SIGUSR1 ? UserSteering::hold : UserSteering::resume);
            continue;
        }
        // Under the lock: whoever takes the request over sees the count, or at_once was called.
        const std::lock_guard lock(mutex_);
        interrupts_.fetch_add(1);
        if (at_once_) {
            at_once_();
        }
    }
}

} // namespace splinefeed::host
