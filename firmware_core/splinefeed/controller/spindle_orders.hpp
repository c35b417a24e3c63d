// SPDX-License-Identifier: MIT
// SpindleOrders: what the spindle and the coolant were told, with the operator's override.
#pragma once

#include "splinefeed/controller/controlled_machine.hpp"
#include "splinefeed/controller/controller_settings.hpp"
#include "splinefeed/s0_program/words/modal_state.hpp"

namespace splinefeed {

class SpindleOrders {
public:
    /// Both must outlive it.
    SpindleOrders(const ControllerSettings& settings, ControlledMachine& machine) noexcept
        : settings_(&settings), machine_(&machine) {}

    /// An event of a program. false: it is none of spindle or coolant
    bool obey(const ProgramEvent& event) noexcept;
    /// Per cent of the programmed speed.
    void set_override(int percent) noexcept;
    /// The operator's switch of flood or mist.
    void toggle(EventKind coolant) noexcept;
    /// Off, until restore() or the program's next order.
    void suspend() noexcept;
    void restore() noexcept;
    /// Stops everything.
    void stop_all() noexcept;
    /// Stops the spindle, or starts it again.
    void toggle_spindle() noexcept;

    [[nodiscard]] bool is_on() const noexcept { return turns() || ((flood_ || mist_) && !suspended_); }
    [[nodiscard]] SpindleState state() const noexcept { return state_; }
    [[nodiscard]] bool flood() const noexcept { return flood_; }
    [[nodiscard]] bool mist() const noexcept { return mist_; }
    /// Whether the spindle turns, or stands, as it was ordered last: until then no motion begins. Speeds that change
    /// while it turns are not waited for.
    [[nodiscard]] bool settles() noexcept;
    /// As it is told to turn [1/min]: what the program and the override ask for, but a speed is never above max_rpm or
    /// below min_rpm. 0 stands.
    [[nodiscard]] Decimal told_rpm() const noexcept;
    [[nodiscard]] int override_percent() const noexcept { return percent_; }

private:
    [[nodiscard]] bool turns() const noexcept {
        return state_ != SpindleState::stopped && !suspended_ && !spindle_suspended_;
    }
    void order_spindle() noexcept;
    void tell_spindle() noexcept;
    void tell_coolant() noexcept;
    void tell(EventKind kind, Decimal value = {}) noexcept;

    const ControllerSettings* settings_;
    ControlledMachine* machine_;
    SpindleState state_ = SpindleState::stopped;
    Decimal rpm_{};
    int percent_ = 100;
    bool flood_ = false;
    bool mist_ = false;
    bool suspended_ = false;
    bool spindle_suspended_ = false;
    bool awaited_ = false; // it is not as ordered yet
};

} // namespace splinefeed
