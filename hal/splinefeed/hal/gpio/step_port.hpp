// SPDX-License-Identifier: MIT
// StepPort: feed segments to edges of output lines, in real time, by a thread of its own.
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
    std::uint32_t settle_ms = 0;          ///< from switching the drives on to releasing the brake, or to the first step
    std::uint32_t brake_release_ms = 0;   ///< from releasing the brake to the first step
    std::uint32_t brake_engage_ms = 0;    ///< from engaging the brake to switching the drives off
    std::uint32_t buffer_ms = 50;         ///< what is held of a motion: how long a feed hold takes to act
    /// Edges of axes that move came later than this: the motors have stopped at once, from whatever speed, and where
    /// they stand is not known. That is a fault. The default is how long the clock takes to slow down to stand.
    std::uint64_t stall_ns = 40'000'000;
    Clock* clock = nullptr; ///< outlives the port; null: the system's. A test's own one, without spinning.
};

/// How the edges of a motion came.
struct StepPortReport {
    std::uint64_t edges = 0;
    std::uint64_t buffer_underruns = 0; ///< the next segment was not there in time: all axes slowed down, on the path
    std::uint64_t schedule_slip_ns = 0;
};

/// One motion, then reset() and the next one. Its thread waits for instants, and neither allocates, nor locks, nor
/// touches a file. Positions are counts that were stepped since the port was made.
class StepPort final : public MotionPort {
public:
    static constexpr std::uint64_t slice_ns = 500'000; ///< its thread looks around as often

    /// Nothing is set and no thread runs yet.
    StepPort(std::vector<ChipOutputs> chips, const StepPortSettings& settings);
    StepPort(const StepPort&) = delete;
    StepPort& operator=(const StepPort&) = delete;
    ~StepPort();

    /// Enables the drives and waits for segments. Returns what real time lacks, as claim_real_time(). After a cut or a
    /// fault it enables nothing, and the port stays as it is.
    [[nodiscard]] std::string start();
    /// No more segments come: it ends with the last one.
    void complete() noexcept { complete_.store(true, std::memory_order_release); }
    /// From any thread, also a handler of signals: within slice_ns, and what a wake-up and one call that sets lines
    /// take, no line changes any more, but enable, to off. So it is from start() to stop(), whether anything moves or
    /// not.
    void disable() noexcept { disable_requested_.store(true, std::memory_order_release); }
    /// From any thread: all axes slow down on the path, over twice the clock's reserve (40 ms), whatever the plan says,
    /// and stay there: the port is halted.
    void quick_stop() noexcept { quick_stop_.store(true, std::memory_order_release); }
    /// Ends the thread; the drives stay enabled, unless they were cut or a line could not be set.
    void stop() noexcept;
    /// Engages the brake, waits until it holds, and switches the drives off. start() switches them on again.
    /// @pre stopped
    void park() noexcept;
    /// @pre stopped. For another motion, which may begin anywhere.
    void reset() noexcept;

    /// Where an axis stands [counts]: what was stepped.
    [[nodiscard]] std::int64_t counts(int axis) const noexcept {
        return counts_[static_cast<unsigned>(axis)].load(std::memory_order_relaxed);
    }
    [[nodiscard]] bool was_disabled() const noexcept { return disable_requested_.load(std::memory_order_relaxed); }
    /// No axis moves: nothing has begun, all is executed, or the clock stands (where more segments come, it goes on).
    [[nodiscard]] bool at_standstill() const noexcept;
    /// The port is fault-free, and its thread has ended a motion by quick_stop().
    [[nodiscard]] bool halted() const noexcept { return state_.load() == State::halted; }
    /// When its thread looked around last. [us]
    [[nodiscard]] std::uint64_t last_cycle_us() const noexcept {
        return last_cycle_us_.load(std::memory_order_relaxed);
    }
    /// Drives that were to be off may be on: the line could not be set.
    [[nodiscard]] bool may_be_on() const noexcept { return may_be_on_.load(std::memory_order_relaxed); }
    /// Whether the counts are where the motors stand, as far as a stepper tells.
    [[nodiscard]] bool position_known() const noexcept { return !was_disabled() && state_.load() != State::failed; }
    /// Where all axes stood at an instant.
    [[nodiscard]] const StepLog& log() const noexcept { return log_; }
    [[nodiscard]] const TimeHistogram& late() const noexcept { return late_; }
    [[nodiscard]] StepPortReport report() const noexcept;
    /// Why it is in fault.
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
    std::vector<FeedSegment> segments_; // the ring's
    SegmentRing ring_;
    StepLog log_;
    TimeHistogram late_;
    PerAxis<std::atomic<std::int64_t>> counts_{};
    std::atomic<std::uint64_t> submitted_ticks_{0};
    std::atomic<std::uint64_t> motion_ns_{0}; // of the last edge, or what has passed
    std::atomic<std::uint64_t> taken_{0};
    std::atomic<std::uint64_t> edges_{0};
    std::atomic<std::uint64_t> buffer_underruns_{0};
    std::atomic<std::uint64_t> schedule_slip_ns_{0};
    std::atomic<State> state_{State::idle};
    std::atomic<int> error_{0};
    std::atomic<bool> at_rest_{true}; // at the end of what was submitted
    std::atomic<bool> complete_{false};
    std::atomic<bool> disable_requested_{false};
    std::atomic<bool> ends_{false};
    std::atomic<bool> quick_stop_{false};
    std::atomic<bool> clock_stopped_{false}; // the clock stands
    std::atomic<bool> may_be_on_{false};
    std::atomic<bool> claimed_{false}; // the thread has what it asked the system for
    std::atomic<std::uint64_t> last_cycle_us_{0};
    Edge edge_; // the next one, where have_
    std::int64_t gathered_tick_ = 0;
    PerAxis<bool> stepped_{};           // by what was gathered
    std::uint64_t overdue_ns_ = 0;      // it was already when the thread looked at it
    std::uint64_t drives_ready_ns_ = 0; // since they were switched on
    std::uint64_t brake_open_ns_ = 0;   // since the brake was released
    bool drives_on_ = false;            // the drives
    bool switched_off_ = false;         // and they were switched off for good
    bool brake_released_ = false;       // the brake
    bool have_ = false;
    bool gathered_ = false;
    bool finished_ = false; // the train's
    Clock* time_;
    std::unique_ptr<ClockThread> thread_;
};

} // namespace splinefeed::hal::gpio
