// SPDX-License-Identifier: MIT
// GpioChips: the lines of a map, requested from their chips, in the form that the port uses.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/ports/gpio/line_claims.hpp"

#include "splinefeed/hal/gpio/crash_guard.hpp"
#include "splinefeed/hal/gpio/input_lines.hpp"
#include "splinefeed/hal/gpio/line_map.hpp"
#include "splinefeed/hal/gpio/step_port.hpp"

#include <deque>
#include <list>
#include <memory>

namespace splinefeed::host {

/// The lines of a map, as a target uses them; tests have their own class.
class GpioLines {
public:
    GpioLines() = default;
    GpioLines(const GpioLines&) = delete;
    GpioLines& operator=(const GpioLines&) = delete;
    virtual ~GpioLines() = default;

    /// The outputs that a port needs.
    [[nodiscard]] virtual std::vector<hal::gpio::ChipOutputs> outputs() = 0;
    /// For each chip that has inputs: the source of its edges, and the indices of its inputs in the map.
    struct Inputs {
        hal::gpio::InputSource* source;
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
    [[nodiscard]] virtual std::string name(hal::gpio::LineBit input) const = 0;
};

/// Lines of real chips. They have safe levels from construction to the end, also if the program crashes.
class GpioChips final : public GpioLines {
public:
    /// Requests the lines. Throws hal::gpio::GpioError; then none was taken. `map` must outlive it.
    GpioChips(const hal::gpio::LineMap& map, const MachineDescription& machine);

    [[nodiscard]] std::vector<hal::gpio::ChipOutputs> outputs() override;
    [[nodiscard]] std::vector<Inputs> inputs() override;
    [[nodiscard]] std::vector<std::uint64_t> set_times_ns(int calls) override;
    void make_safe() noexcept override;
    void keep_drives_on() noexcept override;
    [[nodiscard]] std::string name(hal::gpio::LineBit input) const override;

private:
    const hal::gpio::LineMap* map_;
    const MachineDescription* machine_;
    std::list<LineClaims> claims_;
    std::vector<std::unique_ptr<hal::gpio::OutputLines>> writer_; // one per chip; null: the chip has no outputs
    std::vector<std::unique_ptr<hal::gpio::InputLines>> source_;  // one per chip; null: the chip has no inputs
    std::optional<hal::gpio::CrashGuard> guard_;
};

} // namespace splinefeed::host
