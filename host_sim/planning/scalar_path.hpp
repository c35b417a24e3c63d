// SPDX-License-Identifier: MIT
// ScalarPath: what a PlannedPath is made of, in one scalar. PathTee: passes the curve on to the plan and shows it to
// those who check, measure and write it.
#pragma once

#include "host_sim/curve/segment_cast.hpp"
#include "host_sim/planning/machine_limits.hpp"
#include "host_sim/planning/path_curve.hpp"
#include "host_sim/planning/planned_path.hpp"
#include "host_sim/planning/planner_memory.hpp"

#include "splinefeed/move_stream/scalar_stream.hpp"

#include <exception>
#include <optional>

namespace splinefeed::host {

/// If whoever looks at the curve refuses a segment, it is not passed on and the curve ends before it: the machine stops
/// there in a controlled way, and failure() has the reason.
template <Scalar S>
class PathTee final : public CurveFilter<S> {
public:
    /// Both must outlive it. @param feeder  the one that the owner makes later
    PathTee(const std::unique_ptr<PathFeeder>& feeder, CurveWatch& watch) noexcept : feeder_(&feeder), watch_(&watch) {}

    void begin(CurveSource<S>& source) noexcept override { source_ = &source; }
    Pull next(CurveSegment<S>& out) noexcept override {
        if (failure_) {
            return Pull::finished;
        }
        const Pull pull = source_->next(out);
        if (pull != Pull::item) {
            return pull;
        }
        const PathFeeder& feeder = **feeder_;
        try {
            watch_->segment(in_double(out), feeder.row_of(out.waypoint), feeder);
        } catch (...) {
            failure_ = std::current_exception();
            return Pull::finished;
        }
        ++segments_;
        return pull;
    }
    [[nodiscard]] bool has_ended() const noexcept override { return failure_ != nullptr; }

    [[nodiscard]] const std::exception_ptr& failure() const noexcept { return failure_; }
    [[nodiscard]] std::uint64_t segments() const noexcept { return segments_; }

private:
    CurveSource<S>* source_ = nullptr;
    const std::unique_ptr<PathFeeder>* feeder_;
    CurveWatch* watch_;
    std::exception_ptr failure_;
    std::uint64_t segments_ = 0;
};

template <Scalar S>
class ScalarPath {
public:
    /// plan_path(); without a machine the curve is only looked at.
    ScalarPath(PathInput& input, const MachineDescription* machine, CurveWatch& watch, const PlannerChoice& choice)
        : tee_(feeder_, watch) {
        if (machine != nullptr) {
            limits_ = machine_limits<S>(*machine, choice.sampled());
            planner_.emplace(*limits_, choice);
        }
        const bool moves = input.within_tolerance();
        if (moves) {
            const PathRules<S> rules = rules_cast<S>(input.tolerances().rules);
            if (planner_) {
                stream_.emplace(*limits_, planner_->planner(), rules, &tee_);
            } else {
                stream_.emplace(static_cast<int>(input.axes().size()), rules, &tee_);
            }
            feeder_ = make_feeder(input, *stream_);
            return;
        }
        tee_.begin(curve_.emplace(input).source());
        if (planner_) {
            stream_.emplace(*limits_, planner_->planner(), tee_);
        }
        feeder_ = make_feeder(input, WaypointSink{[this](const Waypoint<double>& waypoint, Role role) {
                                                      return curve_->push(waypoint, role);
                                                  },
                                                  [this] {
                                                      return curve_->waypoints().finish();
                                                  }});
    }
    ScalarPath(const ScalarPath&) = delete;
    ScalarPath& operator=(const ScalarPath&) = delete;

    [[nodiscard]] PathTee<S>& tee() noexcept { return tee_; }
    [[nodiscard]] PathFeeder& feeder() noexcept { return *feeder_; }
    /// @pre it has a machine
    [[nodiscard]] ScalarStream<S>& stream() noexcept { return *stream_; }
    /// The machine stands for nothing. @pre the path is looked at
    void go_on() noexcept {
        if (stream_) {
            stream_->go_on();
        }
    }
    /// @pre it is not of moves
    [[nodiscard]] PathCurve<S>& curve() noexcept { return *curve_; }
    /// @pre it has a machine
    [[nodiscard]] PlannedPath::Statistics statistics() const;

private:
    std::optional<MotionLimits<S>> limits_;
    std::optional<PathCurve<S>> curve_;
    std::unique_ptr<PathFeeder> feeder_;
    PathTee<S> tee_;
    std::optional<PlannerMemory<S>> planner_;
    std::optional<ScalarStream<S>> stream_;
};

} // namespace splinefeed::host
