// SPDX-License-Identifier: MIT
// SimulatedTool: the simulated machine in real time, for a controller.
#pragma once

#include "host_sim/machine/simulated_machine.hpp"

#include "splinefeed/controller/controlled_machine.hpp"

#include <chrono>
#include <deque>
#include <optional>

namespace splinefeed::host {

/// It executes each segment when its time has passed. Where segments come late the motion waits: its time stands still.
/// Homing takes half a second, and then the axes stand at 0. A spindle takes the time that the machine file says.
class SimulatedTool final : public ControlledMachine {
public:
    using Time = std::chrono::steady_clock::time_point;
    static constexpr std::chrono::milliseconds ahead{20}; ///< of motion that it holds
    static constexpr std::chrono::milliseconds dry{8};    ///< with less the plan must not wait for more lines

    /// @param position  where it stands [mm]   @param known  whether that is so
    SimulatedTool(MachineDescription machine, int segments_per_sample, const PerAxis<double>& position, bool known);

    /// Executes what is due.
    void advance(Time now);
    [[nodiscard]] bool has_room() const noexcept { return queued_ < ahead; }
    [[nodiscard]] bool is_dry() const noexcept { return queued_ < dry; }
    void submit(const FeedSegment& segment);
    [[nodiscard]] const PerAxis<double>& position_mm() const noexcept { return mm_; }
    [[nodiscard]] bool stands() const noexcept { return queue_.empty() && !moves_; }
    /// Whether the program's offsets have changed since the last call.
    [[nodiscard]] bool take_offsets_change() noexcept { return std::exchange(offsets_changed_, false); }

    MachineReading read() noexcept override;
    void obey(const ProgramEvent& event) noexcept override;
    void watch_probe(bool away) noexcept override;
    void home(std::uint32_t axes) noexcept override;
    void quick_stop() noexcept override;
    void enable(bool /*on*/) noexcept override {}
    void reset_faults() noexcept override;
    void offsets_changed() noexcept override { offsets_changed_ = true; }

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
    bool offsets_changed_ = false;
};

} // namespace splinefeed::host
