// SPDX-License-Identifier: MIT
// TargetFeed: passes planned segments to a target, in the planner's place, and stops it.
#pragma once

#include "host_sim/ports/program_outputs.hpp"
#include "host_sim/ports/run_target.hpp"
#include "host_sim/report/target_record.hpp"

#include "splinefeed/hal/rt/clock.hpp"
#include "splinefeed/hal/stop_sequence.hpp"
#include "splinefeed/s4_segment_stream/segment_ring.hpp"

#include <array>
#include <atomic>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

namespace splinefeed::host {

/// How a motion of a target ended.
struct MotionEnd {
    /// That of the port. Idle: everything was executed; with a reason, up to where the target held the plan. Halted: it
    /// was asked to stop.
    hal::PortPhase phase = hal::PortPhase::idle;
    std::string why; ///< empty: everything was executed
};

/// For two threads: the planner's pushes segments and orders, the one that supervises looks every millisecond. It knows
/// motions, and no program.
class TargetFeed {
public:
    /// How far the planner may be ahead of the port. [us] More would only delay a hold.
    static constexpr std::uint64_t hand_over_us = 10'000;

    /// All must outlive it. @param outputs, record  null: there are none
    TargetFeed(RunTarget& target, ProgramOutputs* outputs, TargetRecord* record, hal::Clock& clock)
        : target_(&target), port_(&target.port()), outputs_(outputs), record_(record), clock_(&clock) {}
    TargetFeed(const TargetFeed&) = delete;
    TargetFeed& operator=(const TargetFeed&) = delete;

    // For the planner's thread:

    /// Whether push() may be called.
    [[nodiscard]] bool room() const noexcept;
    /// @pre room()
    void push(const FeedSegment& segment) noexcept;
    /// The last segment was the end of the motion, which is at rest there. Another push() begins another motion.
    void complete() noexcept { complete_.store(true); }
    /// Of all motions.
    [[nodiscard]] std::uint64_t pushed() const noexcept { return pushed_; }
    /// An order for the outputs, behind all segments so far. @param standing  the machine stands there
    void order(const ProgramAction& action, bool standing);
    [[nodiscard]] bool carried_out() const;
    [[nodiscard]] bool spindle_stands() const;
    /// What the last input has answered: ProgramOutputs.
    [[nodiscard]] int answer() const;

    // For any thread:

    /// Whether the plan has to be held, and ends there.
    [[nodiscard]] bool hold_asked() const noexcept { return hold_asked_.load(); }
    /// Segments of all motions that were executed.
    [[nodiscard]] std::uint64_t executed() const noexcept { return executed_.load(); }

    // For the thread that supervises:

    /// The port is prepared: its motion begins. @param done  what it has executed until now is none of it
    void begin(std::uint64_t done) noexcept;
    /// Once a millisecond. Nothing: the motion goes on, or has not begun.
    /// @param stop  what is asked for, by now
    /// @param hands_over  false: the port gets no segment
    [[nodiscard]] std::optional<MotionEnd> look(hal::StopRequest stop, bool hands_over = true);
    /// Drops what the port has not taken, and what outputs are told behind segments that were not executed.
    void drop();
    /// Whether a segment waits for the port.
    [[nodiscard]] bool waits() const noexcept { return !ring_.empty(); }
    /// The first one. @pre waits()
    [[nodiscard]] const FeedSegment& front() const noexcept { return ring_.front(); }
    /// Segments that the port has taken, or that were dropped.
    [[nodiscard]] std::uint64_t taken() const noexcept { return taken_; }
    /// Whether the motion is stopped, whoever has asked for it.
    [[nodiscard]] bool stops() const noexcept { return stop_.requested(); }
    /// Carries out what is due, and keeps the outputs going; what is not as ordered is trouble(). look() does it, too,
    /// and stops the motion then.
    void tend_outputs();
    void end_outputs();
    [[nodiscard]] bool outputs_ended() const noexcept { return outputs_ended_; }
    /// In place of those that have ended. May be null.
    void set_outputs(ProgramOutputs* outputs);
    /// The last segment that the port has taken.
    [[nodiscard]] const FeedSegment& last() const noexcept { return last_; }
    /// Why the axes are stopped, where nobody asked for it; the first reason stays.
    void set_trouble(const std::string& why) { trouble_ = trouble_.empty() ? why : trouble_; }
    [[nodiscard]] const std::string& trouble() const noexcept { return trouble_; }

private:
    static constexpr std::size_t capacity = 512; // hand_over_us of the shortest segments
    // The port has a StopSequence of its own for its axes. This one is for a port that does not end: a hold becomes a
    // quick stop, and then nobody waits any more.
    static constexpr hal::StopTimes stop_times{
        .hold_us = 10'000'000, .quick_stop_us = 15'000'000, .last = hal::StopRequest::quick_stop};

    void ask(hal::StopRequest stop);
    void obey(hal::StopRequest stop);
    void hand_over();
    [[nodiscard]] std::optional<MotionEnd> end_of(hal::PortPhase phase, bool completed);
    [[nodiscard]] std::optional<MotionEnd> insist();

    RunTarget* target_;
    hal::MotionPort* port_; // of the target
    ProgramOutputs* outputs_;
    TargetRecord* record_;
    hal::Clock* clock_;
    std::array<FeedSegment, capacity + 1> segments_{}; // storage of the ring
    SegmentRing ring_{segments_};
    std::uint64_t pushed_ticks_ = 0; // used by the planner only
    std::uint64_t pushed_ = 0;       // segments; likewise
    struct DueOrder {
        ProgramAction action;
        std::uint64_t after = 0; // so many segments
    };
    mutable std::mutex order_mutex_;
    std::deque<DueOrder> orders_; // protected by it
    std::atomic<std::uint64_t> taken_ticks_{0};
    std::atomic<bool> hold_asked_{false};
    std::atomic<bool> complete_{false}; // no more segments come, and the last one ends at rest
    std::atomic<std::uint64_t> executed_{0};
    // Used by the thread that supervises:
    hal::StopSequence stop_{1, stop_times};
    std::uint64_t taken_ = 0;
    std::uint64_t done_before_ = 0; // by the port: of moves to the references, and of motions before
    std::uint64_t began_at_ = 0;    // segments of motions before
    FeedSegment last_;
    bool completed_ = false;
    bool outputs_ended_ = false;
    std::string trouble_;
};

} // namespace splinefeed::host
