// SPDX-License-Identifier: MIT
// SimulatedMachine: a motion port that executes feed segments in virtual time and proves that they keep every limit.
//
// It trusts nothing: each segment must start exactly where the last one ended, and velocity, acceleration, jerk, travel
// and path speed are checked against the machine file. It stops permanently at the first violation.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/machine/axis_allowance.hpp"
#include "host_sim/machine/machine_fault.hpp"
#include "host_sim/machine/segment_cubic.hpp"

#include "splinefeed/hal/motion_port.hpp"

#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <vector>

namespace splinefeed {
struct CounterSeam; // of tests
} // namespace splinefeed

namespace splinefeed::host {

/// Receives the planned positions of the axes, once per sample period.
struct TraceSink {
    /// @param ticks  since the start of the first segment, in 1/8 us
    virtual void row(std::uint64_t ticks, const PerAxis<double>& position_mm, double speed_mm_s) = 0;

protected:
    ~TraceSink() = default;
};

/// Largest use of an axis's limits, 1 = at the limit; jerk is 0 where the machine file has no limit.
struct LimitUse {
    double velocity = 0.0;
    double acceleration = 0.0;
    double jerk = 0.0;
};

struct SimulationOptions {
    bool enforce = true;       ///< false: limits are only measured (chain, duration and underrun are still faults)
    bool measures = true;      ///< false: only the chain is looked at, and the time counts
    int ticks_per_segment = 8; ///< rate of the machine's own interpolation, 1 to 1024
    int queue = 64;            ///< largest number of waiting segments
    TraceSink* trace = nullptr;
};

/// Checked per segment: velocity, acceleration and jerk of each axis, over the whole segment and not only at ticks
/// (acceleration is linear, velocity a parabola with a known peak). Acceleration against the velocity of that instant
/// is braking. Checked per tick, `ticks_per_segment` times: position, counts, travel and path speed (with its peak
/// between ticks). The tolerance is that of AxisAllowance. Memory: the queue. Cost of a segment: about 0.5 us for three
/// axes and 8 ticks; it allocates only for a fault.
class SimulatedMachine final : public hal::MotionPort {
public:
    using Options = SimulationOptions;

    /// `segments_per_sample`: number of segments per trace row (MotionLimits::segments_per_sample).
    /// @pre MotionLimits::make accepts the machine's settings (except for jerk)
    SimulatedMachine(const MachineDescription& machine, int segments_per_sample, const Options& options = {});

    [[nodiscard]] int room() const noexcept override;
    [[nodiscard]] bool submit(const FeedSegment& segment) noexcept override;
    hal::PortState poll() noexcept override;
    void halt() noexcept override;
    [[nodiscard]] hal::PortFailure failure() const override {
        return fault_ ? hal::PortFailure{describe(*fault_)} : hal::PortFailure{};
    }

    /// Call it at the end of the motion. It writes the last trace row if the last sample period is incomplete (not
    /// after a fault), and throws what the trace sink threw.
    void finish();

    /// What the trace sink threw; null: nothing. The machine goes on without it.
    [[nodiscard]] const std::exception_ptr& trace_failure() const noexcept { return trace_failure_; }
    [[nodiscard]] const std::optional<Fault>& fault() const noexcept { return fault_; }
    [[nodiscard]] const LimitUse& use(int axis) const noexcept { return use_[static_cast<unsigned>(axis)]; }
    [[nodiscard]] double max_path_speed_mm_s() const noexcept { return max_path_speed_; }
    /// Duration of all segments that were executed completely.
    [[nodiscard]] double cycle_time_s() const noexcept { return seconds(elapsed_ticks_); }
    [[nodiscard]] std::uint64_t segments() const noexcept { return executed_; }
    /// Position of the axis in whole counts: the nearest count, ties upwards.
    [[nodiscard]] std::int64_t counts(int axis) const noexcept { return counts_[static_cast<unsigned>(axis)]; }
    /// Counts travelled in both directions, as seen at ticks.
    [[nodiscard]] std::uint64_t pulses(int axis) const noexcept { return pulses_[static_cast<unsigned>(axis)]; }
    /// Position of the machine (after a fault: at the last tick before it).
    [[nodiscard]] PerAxis<double> position_mm() const noexcept;

private:
    friend struct splinefeed::CounterSeam;

    struct Motion;

    [[nodiscard]] static double seconds(std::uint64_t ticks) noexcept {
        return static_cast<double>(ticks) / (ticks_per_us * 1e6);
    }
    [[nodiscard]] bool moving() const noexcept;
    [[nodiscard]] double path_speed() const noexcept;
    bool execute(const FeedSegment& segment);
    bool accept(const FeedSegment& segment);
    void survey(Motion& motion) noexcept;
    bool tick(Motion& motion, int j);
    bool check_axes(const Motion& motion, int j);
    bool check_path(Motion& motion, int j);
    bool check_travel(const Motion& motion, unsigned k, std::int64_t position, double u);
    bool fail(FaultKind kind, unsigned axis, double time_s, double value, double limit, const char* unit,
              std::uint32_t waypoint);
    void trace_row() noexcept;

    MachineDescription description_;
    PerAxis<AxisAllowance> axis_{};
    Allowance feed_{};
    Allowance turning_feed_{}; ///< used if only rotary axes move
    bool mixed_ = false;       ///< rotary axes together with linear ones
    Options options_;
    unsigned axes_;
    int segments_per_sample_;

    std::vector<FeedSegment> queue_; // ring
    std::size_t head_ = 0;
    std::size_t queued_ = 0;

    PerAxis<std::int64_t> position_{}; // [units]
    PerAxis<std::int64_t> velocity_{}; // at the end of the last segment [units per duration_ticks_]
    PerAxis<double> acceleration_{};   // at the end of the last segment [mm/s^2]
    PerAxis<std::int64_t> counts_{};
    PerAxis<std::uint64_t> pulses_{};
    std::uint32_t duration_ticks_ = 1;
    std::uint32_t waypoint_ = 0;
    std::uint64_t elapsed_ticks_ = 0;
    std::uint64_t executed_ = 0;
    int untraced_ = 0; // segments since the last trace row
    bool started_ = false;
    bool halted_ = false;

    PerAxis<LimitUse> use_{};
    double max_path_speed_ = 0.0;
    std::optional<Fault> fault_;
    std::exception_ptr trace_failure_;
};

} // namespace splinefeed::host
