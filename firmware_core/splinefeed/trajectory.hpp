// SPDX-License-Identifier: MIT
// Trajectory: the whole pipeline: curve source -> arc length -> planner -> segment stream.
#pragma once

#include "splinefeed/planner.hpp"

namespace splinefeed {

/// Delivers the feed segments of a curve, one by one. It is a reference to its planner, which holds all the memory; a
/// copy refers to the same trajectory.
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
    /// An empty trajectory. Assign to it before any other call.
    constexpr Trajectory() noexcept = default;

    /// `curve`, `limits` and `planner` must outlive the trajectory. The planner forgets what it did before. Errors:
    /// axes_out_of_range (the limits were not made), planner_unsuited (a jerk limit without a jerk planner, or a jerk
    /// planner without a jerk limit), window_too_small, storage_too_small. After an error nothing has changed.
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

    /// Why the motion ended before the end of the program. A segment of the curve did not fit, and the machine stopped
    /// before it. Errors: axes_differ, counts_out_of_range, start_elsewhere.
    [[nodiscard]] Status status() const noexcept { return planner_->arc_length_->status(); }

    /// Writes the next segment, or says why there is none. The answer is then `starved` (push waypoints or finish the
    /// input), `held` (the machine stands until resume() or a larger override) or `finished`. It is `finished` after an
    /// abort, and after a refused segment: see status().
    /// @param underrun  drain: for a machine that moves and has no segment left while the input is late. The motion
    ///                  continues along the known path, brakes to standstill at its end, and starts again when more
    ///                  input comes. urgent: the same, and where `work` is spent, the motion goes on by the plan that
    ///                  there is, which ends at standstill, instead of `busy`. What is emitted then depends on `work`.
    /// @param work      bound of the work of this call, at least 1, for a main loop that has other work as well. A step
    ///                  is a node that is planned or a cell that is entered. A part of the curve that is
    ///                  measured is three. A segment of the curve, and each part of the search for the largest speeds
    ///                  of a new cell, is four. On top comes one feed segment. docs/reference/budgets.md has the
    ///                  instructions. `busy`: nothing was lost, call again. What is emitted does not depend on it.
    [[nodiscard]] Pull next(FeedSegment& out, UnderrunPolicy underrun = UnderrunPolicy::wait,
                            unsigned work = WorkBudget::unlimited) noexcept {
        SPLINEFEED_ASSERT(work > 0);
        steering().poll();
        WorkBudget budget(work);
        planner_->state_ = planner_->stream_->next(out, underrun, budget);
        return planner_->state_;
    }
    /// Measures a part of the path before next() needs it: call it while the machine has segments in store. What is
    /// emitted does not depend on it, but waypoints are asked for earlier.
    /// @param work  bound of the work, as in next()
    /// @return false: nothing is left to measure, because the window is full or the input has no more
    bool measure_ahead(unsigned work) noexcept {
        WorkBudget budget(work);
        return planner_->feed_plan_->measure_ahead(budget);
    }
    /// The same, and a plan that limits the jerk also plans what comes behind the committed part, before the motion
    /// needs it. So a machine that cannot wait for a plan seldom has to. With a jerk limit, what is emitted depends on
    /// it.
    bool plan_ahead(unsigned work) noexcept {
        WorkBudget budget(work);
        const bool more = planner_->stages_.plan->plan_ahead(budget);
        return budget.spent() ? more : planner_->feed_plan_->measure_ahead(budget) || more;
    }
    /// The answer of the last next(); `starved` before the first call.
    [[nodiscard]] Pull state() const noexcept { return planner_->state_; }

    /// Steering. These calls are allowed at any time, also from an interrupt or another thread, but only from one at a
    /// time. They take effect with the next segment. The path in space does not change.
    /// Factor of the programmed feed. Values outside 0 to 2 are limited to that range; 0 stops the motion. The
    /// machine's limits still apply.
    void override_feed(S ratio) noexcept { steering().override_feed(ratio); }
    /// Upper limit of the feed on top of the program and of the override, which may change while the machine moves; 0
    /// stops the motion. From 65,535 mm/s on there is none, as at the beginning. Resolution: 2^-16 mm/s. Where only
    /// rotary axes of a machine move that has linear ones, too, it does not count.
    void limit_feed(S mm_s) noexcept { steering().limit_feed(mm_s); }
    /// Factor of the largest speed of moves with rapid_feed. Values outside 1/128 to 1 are limited to that range.
    void override_rapids(S ratio) noexcept { steering().override_rapids(ratio); }
    /// Brakes to standstill on the path, as hard as the axes allow.
    void hold() noexcept { steering().hold(); }
    /// Continues from where the motion was held. If the machine is still braking, it accelerates again at once.
    void resume() noexcept { steering().resume(); }
    /// Brakes like hold(), and ends the program: the rest of it is not travelled. After that start() accepts another
    /// program.
    void abort() noexcept { steering().abort(); }
    /// How far the motion has followed these requests.
    [[nodiscard]] Activity activity() const noexcept {
        Steering<S>& asked = steering();
        asked.poll();
        if (!asked.stops()) {
            return Activity::running;
        }
        return asked.aborts() ? (at_rest() ? Activity::aborted : Activity::aborting)
                              : (at_rest() ? Activity::held : Activity::holding);
    }
    /// Whether the last segment ended at standstill, or there was none yet: at a stop, held, aborted, finished, or at
    /// the end of what was known.
    [[nodiscard]] bool at_rest() const noexcept {
        return planner_->stages_.plan->standing() && planner_->stream_->at_rest();
    }
    /// Writes a segment of standstill, for a machine that needs a segment all the time: held, aborted, finished or at a
    /// stop. false: the machine moves, or its position is not known because no motion has begun.
    [[nodiscard]] bool stand(FeedSegment& out) noexcept { return planner_->stream_->stand(out); }
    /// The position where the machine stands, once it is at standstill.
    [[nodiscard]] const PerAxis<Position>& position() const noexcept { return planner_->stream_->position(); }
    /// Starts a new program and forgets what is left of the one before. After a motion, the first waypoint must be
    /// position(); otherwise the segment is refused when it comes: see status(). The override, the limit of the feed
    /// and a hold stay in force. Error: still_moving (nothing was changed).
    Status start(CurveSource<S>& curve) noexcept {
        if (!at_rest()) {
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

    Planner<S>* planner_ = nullptr;
};

} // namespace splinefeed
