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
