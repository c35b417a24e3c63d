// SPDX-License-Identifier: MIT
// GpioTarget: a run on step and direction lines of GPIO chips, or a machine of such lines that is served.
#pragma once

#include "host_sim/config/gpio_address.hpp"
#include "host_sim/ports/run_target.hpp"

#include "splinefeed/hal/gpio/gpio_port.hpp"

namespace splinefeed::host {

/// Makes the settings of a hal::gpio::GpioPort from a machine file, and sentences of what it tells.
class GpioTarget final : public RunTarget {
public:
    /// Throws TargetError, and UsageError if the chip is too slow for the machine's limits. `machine` must outlive it.
    /// @param lines  lines of the map
    /// @param clock  null: the system's clock; the target then also requests real-time priority. Must outlive it.
    GpioTarget(std::unique_ptr<hal::gpio::PinMap> map, std::unique_ptr<hal::gpio::MachinePins> lines,
               const MachineDescription& machine, const RunOptions& options, hal::Clock* clock = nullptr);

    [[nodiscard]] TargetFacts facts() const override;
    [[nodiscard]] hal::MotionPort& port() noexcept override { return port_; }
    [[nodiscard]] Signs signs() override;
    void watch_probe(bool away) override { port_.watch_probe(away); }
    [[nodiscard]] std::string sentence(const hal::PortFailure& failure) const override {
        return failure.what + (failure.remedy == hal::Remedy::home ? " (--home)" : "");
    }
    [[nodiscard]] std::string halted(bool quick) const override;
    [[nodiscard]] std::string leave(bool off) override { return off ? port_.switch_off() : port_.leave(); }
    [[nodiscard]] std::vector<AxisPlace> places() const override;
    [[nodiscard]] std::vector<AxisPlace> standing() override;
    [[nodiscard]] std::string where() const override;
    void describe(Summary& summary) const override;

private:
    [[nodiscard]] std::string holds() const;
    [[nodiscard]] SwitchFacts switch_facts() const;
    [[nodiscard]] std::optional<double> place(int axis) const;
    void note(const hal::gpio::InputChange& change, const std::optional<PerAxis<double>>& mm);

    const MachineDescription* machine_;
    std::optional<hal::AwakeHost> awake_;
    std::unique_ptr<hal::gpio::PinMap> map_;
    std::unique_ptr<hal::gpio::MachinePins> lines_;
    GpioSummary input_summary_; // changes of inputs
    std::string missing_;       // real-time rights that are missing
    hal::gpio::GpioPort port_;
};

/// Reads the map and requests the lines. Throws InputError, TargetError and UsageError.
[[nodiscard]] std::unique_ptr<GpioTarget>
make_gpio_target(const GpioAddress& address, const MachineDescription& machine, const RunOptions& options);

} // namespace splinefeed::host
