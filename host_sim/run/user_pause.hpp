// SPDX-License-Identifier: MIT
// UserPause: asks the user to go on, by a line on the terminal or by a signal.
#pragma once

#include <string>

namespace splinefeed::host {

/// For the planner's thread. Nothing here waits, but for a standard error whose reader does not read.
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

} // namespace splinefeed::host
