// SPDX-License-Identifier: MIT
// ScalarPath: a PlannedPath in one scalar. PathTee: passes the curve on to the plan and shows it to those who check,
// measure and write it.
#pragma once

#include "host_sim/base/interruption.hpp"
#include "host_sim/curve/segment_cast.hpp"
#include "host_sim/planning/machine_limits.hpp"
#include "host_sim/planning/path_curve.hpp"
#include "host_sim/planning/path_feeder.hpp"
#include "host_sim/planning/planned_path.hpp"
#include "host_sim/planning/planned_trajectory.hpp"
#include "splinefeed/s1_curve/curve_source.hpp"

#include <exception>

namespace splinefeed::host {

/// A decorator of the curve. If whoever looks at it refuses a segment, it is not passed on and the curve ends before
/// it: the machine stops there in a controlled way, and failure() has the reason.
template <Scalar S>
class PathTee final : public CurveSource<S> {
public:
    /// All arguments must outlive it.
    PathTee(CurveSource<S>& source, const PathFeeder& feeder, CurveWatch& watch) noexcept
        : source_(&source), feeder_(&feeder), watch_(&watch) {}

    /// Segments are passed on with the index of the waypoint in the input, from 0.
    Pull next(CurveSegment<S>& out) noexcept override {
        if (failure_) {
            return Pull::finished;
        }
        const Pull pull = source_->next(out);
        if (pull != Pull::item) {
            return pull;
        }
        const std::uint32_t row = feeder_->row_of(out.waypoint);
        try {
            watch_->segment(in_double(out), row, *feeder_);
        } catch (...) {
            failure_ = std::current_exception();
            return Pull::finished;
        }
        out.waypoint = row;
        ++segments_;
        return pull;
    }

    [[nodiscard]] const std::exception_ptr& failure() const noexcept { return failure_; }
    [[nodiscard]] std::uint64_t segments() const noexcept { return segments_; }

private:
    CurveSource<S>* source_;
    const PathFeeder* feeder_;
    CurveWatch* watch_;
    std::exception_ptr failure_;
    std::uint64_t segments_ = 0;
};

/// The curve of an input, with what feeds it and who looks at it.
template <Scalar S>
struct WatchedCurve {
    WatchedCurve(PathInput& input, CurveWatch& watch)
        : curve(input), feeder(make_feeder(input, curve)), tee(curve.source(), *feeder, watch) {}

    PathCurve<S> curve;
    std::unique_ptr<PathFeeder> feeder;
    PathTee<S> tee;
};

template <Scalar S>
class ScalarPath final : public PlannedPath {
public:
    /// plan_path().
    ScalarPath(PathInput& input, const MachineDescription& machine, CurveWatch& watch, const PlannerChoice& choice)
        : limits_(machine_limits<S>(machine, choice.sampled())), watched_(input, watch),
          planner_(watched_.tee, limits_, choice) {}

    [[nodiscard]] PathCurve<S>& curve() noexcept { return watched_.curve; }
    [[nodiscard]] Trajectory<S>& trajectory() noexcept { return planner_.trajectory(); }

    [[nodiscard]] PathFeeder& feeder() noexcept override { return *watched_.feeder; }
    Pull next(FeedSegment& out, UnderrunPolicy underrun) override {
        Interruption::point();
        return trajectory().next(out, underrun);
    }
    [[nodiscard]] Pull state() const noexcept override { return planner_.trajectory().state(); }
    [[nodiscard]] Activity activity() const noexcept override { return planner_.trajectory().activity(); }
    [[nodiscard]] Status status() const noexcept override { return planner_.trajectory().status(); }
    bool stand(FeedSegment& out) override { return trajectory().stand(out); }
    void hold() noexcept override { trajectory().hold(); }
    void resume() noexcept override { trajectory().resume(); }
    void abort() noexcept override { trajectory().abort(); }
    void override_feed(double ratio) noexcept override { trajectory().override_feed(from_double<S>(ratio)); }
    [[nodiscard]] const std::exception_ptr& failure() const noexcept override { return watched_.tee.failure(); }
    [[nodiscard]] Statistics statistics() const override;

private:
    MotionLimits<S> limits_;
    WatchedCurve<S> watched_;
    PlannedTrajectory<S> planner_;
};

} // namespace splinefeed::host
