// SPDX-License-Identifier: MIT
// Motion: sends the curve through the planner to the machine, and takes the measurements.
#pragma once

#include "host_sim/analysis/exact_stop_time.hpp"
#include "host_sim/analysis/linear_length.hpp"
#include "host_sim/analysis/program_report.hpp"
#include "host_sim/live/live_machine.hpp"
#include "host_sim/output/outputs.hpp"
#include "host_sim/output/progress.hpp"
#include "host_sim/output/summary.hpp"
#include "host_sim/planning/planned_path.hpp"
#include "host_sim/program/event_file.hpp"
#include "host_sim/report/motion_record.hpp"
#include "host_sim/run/kept_motion.hpp"
#include "host_sim/run/path_watch.hpp"
#include "host_sim/run/program_steps.hpp"
#include "host_sim/run/run_start.hpp"
#include "host_sim/run/user_pause.hpp"
#include "splinefeed/hal/motion/straight_motion.hpp"

#include <chrono>
#include <span>
#include <string>
#include <vector>

namespace splinefeed {
struct CounterSeam; // of tests
} // namespace splinefeed

namespace splinefeed::host {

struct MotionArguments {
    PlannerChoice planner;
    std::string events;              ///< file of an operator's actions; empty: none
    bool enforce = true;             ///< the simulated machine stops if a limit is broken
    bool measures = true;            ///< false: of the motion only its time and what binds it is known
    bool quiet = false;              ///< writes nothing on standard error
    bool progress = false;           ///< though it is quiet, shows the progress on a terminal
    int terminal = -1;               ///< of a user who is asked to go on; -1: none
    MachineState begins;             ///< as the run begins
    StateKeeper* state = nullptr;    ///< of offsets and position; null: nothing keeps them
    const RunStart* start = nullptr; ///< of a machine that stands somewhere; null: it stands where the path begins
    ProgramReport* report = nullptr; ///< gets the moves of a program and their times; null: nobody does
    MotionRecord* record = nullptr;  ///< gets what the machine does, for a page; null: there is none
    KeptMotion* kept = nullptr;      ///< gets all segments; null: nobody keeps them
};

/// One run. A waypoint is read only when the planner has no segment left.
///
/// Without a target the run waits for its input. With a target, a moving machine cannot wait: while the target needs
/// segments, the motion continues along the known path, stops at its end, and starts again when more input comes. At
/// standstill it starts with the known path when the input has paused for pause_ms.
class Motion {
public:
    static constexpr int pause_ms = 100;

    /// All arguments must outlive it.
    Motion(const MotionArguments& arguments, const MachineDescription& description, const PlanFigures& figures,
           PathInput& input, const PathLimits& path_limits, Outputs& outputs, LiveMachine& live);
    Motion(const Motion&) = delete;
    Motion& operator=(const Motion&) = delete;

    /// Runs to the end. Returns an empty text, or why the machine stopped before the end and where it stands. Throws an
    /// error of the input if nothing has moved yet, and OutputError.
    /// @param waypoints  total number, if it is known
    [[nodiscard]] std::string run(std::optional<std::uint64_t> waypoints);

    [[nodiscard]] Summary summary() const;
    /// Time of the run in which the machine stood for the program.
    [[nodiscard]] double stood_s() const noexcept { return stood_s_; }
    /// Events of the operator whose time was after the end of the run.
    [[nodiscard]] std::span<const OperatorEvent> events_not_reached() const noexcept {
        return std::span(events_).subspan(operated_);
    }

private:
    friend struct splinefeed::CounterSeam;

    using Clock = std::chrono::steady_clock;

    void execute_all();
    void show_progress();
    bool pull(FeedSegment& segment);
    void read();
    [[nodiscard]] Supply supply() const;
    [[nodiscard]] bool late() const noexcept { return supply_ != Supply::flows; }
    [[nodiscard]] bool wait();
    void operate();
    void obey_machine();
    bool stand();
    [[nodiscard]] bool dwell(FeedSegment& segment);
    bool execute(FeedSegment& segment, LimitKind standstill = LimitKind::none);
    [[nodiscard]] bool come_to_rest(const std::string& broken);
    void require_end();
    [[noreturn]] void fail() const;
    [[nodiscard]] bool execute_first(FeedSegment& segment, LimitKind standstill = LimitKind::none);
    [[nodiscard]] bool move_to(FeedSegment& first, const PerAxis<double>& from, const PerAxis<double>& to);
    void keep_failure(const std::exception_ptr& failure);
    void measure(const PathFeeder::Pushed& pushed);
    void pass(std::uint32_t row);
    void come_to(std::uint64_t line);
    void keep_state();
    void require_tolerance();
    [[nodiscard]] std::string excess() const;
    [[nodiscard]] ToleranceSummary tolerance_summary() const;
    [[nodiscard]] std::string where() const;

    MotionArguments asked_;
    const MachineDescription* description_;
    const PlanFigures* figures_;
    PathInput* input_;
    Outputs* outputs_;
    std::optional<hal::StraightMotion> way_; // to where the path begins, while the machine is on it
    LiveMachine* live_;
    WaypointError error_;
    PathDeviation deviation_;
    ExactStopTime exact_stop_;
    OptimumTime optimum_;
    LimitShare share_;
    OperatorState steered_;
    LinearLength length_; // of the path
    ProgramObserver program_;
    BackgroundWork work_; // what is measured, where nobody else looks at it meanwhile
    PathWatch watch_;
    std::unique_ptr<PlannedPath> path_;
    PathFeeder& feeder_;
    MoveStream& stream_;
    ProgramSteps steps_;
    SimulatedMachine machine_;
    std::vector<OperatorEvent> events_;
    std::size_t operated_ = 0; // events that have acted so far
    Clock::duration planning_{};
    std::string stopped_;              // why the run stopped before its end
    std::exception_ptr failure_;       // of an output or of the program itself; it ends the run
    std::optional<std::uint32_t> row_; // of the last segment
    std::uint64_t passed_ = 0;         // moves up to it, of a program
    std::uint64_t line_ = 0;           // of that row or of the dwell behind it, of a program; 0: unknown
    std::uint64_t segments_ = 0;
    double stood_s_ = 0.0;
    std::uint64_t rests_ = 0; // number of instants at which all axes stood still
    bool at_end_ = false;     // the machine stands since the last of these
    bool read_all_ = false;
    bool moves_ = false;                                        // the axes move at the end of the last segment
    Supply supply_ = Supply::flows;                             // at the last pull
    std::optional<Clock::time_point> paused_;                   // since this time there was no input
    enum class Held : std::uint8_t { no, by_user, by_machine }; // by the machine: the run ends there
    Held held_ = Held::no;
    UserSuspend suspend_;
    std::optional<Progress> progress_;
};

} // namespace splinefeed::host
