// SPDX-License-Identifier: MIT
// GpioChips: the lines of a map, requested from their chips, in the form that the port uses.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/ports/gpio/pin_claims.hpp"

#include "splinefeed/hal/gpio/crash_guard.hpp"
#include "splinefeed/hal/gpio/input_pins.hpp"
#include "splinefeed/hal/gpio/machine_pins.hpp"

#include <list>
#include <memory>
#include <optional>

namespace splinefeed::host {

/// Lines of real chips. They have safe levels from construction to the end, also if the program crashes.
class GpioChips final : public hal::gpio::MachinePins {
public:
    /// Requests the lines. Throws hal::gpio::GpioError; then none was taken. `map` must outlive it.
    GpioChips(const hal::gpio::PinMap& map, const MachineDescription& machine);

    [[nodiscard]] std::vector<hal::gpio::ChipOutputs> outputs() override;
    [[nodiscard]] std::vector<Inputs> inputs() override;
    [[nodiscard]] std::vector<std::uint64_t> set_times_ns(int calls) override;
    void make_safe() noexcept override;
    void keep_drives_on() noexcept override;
    [[nodiscard]] std::string name(hal::gpio::PinBit input) const override;

private:
    const hal::gpio::PinMap* map_;
    const MachineDescription* machine_;
    std::list<PinClaims> claims_;
    std::vector<std::unique_ptr<hal::gpio::OutputPins>> writer_; // one per chip; null: the chip has no outputs
    std::vector<std::unique_ptr<hal::gpio::InputPins>> source_;  // one per chip; null: the chip has no inputs
    std::optional<hal::gpio::CrashGuard> guard_;
};

} // namespace splinefeed::host
