// SPDX-License-Identifier: MIT
// MachinePins: the lines of a map, requested from their chips, as a GpioPort uses them. Tests replace it.
#pragma once

#include "splinefeed/hal/gpio/input_source.hpp"
#include "splinefeed/hal/gpio/pin_changes.hpp"
#include "splinefeed/hal/gpio/pin_map.hpp"

#include <string>
#include <vector>

namespace splinefeed::hal::gpio {

class MachinePins {
public:
    MachinePins() = default;
    MachinePins(const MachinePins&) = delete;
    MachinePins& operator=(const MachinePins&) = delete;
    virtual ~MachinePins() = default;

    /// The outputs that a port needs.
    [[nodiscard]] virtual std::vector<ChipOutputs> outputs() = 0;
    /// For each chip that has inputs: the source of its edges, and the indices of its inputs in the map.
    struct Inputs {
        InputSource* source;
        std::vector<std::size_t> input;
    };
    [[nodiscard]] virtual std::vector<Inputs> inputs() = 0;
    /// Measures how long a call that sets lines takes, on the slowest chip: the time of each of `calls` calls, which
    /// change nothing. [ns]
    [[nodiscard]] virtual std::vector<std::uint64_t> set_times_ns(int calls) = 0;
    /// Sets all outputs to their safe levels, as at the end.
    virtual void make_safe() noexcept = 0;
    /// Enable and brake keep their present levels, also at the end. @pre nothing sets lines any more
    virtual void keep_drives_on() noexcept = 0;
    /// Name of the line for messages: "/dev/gpiochip0 X_LIMIT".
    [[nodiscard]] virtual std::string name(PinBit input) const = 0;
};

} // namespace splinefeed::hal::gpio
