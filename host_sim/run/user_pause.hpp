// SPDX-License-Identifier: MIT
// UserPause: asks the user to go on, by a line on the terminal or by a signal. UserSuspend: stops the process at the
// user's request (Ctrl-Z), once the machine stands.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace splinefeed::host {

/// For the planner's thread. Nothing here waits.
class UserPause {
public:
    /// @param terminal  its lines count while the user is asked; a descriptor of none, or -1, is not read
    explicit UserPause(int terminal);

    /// Tells why. Lines and signals from before do not count.
    void ask(const std::string& why);
    /// The user's signal to go on.
    void go_on() noexcept { answered_ = true; }
    /// Whether the user has answered since ask().
    [[nodiscard]] bool answered();

private:
    int terminal_;
    bool answered_ = false;
};

/// A process that is stopped supervises nothing, so the machine is held first. For the planner's thread.
class UserSuspend {
public:
    /// Then the process is not stopped any more. A hold takes the way to standstill and what drives have in store.
    static constexpr std::chrono::seconds most{15};

    void ask() noexcept;
    void forget() noexcept { since_.reset(); }
    [[nodiscard]] bool asked() const noexcept { return since_.has_value(); }
    /// Called often. Stops the process if it was asked to and the machine stands; returns when it continues.
    /// @param moves  the plan does not stand yet
    /// @param submitted, executed  segments
    /// @param spindle_stands  for what the user is told
    void follow(bool moves, std::uint64_t submitted, std::uint64_t executed, bool spindle_stands);
    /// The process continues: says how the motion does.
    static void tell_held();

private:
    std::optional<std::chrono::steady_clock::time_point> since_;
    std::optional<std::uint64_t> stands_after_; // so many segments
};

} // namespace splinefeed::host
