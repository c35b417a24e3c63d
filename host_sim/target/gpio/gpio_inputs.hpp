// SPDX-License-Identifier: MIT
// GpioInputs: the switches of a map, of all its chips, by their roles.
#pragma once

#include "host_sim/target/gpio/gpio_chips.hpp"

#include "splinefeed/hal/gpio/input_watch.hpp"

#include <optional>

namespace splinefeed::host {

/// A change of an input of the map.
struct SwitchChange {
    std::size_t input = 0; ///< of LineMap::inputs
    bool active = false;
    std::uint64_t time_ns = 0;                   ///< CLOCK_MONOTONIC, of the edge
    std::optional<PerAxis<std::int64_t>> counts; ///< stepped by then; nothing: not known
};

class GpioInputs {
public:
    /// Watches from here on. An e-stop, or a chip that is not heard any more, disables the drives.
    /// Throws TargetError where levels cannot be read. All arguments outlive it.
    GpioInputs(const hal::gpio::LineMap& map, const MachineDescription& machine, GpioLines& chips,
               hal::gpio::StepPort& port, const hal::gpio::InputWatchSettings& settings);

    /// The oldest change that was not taken yet, of each chip.
    [[nodiscard]] std::optional<SwitchChange> take();
    [[nodiscard]] bool active(std::size_t input) const;
    /// The first limit or drive fault that acts, as it was last known; nothing: none does.
    [[nodiscard]] std::optional<std::size_t> stopping() const;
    /// Of an axis; nothing: it has none.
    [[nodiscard]] std::optional<std::size_t> home_of(int axis) const;
    /// Why a machine must not start: "the e-stop (/dev/gpiochip0 ESTOP) acts; release it". Empty: it may.
    /// @param limits  false: on the way of homing, where a limit may act
    [[nodiscard]] std::string in_the_way(bool limits) const;
    /// "limit of axis x (/dev/gpiochip0 X_LIMIT)"
    [[nodiscard]] std::string name(std::size_t input) const;
    /// Why a chip is not heard any more; empty: all are.
    [[nodiscard]] std::string trouble() const;
    [[nodiscard]] std::uint64_t missed() const;

private:
    struct Chip {
        std::vector<std::size_t> input; // of the map, in the watch's order
        std::unique_ptr<hal::gpio::InputWatch> watch;
    };

    const hal::gpio::LineMap* map_;
    const MachineDescription* machine_;
    GpioLines* chips_;
    std::vector<Chip> watched_;
};

/// A role's name, as the map file and the summary have it.
[[nodiscard]] const char* role_name(hal::gpio::InputRole role) noexcept;

} // namespace splinefeed::host
