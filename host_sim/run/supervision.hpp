// SPDX-License-Identifier: MIT
// Supervision: the thread that looks after a run's target, and depends on no planner, no input and no output.
#pragma once

#include "host_sim/base/signal_watch.hpp"
#include "host_sim/target/run_target.hpp"

#include "splinefeed/s4_segment_stream/segment_ring.hpp"

#include <array>
#include <atomic>
#include <thread>

namespace splinefeed::host {

/// It prepares the target, hands it the plan's segments, polls its port every millisecond, and obeys the user's
/// signals: the first request of an end stops all axes on the path, the second at once. Where the target's plan is to
/// be held, the planner learns it by hold_asked().
///
/// When the run is over before its end and the planner does not come back for stall_s because an output is blocked,
/// it ends the process with the run's sentence and exit status 1. So does a signal, at once, when the run is over.
class Supervision {
public:
    /// What the planner may be ahead of the port. [us] More would only delay a hold.
    static constexpr std::uint64_t hand_over_us = 10'000;
    static constexpr int stall_s = 2;

    /// No thread runs before the first segment. Both must outlive it.
    Supervision(RunTarget& target, SignalWatch& signals) : target_(&target), signals_(&signals) {}
    Supervision(const Supervision&) = delete;
    Supervision& operator=(const Supervision&) = delete;
    /// Where the run is not over: stops the axes as for the first signal, and waits for it.
    ~Supervision();

    // Of the planner's thread:

    /// Hands a segment on, when there is room for it; the first one defines where the axes stand.
    /// False: the run is over.
    [[nodiscard]] bool submit(const FeedSegment& segment);
    /// No more segments come: waits until everything is executed. False: it ended before, ending() says why.
    [[nodiscard]] bool finish();
    /// submit() would not wait.
    [[nodiscard]] bool room() const noexcept;
    [[nodiscard]] bool over() const noexcept { return over_.load(); }
    /// The plan is to be held, and ends there.
    [[nodiscard]] bool hold_asked() const noexcept { return hold_asked_.load(); }
    [[nodiscard]] UserSteering take_steering() noexcept { return signals_->take_steering(); }
    /// Why the run ended before its end, and where the machine stands. @pre finish() returned
    [[nodiscard]] const std::string& ending() const noexcept { return ending_; }
    /// "; the machine stands at ..." @pre as above
    [[nodiscard]] const std::string& where() const noexcept { return where_; }
    void describe(Summary& summary) const { target_->describe(summary); }

private:
    static constexpr std::size_t capacity = 512; // hand_over_us of the shortest segments

    void work() noexcept;
    [[nodiscard]] std::string supervise();
    void obey();
    void hand_over();
    void await_planner() noexcept;

    RunTarget* target_;
    SignalWatch* signals_;
    std::array<FeedSegment, capacity + 1> segments_{}; // the ring's
    SegmentRing ring_{segments_};
    std::uint64_t pushed_ticks_ = 0; // the planner's
    std::atomic<std::uint64_t> taken_ticks_{0};
    std::atomic<bool> hold_asked_{false};
    std::atomic<bool> complete_{false}; // no more segments come
    std::atomic<bool> leaves_{false};   // the planner's thread needs nobody any more
    std::atomic<bool> over_{false};
    // The thread's, and after over_ anybody's:
    int obeyed_ = 0; // requests of an end
    std::uint64_t obeyed_us_ = 0;
    bool completed_ = false;
    bool began_ = false;
    std::string ending_; // empty: all was executed
    std::string where_;
    std::thread thread_;
};

} // namespace splinefeed::host
