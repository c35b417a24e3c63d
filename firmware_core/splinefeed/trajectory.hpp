// SPDX-License-Identifier: MIT
// Trajectory: the pipeline in one object: curve source -> arc length -> feed plan -> segment stream.
#pragma once

#include "splinefeed/s4_segment_stream/segment_stream.hpp"

namespace splinefeed {

/// Pulls feed segments out of a curve. The stages refer to one another: not copied, not moved.
///
///     G2Spline<Fixed> curve({.axes = 3});
///     Trajectory<Fixed> trajectory(curve, limits, window);
///     while (trajectory.next(segment)) port.submit(segment);
template <Scalar S>
class Trajectory {
public:
    /// `curve`, `limits` and `window` must outlive the trajectory.
    Trajectory(CurveSource<S>& curve, const MotionLimits<S>& limits, std::span<PlannedCell<S>> window) noexcept
        : arc_length_(curve, limits.refinement), plan_(arc_length_, limits, window), stream_(plan_, limits) {}
    Trajectory(CurveSource<S>& curve, const MotionLimits<S>&& limits, std::span<PlannedCell<S>> window) = delete;
    Trajectory(const Trajectory&) = delete;
    Trajectory& operator=(const Trajectory&) = delete;

    /// Writes the next segment; false when there is none: see state().
    bool next(FeedSegment& out) noexcept {
        state_ = stream_.next(out);
        return state_ == Pull::item;
    }
    /// Why the last next() answered as it did: `starved` (push waypoints or finish) or `finished`.
    [[nodiscard]] Pull state() const noexcept { return state_; }

    [[nodiscard]] const ArcLength<S>& arc_length() const noexcept { return arc_length_; }
    [[nodiscard]] const FeedPlan<S>& feed_plan() const noexcept { return plan_; }

private:
    ArcLength<S> arc_length_;
    FeedPlan<S> plan_;
    SegmentStream<S> stream_;
    Pull state_ = Pull::starved;
};

} // namespace splinefeed
