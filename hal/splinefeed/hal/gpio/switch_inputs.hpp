// SPDX-License-Identifier: MIT
// SwitchInputs: the switches of a map, of all its chips, by role.
#pragma once

#include "splinefeed/hal/gpio/gpio_port_settings.hpp"
#include "splinefeed/hal/gpio/input_watch.hpp"
#include "splinefeed/hal/gpio/machine_pins.hpp"

#include <initializer_list>
#include <optional>

namespace splinefeed::hal::gpio {

class SwitchInputs {
public:
    using Roles = std::initializer_list<InputRole>;

    /// Watches from now on. An e-stop, or a chip whose inputs can no longer be read, disables the port. Throws
    /// GpioError if levels cannot be read. All arguments must outlive it.
    SwitchInputs(const PinMap& map, const GpioPortSettings& settings, MachinePins& lines, StepPort& port);

    /// The oldest change that was not taken yet; its input is an index in PinMap::inputs.
    [[nodiscard]] std::optional<InputChange> take();
    [[nodiscard]] bool is(std::size_t input, InputRole role) const { return map_->inputs[input].role == role; }
    /// By its level. Where a change can be taken its level has become so, too.
    [[nodiscard]] bool active(std::size_t input) const;
    /// The first input of these roles that acts; nothing: none does.
    [[nodiscard]] std::optional<std::size_t> acting(Roles roles) const;
    /// The first input of that role; nothing: there is none. @param axis  of home and limit
    [[nodiscard]] std::optional<std::size_t> find(InputRole role, int axis = -1) const;
    /// "the e-stop (/dev/gpiochip0 ESTOP) acts; release it"
    [[nodiscard]] std::string acts(std::size_t input) const;
    /// Why a machine must not start: the first input of these roles that acts. Empty: it may start.
    [[nodiscard]] std::string in_the_way(Roles roles) const;
    /// "limit of axis x (/dev/gpiochip0 X_LIMIT)"
    [[nodiscard]] std::string name(std::size_t input) const;
    /// Why the inputs of a chip can no longer be read; empty: all can.
    [[nodiscard]] std::string trouble() const;
    [[nodiscard]] std::uint64_t missed() const;

private:
    struct Chip {
        std::vector<std::size_t> input; // index in the map, in the order of the watch
        std::unique_ptr<InputWatch> watch;
    };

    const PinMap* map_;
    const GpioPortSettings* settings_;
    MachinePins* lines_;
    std::vector<Chip> watched_;
};

/// Name of a role, as in the map file and the summary.
[[nodiscard]] const char* role_name(InputRole role) noexcept;

} // namespace splinefeed::hal::gpio
