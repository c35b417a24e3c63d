// SPDX-License-Identifier: MIT
// GpioInputs: the switches of a map, of all its chips, by role.
#pragma once

#include "host_sim/ports/gpio/gpio_chips.hpp"

#include "splinefeed/hal/gpio/input_watch.hpp"

#include <optional>

namespace splinefeed::host {

/// A change of an input of the map.
struct SwitchChange {
    std::size_t input = 0; ///< index in LineMap::inputs
    bool active = false;
    std::uint64_t time_ns = 0;                   ///< CLOCK_MONOTONIC, of the edge
    std::optional<PerAxis<std::int64_t>> counts; ///< counts that were stepped until then; nothing: not known
};

class GpioInputs {
public:
    /// Watches from now on. An e-stop, or a chip whose inputs can no longer be read, disables the port. Throws
    /// TargetError if levels cannot be read. All arguments must outlive it.
    GpioInputs(const hal::gpio::LineMap& map, const MachineDescription& machine, GpioLines& chips,
               hal::gpio::StepPort& port, const hal::gpio::InputWatchSettings& settings);

    /// The oldest change that was not taken yet.
    [[nodiscard]] std::optional<SwitchChange> take();
    [[nodiscard]] bool active(std::size_t input) const;
    /// The first e-stop that is active; nothing: none is.
    [[nodiscard]] std::optional<std::size_t> pressed() const;
    /// Home input of an axis; nothing: it has none.
    [[nodiscard]] std::optional<std::size_t> home_of(int axis) const;
    /// Why a machine must not start: "the e-stop (/dev/gpiochip0 ESTOP) acts; release it". Empty: it may start.
    /// @param limits  false: during homing, where a limit may be active
    [[nodiscard]] std::string in_the_way(bool limits) const;
    /// "limit of axis x (/dev/gpiochip0 X_LIMIT)"
    [[nodiscard]] std::string name(std::size_t input) const;
    /// Why the inputs of a chip can no longer be read; empty: all can.
    [[nodiscard]] std::string trouble() const;
    [[nodiscard]] std::uint64_t missed() const;

private:
    struct Chip {
        std::vector<std::size_t> input; // index in the map, in the order of the watch
        std::unique_ptr<hal::gpio::InputWatch> watch;
    };

    const hal::gpio::LineMap* map_;
    const MachineDescription* machine_;
    GpioLines* chips_;
    std::vector<Chip> watched_;
};

/// Name of a role, as in the map file and the summary.
[[nodiscard]] const char* role_name(hal::gpio::InputRole role) noexcept;

} // namespace splinefeed::host
