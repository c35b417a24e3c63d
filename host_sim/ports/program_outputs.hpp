// SPDX-License-Identifier: MIT
// ProgramOutputs: everything that the events of a program act on or wait for: spindle,
// coolant, digital outputs and inputs. InputQuestion: how M66 waits for an input, and its answer.
#pragma once

#include "host_sim/ports/output_parts.hpp"
#include "host_sim/program/program_action.hpp"
#include "splinefeed/hal/rt/clock.hpp"
#include "splinefeed/s0_program/words/program_event.hpp"

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

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

/// All functions return at once; but act() and update(), which one thread calls, they may be called by any thread.
/// After end(), or once there is trouble, nothing is turned on any more.
class ProgramOutputs {
public:
    static constexpr std::int32_t none = -1; ///< an input that there is not

    explicit ProgramOutputs(OutputParts parts, hal::Clock& clock = hal::system_clock())
        : parts_(std::move(parts)), clock_(&clock) {}

    /// Carries out what an event asks for, or begins to wait for its input, in place of another one; of one that there
    /// is not: it waits for none any more. @pre the machine has what it is about
    void act(const ProgramAction& action);
    /// Called each millisecond.
    void update();
    /// Whether the last order is carried out: the spindle turns as it was told, the input has answered. The motion
    /// waits for that.
    [[nodiscard]] bool reached() const { return !asks_.load() && progress().carried_out; }
    /// What the last input answered: its level as 0 or 1, -1 after the time-out.
    [[nodiscard]] int answer() const noexcept { return answer_.load(); }
    /// How long the spindle goes on turning that is not known to stand, behind end(), where only its own part knows it.
    [[nodiscard]] std::uint64_t coasts_us() const;
    /// Stops the spindle, turns the coolant off, and makes the outputs safe, for good.
    void end();
    /// Why something is not as ordered; empty: all is.
    [[nodiscard]] std::string trouble() const;
    /// Whether the spindle is known to stand.
    [[nodiscard]] bool spindle_stands() const { return progress().stands; }
    /// After end(): what may not have ended yet, "the spindle did not confirm ..."; empty: everything has.
    [[nodiscard]] std::string unended() const;
    /// After end(): whether something that has not ended may still do so, each in the time that it may take.
    [[nodiscard]] bool ends() const;

    /// Whether an event acts on an output.
    [[nodiscard]] static bool is_of(const ProgramAction& action) noexcept;

private:
    [[nodiscard]] std::string unconfirmed() const;
    [[nodiscard]] OutputPart::Progress progress() const;

    OutputParts parts_;
    hal::Clock* clock_;
    std::optional<InputQuestion> question_;
    std::atomic<bool> asks_{false};
    std::atomic<int> answer_{0};
    std::atomic<std::uint64_t> ended_us_{0}; // 0: not yet
};

} // namespace splinefeed::host
