// SPDX-License-Identifier: MIT
// ProgramLines: the GPIO lines that a program switches, as the machine file names them.
#pragma once

#include "splinefeed/hal/gpio/line_map.hpp"

#include <optional>
#include <vector>

namespace splinefeed::host {

struct SwitchedLine {
    hal::gpio::LineBit line; ///< of ProgramLines::chips
    bool on_level = true;
};

struct SensedLine {
    hal::gpio::LineBit line; ///< of ProgramLines::chips
    bool active_level = true;
};

/// A spindle that lines switch on and off; its speed is set elsewhere.
struct SpindleLines {
    SwitchedLine enable;                  ///< it turns
    std::optional<SwitchedLine> reverse;  ///< it turns counterclockwise; none: M4 is refused
    std::optional<SensedLine> at_speed{}; ///< it has its speed
    double spin_up_s = 0.0;               ///< from standstill to its speed: the motion waits for so long at least
    double spin_down_s = 0.0;             ///< from its speed to standstill
};

/// A digital output of M62 to M65.
struct DigitalOutput {
    static constexpr int most = 63; ///< largest number

    int number = 0; ///< their P
    SwitchedLine line;
    bool safe_on = false; ///< as it is before the run, after it and after an e-stop
};

struct ProgramLines {
    std::vector<hal::gpio::ChipLines> chips; ///< the safe level of a line of the coolant is off
    std::optional<SwitchedLine> mist;        ///< M7
    std::optional<SwitchedLine> flood;       ///< M8
    std::vector<DigitalOutput> outputs;      ///< in the order of the file

    [[nodiscard]] bool empty() const noexcept { return chips.empty(); }
    [[nodiscard]] const DigitalOutput* output(int number) const noexcept {
        for (const DigitalOutput& output : outputs) {
            if (output.number == number) {
                return &output;
            }
        }
        return nullptr;
    }
};

} // namespace splinefeed::host
