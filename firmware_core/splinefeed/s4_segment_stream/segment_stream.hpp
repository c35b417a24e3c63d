// SPDX-License-Identifier: MIT
// SegmentStream: turns the planned speed into feed segments of equal duration, cubics in time, in integers.
//
// The planned motion q(t) is sampled once per segment; the samples are the control points of a uniform cubic B-spline
// in time. Its velocity, acceleration and jerk are convex combinations of differences of samples, and those are
// averages of the planned derivatives: whatever limit holds for the plan holds at every instant of what is emitted. The
// price is a path deviation of at most T^2 |A| / 6 (0.29 um for 1000 mm/s^2 on three axes at 1 ms). Derivation:
// segment_stream.cpp.
#pragma once

#include "splinefeed/s3_feed_plan/motion_limits.hpp"
#include "splinefeed/s3_feed_plan/motion_plan.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"
#include "splinefeed/s4_segment_stream/passage_motion.hpp"

namespace splinefeed {

/// Stage 4. Memory: constant. Cost of next(): one evaluation of the curve, plus one division per cell that is passed:
/// amortised constant, at most the cells of the window; and
/// after a change of the steering a visit to every cell of the window.
template <Scalar S>
class SegmentStream {
public:
    SegmentStream(MotionPlan<S>& plan, const MotionLimits<S>& limits) noexcept;

    /// Another plan to follow. @pre nothing was written yet
    void follow(MotionPlan<S>& plan) noexcept { plan_ = &plan; }

    /// Writes the next feed segment. `starved`: the plan has none yet; nothing was lost. `held`: the machine stands.
    Pull next(FeedSegment& out, Starvation starvation = Starvation::waits) noexcept;
    /// Writes a segment in which the machine stands where it is. @pre at_rest()
    void stand(FeedSegment& out) noexcept;

    /// The last segment ended at rest, or there was none.
    [[nodiscard]] bool at_rest() const noexcept { return !in_passage_ && repeats_ == 0 && !advanced_; }
    /// Of the last control point: where the machine stands once it is at rest.
    [[nodiscard]] const PerAxis<Position>& position() const noexcept { return position_; }

private:
    Pull sample(Starvation starvation) noexcept;
    Pull enter_passage(Starvation starvation) noexcept;
    void follow_steering() noexcept;
    [[nodiscard]] S braked(S x, S speed) const noexcept;
    bool arrive() noexcept;
    [[nodiscard]] S fraction() const noexcept;
    void push_control() noexcept;
    void repeat_control() noexcept;
    void write(FeedSegment& out) noexcept;

    MotionPlan<S>* plan_;
    PerAxis<std::uint64_t> steps_per_mm_q32_{};
    PerAxis<S> braking_mm_s2_{};
    S segments_per_s_{};
    S elapsed_{}; // time since the start of the passage [segment durations]
    PassageMotion<S> motion_;
    PerAxis<Position> position_{}; // of the last control point, and of the one before
    PerAxis<Position> previous_{};
    std::array<PerAxis<std::int64_t>, 4> control_{}; // the window of control points [6 units]
    std::uint64_t index_ = 0;
    std::uint32_t segment_ticks_ = 0;
    std::uint32_t waypoint_ = 0;
    int axes_ = 0;
    int repeats_ = 0; // control points still to repeat at a stop
    bool started_ = false;
    bool in_passage_ = false;
    bool advanced_ = false; // elapsed_ already holds the next sample's time
};

} // namespace splinefeed
