// SPDX-License-Identifier: MIT
//
//   switch on disabled --6--> ready to switch on --7--> switched on --F--> operation enabled --bit 2 off--> quick stop
//          ^ bit 1 off, from everywhere                                           |                             |
//          +------------------ at rest <------------------------------------------|-----------------------------+
//   fault --rising edge of bit 7--> switch on disabled                 F from ready passes both steps at once
#include "host_sim/drive/cia402_machine.hpp"

namespace splinefeed::host {

namespace {
constexpr std::uint16_t switch_on_bit = 0x0001;
constexpr std::uint16_t voltage_bit = 0x0002;
constexpr std::uint16_t no_quick_stop_bit = 0x0004;
constexpr std::uint16_t operation_bit = 0x0008;
constexpr std::uint16_t powered_and_remote = 0x0210;
} // namespace

void Cia402Machine::leave_operation(State next, PositioningAxis& axis) noexcept {
    axis.disable();
    state_ = next;
}

void Cia402Machine::go(std::uint16_t word, PositioningAxis& axis) noexcept {
    if ((word & voltage_bit) == 0) {
        leave_operation(State::switch_on_disabled, axis);
    } else if ((word & no_quick_stop_bit) == 0) {
        if (state_ == State::operation_enabled) {
            state_ = State::quick_stop_active;
            axis.quick_stop();
        } else if (state_ != State::quick_stop_active) {
            state_ = State::switch_on_disabled;
        }
    } else if ((word & switch_on_bit) == 0 && state_ != State::quick_stop_active) {
        leave_operation(State::ready_to_switch_on, axis);
    } else if (state_ == State::quick_stop_active || state_ == State::switch_on_disabled) {
        return; // down to rest first, and then it must be made ready
    } else if ((word & operation_bit) == 0) {
        leave_operation(State::switched_on, axis);
    } else {
        state_ = State::operation_enabled;
        axis.enable();
    }
}

Cia402Orders Cia402Machine::control(std::uint16_t word, PositioningAxis& axis) noexcept {
    const auto rising = static_cast<std::uint16_t>(word & ~word_);
    const auto falling = static_cast<std::uint16_t>(word_ & ~word);
    word_ = word;
    update(axis);
    if (state_ == State::fault && (rising & reset_bit) != 0) {
        axis.reset_fault();
        state_ = State::switch_on_disabled;
    }
    if (state_ == State::fault || state_ == State::fault_reaction_active) {
        return {};
    }
    const bool was_in_operation = in_operation();
    go(word, axis);
    if (!in_operation()) {
        return {};
    }
    return {.start = (rising & start_bit) != 0,
            .immediately = (word & immediately_bit) != 0,
            .relative = (word & relative_bit) != 0,
            .halt = (rising & halt_bit) != 0,
            .go_on = was_in_operation && (falling & halt_bit) != 0};
}

void Cia402Machine::update(PositioningAxis& axis) noexcept {
    if (axis.power() == AxisPower::stopping_fault) {
        state_ = State::fault_reaction_active;
    } else if (axis.power() == AxisPower::fault) {
        state_ = State::fault;
    } else if (state_ == State::quick_stop_active && !axis.moving()) {
        leave_operation(State::switch_on_disabled, axis);
    }
}

std::uint16_t Cia402Machine::status() const noexcept {
    return static_cast<std::uint16_t>(static_cast<std::uint16_t>(state_) | powered_and_remote);
}

} // namespace splinefeed::host
