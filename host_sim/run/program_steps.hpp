// SPDX-License-Identifier: MIT
// ProgramSteps: carries out the dwells and events of a program where the motion reaches them. PendingSteps: those that
// it has not reached yet, each with its place on the path.
#pragma once

#include "host_sim/live/live_machine.hpp"
#include "host_sim/output/program_summary.hpp"
#include "host_sim/planning/machine_limits.hpp"
#include "host_sim/planning/path_feeder.hpp"
#include "host_sim/program/move_source.hpp"
#include "host_sim/report/motion_record.hpp"
#include "host_sim/run/user_pause.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <deque>
#include <optional>
#include <utility>

namespace splinefeed::host {

/// A dwell or an event, behind the move of `row`.
struct PendingStep {
    StepKind kind = StepKind::event;
    bool stops = false; ///< the machine stands at the end of the move
    double dwell_s = 0.0;
    std::uint64_t line = 0;
    ProgramAction action{};
    std::shared_ptr<const WorkOffsets> offsets{}; ///< what the event makes of them; null: nothing
    std::optional<std::uint32_t> row{}; ///< of the last move before it, as segments name it; none: before every move
    PerAxis<Position> place{};          ///< where that move ends
    std::uint32_t short_rows = 0; ///< rows behind it with moves too short to be one: the path may have one of them
};

/// First in, first out. Memory: the steps between what the path has read and what has been travelled.
class PendingSteps {
public:
    /// 0.1 um: shorter moves are none.
    static constexpr double same_place_mm = 1e-4;

    void add(PendingStep step) { steps_.push_back(std::move(step)); }
    [[nodiscard]] bool empty() const noexcept { return steps_.empty(); }

    /// The first step if the machine is past it when a segment of `row` begins; null: it is not.
    [[nodiscard]] const PendingStep* passed(std::uint32_t row) const noexcept;
    /// The first step if the machine has come to a standstill where it is due.
    /// @param row  of the last segment; none: nothing has moved yet
    /// @param position_mm  of the axes
    [[nodiscard]] const PendingStep* reached(std::optional<std::uint32_t> row, const PerAxis<double>& position_mm,
                                             int axes) const noexcept;
    /// @pre not empty
    [[nodiscard]] const PendingStep& first() const noexcept { return steps_.front(); }
    /// Removes the first step. @pre not empty
    PendingStep take();

private:
    std::deque<PendingStep> steps_;
};

/// A dwell is standstill, segment by segment, so it takes the machine's time on every target. Events happen at the
/// begin of the segment after their place.
class ProgramSteps {
public:
    /// @param tells  messages of the program go to standard error
    /// `figures` must outlive it.
    /// @param live  gets what is for real outputs; of a plan nobody waits for a user
    /// @param terminal  of the user, as in UserPause
    /// @param record  gets the events; null: nobody does
    ProgramSteps(const PlanFigures& figures, bool tells, LiveMachine& live, int terminal = -1,
                 MotionRecord* record = nullptr)
        : figures_(&figures), live_(&live), record_(record), pause_(terminal), tells_(tells) {}

    /// What the feeder has read.
    void add(const PathFeeder::Pushed& pushed);

    /// Whether nothing is waiting.
    [[nodiscard]] bool empty() const noexcept { return pending_.empty(); }
    /// The next segment is executed: events that it leaves behind happen. Throws std::logic_error if one of them is a
    /// step that the machine has to stand for, and it has not: nothing is ever left out.
    void begin(const FeedSegment& segment, double time_s);
    /// The machine stands at `position_mm`: steps that are due happen. Returns whether it has to stand for one more
    /// segment.
    [[nodiscard]] bool stands(const PerAxis<double>& position_mm, double time_s);
    /// Line of the step for which the machine stands; 0: unknown. @pre stands() was true
    [[nodiscard]] std::uint64_t line() const noexcept { return pending_.first().line; }
    /// It stood for this segment. @pre stands() was true
    void stood(const FeedSegment& segment);
    /// Standstill where the program begins, for a machine that has not moved yet. @pre stands() was true
    void at_start(FeedSegment& segment) const noexcept;
    [[nodiscard]] bool moved() const noexcept { return row_.has_value(); }

    /// What the input of an M66 has answered since the last call.
    [[nodiscard]] std::optional<int> take_answer() noexcept { return std::exchange(answer_, std::nullopt); }

    /// The user's signal to go on.
    void go_on() noexcept { pause_.go_on(); }

    /// The offsets as the motion has come to them; null: the program has not changed them.
    [[nodiscard]] const WorkOffsets* offsets() const noexcept { return offsets_.get(); }
    /// Whether they changed since the last call.
    [[nodiscard]] bool take_change() noexcept { return std::exchange(offsets_changed_, false); }

    [[nodiscard]] const ProgramSummary& summary() const noexcept { return summary_; }

private:
    void happen(double time_s);
    [[nodiscard]] bool waits_for_order(const PendingStep& step);
    [[nodiscard]] bool waits_for_user(const PendingStep& step);

    const PlanFigures* figures_;
    LiveMachine* live_;
    MotionRecord* record_;
    std::optional<int> answer_;
    bool ordered_ = false; // the machine stands for the first step's order
    UserPause pause_;
    enum class Asked { no, spindle, user };
    Asked asked_ = Asked::no; // what the machine stands for, as the user was told
    PendingSteps pending_;
    PerAxis<Position> start_{};
    PerAxis<Position> place_{}; // where the last move that was read ends
    std::shared_ptr<const WorkOffsets> offsets_;
    bool offsets_changed_ = false;
    std::optional<std::uint32_t> row_; // of the last segment
    std::uint64_t left_ticks_ = 0;     // of a dwell that has begun
    double began_s_ = 0.0;             // when it began
    ProgramSummary summary_;
    bool tells_;
};

} // namespace splinefeed::host
