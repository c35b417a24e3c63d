// SPDX-License-Identifier: MIT
// Cia402Machine: the state machine of CiA 402, with control word, power stage and status word.
#pragma once

#include "host_sim/drive/positioning_axis.hpp"

#include <cstdint>

namespace splinefeed::host {

/// The requests of a control word besides those to the power stage.
struct Cia402Orders {
    bool start = false; ///< rising edge of bit 4
    bool immediately = false;
    bool relative = false;
    bool halt = false;  ///< rising edge of bit 8
    bool go_on = false; ///< falling edge of bit 8
};

class Cia402Machine {
public:
    Cia402Orders control(std::uint16_t word, PositioningAxis& axis) noexcept;
    /// Follows changes of the axis that no command caused: faults, the end of a quick stop.
    void update(PositioningAxis& axis) noexcept;
    void reset() noexcept { *this = Cia402Machine(); }

    /// The status word without the bits of the motion mode.
    [[nodiscard]] std::uint16_t status() const noexcept;
    [[nodiscard]] bool in_operation() const noexcept { return state_ == State::operation_enabled; }
    [[nodiscard]] bool halted() const noexcept { return (word_ & halt_bit) != 0; }
    [[nodiscard]] std::uint16_t word() const noexcept { return word_; }

    static constexpr std::uint16_t start_bit = 0x0010;
    static constexpr std::uint16_t immediately_bit = 0x0020;
    static constexpr std::uint16_t relative_bit = 0x0040;
    static constexpr std::uint16_t reset_bit = 0x0080;
    static constexpr std::uint16_t halt_bit = 0x0100;

private:
    /// The values are the bits in the status word.
    enum class State : std::uint16_t {
        quick_stop_active = 0x07,
        fault = 0x08,
        fault_reaction_active = 0x0F,
        ready_to_switch_on = 0x21,
        switched_on = 0x23,
        operation_enabled = 0x27,
        switch_on_disabled = 0x40,
    };

    void go(std::uint16_t word, PositioningAxis& axis) noexcept;
    void leave_operation(State next, PositioningAxis& axis) noexcept;

    State state_ = State::switch_on_disabled;
    std::uint16_t word_ = 0;
};

} // namespace splinefeed::host
