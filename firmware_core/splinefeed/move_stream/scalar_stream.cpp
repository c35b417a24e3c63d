// SPDX-License-Identifier: MIT
#include "splinefeed/move_stream/scalar_stream.hpp"

namespace splinefeed {

template <Scalar S>
ScalarStream<S>::ScalarStream(const MotionLimits<S>& limits, Planner<S>& planner, const PathRules<S>& rules,
                              CurveFilter<S>* filter) noexcept
    : limits_(&limits), planner_(&planner), filter_(filter), axes_(limits.axes), rules_(rules) {
    static_cast<void>(begin_path());
    trajectory_ = *Trajectory<S>::make(curve(), limits, planner);
}

template <Scalar S>
ScalarStream<S>::ScalarStream(const MotionLimits<S>& limits, Planner<S>& planner, CurveFilter<S>& curve) noexcept
    : limits_(&limits), planner_(&planner), filter_(&curve), axes_(limits.axes),
      trajectory_(*Trajectory<S>::make(curve, limits, planner)) {}

template <Scalar S>
ScalarStream<S>::ScalarStream(int axes, const PathRules<S>& rules, CurveFilter<S>* filter) noexcept
    : limits_(nullptr), planner_(nullptr), filter_(filter), axes_(axes), rules_(rules) {
    static_cast<void>(begin_path());
}

template <Scalar S>
CurveSource<S>& ScalarStream<S>::curve() noexcept {
    if (filter_ != nullptr) {
        return *filter_;
    }
    return *path_;
}

// From end_.
template <Scalar S>
Status ScalarStream<S>::begin_path() noexcept {
    path_.build(axes_, rules_);
    if (filter_ != nullptr) {
        filter_->begin(*path_);
    }
    moves_ = reached_ = 0;
    kept_.stop_at_end = keeps_ = stops_ = false;
    exhausted_ = at_rest_ = true;
    return path_->start(end_);
}

template <Scalar S>
Status ScalarStream<S>::place(const PerAxis<Position>& position) noexcept {
    end_ = place_ = position;
    const Status begun = begin_path();
    if (moved_) {
        trajectory_ = *Trajectory<S>::make(curve(), *limits_, *planner_);
    } else if (planner_ != nullptr) { // what was asked of it stays
        const Status status = trajectory_.start(curve());
        SPLINEFEED_ASSERT(status.ok());
        static_cast<void>(status);
    }
    moved_ = false;
    return begun;
}

template <Scalar S>
void ScalarStream<S>::restart() noexcept {
    end_ = moved_ ? trajectory_.position() : place_;
    const Status begun = begin_path();
    const Status status = trajectory_.start(curve());
    SPLINEFEED_ASSERT(begun.ok() && status.ok());
    static_cast<void>(begun);
    static_cast<void>(status);
    trajectory_.resume();
}

// The move that was kept back goes into the path. false: there is no room.
template <Scalar S>
bool ScalarStream<S>::release(bool stops) noexcept {
    const bool lost = has_failed(); // the path gives nothing more, so it may never have room
    if (!keeps_ || (!lost && !path_->has_room())) {
        return !keeps_;
    }
    keeps_ = false;
    kept_.stop_at_end = kept_.stop_at_end || stops;
    const Status status = lost ? Status{} : path_->push(kept_);
    SPLINEFEED_ASSERT(status.ok()); // take() has measured it
    static_cast<void>(status);
    return true;
}

template <Scalar S>
Result<bool> ScalarStream<S>::take(const PathElement<S>& move) noexcept {
    const Result<S> length = BlendedPath<S>::length_of(end_, move, axes_);
    if (!length.has_value()) {
        return length.error();
    }
    if (!(*length > S{})) {
        kept_.stop_at_end = kept_.stop_at_end || (keeps_ && move.stop_at_end);
        return false;
    }
    if (stops_ || !release(false)) {
        return Error::no_room;
    }
    kept_ = move;
    end_ = move.to;
    ++moves_;
    keeps_ = true;
    exhausted_ = false;
    return true;
}

template <Scalar S>
bool ScalarStream<S>::stop() noexcept {
    stops_ = release(true);
    return stops_;
}

template <Scalar S>
Status ScalarStream<S>::finish() noexcept {
    if (!release(false)) {
        return Error::no_room;
    }
    return path_->finish();
}

template <Scalar S>
Pull ScalarStream<S>::next(FeedSegment& out, Supply supply, unsigned work) noexcept {
    if (supply == Supply::pauses) {
        release(true);
    }
    const UnderrunPolicy underrun = supply == Supply::urgent  ? UnderrunPolicy::urgent
                                    : supply == Supply::flows ? UnderrunPolicy::wait
                                                              : UnderrunPolicy::drain;
    const Pull pull = trajectory_.next(out, underrun, work);
    const bool ends = pull == Pull::finished || (pull == Pull::starved && closed() && supply != Supply::flows);
    if (pull == Pull::item) {
        moved_ = true;
        at_rest_ = out.ends_at_rest();
        reached_ = out.waypoint;
    } else if (ends && at_rest_ && activity() == Activity::running) {
        exhausted_ = true;
        reached_ = moves_;
    }
    return pull;
}

template <Scalar S>
bool ScalarStream<S>::look_ahead(unsigned work) noexcept {
    const bool full = !path_->has_room();
    trajectory_.measure_ahead(work);
    return full && path_->has_room();
}

#if SPLINEFEED_MAX_DEGREE >= 5
SPLINEFEED_INSTANTIATE_CLASS(ScalarStream)
#endif

} // namespace splinefeed
