// SPDX-License-Identifier: MIT
// ProgramOutputs: everything that the events of a program act on in a run on a real target: spindle, coolant and
// digital outputs.
#pragma once

#include "host_sim/program/program_action.hpp"
#include "host_sim/target/run_spindle.hpp"
#include "host_sim/target/run_switches.hpp"

#include <memory>
#include <string>

namespace splinefeed::host {

/// All functions return at once and may be called by any thread. After end(), or once there is trouble, nothing is
/// turned on any more.
class ProgramOutputs {
public:
    /// Null: the machine has none.
    ProgramOutputs(std::unique_ptr<RunSpindle> spindle, std::unique_ptr<RunSwitches> switches)
        : spindle_(std::move(spindle)), switches_(std::move(switches)) {}

    /// Carries out what an event asks for. @pre the machine has what it acts on
    void act(const ProgramAction& action);
    /// Called each millisecond, by the thread that calls act().
    void update() {
        if (spindle_ != nullptr) {
            spindle_->update();
        }
    }
    /// Whether the spindle has carried out its last order: the motion waits for that.
    [[nodiscard]] bool spindle_reached() const { return spindle_ == nullptr || spindle_->reached(); }
    /// Stops the spindle, turns the coolant off, and makes the outputs safe, for good.
    void end();
    /// Why something is not as ordered; empty: all is.
    [[nodiscard]] std::string trouble() const;
    /// Whether the spindle is known to stand, and how long it may take to come to that. [s]
    [[nodiscard]] bool spindle_stands() const { return spindle_ == nullptr || spindle_->stands(); }
    [[nodiscard]] double spindle_stop_timeout_s() const { return spindle_ ? spindle_->stop_timeout_s() : 0.0; }

    /// Whether an event acts on an output.
    [[nodiscard]] static bool is_of(const ProgramAction& action) noexcept {
        return action.spindle.has_value() || RunSwitches::is_of(action.kind);
    }

private:
    std::unique_ptr<RunSpindle> spindle_;
    std::unique_ptr<RunSwitches> switches_;
};

} // namespace splinefeed::host
