// SPDX-License-Identifier: MIT
// SignalWatch: the signals of a run, taken by a thread of its own.
#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <mutex>
#include <thread>

namespace splinefeed::host {

/// What the user asks for by signals.
enum class UserSteering { none, hold, resume };

/// While one lives, SIGINT, SIGTERM and SIGHUP ask for an end, and each of them counts; SIGUSR1 asks for a feed hold
/// and SIGUSR2 for its end. All five are blocked in the thread that makes it and in every thread that is started from
/// there, so that no system call of theirs is interrupted. A signal that the process ignored when it was started
/// (nohup; a shell's background job) stays ignored. One at a time.
///
/// The kernel keeps one pending signal of a kind: two of a kind count as one if they come before the thread was woken
/// up for the first.
class SignalWatch {
public:
    /// Starts the thread. @param at_once  called from it for every request of an end, until supervise(). May be empty.
    explicit SignalWatch(std::function<void()> at_once);
    SignalWatch(const SignalWatch&) = delete;
    SignalWatch& operator=(const SignalWatch&) = delete;
    /// Signals have their former effect again.
    ~SignalWatch();

    /// From here on somebody looks at interrupts(): at_once is not called any more.
    void supervise() { at_once({}); }
    /// What is called from here on. Waits for a call that is running.
    void at_once(std::function<void()> action);

    /// Requests of an end since the one that lives was made.
    [[nodiscard]] static int interrupts() noexcept { return interrupts_.load(); }
    [[nodiscard]] static bool interrupted() noexcept { return interrupts() > 0; }
    /// The last of SIGUSR1 and SIGUSR2 that was not taken yet.
    [[nodiscard]] UserSteering take_steering() noexcept { return steering_.exchange(UserSteering::none); }

private:
    void work() noexcept;

    sigset_t taken_{};
    sigset_t before_{};
    static std::atomic<int> interrupts_; // ports ask for it by a plain function
    std::atomic<UserSteering> steering_{UserSteering::none};
    std::atomic<bool> ends_{false};
    std::mutex mutex_; // of what follows
    std::function<void()> at_once_;
    std::thread thread_;
};

} // namespace splinefeed::host
