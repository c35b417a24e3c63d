// SPDX-License-Identifier: MIT
// ProgramPins: the GPIO lines, and the bits of Modbus I/O modules, that a program switches and reads, as the machine
// file names them.
#pragma once

#include "host_sim/config/drive_address.hpp"

#include "splinefeed/hal/gpio/pin_map.hpp"
#include "splinefeed/hal/modbus/link/modbus_wire.hpp"
#include "splinefeed/s0_program/words/program_event.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace splinefeed::host {

struct SwitchedPin {
    hal::gpio::PinBit line; ///< of ProgramPins::chips
    bool on_level = true;
};

struct SensedPin {
    hal::gpio::PinBit line; ///< of ProgramPins::chips
    bool active_level = true;
};

/// A device with coils and discrete inputs.
struct IoModule {
    std::string name;
    DriveAddress address;
    std::uint32_t answer_ms = 100; ///< it answers within this time
};

struct SwitchedCoil {
    std::size_t module = 0; ///< index in ProgramPins::modules
    int address = 0;
    bool on_level = true;
};

struct SensedBit {
    std::size_t module = 0; ///< as above
    hal::modbus::BitTable table = hal::modbus::BitTable::inputs;
    int address = 0;
    bool active_level = true;
};

using ProgramSwitch = std::variant<SwitchedPin, SwitchedCoil>;
using ProgramSensor = std::variant<SensedPin, SensedBit>;

/// A spindle that lines switch on and off; its speed is set elsewhere.
struct SpindlePins {
    SwitchedPin enable;                  ///< it turns
    std::optional<SwitchedPin> reverse;  ///< it turns counterclockwise; none: M4 is refused
    std::optional<SensedPin> at_speed{}; ///< it has its speed
    double spin_up_s = 0.0;              ///< from standstill to its speed: the motion waits for so long at least
    double spin_down_s = 0.0;            ///< from its speed to standstill
};

/// A digital output of M62 to M65.
struct DigitalOutput {
    static constexpr int most = 63; ///< largest number

    int number = 0; ///< their P
    ProgramSwitch line;
    bool safe_on = false; ///< as it is before the run, after it and after an e-stop
};

/// A digital input of M66.
struct DigitalInput {
    static constexpr int most = 63; ///< largest number

    int number = 0; ///< its P
    ProgramSensor line;
};

struct ProgramPins {
    std::vector<hal::gpio::ChipPins> chips; ///< the safe level of a line of the coolant is off
    std::vector<IoModule> modules;
    std::optional<ProgramSwitch> mist;  ///< M7
    std::optional<ProgramSwitch> flood; ///< M8
    std::vector<DigitalOutput> outputs; ///< in the order of the file
    std::vector<DigitalInput> inputs;   ///< likewise

    /// Whether the machine has none on GPIO lines.
    [[nodiscard]] bool empty() const noexcept { return chips.empty(); }
    [[nodiscard]] const DigitalOutput* output(int number) const noexcept { return of_number(outputs, number); }
    [[nodiscard]] const DigitalInput* input(int number) const noexcept { return of_number(inputs, number); }
    /// The law of both doors: whether the machine has what an event of M7 to M9 or M62 to M66 switches or reads.
    [[nodiscard]] bool has(EventKind kind, int number) const noexcept {
        switch (kind) {
        case EventKind::mist_on: return mist.has_value();
        case EventKind::flood_on: return flood.has_value();
        case EventKind::coolant_off: return mist || flood;
        case EventKind::input_wait: return input(number) != nullptr;
        default: return is_output(kind) && output(number) != nullptr;
        }
    }

private:
    template <class Numbered>
    [[nodiscard]] static const Numbered* of_number(const std::vector<Numbered>& all, int number) noexcept {
        const auto found = std::ranges::find(all, number, &Numbered::number);
        return found != all.end() ? &*found : nullptr;
    }
};

} // namespace splinefeed::host
