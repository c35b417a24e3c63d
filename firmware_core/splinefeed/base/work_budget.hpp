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
    /// Takes a step. false: none is left.
    [[nodiscard]] constexpr bool take() noexcept {
        const bool left = !spent();
        charge();
        return left;
    }
    /// Counts steps that are done in any case, because they belong to the one before them.
    constexpr void charge(unsigned steps = 1) noexcept {
        if (steps_ != unlimited) {
            steps_ -= steps < steps_ ? steps : steps_;
        }
    }

private:
    unsigned steps_;
};

} // namespace splinefeed
