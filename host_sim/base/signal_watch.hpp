// SPDX-License-Identifier: MIT
// SignalWatch: the signals of a run, received by a thread of its own.
#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <mutex>
#include <thread>

namespace splinefeed::host {

/// What the user requests by signals.
enum class UserSteering { none, hold, resume };

/// While an object exists, SIGINT, SIGTERM and SIGHUP request the end of the run, and each of them counts. SIGUSR1
/// requests a feed hold and SIGUSR2 its end. All five signals are blocked in the thread that creates the object and in
/// every thread started from there, so they interrupt none of their system calls. A signal that the process ignored
/// when it was started (nohup; a shell's background job) stays ignored. Only one object at a time.
///
/// The kernel keeps one pending signal of each kind: two of a kind count as one if both come before the thread was
/// woken for the first.
class SignalWatch {
public:
    /// Starts the thread. @param at_once  called by it for every request to end, until supervise(). May be empty.
    explicit SignalWatch(std::function<void()> at_once);
    SignalWatch(const SignalWatch&) = delete;
    SignalWatch& operator=(const SignalWatch&) = delete;
    /// SIGUSR1 and SIGUSR2 have their former effect again. SIGINT, SIGTERM and SIGHUP stay blocked: the run has said
    /// how it ended, and a request that comes before the process has exited must not change its exit status.
    ~SignalWatch();

    /// From here on somebody checks interrupts(): at_once is no longer called.
    void supervise() { at_once({}); }
    /// Replaces the function that is called. Waits for a call that is running.
    void at_once(std::function<void()> action);

    /// Requests to end since the present object was created.
    [[nodiscard]] static int interrupts() noexcept { return interrupts_.load(); }
    [[nodiscard]] static bool interrupted() noexcept { return interrupts() > 0; }
    /// The last of SIGUSR1 and SIGUSR2 that was not taken yet.
    [[nodiscard]] UserSteering take_steering() noexcept { return steering_.exchange(UserSteering::none); }

private:
    void work() noexcept;

    sigset_t taken_{};
    sigset_t before_{};
    static std::atomic<int> interrupts_; // ports read it through a plain function
    std::atomic<UserSteering> steering_{UserSteering::none};
    std::atomic<bool> ends_{false};
    std::mutex mutex_; // protects the members below
    std::function<void()> at_once_;
    std::thread thread_;
};

} // namespace splinefeed::host
