// SPDX-License-Identifier: MIT
// GpioSwitches: coolant and digital outputs on lines of GPIO chips.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/target/run_switches.hpp"

#include "splinefeed/hal/gpio/line_writer.hpp"

#include <memory>
#include <mutex>
#include <vector>

namespace splinefeed::host {

class GpioSwitches final : public RunSwitches {
public:
    using Writers = std::vector<std::unique_ptr<hal::gpio::LineWriter>>;

    /// @param lines  must outlive it   @param writers  one for each chip of them, its lines at their safe levels
    GpioSwitches(const ProgramLines& lines, Writers writers) : lines_(&lines), writers_(std::move(writers)) {}
    ~GpioSwitches() override { GpioSwitches::end(); }

    void act(EventKind kind, std::int32_t number) override;
    void end() noexcept override;
    [[nodiscard]] std::string trouble() const override;

private:
    void turn(const std::optional<SwitchedLine>& line, bool on);

    const ProgramLines* lines_;
    Writers writers_;
    mutable std::mutex mutex_;
    bool ended_ = false;
    std::string trouble_;
};

/// Requests the lines; null: the machine has none. Throws TargetError.
[[nodiscard]] std::unique_ptr<RunSwitches> make_gpio_switches(const MachineDescription& machine);

} // namespace splinefeed::host
