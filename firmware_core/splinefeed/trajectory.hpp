// SPDX-License-Identifier: MIT
// Trajectory: the pipeline: curve source -> arc length -> planner -> segment stream.
#pragma once

#include "splinefeed/planner.hpp"

namespace splinefeed {

/// Pulls feed segments out of a curve. A reference to its planner, which has all of its memory; copies are the same
/// trajectory.
///
///     static PlannedCell<Fixed> window[64];
///     static AccelerationPlanner<Fixed> planner(window);
///     auto trajectory = Trajectory<Fixed>::make(curve, limits, planner);
///     if (!trajectory.has_value()) ... // trajectory.error()
///     while (trajectory->next(segment) == Pull::item) port.submit(segment);
///     if (!trajectory->status().ok()) ...
template <Scalar S>
class Trajectory {
public:
    /// One that may only be assigned to.
    constexpr Trajectory() noexcept = default;

    /// `curve`, `limits` and `planner` must outlive the trajectory; what the planner did before is forgotten. Errors:
    /// axes_out_of_range (the limits are none), planner_unsuited (a jerk limit without a planner for it, or one for
    /// limits without jerk), window_too_small, storage_too_small. Then nothing was written.
    [[nodiscard]] static Result<Trajectory> make(CurveSource<S>& curve, const MotionLimits<S>& limits,
                                                 Planner<S>& planner) noexcept {
        if (limits.axes < 1 || limits.axes > max_axes) {
            return Error::axes_out_of_range;
        }
        if (const Status fits = planner.fits(limits); !fits.ok()) {
            return fits.error();
        }
        if (planner.window_.size() < FeedPlan<S>::smallest_window) {
            return Error::window_too_small;
        }
        ArcLength<S>& cells = planner.arc_length_.build(curve, limits.refinement);
        FeedPlan<S>& speeds = planner.feed_plan_.build(cells, limits, planner.window_);
        planner.stages_ = planner.build(speeds, limits);
        planner.stream_.build(*planner.stages_.sampler, limits);
        planner.state_ = Pull::starved;
        return Trajectory(planner);
    }
    static Result<Trajectory> make(CurveSource<S>& curve, const MotionLimits<S>&& limits, Planner<S>& planner) = delete;

    /// Why the motion did not go to the end of the program: the first segment of the curve that does not fit, before
    /// which the machine came to rest. axes_differ, counts_out_of_range, start_elsewhere.
    [[nodiscard]] Status status() const noexcept { return planner_->arc_length_->status(); }

    /// Writes the next segment, or answers why there is none: `starved` (push waypoints or finish), `held` (stands
    /// until resume() or a larger override) or `finished` (also: aborted, or refused: see status()).
    /// @param underrun  drain: for a machine that moves and has no segment left, while the input is late. The motion
    ///                  goes on with what is known, brakes to rest at its end, and starts again when more comes.
    [[nodiscard]] Pull next(FeedSegment& out, UnderrunPolicy underrun = UnderrunPolicy::wait) noexcept {
        steering().poll();
        planner_->state_ = planner_->stream_->next(out, underrun);
        return planner_->state_;
    }
    /// What the last next() answered; `starved` before the first.
    [[nodiscard]] Pull state() const noexcept { return planner_->state_; }

    /// Steering, at any time, from an interrupt or another thread, too, one of them at a time: it acts with the next
    /// segment. The path in space stays the same.
    /// Factor of the programmed feed, 0 to 2, taken as the nearest of these; 0 stops. The machine's limits stay.
    void override_feed(S ratio) noexcept { steering().override_feed(ratio); }
    /// Brakes to rest on the path, as hard as the axes allow.
    void hold() noexcept { steering().hold(); }
    /// Goes on from where it was held; before it stands, at once.
    void resume() noexcept { steering().resume(); }
    /// Brakes like hold(), for good: what is left of the program is not travelled. Then start() takes another.
    void abort() noexcept { steering().abort(); }
    /// What the motion does about all that.
    [[nodiscard]] Activity activity() const noexcept {
        Steering<S>& asked = steering();
        asked.poll();
        if (!asked.stops()) {
            return Activity::running;
        }
        return asked.aborts() ? (stands() ? Activity::aborted : Activity::aborting)
                              : (stands() ? Activity::held : Activity::holding);
    }
    /// Writes a segment of standing still, for a machine that is to have one: held, aborted, finished or at a stop.
    /// false: it moves, or where it stands is not known, since no motion has begun.
    [[nodiscard]] bool stand(FeedSegment& out) noexcept { return planner_->stream_->stand(out); }
    /// Where the machine stands once it is at rest.
    [[nodiscard]] const PerAxis<Position>& position() const noexcept { return planner_->stream_->position(); }
    /// A new program; what is left of the one before is forgotten. Once it moved, the first waypoint must be
    /// position(), else it is refused when it comes: see status(). The override and a hold stay as they are. Error:
    /// still_moving (nothing was changed).
    Status start(CurveSource<S>& curve) noexcept {
        if (!stands()) {
            return Error::still_moving;
        }
        const SegmentStream<S>& stream = *planner_->stream_;
        planner_->stages_.plan->clear();
        planner_->stages_.sampler->clear();
        planner_->arc_length_->start(curve, stream.begun() ? &stream.position() : nullptr);
        planner_->state_ = Pull::starved;
        return {};
    }

    [[nodiscard]] const ArcLength<S>& arc_length() const noexcept { return *planner_->arc_length_; }
    [[nodiscard]] const FeedPlan<S>& feed_plan() const noexcept { return *planner_->feed_plan_; }

private:
    friend struct CounterSeam;

    explicit Trajectory(Planner<S>& planner) noexcept : planner_(&planner) {}

    [[nodiscard]] Steering<S>& steering() const noexcept { return planner_->stages_.plan->steering(); }
    [[nodiscard]] bool stands() const noexcept {
        return planner_->stages_.plan->standing() && planner_->stream_->at_rest();
    }

    Planner<S>* planner_ = nullptr;
};

} // namespace splinefeed
