// SPDX-License-Identifier: MIT
// SimTarget: the simulated machine in real time, a target like others. SimSpindle: its spindle.
#pragma once

#include "host_sim/machine/simulated_machine.hpp"
#include "host_sim/ports/output_parts.hpp"
#include "host_sim/ports/run_target.hpp"

#include "splinefeed/hal/rt/clock.hpp"

#include <atomic>
#include <deque>
#include <optional>

namespace splinefeed::host {

/// It executes each segment when its time has passed; where segments come late the motion waits. What breaks a limit is
/// a fault. It stands where it was told, and stops in an instant. Homing takes half a second. Nothing is ever touched.
class SimTarget final : public RunTarget, private hal::MotionPort {
public:
    /// All must outlive it.
    SimTarget(const MachineDescription& machine, const RunOptions& options,
              hal::Clock& clock = hal::system_clock()) noexcept
        : machine_(&machine), interrupted_(options.interrupted), clock_(&clock) {}

    [[nodiscard]] TargetFacts facts() const override;
    [[nodiscard]] hal::MotionPort& port() noexcept override { return *this; }
    [[nodiscard]] Signs signs() override { return {.least_ahead_us = dry_us}; }
    [[nodiscard]] std::string halted(bool quick) const override;
    [[nodiscard]] std::string leave(bool /*off*/) override { return {}; }
    [[nodiscard]] std::vector<AxisPlace> places() const override;
    [[nodiscard]] std::string where() const override;
    void describe(Summary& /*summary*/) const override {}

private:
    static constexpr std::uint64_t ahead_us = 10'000; // of motion that it holds
    static constexpr std::uint64_t dry_us = 8'000;

    [[nodiscard]] hal::PortFailure open() override { return {}; }
    [[nodiscard]] hal::PortFailure prepare(const FeedSegment& first) override;
    [[nodiscard]] hal::PortFailure renew(const FeedSegment& first) override;
    [[nodiscard]] int room() const noexcept override;
    [[nodiscard]] bool submit(const FeedSegment& segment) noexcept override;
    void complete() noexcept override { completed_ = true; }
    hal::PortState poll() noexcept override;
    void halt() noexcept override { stop(hal::PortPhase::halted); }
    [[nodiscard]] hal::PortFailure failure() const override;

    [[nodiscard]] PerAxis<double> mm_of(const PerAxis<std::int64_t>& units) const noexcept;
    [[nodiscard]] PerAxis<double> now_mm() const noexcept;
    [[nodiscard]] std::uint64_t now_ticks() const noexcept {
        return clock_->now_us() * static_cast<std::uint64_t>(ticks_per_us);
    }
    void stop(hal::PortPhase phase) noexcept;

    const MachineDescription* machine_;
    bool (*interrupted_)();
    hal::Clock* clock_;
    std::optional<SimulatedMachine> checks_; // of this motion
    std::deque<FeedSegment> queue_;
    std::uint64_t queued_ticks_ = 0;
    std::uint64_t time_ticks_ = 0; // up to which the motion has come
    std::uint64_t executed_ = 0;
    PerAxis<double> mm_{};
    hal::PortPhase phase_ = hal::PortPhase::idle;
    bool completed_ = false;
};

/// It takes the time that the machine file says.
class SimSpindle final : public OutputPart {
public:
    explicit SimSpindle(const SpindleDescription& machine, hal::Clock& clock = hal::system_clock()) noexcept
        : machine_(&machine), clock_(&clock) {}

    void act(const ProgramAction& action) override;
    void end() noexcept override { turn({}); }
    [[nodiscard]] Progress progress() const override;
    [[nodiscard]] std::string trouble() const override { return {}; }

private:
    void turn(const SpindleTurn& turn) noexcept;

    const SpindleDescription* machine_;
    hal::Clock* clock_;
    std::atomic<double> rpm_{0.0};
    std::atomic<std::uint64_t> ready_us_{0};
};

} // namespace splinefeed::host
