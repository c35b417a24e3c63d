// SPDX-License-Identifier: MIT
// Motion: the curve's way through the planner into the machine, and what is measured on it.
#pragma once

#include "host_sim/output/outputs.hpp"
#include "host_sim/output/summary.hpp"
#include "host_sim/planning/planned_trajectory.hpp"
#include "host_sim/program/event_file.hpp"
#include "host_sim/run/path_tee.hpp"
#include "host_sim/run/supervision.hpp"

#include <chrono>
#include <span>
#include <string>
#include <vector>

namespace splinefeed {
struct CounterSeam; // of tests
} // namespace splinefeed

namespace splinefeed::host {

struct MotionArguments {
    std::size_t window_cells = 1024; ///< that the feed plan looks ahead
    std::string events;              ///< file of what an operator does; empty: nobody steers
    bool enforce = true;             ///< the simulated machine stops where a limit is broken
    bool quiet = false;              ///< nothing on standard error
};

/// One run. A waypoint is read only when the planner is out of segments.
///
/// Without a target it waits for its input. With one a machine that moves cannot: while the target needs segments the
/// motion goes on with what is known, comes to rest at the end of that, and starts again when more comes. At rest it
/// starts with what is known when the input has paused for pause_ms.
template <Scalar S>
class Motion {
public:
    static constexpr int pause_ms = 100;

    /// All arguments must outlive it.
    Motion(const MotionArguments& arguments, const MachineDescription& description, const MotionLimits<S>& limits,
           PathInput& input, const PathLimits& path_limits, Outputs& outputs, Supervision* target = nullptr);
    Motion(const Motion&) = delete;
    Motion& operator=(const Motion&) = delete;

    /// Runs to the end. Empty: done; else why the machine stopped before, and where it stands. Throws what was wrong
    /// with the input if nothing has moved yet, and OutputError.
    /// @param waypoints  how many there are, where that is known
    [[nodiscard]] std::string run(std::optional<std::uint64_t> waypoints);

    [[nodiscard]] Summary summary() const;
    /// What the operator was to do after the end of the run.
    [[nodiscard]] std::span<const OperatorEvent> events_not_reached() const noexcept {
        return std::span(events_).subspan(operated_);
    }

private:
    friend struct splinefeed::CounterSeam;

    using Clock = std::chrono::steady_clock;

    void execute_all(std::optional<std::uint64_t> waypoints);
    bool pull(FeedSegment& segment);
    void read();
    [[nodiscard]] bool late() const;
    [[nodiscard]] bool wait();
    void operate();
    void obey_target();
    bool stand();
    bool execute(const FeedSegment& segment);
    void keep_failure(const std::exception_ptr& failure);
    [[nodiscard]] std::string where() const;

    bool quiet_;
    const MachineDescription* description_;
    const MotionLimits<S>* limits_;
    PathInput* input_;
    Outputs* outputs_;
    Supervision* target_; // null: the simulated machine alone
    WaypointError error_;
    OptimumTime optimum_;
    LimitShare share_;
    CurveFeeder<S> feeder_;
    PathTee<S> tee_;
    PlannedTrajectory<S> planner_;
    Trajectory<S>& trajectory_; // the planner's
    SimulatedMachine machine_;
    std::vector<OperatorEvent> events_;
    std::size_t operated_ = 0; // events so far
    Clock::duration planning_{};
    std::string stopped_; // why, if it was before the end
    std::uint64_t segments_ = 0;
    std::uint64_t rests_ = 0; // instants at which all axes stood still
    bool read_all_ = false;
    bool moves_ = false;                      // at the end of the last segment
    bool late_ = false;                       // the last pull could not wait for input
    std::optional<Clock::time_point> paused_; // since then the input has nothing
    bool held_by_user_ = false;
    bool held_by_target_ = false; // and ends there
};

} // namespace splinefeed::host
