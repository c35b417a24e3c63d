// SPDX-License-Identifier: MIT
// WorkBudget: how much of its work a function may do before it returns.
#pragma once

#include <limits>

namespace splinefeed {

/// Counts steps. A step is the largest piece of work that is not interrupted; the function that takes it says what it
/// is. With any budget but an empty one there is progress.
class WorkBudget {
public:
    static constexpr unsigned unlimited = std::numeric_limits<unsigned>::max();

    /// @param steps  at least 1
    explicit constexpr WorkBudget(unsigned steps = unlimited) noexcept : steps_(steps) {}

    [[nodiscard]] constexpr bool spent() const noexcept { return steps_ == 0; }
    /// Takes a piece of work that is as long as so many steps. false: too few are left, and the rest is forfeited. The
    /// first piece of a call is always taken.
    [[nodiscard]] constexpr bool take(unsigned steps = 1) noexcept {
        const bool enough = fresh_ || steps <= steps_;
        charge(enough ? steps : steps_);
        return enough;
    }
    /// Counts steps that are done in any case, because they belong to the one before them.
    constexpr void charge(unsigned steps = 1) noexcept {
        fresh_ = false;
        if (steps_ != unlimited) {
            steps_ -= steps < steps_ ? steps : steps_;
        }
    }

private:
    unsigned steps_;
    bool fresh_ = true;
};

} // namespace splinefeed
