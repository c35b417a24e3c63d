// SPDX-License-Identifier: MIT
// StepPort: motion port for step and direction lines. Its own real-time thread turns feed segments into edges.
#pragma once

#include "splinefeed/hal/gpio/edge_clock.hpp"
#include "splinefeed/hal/gpio/line_changes.hpp"
#include "splinefeed/hal/gpio/step_log.hpp"
#include "splinefeed/hal/motion_port.hpp"
#include "splinefeed/hal/rt/clock.hpp"
#include "splinefeed/hal/rt/real_time.hpp"
#include "splinefeed/hal/rt/time_histogram.hpp"
#include "splinefeed/s4_segment_stream/segment_ring.hpp"
#include "splinefeed/s5_pulse_train/any_pulse_train.hpp"

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace splinefeed::hal::gpio {

struct StepPortSettings {
    int axes = 1;
    StepTiming timing{};
    RealTimeSettings real_time{};
    std::uint64_t tolerated_ns = 100'000; ///< EdgeClockSettings
    std::uint32_t settle_ms = 0;          ///< from enabling the drives to releasing the brake, or to the first step
    std::uint32_t brake_release_ms = 0;   ///< from releasing the brake to the first step
    std::uint32_t brake_engage_ms = 0;    ///< from engaging the brake to disabling the drives
    std::uint32_t buffer_ms = 50;         ///< motion that is buffered: a feed hold acts after this time
    /// Edges of moving axes that are later than this are a fault: the motors have stopped abruptly, and their positions
    /// are unknown. The default is the duration of the clock's slow-down to standstill.
    std::uint64_t stall_ns = 40'000'000;
    Clock* clock =
        nullptr; ///< must outlive the port; null: the system clock. Tests use a virtual one, without spinning.
};

/// Counts of a motion.
struct StepPortReport {
    std::uint64_t edges = 0;
    std::uint64_t buffer_underruns = 0; ///< segments came too late, and all axes slowed down on the path
    std::uint64_t schedule_slip_ns = 0;
};

/// Executes one motion; after reset() another one. Its thread does not allocate, lock or access files. Positions are
/// counts stepped since construction.
class StepPort final : public MotionPort {
public:
    static constexpr std::uint64_t slice_ns = 500'000; ///< longest time between two cycles of its thread

    /// Sets no line and starts no thread.
    StepPort(std::vector<ChipOutputs> chips, const StepPortSettings& settings);
    StepPort(const StepPort&) = delete;
    StepPort& operator=(const StepPort&) = delete;
    ~StepPort();

    /// Enables the drives and starts the thread, which waits for segments. Returns what the system refused, as
    /// claim_real_time(). After disable() or a fault it does nothing.
    [[nodiscard]] std::string start();
    /// Declares that no more segments will come: the motion ends with the last one.
    void complete() noexcept { complete_.store(true, std::memory_order_release); }
    /// Emergency stop: disables the drives and makes no further edge, within slice_ns plus one wake-up and one write of
    /// lines. Works between start() and stop(), whether axes move or not. Callable from any thread and from signal
    /// handlers.
    void disable() noexcept { disable_requested_.store(true, std::memory_order_release); }
    /// Slows all axes down on the path, independent of the plan, within twice the clock's reserve (40 ms). The port is
    /// then halted. Callable from any thread.
    void quick_stop() noexcept { quick_stop_.store(true, std::memory_order_release); }
    /// Ends the thread. The drives stay enabled, unless disable() was called or a line could not be set.
    void stop() noexcept;
    /// Engages the brake, waits until it holds, and disables the drives. start() enables them again.
    /// @pre stopped
    void park() noexcept;
    /// Prepares for another motion, which may begin at any position. @pre stopped
    void reset() noexcept;

    /// Position of an axis: the sum of its steps. [counts]
    [[nodiscard]] std::int64_t counts(int axis) const noexcept {
        return counts_[static_cast<unsigned>(axis)].load(std::memory_order_relaxed);
    }
    [[nodiscard]] bool was_disabled() const noexcept { return disable_requested_.load(std::memory_order_relaxed); }
    /// No axis moves: the motion has not begun or is complete, or the clock has stopped (it resumes when more segments
    /// come).
    [[nodiscard]] bool at_standstill() const noexcept;
    /// quick_stop() has ended the motion, without a fault.
    [[nodiscard]] bool halted() const noexcept { return state_.load() == State::halted; }
    /// Instant of the last cycle of its thread. [us]
    [[nodiscard]] std::uint64_t last_cycle_us() const noexcept {
        return last_cycle_us_.load(std::memory_order_relaxed);
    }
    /// Drives that should be disabled may be enabled: the line could not be set.
    [[nodiscard]] bool may_be_on() const noexcept { return may_be_on_.load(std::memory_order_relaxed); }
    /// Whether counts() are the positions of the motors. A stepper has no feedback: lost steps are not detected.
    [[nodiscard]] bool position_known() const noexcept { return !was_disabled() && state_.load() != State::failed; }
    /// Log of steps: positions of all axes at an instant.
    [[nodiscard]] const StepLog& log() const noexcept { return log_; }
    [[nodiscard]] const TimeHistogram& late() const noexcept { return late_; }
    [[nodiscard]] StepPortReport report() const noexcept;
    /// Cause of the fault.
    [[nodiscard]] std::string trouble() const;

private:
    enum class State : std::uint8_t { idle, running, done, halted, disabled, failed };

    [[nodiscard]] int do_room() const noexcept override;
    [[nodiscard]] bool do_submit(const FeedSegment& segment) noexcept override;
    PortState do_poll() noexcept override;
    void do_halt() noexcept override { quick_stop(); }

    void work() noexcept;
    bool apply_requests(std::uint64_t now_ns) noexcept;
    [[nodiscard]] bool drives_ready(std::uint64_t now_ns) noexcept;
    void advance(std::uint64_t now_ns) noexcept;
    void switch_off() noexcept;
    void fail(int error) noexcept;
    void wait_until(std::uint64_t instant_ns, std::uint32_t spin_ns) const noexcept;
    [[nodiscard]] bool stalled(std::uint64_t late_ns) const noexcept;
    [[nodiscard]] bool next(Edge& edge) noexcept;
    template <class Engine>
    [[nodiscard]] bool next_of(PulseTrain<Engine>& train, Edge& edge) noexcept;
    [[nodiscard]] bool buffer_filled() const noexcept;
    void check_supply(std::uint64_t now_ns) noexcept;
    [[nodiscard]] bool gather() noexcept;
    void make() noexcept;
    [[nodiscard]] bool steps(const Edge& edge) const noexcept;

    LineChanges lines_;
    StepPortSettings settings_;
    AnyPulseTrain train_;
    EdgeClock clock_;
    std::vector<FeedSegment> segments_; // storage of the ring
    SegmentRing ring_;
    StepLog log_;
    TimeHistogram late_;
    PerAxis<std::atomic<std::int64_t>> counts_{};
    std::atomic<std::uint64_t> submitted_ticks_{0};
    std::atomic<std::uint64_t> motion_ns_{0}; // of the last edge, or elapsed motion time
    std::atomic<std::uint64_t> taken_{0};
    std::atomic<std::uint64_t> edges_{0};
    std::atomic<std::uint64_t> buffer_underruns_{0};
    std::atomic<std::uint64_t> schedule_slip_ns_{0};
    std::atomic<State> state_{State::idle};
    std::atomic<int> error_{0};
    std::atomic<bool> at_rest_{true}; // at the end of the submitted segments
    std::atomic<bool> complete_{false};
    std::atomic<bool> disable_requested_{false};
    std::atomic<bool> ends_{false};
    std::atomic<bool> quick_stop_{false};
    std::atomic<bool> clock_stopped_{false}; // the clock stands
    std::atomic<bool> may_be_on_{false};
    std::atomic<bool> claimed_{false}; // the thread has its real-time settings
    std::atomic<std::uint64_t> last_cycle_us_{0};
    Edge edge_; // the next edge, if have_
    std::int64_t gathered_tick_ = 0;
    PerAxis<bool> stepped_{};           // by the gathered edges
    std::uint64_t overdue_ns_ = 0;      // lateness of the next edge that was absorbed already
    std::uint64_t drives_ready_ns_ = 0; // the drives hold the axes from then on
    std::uint64_t brake_open_ns_ = 0;   // the brake is open from then on
    bool drives_on_ = false;
    bool switched_off_ = false; // the drives were disabled for good
    bool brake_released_ = false;
    bool have_ = false;
    bool gathered_ = false;
    bool finished_ = false; // the train's
    Clock* time_;
    std::unique_ptr<ClockThread> thread_;
};

} // namespace splinefeed::hal::gpio
