// SPDX-License-Identifier: MIT
// SignalWatch: the signals of a run, received by a thread of its own.
#pragma once

#include "host_sim/base/standard_streams.hpp"

#include <atomic>
#include <csignal>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

namespace splinefeed::host {

/// What the user requests by signals.
enum class UserSteering {
    none,
    hold,
    resume,
    suspend, ///< a hold, and then the process stops: suspend_now()
    held,    ///< the process was stopped and continues: the motion does not
};

/// While an object exists, SIGINT, SIGTERM, SIGHUP, SIGQUIT and SIGXCPU request the end of the run, and each of them
/// counts. SIGUSR1 requests a feed hold and SIGUSR2 its end. SIGTSTP requests a hold, too, and that the process then
/// stops; SIGCONT, by which a process goes on that was stopped, a hold. SIGTTIN and SIGTTOU, which would stop a
/// process in the background in the middle of a motion, do nothing. All these signals are blocked in the thread that
/// creates the object and in every thread started from there, so they interrupt none of their system calls. A signal
/// that the process ignored when it was started (nohup; a shell's background job) stays ignored. Only one object at a
/// time.
///
/// Nobody else knows that a request to suspend comes before anybody can obey it: where it was not taken within a
/// second, the thread says so.
///
/// What is told meanwhile is written by a thread of its own (BackgroundTelling): whoever obeys a signal waits for
/// nobody who reads.
///
/// The kernel keeps one pending signal of each kind: two of a kind count as one if both come before the thread was
/// woken for the first.
class SignalWatch {
public:
    /// Starts the thread. @param at_once  called by it for every request to end, until supervise(). May be empty. As
    /// long as there is one, nothing moves, and SIGTSTP stops the process at once.
    explicit SignalWatch(std::function<void()> at_once);
    SignalWatch(const SignalWatch&) = delete;
    SignalWatch& operator=(const SignalWatch&) = delete;
    /// What steers has its former effect again. What requests an end stays blocked: the run has said how it ended, and
    /// a request that comes before the process has exited must not change its exit status.
    ~SignalWatch();

    /// From here on somebody checks interrupts(): at_once is no longer called.
    void supervise() { at_once({}); }
    /// Replaces the function that is called. Waits for a call that is running.
    void at_once(std::function<void()> action);

    /// Requests to end since the present object was created.
    [[nodiscard]] static int interrupts() noexcept { return interrupts_.load(); }
    [[nodiscard]] static bool interrupted() noexcept { return interrupts() > 0; }
    /// Stops the process, as SIGSTOP does. Returns true when it continues; UserSteering::held follows. Returns false at
    /// once where a signal came behind the SIGTSTP that steers otherwise: nobody would continue the process again.
    [[nodiscard]] static bool suspend_now() noexcept;
    /// The last request that was not taken yet.
    [[nodiscard]] UserSteering take_steering() noexcept { return steering_.exchange(UserSteering::none); }

private:
    void work() noexcept;
    void steer(int signal) noexcept;

    sigset_t taken_{};
    sigset_t before_{};
    static std::atomic<int> interrupts_;   // ports read it through a plain function
    static std::atomic<bool> may_suspend_; // the last signal was SIGTSTP
    std::atomic<UserSteering> steering_{UserSteering::none};
    bool asked_to_suspend_ = false; // used by the thread
    std::atomic<bool> ends_{false};
    std::mutex mutex_; // protects the members below
    std::function<void()> at_once_;
    std::optional<BackgroundTelling> telling_; // its thread has the signals blocked
    std::thread thread_;
};

} // namespace splinefeed::host
