// SPDX-License-Identifier: MIT
// SimulatedTool: the simulated machine in real time, for a controller.
#pragma once

#include "host_sim/machine/simulated_machine.hpp"

#include "host_sim/serve/served_machine.hpp"

#include <deque>
#include <optional>

namespace splinefeed::host {

/// It executes each segment when its time has passed. Where segments come late the motion waits: its time stands still.
/// Homing takes half a second, and then the axes stand at 0. A spindle takes the time that the machine file says.
class SimulatedTool final : public ServedMachine {
public:
    static constexpr std::chrono::milliseconds ahead{20}; ///< of motion that it holds
    static constexpr std::chrono::milliseconds dry{8};    ///< with less the plan must not wait for more lines

    /// @param position  where it stands [mm]   @param known  whether that is so
    SimulatedTool(MachineDescription machine, int segments_per_sample, const PerAxis<double>& position, bool known);

    /// Executes what is due.
    void advance(Time now) override;
    [[nodiscard]] bool has_room() const noexcept override { return queued_ < ahead; }
    [[nodiscard]] bool is_dry() const noexcept override { return queued_ < dry; }
    void submit(const FeedSegment& segment) override;
    void rest() override {}
    [[nodiscard]] bool stands() const noexcept override { return queue_.empty() && !moves_; }
    [[nodiscard]] std::vector<RunTarget::AxisPlace> places() const override;

    MachineReading read() noexcept override;
    void obey(const ProgramEvent& event) noexcept override;
    void watch_probe(bool away) noexcept override;
    void home(std::uint32_t axes) noexcept override;
    bool halt() noexcept override { return false; }
    void quick_stop() noexcept override;
    void enable(bool /*on*/) noexcept override {}
    void reset_faults() noexcept override;

private:
    void execute(const FeedSegment& segment);
    void begin_chain();

    MachineDescription description_;
    int segments_per_sample_;
    std::optional<SimulatedMachine> machine_; // of this chain of segments
    std::deque<FeedSegment> queue_;
    std::chrono::nanoseconds queued_{};
    Time time_{}; // up to which the motion has come
    Time now_{};
    Time homed_{};
    Time spindle_ready_{};
    PerAxis<double> mm_{};
    PerAxis<Position> position_{};
    double speed_mm_s_ = 0.0;
    double rpm_ = 0.0;
    std::uint32_t homing_axes_ = 0;
    HomingPhase homing_ = HomingPhase::none;
    std::string fault_;
    bool known_ = true;
    bool moves_ = false;
};

} // namespace splinefeed::host
