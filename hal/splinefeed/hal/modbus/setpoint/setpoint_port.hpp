// SPDX-License-Identifier: MIT
// SetpointPort: motion port for drives that get cyclic targets or blocks, by their profiles. All drives follow one
// motion clock.
#pragma once

#include "splinefeed/hal/modbus/setpoint/setpoint_group.hpp"
#include "splinefeed/hal/modbus/setpoint/setpoint_phases.hpp"
#include "splinefeed/hal/motion_port.hpp"

namespace splinefeed::hal::modbus {

class SetpointPort final : public MotionPort {
public:
    /// Makes one bus for each wire. Constructor, open() and prepare() allocate; submit(), poll() and halt() do not.
    SetpointPort(const std::vector<SetpointWiring>& wiring, const SetpointPortSettings& settings);
    ~SetpointPort() { close(); }

    /// Checks the drives against their profiles.
    [[nodiscard]] PortFailure open() override;
    /// Period of the targets: the shortest that all wires and drives support. [us] After open().
    [[nodiscard]] std::uint32_t period_us() const noexcept { return group_.period_us(); }
    /// Reads the next status frame of a drive. Call between open() and prepare().
    LinkAnswer probe(std::size_t drive) noexcept;
    /// Waits until no drive moves, so that standing_counts() has where it stands. Sends no command, so nothing changes.
    /// Returns the first drive that goes on moving, does not answer, or is in a fault that prepare() will not reset.
    /// Call between open() and prepare().
    [[nodiscard]] PortFailure await_standstill();
    /// Whether the drive says that it has its reference: then its counts are those of the machine's axis. Before
    /// prepare().
    [[nodiscard]] bool placed(std::size_t drive) const noexcept { return group_.placed(drive); }
    /// Where the drive stands by what its counts meant in the motion before, in counts of the machine's axis; empty:
    /// there was none, or it may have been off since. Between open() and prepare().
    [[nodiscard]] std::optional<double> kept_counts(std::size_t drive) const noexcept {
        return group_.keeps_place(drive) ? std::optional(group_.frame(drive).axis_counts(reading(drive).position_q16))
                                         : std::nullopt;
    }
    /// Enables all drives and maps their positions to the start of the first segment. If something is wrong all drives
    /// were stopped by then: a drive that was homing by a quick stop, the others by a hold. Or it is known that they
    /// did not confirm it: stop_report().
    [[nodiscard]] PortFailure prepare(const FeedSegment& first) override;
    /// As prepare(), but positions keep their meaning.
    [[nodiscard]] PortFailure renew(const FeedSegment& first) override;
    [[nodiscard]] int room() const noexcept override;
    /// With less motion than this, of which the end is not declared, all drives slow down. [us]
    [[nodiscard]] std::uint64_t least_ahead_us() const noexcept;
    [[nodiscard]] bool submit(const FeedSegment& segment) noexcept override;
    void complete() noexcept override;
    PortState poll() noexcept override;
    /// A stop is over when every drive has confirmed it or its time is over: stop_report().
    void halt() noexcept override;
    void quick_stop() noexcept override;
    void power_off() noexcept override;
    void close() noexcept override;
    [[nodiscard]] PortFailure failure() const override { return trouble_; }
    /// State of a drive's stop after halt(), quick_stop() or a fault of the port. No stop requested: StopRequest::none.
    [[nodiscard]] StopReport stop_report(std::size_t drive) const noexcept { return stop_.report(drive); }
    /// Longest duration of a stop, whether the drives answer or not. [us] After prepare().
    [[nodiscard]] std::uint64_t longest_stop_us() const noexcept { return stop_times_.longest_us(); }

    [[nodiscard]] std::size_t drives() const noexcept { return group_.size(); }
    [[nodiscard]] SetpointReport report(std::size_t drive) const noexcept { return group_.report(drive); }
    /// What the drive reports, in its own counts. Before prepare().
    [[nodiscard]] const DriveReading& reading(std::size_t drive) const noexcept {
        return group_.drive(drive).reading();
    }
    /// Position that the drive reports, in its own counts. Before prepare().
    [[nodiscard]] double standing_counts(std::size_t drive) const noexcept {
        return static_cast<double>(reading(drive).position_q16) / (1 << physical_bits);
    }
    /// Statistics of its exchanges. Before prepare().
    [[nodiscard]] const LinkCounts& counts(std::size_t drive) const noexcept { return group_.drive(drive).counts(); }
    /// prepare() succeeded: positions of the drives are those of the machine.
    [[nodiscard]] bool referenced() const noexcept { return referenced_; }
    /// Reported position of a drive, in counts of the machine's axis. Empty: it is not known which position of the axis
    /// that is. prepare() has not come so far, or the drive was off since. After prepare().
    [[nodiscard]] std::optional<double> position_counts(std::size_t drive) const noexcept {
        const AxisFrame& frame = group_.frame(drive);
        const SetpointReport last = report(drive);
        return frame.aligned() && !last.lost ? std::optional(frame.axis_counts(last.reading.position_q16))
                                             : std::nullopt;
    }
    /// Whether the drive has answered recently.
    [[nodiscard]] bool online(std::size_t drive) const noexcept { return group_.online(drive); }
    /// Upper bound of the drive's distance from the path, by the segments so far, the rounding of its registers and the
    /// lateness of its targets. [counts]
    [[nodiscard]] double deviation_counts(std::size_t drive) const noexcept { return group_.deviation_counts(drive); }
    /// The same for any path with the axis's acceleration, with targets in time. [counts]
    [[nodiscard]] double deviation_bound_counts(std::size_t drive) const noexcept {
        return group_.deviation_bound_counts(drive);
    }
    /// Number of times that all drives stopped because of late targets and resumed.
    [[nodiscard]] std::uint32_t resumes() const noexcept { return resumes_; }
    [[nodiscard]] std::uint64_t busy_us() const noexcept { return group_.busy_us(); }
    /// What the port has been through.
    [[nodiscard]] const SetpointPhases& phases() const noexcept { return phases_; }

private:
    using Phase = SetpointPhase;
    using Event = SetpointEvent;
    /// What is true at a poll, whatever the phase.
    using Facts = std::array<bool, SetpointPhases::events>;

    [[nodiscard]] PortFailure begin_motion(const FeedSegment& first, bool placed);
    void set_times();
    void make_room(const FeedSegment& first);
    void begin_stop(StopRequest request, Event reason = Event::stop) noexcept;
    void fail(PortFailure&& trouble) noexcept;
    void follow_stop(std::uint64_t now_us) noexcept;
    void await_stop() noexcept;
    void follow_clock(std::uint64_t now_us) noexcept;
    void follow_bounds(std::uint64_t now_us) noexcept;
    [[nodiscard]] Facts facts(std::uint64_t now_us) noexcept;
    void start_clock(std::uint64_t now_us) noexcept;
    void find_late() noexcept;
    [[nodiscard]] bool accepts_segments() const noexcept {
        const Phase phase = phases_.phase();
        return phase == Phase::filling || phase == Phase::running || phase == Phase::stopping ||
               phase == Phase::starved || phase == Phase::returning;
    }
    [[nodiscard]] std::uint64_t executed() const noexcept;

    SetpointPortSettings settings_;
    std::unique_ptr<SetpointMotion> motion_; // used by the bus threads until they end
    SetpointGroup group_;
    std::vector<StopFacts> facts_; // of each drive
    StopSequence stop_;
    StopTimes stop_times_;
    std::uint64_t stop_began_us_ = 0;
    PortFailure trouble_;
    std::size_t awaited_ = 0; // the drive that was found last not to be ready, or not to have arrived
    SetpointPhases phases_{setpoint_table(), Phase::filling};
    std::uint64_t began_us_ = 0;         // when the bus threads started; 0: not yet
    std::uint64_t stood_since_us_ = 0;   // the clock stands since then; 0: it does not
    std::uint64_t arrived_since_us_ = 0; // all drives have arrived since then; 0: not yet
    std::uint64_t time_us_ = 0;          // of the motion, at the last poll
    std::uint64_t bounded_us_ = 0;       // when it was last looked whether the motion advances,
    std::uint64_t bounded_time_us_ = 0;  // and its time then
    std::uint64_t lag_us_ = 0;           // how much longer it takes than it may, because of late targets
    std::uint32_t late_stops_ = 0;       // by late targets of any drive
    std::size_t latest_ = 0;             // the drive whose targets were late most often
    bool referenced_ = false;
    bool late_ = false; // the last stop was because of late targets
    std::uint64_t submitted_ = 0;
    std::uint64_t segment_ticks_ = 1;
    std::uint32_t resumes_ = 0;
};

} // namespace splinefeed::hal::modbus
