// SPDX-License-Identifier: MIT
// GpioTarget: a run on step and direction lines of GPIO chips, or a machine of such lines that is served.
#pragma once

#include "host_sim/config/gpio_address.hpp"
#include "host_sim/ports/gpio/gpio_mover.hpp"
#include "host_sim/ports/gpio/gpio_stops.hpp"
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

    void set_ready(const RunOptions& options) override;
    /// What is on stays on, and the e-stop acts.
    void disconnect() override {}
    [[nodiscard]] bool has_feedback() const noexcept override { return false; }
    [[nodiscard]] Stop stopped_by() override;
    [[nodiscard]] std::uint32_t homes_with(std::uint32_t axes) const override;
    [[nodiscard]] std::vector<AxisPlace> references() const override;
    [[nodiscard]] SwitchFacts switch_facts() const override;
    [[nodiscard]] Switches switches() override;
    void watch_probe(bool away) override;
    [[nodiscard]] std::uint64_t least_ahead_us() const noexcept override;
    [[nodiscard]] std::string switch_off() override;

private:
    [[nodiscard]] hal::MotionPort& port() noexcept override { return *this; }
    [[nodiscard]] std::string halted(bool quick) const override;
    [[nodiscard]] std::string finish() override;

    [[nodiscard]] hal::PortFailure open() override;
    [[nodiscard]] hal::PortFailure prepare(const FeedSegment& first) override;
    [[nodiscard]] hal::PortFailure renew(const FeedSegment& first) override;
    [[nodiscard]] int room() const noexcept override { return port_.room(); }
    [[nodiscard]] bool submit(const FeedSegment& segment) noexcept override;
    void complete() noexcept override;
    hal::PortState poll() noexcept override;
    void halt() noexcept override { holds_ = "interrupted: held on the path"; }
    void quick_stop() noexcept override;
    void power_off() noexcept override { port_.power_off(); }
    void close() noexcept override;
    [[nodiscard]] hal::PortFailure failure() const override { return {fault()}; }

    [[nodiscard]] std::string make_ready(const FeedSegment& first);
    [[nodiscard]] std::string home(const PerAxis<double>& begin_mm);
    void place_unknown(int axis, const FeedSegment& first) noexcept;
    [[nodiscard]] bool align(const FeedSegment& first);
    void hold(StopCause cause, const std::string& why);
    void hold_by(std::size_t input);
    void forget_stop() noexcept;
    void forget_places() noexcept;
    [[nodiscard]] bool has(hal::gpio::InputRole role) const noexcept;
    [[nodiscard]] std::string fault() const;
    [[nodiscard]] std::optional<double> place(int axis) const;
    [[nodiscard]] PerAxis<double> positions_at(const std::optional<PerAxis<std::int64_t>>& counts) const;
    void note(const SwitchChange& change);
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
    GpioStops stops_;
    hal::StopSequence stop_; // all axes stop as one drive
    std::uint64_t executed_us_ = 0;
    std::string missing_; // real-time rights that are missing
    std::string holds_;   // why the motion is held and ends,
    StopCause cause_ = StopCause::none;
    PerAxis<std::int64_t> shift_{};  // of the motion's segments, to the count at which an axis stands [units]
    std::optional<bool> probe_away_; // a change of the probe is awaited: to no contact,
    std::optional<PerAxis<double>> touched_mm_; // or has come here
    GpioSummary input_summary_;                 // changes of inputs
    std::uint64_t began_ns_;
    bool began_ = false; // the lines may have changed
    bool probed_ = false;
    bool quick_ = false;
    bool completed_ = false;
    bool begins_ = false;   // no segment of the motion has come
    bool finished_ = false; // the drives are in the state that the machine file requires
};

/// Reads the map and requests the lines. Throws InputError, TargetError and UsageError.
[[nodiscard]] std::unique_ptr<GpioTarget>
make_gpio_target(const GpioAddress& address, const MachineDescription& machine, const RunOptions& options);

} // namespace splinefeed::host
