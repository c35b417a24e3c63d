// SPDX-License-Identifier: MIT
// Trajectory: the pipeline in one object: curve source -> arc length -> feed plan -> segment stream.
#pragma once

#include "splinefeed/s3_feed_plan/acceleration/feed_plan.hpp"
#include "splinefeed/s4_segment_stream/profile_sampler.hpp"
#include "splinefeed/s4_segment_stream/segment_stream.hpp"

namespace splinefeed {

/// Pulls feed segments out of a curve, for limits without jerk. The stages refer to one another: not copied, not moved.
///
///     G2Spline<Fixed> curve({.axes = 3});
///     Trajectory<Fixed> trajectory(curve, limits, window);
///     while (trajectory.next(segment)) port.submit(segment);
///     if (!trajectory.status().ok()) ...
///
/// What does not fit together is refused: the trajectory writes no segment, and status() says why.
template <Scalar S>
class Trajectory {
public:
    /// `curve`, `limits` and `window` must outlive the trajectory.
    Trajectory(CurveSource<S>& curve, const MotionLimits<S>& limits, std::span<PlannedCell<S>> window) noexcept
        : Trajectory(curve, limits, window, limits.jerk_limited ? Error::planner_unsuited : Error::none) {}
    Trajectory(CurveSource<S>& curve, const MotionLimits<S>&& limits, std::span<PlannedCell<S>> window) = delete;
    Trajectory(const Trajectory&) = delete;
    Trajectory& operator=(const Trajectory&) = delete;

    /// Why there is no motion, or none to the end of the program. From the start: axes_out_of_range (the limits are
    /// none), planner_unsuited, window_too_small, storage_too_small. Once the curve's segments come, before the first
    /// one that does not fit, at rest: axes_differ, counts_out_of_range, start_elsewhere.
    [[nodiscard]] Status status() const noexcept { return built_.ok() ? arc_length_.status() : built_; }

    /// Writes the next segment; false when there is none: see state().
    /// @param underrun  drain: for a machine that moves and has no segment left, while the input is late. The
    /// motion
    ///                    goes on with what is known, brakes to rest at its end, and starts again when more comes.
    bool next(FeedSegment& out, UnderrunPolicy underrun = UnderrunPolicy::wait) noexcept {
        state_ = built_.ok() ? stream_.next(out, underrun) : Pull::finished;
        return state_ == Pull::item;
    }
    /// Why the last next() answered as it did: `starved` (push waypoints or finish), `held` (stands until resume() or a
    /// larger override) or `finished` (also: aborted, or refused: see status()).
    [[nodiscard]] Pull state() const noexcept { return state_; }

    /// Steering, at any time between two next(): it acts with the next segment. The path in space stays the same.
    /// Factor of the programmed feed, 0 to 2, taken as the nearest of these; 0 stops. The machine's limits stay.
    void override_feed(S ratio) noexcept { plan_->steering().override_feed(ratio); }
    /// Brakes to rest on the path, as hard as the axes allow.
    void hold() noexcept { plan_->steering().hold(); }
    /// Goes on from where it was held; before it stands, at once.
    void resume() noexcept { plan_->steering().resume(); }
    /// Brakes like hold(), for good: what is left of the program is not travelled. Then start() takes another.
    void abort() noexcept { plan_->steering().abort(); }
    /// What the motion does about all that.
    [[nodiscard]] Activity activity() const noexcept {
        const Steering<S>& steering = plan_->steering();
        if (!steering.stops() || !built_.ok()) {
            return Activity::running;
        }
        const bool stands = plan_->standing() && stream_.at_rest();
        return steering.aborts() ? (stands ? Activity::aborted : Activity::aborting)
                                 : (stands ? Activity::held : Activity::holding);
    }
    /// Writes a segment of standing still, for a machine that is to have one: held, aborted, finished or at a stop.
    /// false: it moves, or where it stands is not known, since no motion has begun.
    [[nodiscard]] bool stand(FeedSegment& out) noexcept { return stream_.stand(out); }
    /// Where the machine stands once it is at rest.
    [[nodiscard]] const PerAxis<Position>& position() const noexcept { return stream_.position(); }
    /// A new program; what is left of the one before is forgotten. Once it moved, the first waypoint must be
    /// position(), else it is refused when it comes: see status(). The override and a hold stay as they are. Errors:
    /// still_moving (nothing was changed), and those of status() that are there from the start.
    Status start(CurveSource<S>& curve) noexcept {
        if (!built_.ok()) {
            return built_;
        }
        if (!plan_->standing() || !stream_.at_rest()) {
            return Error::still_moving;
        }
        plan_->clear();
        sampler_->clear();
        arc_length_.start(curve, stream_.begun() ? &stream_.position() : nullptr);
        state_ = Pull::starved;
        return {};
    }

    [[nodiscard]] const ArcLength<S>& arc_length() const noexcept { return arc_length_; }
    [[nodiscard]] const FeedPlan<S>& feed_plan() const noexcept { return feed_plan_; }

protected:
    /// @param planner  whether there is one that the limits ask for, with its storage
    Trajectory(CurveSource<S>& curve, const MotionLimits<S>& limits, std::span<PlannedCell<S>> window,
               Status planner) noexcept
        : arc_length_(curve, limits.refinement), feed_plan_(arc_length_, limits, window), plan_(&feed_plan_),
          samples_(feed_plan_, limits), sampler_(&samples_), stream_(samples_, limits),
          built_(limits.axes < 1 || limits.axes > max_axes      ? Error::axes_out_of_range
                 : !planner.ok()                                ? planner.error()
                 : window.size() < FeedPlan<S>::smallest_window ? Error::window_too_small
                                                                : Error::none) {}
    [[nodiscard]] FeedPlan<S>& speeds() noexcept { return feed_plan_; }
    /// The stream follows another plan, made of the feed plan's. @pre nothing was asked of it yet
    void refine(MotionPlan<S>& plan) noexcept {
        plan_ = &plan;
        samples_.follow(plan);
    }
    /// And other samples. @pre as above
    void refine(MotionPlan<S>& plan, Sampler<S>& sampler) noexcept {
        plan_ = &plan;
        sampler_ = &sampler;
        stream_.follow(sampler);
    }

private:
    friend struct CounterSeam;

    ArcLength<S> arc_length_;
    FeedPlan<S> feed_plan_;
    MotionPlan<S>* plan_;
    ProfileSampler<S> samples_;
    Sampler<S>* sampler_;
    SegmentStream<S> stream_;
    Pull state_ = Pull::starved;
    Status built_{};
};

} // namespace splinefeed
