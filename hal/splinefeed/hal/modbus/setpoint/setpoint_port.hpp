// SPDX-License-Identifier: MIT
// SetpointPort: a motion port whose axes are drives that get targets or blocks on the fly (their profiles say which),
// all of them along one motion clock.
#pragma once

#include "splinefeed/hal/modbus/setpoint/axis_frame.hpp"
#include "splinefeed/hal/modbus/setpoint/setpoint_stop.hpp"
#include "splinefeed/hal/modbus/setpoint/setpoint_watch.hpp"
#include "splinefeed/hal/modbus/setpoint/setpoint_wiring.hpp"
#include "splinefeed/hal/motion_port.hpp"

namespace splinefeed::hal::modbus {

struct SetpointPortSettings {
    std::uint32_t reserve_us = 100'000; ///< motion on which a stop on the path takes slot
    bool home = false;                  ///< prepare() has the drives find their references first, one after the other
    bool (*interrupted)() = nullptr;    ///< asked meanwhile: a quick stop
    std::uint32_t buffer_us = 300'000;  ///< motion that is planned ahead
    std::uint32_t away_us = 5'000'000;  ///< a drive that was not heard for this long: the port gives up
    LinkTiming timing{};
    MakeLine make_line = make_link;
    Clock* clock = &system_clock(); ///< outlives the port
};

class SetpointPort final : public MotionPort {
public:
    /// One bus for each wire. It allocates, as open() and prepare() do; submit, poll and halt do not.
    SetpointPort(const std::vector<SetpointWiring>& wiring, const SetpointPortSettings& settings);
    SetpointPort(const SetpointPort&) = delete;
    SetpointPort& operator=(const SetpointPort&) = delete;
    ~SetpointPort() { close(); }

    /// Connects to all drives and looks whether they are what their profiles say. Empty, or what is wrong with
    /// trouble_with(). Nothing moves.
    [[nodiscard]] std::string open();
    /// Period of the targets: the shortest that every wire and drive can keep, found by open(). [us]
    [[nodiscard]] std::uint32_t period_us() const noexcept { return period_us_; }
    /// Reads a drive's status once, the next frame of it. After open(), before prepare().
    LinkAnswer probe(std::size_t drive) noexcept;
    /// Enables all drives; where they stand is where the first segment starts. Empty, or what is wrong.
    [[nodiscard]] std::string prepare(const FeedSegment& first);
    /// No more segments come.
    void complete() noexcept;
    /// Every axis stops as hard as its drive can, off the path. Ends like halt(): when every drive has confirmed its
    /// stop, or did not within its time; stop_report() says which.
    void quick_stop() noexcept;
    /// Switches every drive's power off; waits until each has confirmed it, or stop_report() says that it did not. @pre
    /// they stand
    void power_off() noexcept;
    /// How a drive was stopped: by halt(), quick_stop(), or because the port is in fault. Nothing asked for: request
    /// none.
    [[nodiscard]] StopReport stop_report(std::size_t drive) const noexcept { return stop_.report(drive); }
    /// The longest that a stop takes, whatever answers. [us] After prepare().
    [[nodiscard]] std::uint64_t longest_stop_us() const noexcept {
        return stop_times_.hold_us + stop_times_.quick_stop_us + stop_times_.disable_us;
    }

    /// Why it is in fault, or did not take a segment; the drive that it is about.
    [[nodiscard]] const std::string& trouble() const noexcept { return trouble_; }
    [[nodiscard]] std::size_t trouble_with() const noexcept { return trouble_with_; }
    [[nodiscard]] std::size_t drives() const noexcept { return slots_.size(); }
    [[nodiscard]] SetpointReport report(std::size_t drive) const noexcept {
        return slots_[drive].bus->report(slots_[drive].index);
    }
    /// Before prepare(): where the drive itself says that it is, and how its wire did.
    [[nodiscard]] double standing_counts(std::size_t drive) const noexcept {
        const DriveReading& reading = slots_[drive].bus->drive(slots_[drive].index).reading();
        return static_cast<double>(reading.position_q16) / (1 << physical_bits);
    }
    [[nodiscard]] const LinkCounts& counts(std::size_t drive) const noexcept {
        return slots_[drive].bus->drive(slots_[drive].index).counts();
    }
    /// Where a machine's axis stands by what its drive says, in counts of the machine.
    [[nodiscard]] double position_counts(std::size_t drive) const noexcept {
        return slots_[drive].frame.axis_counts(report(drive).reading.position_q16);
    }
    /// Whether it was heard just now.
    [[nodiscard]] bool online(std::size_t drive) const noexcept;
    /// How far the drive may have been from the path between two targets, by what was submitted so far, with what its
    /// registers round and how late its targets came. [counts]
    [[nodiscard]] double deviation_counts(std::size_t drive) const noexcept;
    /// The same by the axis's acceleration.
    [[nodiscard]] double deviation_bound_counts(std::size_t drive) const noexcept;
    /// How often all stopped together, because targets came late, and went on.
    [[nodiscard]] std::uint32_t resumes() const noexcept { return resumes_; }
    [[nodiscard]] std::uint64_t busy_us() const noexcept;
    /// Ends the threads. What still moves is held first.
    void close() noexcept;

private:
    enum class Phase : std::uint8_t { filling, running, arriving, stopping, waiting, ending, halted, done, fault };

    struct Slot {
        SetpointWiring wiring;
        SetpointBus* bus = nullptr;
        std::size_t index = 0; // on the bus
        AxisFrame frame;
        double deviation_counts = 0.0; // between targets alone
        double speed_counts_s = 0.0;   // the largest
        SetpointWatch watch;
    };

    [[nodiscard]] int do_room() const noexcept override;
    [[nodiscard]] bool do_submit(const FeedSegment& segment) noexcept override;
    PortState do_poll() noexcept override;
    void do_halt() noexcept override;

    [[nodiscard]] std::uint64_t answers_us() const noexcept;
    bool check_drives() noexcept;
    void begin_stop(StopRequest request) noexcept;
    void follow_stop(std::uint64_t now_us) noexcept;
    void await_stop() noexcept;
    void follow_clock(std::uint64_t now_us) noexcept;
    [[nodiscard]] bool accepts_segments() const noexcept {
        return phase_ == Phase::filling || phase_ == Phase::running || phase_ == Phase::waiting ||
               phase_ == Phase::stopping;
    }
    [[nodiscard]] bool arrived() noexcept;
    [[nodiscard]] std::uint64_t executed() const noexcept;

    SetpointPortSettings settings_;
    mutable SetpointMotion motion_; // the buses' threads use it to their end
    std::vector<std::unique_ptr<SetpointBus>> buses_;
    std::vector<Slot> slots_;
    std::vector<StopFacts> facts_; // of each drive
    StopSequence stop_;
    StopTimes stop_times_;
    std::uint64_t stop_began_us_ = 0;
    std::string trouble_;
    std::size_t trouble_with_ = 0;
    Phase phase_ = Phase::filling;
    std::uint64_t arriving_us_ = 0;
    std::uint64_t began_us_ = 0;         // the buses' threads; 0: not yet
    std::uint64_t waiting_since_us_ = 0; // when it began to wait
    std::uint64_t arrived_since_us_ = 0; // all have arrived since then; 0: not yet
    std::uint64_t submitted_ = 0;
    std::uint64_t segment_us_ = 1;
    std::uint32_t period_us_ = 0;
    std::uint32_t resumes_ = 0;
};

} // namespace splinefeed::hal::modbus
