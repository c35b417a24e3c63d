// SPDX-License-Identifier: MIT
// InputQuestion: how M66 waits for an input, and its answer.
#pragma once

#include "splinefeed/s0_program/program_event.hpp"

#include <cstdint>
#include <optional>

namespace splinefeed::host {

/// By readings of the input. A change is one between two of them.
class InputQuestion {
public:
    static constexpr int timed_out = -1; ///< the answer, #5399, as in LinuxCNC

    /// @param timeout_s  not for InputWait::now   @param now_us  when it begins
    InputQuestion(InputWait wait, double timeout_s, std::uint64_t now_us) noexcept;

    /// Takes a reading that was asked for at that instant, since it began. Returns the answer, the level as 0 or 1, or
    /// timed_out; nothing: it waits on. What is not read is no time-out: the last reading decides.
    [[nodiscard]] std::optional<int> take(bool active, std::uint64_t asked_us) noexcept;

private:
    InputWait wait_;
    std::uint64_t until_us_;
    std::optional<bool> before_; // the reading before
};

} // namespace splinefeed::host
