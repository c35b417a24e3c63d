// SPDX-License-Identifier: MIT
// GpioTarget: a run on step and direction lines of GPIO chips.
#pragma once

#include "gpio_mover.hpp"
#include "host_sim/gpio_address.hpp"
#include "host_sim/run_target.hpp"

namespace splinefeed::host {

class GpioTarget final : public RunTarget {
public:
    /// Takes the lines. Throws InputError, TargetError, and UsageError where the chip is too slow for the machine's
    /// limits. `machine` outlives it.
    GpioTarget(const GpioAddress& address, const MachineDescription& machine, const RunWishes& wishes);

    [[nodiscard]] double least_segment_us() const noexcept override { return 0.0; }
    [[nodiscard]] bool resamples() const noexcept override { return false; }
    [[nodiscard]] std::string note() const override;
    [[nodiscard]] std::string where() const override;
    void describe(Summary& summary) const override;
    [[nodiscard]] std::string holds() const override { return holds_; }
    [[nodiscard]] bool achieved() const override { return probed_; }

private:
    [[nodiscard]] hal::MotionPort& port() noexcept override { return port_; }
    [[nodiscard]] std::string prepare(const FeedSegment& first) override;
    void complete() override;
    void hold() override { holds_ = "interrupted: held on the path"; }
    void quick_stop() override;
    [[nodiscard]] std::string halted(bool /*quick*/) const override { return holds_; }
    [[nodiscard]] bool stands_dry() const override { return port_.stands_dry(); }
    void release() noexcept override;
    void look() override;
    [[nodiscard]] std::string fault() const override;

    const MachineDescription* machine_;
    RunWishes wishes_;
    hal::gpio::LineMap map_;
    hal::gpio::AwakeHost awake_;
    GpioChips chips_;
    hal::gpio::StepPort port_;
    GpioInputs inputs_;
    GpioMover mover_;
    std::string missing_; // of real time
    std::string holds_;   // why the motion is held, and ends
    std::vector<GpioSummary::Change> changes_;
    std::uint64_t began_ns_;
    bool began_ = false; // the lines may have changed
    bool probed_ = false;
    bool quick_ = false;
};

/// How many lines a second may be set where a call takes so long: half of the time.
[[nodiscard]] double most_edges_per_s(double call_ns) noexcept;
/// What the machine's limits may ask for.
[[nodiscard]] double asked_edges_per_s(const MachineDescription& machine) noexcept;
/// Of the map's thread.
[[nodiscard]] hal::gpio::StepPortSettings port_settings(const MachineDescription& machine,
                                                        const hal::gpio::LineMap& map);

} // namespace splinefeed::host
