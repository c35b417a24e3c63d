// SPDX-License-Identifier: MIT
// StepPort: motion port for step and direction lines. Its own real-time thread turns feed segments into edges.
#pragma once

#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/gpio/edge_clock.hpp"
#include "splinefeed/hal/gpio/next_edges.hpp"
#include "splinefeed/hal/gpio/step_log.hpp"
#include "splinefeed/hal/gpio/step_phases.hpp"
#include "splinefeed/hal/rt/clock.hpp"
#include "splinefeed/hal/rt/real_time.hpp"
#include "splinefeed/hal/rt/time_histogram.hpp"

#include <algorithm>
#include <memory>
#include <string>
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
    /// What each axis may brake with when the port slows down by itself. [counts/s^2]; 0: it is not looked at
    PerAxis<double> acceleration{};
    /// The port's own slow-down takes from twice least_reserve_ms to twice this, as the axes' accelerations ask, and
    /// covers half of that of the motion. 20 to 1000
    std::uint32_t reserve_ms = 20;
    /// How late segments may come: this much motion is buffered on top of the reserve that its speed asks for. A feed
    /// hold acts behind both.
    std::uint32_t supply_ms = 30;
    /// Edges of moving axes that are later than this are a fault: the motors have stopped abruptly, and their positions
    /// are unknown.
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

/// Executes one motion; after reset() another one. Its thread does not allocate, lock or access files, and alone
/// changes the phase while it runs. Positions are counts stepped since construction. One thread calls what says nothing
/// else.
class StepPort final : public MotionPort {
public:
    static constexpr std::uint64_t slice_ns = 500'000; ///< longest time between two cycles of its thread
    static constexpr std::uint32_t least_reserve_ms = 20;
    static constexpr std::uint64_t silent_ms = 2000; ///< a thread that has no cycle for so long is a fault

    /// Sets no line and starts no thread.
    StepPort(std::vector<ChipOutputs> chips, const StepPortSettings& settings);
    ~StepPort();

    /// Enables the drives and starts the thread, which waits for segments. A motion that was begun is over. Returns
    /// what the system refused, as claim_real_time(). After disable() or a fault it enables nothing.
    [[nodiscard]] std::string start();
    /// start(); what the system refused is no failure.
    [[nodiscard]] PortFailure prepare(const FeedSegment& first) override;
    [[nodiscard]] int room() const noexcept override;
    [[nodiscard]] bool submit(const FeedSegment& segment) noexcept override;
    void complete() noexcept override { ask(complete_bit); }
    PortState poll() noexcept override;
    void halt() noexcept override { quick_stop(); }
    /// Emergency stop: disables the drives and makes no further edge, within slice_ns plus one wake-up and one write of
    /// lines. Works from start() on, whether axes move or not; between close() and the next start() that one or
    /// power_off() disables them. Callable from any thread and from signal handlers.
    void disable() noexcept { ask(disable_bit); }
    /// Slows all axes down on the path, independent of the plan, within twice the reserve. The port is then halted.
    /// Callable from any thread.
    void quick_stop() noexcept override { ask(quick_stop_bit); }
    /// Ends the thread; axes that move are stopped as by quick_stop() first. The drives stay enabled, unless disable()
    /// was called or a line could not be set. Blocks for as long as the thread's call that sets lines does.
    void close() noexcept override;
    /// Ends the thread, engages the brake, waits until it holds, and disables the drives. start() enables them again.
    /// disable() shortens the wait.
    void power_off() noexcept override;
    /// Prepares for another motion, which may begin at any position. @pre closed
    void reset() noexcept;
    /// Behind disable() or a fault: start() enables the drives again. Where they stand nobody knows: counts() go on
    /// from what they were. false: the drives may still be on, and the fault stays. @pre closed
    [[nodiscard]] bool clear() noexcept;

    /// Position of an axis: the sum of its steps. [counts]
    [[nodiscard]] std::int64_t counts(int axis) const noexcept {
        return counts_[static_cast<unsigned>(axis)].load(std::memory_order_relaxed);
    }
    [[nodiscard]] bool was_disabled() const noexcept { return asked(disable_bit); }
    /// No axis moves: the motion has not begun or is complete, or the clock has stopped (it resumes when more segments
    /// come).
    [[nodiscard]] bool at_standstill() const noexcept { return !axes_move(phase_.load()); }
    /// The motion was ended by quick_stop(), or ended where its segments did, without a fault.
    [[nodiscard]] bool halted() const noexcept { return phase_.load() == StepPhase::halted; }
    /// Instant of the last cycle of its thread. [us]
    [[nodiscard]] std::uint64_t last_cycle_us() const noexcept {
        return last_cycle_us_.load(std::memory_order_relaxed);
    }
    /// Drives that should be disabled may be enabled: the line could not be set, or the thread does not run.
    [[nodiscard]] bool may_be_on() const noexcept;
    /// Whether counts() are the positions of the motors. A stepper has no feedback: lost steps are not detected.
    [[nodiscard]] bool position_known() const noexcept {
        return !asked(disable_bit | silent_bit) && phase_.load() != StepPhase::failed;
    }
    /// Motion that it needs to slow down with what it has: with less it does so by itself. [us]
    [[nodiscard]] std::uint64_t reserve_us() const noexcept {
        return std::max(present_ns_.load(), ahead_ns_.load()) / ns_per_us;
    }
    /// Log of steps: positions of all axes at an instant.
    [[nodiscard]] const StepLog& log() const noexcept { return log_; }
    [[nodiscard]] const TimeHistogram& late() const noexcept { return late_; }
    [[nodiscard]] StepPortReport report() const noexcept;
    /// Why the port stopped the motion by itself.
    [[nodiscard]] PortFailure failure() const override { return {trouble()}; }
    /// @pre closed
    [[nodiscard]] const StepPhases& phases() const noexcept { return phases_; }

private:
    enum Bit : std::uint8_t { complete_bit = 1, disable_bit = 2, quick_stop_bit = 4, end_bit = 8, silent_bit = 16 };

    static constexpr std::int64_t ns_per_tick = 125;
    static constexpr int stall_error = -1; // these are no errno
    static constexpr int overdue_error = -2;

    [[nodiscard]] std::string trouble() const;
    void ask(unsigned bits) noexcept { requests_.fetch_or(static_cast<std::uint8_t>(bits)); }
    [[nodiscard]] bool asked(unsigned bits) const noexcept { return (requests_.load() & bits) != 0; }
    void take(StepEvent event) noexcept;
    void work() noexcept;
    void obey(std::uint64_t now_ns) noexcept;
    void advance(std::uint64_t now_ns) noexcept;
    void begin(std::uint64_t now_ns) noexcept;
    void follow_clock(std::uint64_t now_ns) noexcept;
    void slow_down(std::uint64_t now_ns) noexcept;
    void pursue(std::uint64_t now_ns) noexcept;
    void make() noexcept;
    void switch_off(StepEvent why) noexcept;
    void fail(int error) noexcept;
    /// Motion that a slow-down from a segment's speed needs, so that all axes keep their accelerations. [ns]
    [[nodiscard]] std::uint64_t reserve_ns(const FeedSegment& segment) const noexcept;
    /// Motion to be buffered. [ns]
    [[nodiscard]] std::uint64_t buffer_ns() const noexcept {
        return settings_.supply_ms * ns_per_ms + std::max(present_ns_.load(), ahead_ns_.load());
    }
    void wait_until(std::uint64_t instant_ns, std::uint32_t spin_ns) const noexcept;
    [[nodiscard]] bool stalled(std::uint64_t late_ns) const noexcept;
    [[nodiscard]] bool buffer_filled() const noexcept;
    /// What is known of the motion is all of it: no segment comes, and the last one ends at rest.
    [[nodiscard]] bool whole() const noexcept { return asked(complete_bit) && at_rest_.load(); }
    [[nodiscard]] bool cut_off() const noexcept { return asked(complete_bit) && !at_rest_.load(); }
    [[nodiscard]] bool joins(const FeedSegment& segment) const noexcept;
    /// Motion time that is known. [ns]
    [[nodiscard]] std::uint64_t end_ns() const noexcept;

    PinChanges lines_;
    StepPortSettings settings_;
    NextEdges edges_;
    EdgeClock clock_;
    StepLog log_;
    TimeHistogram late_;
    StepPhases phases_;
    PerAxis<std::atomic<std::int64_t>> counts_{};
    std::atomic<std::uint8_t> requests_{0};
    std::atomic<StepPhase> phase_{StepPhase::off}; // as phases_ has it, for other threads
    std::atomic<std::uint64_t> submitted_ticks_{0};
    std::atomic<std::uint64_t> ahead_ns_{0}; // reserve that the last submitted segment asks for,
    std::atomic<std::uint64_t> present_ns_{least_reserve_ms * ns_per_ms}; // and the one that is executed
    std::atomic<bool> at_rest_{true};                                     // at the end of the submitted segments
    std::atomic<std::uint64_t> motion_ns_{0};                             // of the last edge, or elapsed motion time
    std::atomic<std::uint64_t> made_{0};                                  // writes of edges
    std::atomic<std::uint64_t> buffer_underruns_{0};
    std::atomic<std::uint64_t> schedule_slip_ns_{0};
    std::atomic<std::uint64_t> last_cycle_us_{0};
    std::atomic<int> error_{0};
    std::atomic<const char*> overdue_{nullptr};
    std::atomic<bool> may_be_on_{false};
    std::atomic<bool> claimed_{false}; // the thread has its real-time settings
    std::uint64_t overdue_ns_ = 0;     // lateness of the next edge that was absorbed already
    // Of the caller's thread.
    FeedSegment last_;           // submitted
    bool refused_ = false;       // a segment did not join
    std::uint64_t looks_ = 0;    // at a thread that has had no cycle since
    std::uint64_t seen_us_ = 0;  // this cycle,
    std::uint64_t first_us_ = 0; // the first look at that instant
    std::string missing_;        // real-time settings
    Clock* time_;
    std::unique_ptr<ClockThread> thread_;
};

} // namespace splinefeed::hal::gpio
