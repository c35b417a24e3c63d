// SPDX-License-Identifier: MIT
// ProgramSteps: carries out the dwells and events of a program where the motion reaches them.
#pragma once

#include "host_sim/live/live_machine.hpp"
#include "host_sim/output/program_summary.hpp"
#include "host_sim/planning/machine_limits.hpp"
#include "host_sim/planning/path_feeder.hpp"
#include "host_sim/program/move_source.hpp"
#include "host_sim/report/motion_record.hpp"
#include "host_sim/run/user_pause.hpp"
#include "splinefeed/move_stream/move_stream.hpp"

#include <deque>
#include <optional>
#include <utility>

namespace splinefeed::host {

/// A dwell or an event.
struct PendingStep {
    StepKind kind = StepKind::event;
    bool stops = false; ///< the machine stands at the end of the moves before it
    double dwell_s = 0.0;
    std::uint64_t line = 0;
    ProgramAction action{};
    std::shared_ptr<const WorkOffsets> offsets{}; ///< what the event makes of them; null: nothing
    std::uint32_t moves = 0;                      ///< so many are before it, modulo 2^32
};

/// A dwell is standstill, segment by segment, so it takes the machine's time on every target. Events happen at the
/// begin of the segment after their place.
class ProgramSteps {
public:
    /// @param tells  messages of the program go to standard error
    /// `figures` and `stream`, where the steps have their places, must outlive it.
    /// @param live  gets what is for real outputs; of a plan nobody waits for a user
    /// @param terminal  of the user, as in UserPause
    /// @param record  gets the events; null: nobody does
    ProgramSteps(const PlanFigures& figures, MoveStream& stream, bool tells, LiveMachine& live, int terminal = -1,
                 MotionRecord* record = nullptr)
        : figures_(&figures), stream_(&stream), live_(&live), record_(record), pause_(terminal), tells_(tells) {}

    /// What the feeder has read.
    void add(const PathFeeder::Pushed& pushed);

    /// Whether nothing is waiting.
    [[nodiscard]] bool empty() const noexcept { return pending_.empty(); }
    /// The next segment is executed: events that it leaves behind happen.
    void begin(double time_s);
    /// Steps that are due where the machine stands happen. Returns whether it has to stand for one more segment.
    [[nodiscard]] bool stands(double time_s);
    /// Line of the step for which the machine stands; 0: unknown. @pre stands() was true
    [[nodiscard]] std::uint64_t line() const noexcept { return pending_.front().line; }
    /// It stood for this segment. @pre stands() was true
    void stood(const FeedSegment& segment);
    /// Standstill where the program begins, for a machine that has not moved yet. @pre stands() was true
    void at_start(FeedSegment& segment) const noexcept;
    [[nodiscard]] bool moved() const noexcept { return moved_; }

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
    [[nodiscard]] const PendingStep* due() const noexcept;
    void happen(double time_s);
    [[nodiscard]] bool waits_for_order(const PendingStep& step);
    [[nodiscard]] bool waits_for_user(const PendingStep& step);

    const PlanFigures* figures_;
    MoveStream* stream_;
    LiveMachine* live_;
    MotionRecord* record_;
    std::optional<int> answer_;
    bool ordered_ = false; // the machine stands for the first step's order
    UserPause pause_;
    enum class Asked { no, spindle, user };
    Asked asked_ = Asked::no; // what the machine stands for, as the user was told
    std::deque<PendingStep> pending_;
    PerAxis<Position> start_{};
    std::shared_ptr<const WorkOffsets> offsets_;
    bool offsets_changed_ = false;
    bool moved_ = false;
    std::uint64_t left_ticks_ = 0; // of a dwell that has begun
    double began_s_ = 0.0;         // when it began
    ProgramSummary summary_;
    bool tells_;
};

} // namespace splinefeed::host
