// SPDX-License-Identifier: MIT
// ProgramChips: the lines that a program switches and reads, requested from their chips.
#pragma once

#include "host_sim/config/program_pins.hpp"

#include "splinefeed/hal/gpio/input_source.hpp"
#include "splinefeed/hal/gpio/pin_writer.hpp"

#include <memory>
#include <string>
#include <vector>

namespace splinefeed::host {

/// For each chip of ProgramPins; null: it has no outputs, or no inputs.
struct ProgramChips {
    std::vector<std::shared_ptr<hal::gpio::PinWriter>> writer; ///< for several threads
    std::vector<std::shared_ptr<hal::gpio::InputSource>> source;

    [[nodiscard]] bool set(const SwitchedPin& line, bool on) const noexcept {
        return writer[line.line.chip]->set(line.line.mask(), on == line.on_level ? line.line.mask() : 0);
    }
};

/// The lines have their safe levels until they are set, at the end, and if the program crashes. Throws TargetError.
[[nodiscard]] ProgramChips open_program_chips(const ProgramPins& lines);

/// "/dev/gpiochip0 MIST"
[[nodiscard]] std::string name_of_output(const ProgramPins& lines, hal::gpio::PinBit line);

} // namespace splinefeed::host
