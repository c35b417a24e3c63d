// SPDX-License-Identifier: MIT
// GpioTarget: a run on step and direction lines of GPIO chips.
#pragma once

#include "host_sim/config/gpio_address.hpp"
#include "host_sim/ports/gpio/gpio_mover.hpp"
#include "host_sim/ports/run_target.hpp"

#include "splinefeed/hal/stop_sequence.hpp"

namespace splinefeed::host {

/// It is its own port: what the switches and the user ask for acts on the port of the step lines.
class GpioTarget final : public RunTarget, private hal::MotionPort {
public:
    /// Throws TargetError, and UsageError if the chip is too slow for the machine's limits. `machine` must outlive it.
    /// @param lines  lines of the map
    /// @param clock  null: the system's clock; the target then also requests real-time priority. Must outlive it.
    GpioTarget(std::unique_ptr<hal::gpio::LineMap> map, std::unique_ptr<GpioLines> lines,
               const MachineDescription& machine, const RunOptions& options, hal::Clock* clock = nullptr);
    ~GpioTarget() override;

    [[nodiscard]] double least_segment_us() const noexcept override { return 0.0; }
    [[nodiscard]] bool resamples() const noexcept override { return false; }
    [[nodiscard]] std::string note() const override;
    [[nodiscard]] std::vector<AxisPlace> standing() override;
    [[nodiscard]] std::vector<AxisPlace> places() const override;
    [[nodiscard]] std::string where() const override;
    void describe(Summary& summary) const override;
    [[nodiscard]] std::string holds() const override { return holds_; }
    [[nodiscard]] bool achieved() const override { return probed_; }

private:
    [[nodiscard]] hal::MotionPort& port() noexcept override { return *this; }
    [[nodiscard]] std::string halted(bool quick) const override;
    [[nodiscard]] std::string finish() override;

    [[nodiscard]] hal::PortFailure prepare(const FeedSegment& first) override;
    [[nodiscard]] int room() const noexcept override { return port_.room(); }
    [[nodiscard]] bool submit(const FeedSegment& segment) noexcept override { return port_.submit(segment); }
    void complete() noexcept override;
    hal::PortState poll() noexcept override;
    void halt() noexcept override { holds_ = "interrupted: held on the path"; }
    void quick_stop() noexcept override;
    void power_off() noexcept override { port_.power_off(); }
    void close() noexcept override;
    [[nodiscard]] hal::PortFailure failure() const override { return {fault()}; }

    [[nodiscard]] std::string make_ready(const FeedSegment& first);
    [[nodiscard]] std::string fault() const;
    [[nodiscard]] std::optional<double> place(int axis) const;
    void take_changes();
    void follow_stop();

    const MachineDescription* machine_;
    RunOptions options_;
    hal::Clock* time_;
    std::optional<hal::AwakeHost> awake_;
    std::unique_ptr<hal::gpio::LineMap> map_;
    std::unique_ptr<GpioLines> chips_;
    hal::gpio::StepPort port_;
    GpioInputs inputs_;
    GpioMover mover_;
    hal::StopSequence stop_; // all axes stop as one drive
    std::uint64_t executed_us_ = 0;
    std::string missing_;       // real-time rights that are missing
    std::string holds_;         // why the motion is held and ends
    GpioSummary input_summary_; // changes of inputs
    std::uint64_t began_ns_;
    bool began_ = false; // the lines may have changed
    bool probed_ = false;
    bool quick_ = false;
    bool completed_ = false;
    bool finished_ = false; // the drives are in the state that the machine file requires
};

/// Reads the map and requests the lines. Throws InputError, TargetError and UsageError.
[[nodiscard]] std::unique_ptr<GpioTarget>
make_gpio_target(const GpioAddress& address, const MachineDescription& machine, const RunOptions& options);

} // namespace splinefeed::host
