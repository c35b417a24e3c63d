// SPDX-License-Identifier: MIT
// SetpointPort: motion port for drives that get cyclic targets or blocks, by their profiles. All drives follow one
// motion clock.
#pragma once

#include "splinefeed/hal/modbus/setpoint/axis_frame.hpp"
#include "splinefeed/hal/modbus/setpoint/setpoint_stop.hpp"
#include "splinefeed/hal/modbus/setpoint/setpoint_watch.hpp"
#include "splinefeed/hal/modbus/setpoint/setpoint_wiring.hpp"
#include "splinefeed/hal/motion_port.hpp"

namespace splinefeed::hal::modbus {

struct SetpointPortSettings {
    std::uint32_t reserve_us = 100'000; ///< motion time of a stop on the path
    bool home = false;                  ///< prepare() homes the drives first, one after the other
    bool (*interrupted)() = nullptr;    ///< polled during homing; true: quick stop
    std::uint32_t buffer_us = 300'000;  ///< motion that is buffered ahead
    std::uint32_t away_us = 5'000'000;  ///< a drive is offline for this long: the port goes to fault
    LinkTiming timing{};
    MakeLine make_line = make_link;
    Clock* clock = &system_clock(); ///< must outlive the port
};

class SetpointPort final : public MotionPort {
public:
    /// Makes one bus for each wire. Constructor, open() and prepare() allocate; submit(), poll() and halt() do not.
    SetpointPort(const std::vector<SetpointWiring>& wiring, const SetpointPortSettings& settings);
    SetpointPort(const SetpointPort&) = delete;
    SetpointPort& operator=(const SetpointPort&) = delete;
    ~SetpointPort() { close(); }

    /// Connects to all drives and checks them against their profiles. Nothing moves. Returns what is wrong with drive
    /// trouble_with(); empty: nothing.
    [[nodiscard]] std::string open();
    /// Period of the targets: the shortest that all wires and drives support. [us] After open().
    [[nodiscard]] std::uint32_t period_us() const noexcept { return period_us_; }
    /// Reads the next status frame of a drive. Call between open() and prepare().
    LinkAnswer probe(std::size_t drive) noexcept;
    /// Enables all drives and maps their positions to the start of the first segment. Returns what is wrong; empty:
    /// nothing.
    [[nodiscard]] std::string prepare(const FeedSegment& first);
    /// Declares that no more segments will come.
    void complete() noexcept;
    /// Every axis stops as hard as its drive can and leaves the path. Ends like halt(), when every drive has confirmed
    /// its stop or its time is over: stop_report().
    void quick_stop() noexcept;
    /// Switches the power of every drive off and waits until each has confirmed it or its time is over: stop_report().
    /// @pre the drives stand
    void power_off() noexcept;
    /// State of a drive's stop after halt(), quick_stop() or a fault of the port. No stop requested: StopRequest::none.
    [[nodiscard]] StopReport stop_report(std::size_t drive) const noexcept { return stop_.report(drive); }
    /// Longest duration of a stop, whether the drives answer or not. [us] After prepare().
    [[nodiscard]] std::uint64_t longest_stop_us() const noexcept {
        return stop_times_.hold_us + stop_times_.quick_stop_us + stop_times_.disable_us;
    }

    /// Cause of the fault or of a rejected segment, and the index of its drive.
    [[nodiscard]] const std::string& trouble() const noexcept { return trouble_; }
    [[nodiscard]] std::size_t trouble_with() const noexcept { return trouble_with_; }
    [[nodiscard]] std::size_t drives() const noexcept { return slots_.size(); }
    [[nodiscard]] SetpointReport report(std::size_t drive) const noexcept {
        return slots_[drive].bus->report(slots_[drive].index);
    }
    /// Position that the drive reports, in its own counts, and statistics of its exchanges. Before prepare().
    [[nodiscard]] double standing_counts(std::size_t drive) const noexcept {
        const DriveReading& reading = slots_[drive].bus->drive(slots_[drive].index).reading();
        return static_cast<double>(reading.position_q16) / (1 << physical_bits);
    }
    [[nodiscard]] const LinkCounts& counts(std::size_t drive) const noexcept {
        return slots_[drive].bus->drive(slots_[drive].index).counts();
    }
    /// Reported position of a drive, in counts of the machine's axis.
    [[nodiscard]] double position_counts(std::size_t drive) const noexcept {
        return slots_[drive].frame.axis_counts(report(drive).reading.position_q16);
    }
    /// Whether the drive has answered recently.
    [[nodiscard]] bool online(std::size_t drive) const noexcept;
    /// Upper bound of the drive's distance from the path, by the segments so far, the rounding of its registers and the
    /// lateness of its targets. [counts]
    [[nodiscard]] double deviation_counts(std::size_t drive) const noexcept;
    /// The same for any path with the axis's acceleration, with targets in time. [counts]
    [[nodiscard]] double deviation_bound_counts(std::size_t drive) const noexcept;
    /// Number of times that all drives stopped because of late targets and resumed.
    [[nodiscard]] std::uint32_t resumes() const noexcept { return resumes_; }
    [[nodiscard]] std::uint64_t busy_us() const noexcept;
    /// Holds the drives if they move, then ends the threads.
    void close() noexcept;

private:
    enum class Phase : std::uint8_t { filling, running, arriving, stopping, waiting, ending, halted, done, fault };

    struct Slot {
        SetpointWiring wiring;
        SetpointBus* bus = nullptr;
        std::size_t index = 0; // index on the bus
        AxisFrame frame;
        double deviation_counts = 0.0; // between two targets
        double speed_counts_s = 0.0;   // largest speed
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
    mutable SetpointMotion motion_; // used by the bus threads until they end
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
    std::uint64_t began_us_ = 0;         // when the bus threads started; 0: not yet
    std::uint64_t waiting_since_us_ = 0; // last instant before waiting
    std::uint64_t arrived_since_us_ = 0; // all drives have arrived since then; 0: not yet
    std::uint64_t submitted_ = 0;
    std::uint64_t segment_us_ = 1;
    std::uint32_t period_us_ = 0;
    std::uint32_t resumes_ = 0;
};

} // namespace splinefeed::hal::modbus
