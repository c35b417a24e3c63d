// SPDX-License-Identifier: MIT
// SegmentStream: turns the planned speed into feed segments of equal duration, cubics in time, in integers.
//
// The planned motion q(t) is sampled once per segment; the samples are the control points of a uniform cubic B-spline
// in time. Its velocity, acceleration and jerk are convex combinations of differences of samples, and those are
// averages of the planned derivatives: whatever limit holds for the plan holds at every instant of what is emitted. The
// price is a path deviation of at most T^2 |A| / 6 (0.29 um for 1000 mm/s^2 on three axes at 1 ms). Derivation:
// segment_stream.cpp.
#pragma once

#include "splinefeed/s3_feed_plan/feed_plan.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"

namespace splinefeed {

/// Stage 4. Memory: constant. Cost of next(): one evaluation of the curve, plus one division per cell that is passed:
/// amortised constant, at most the cells of the window.
template <Scalar S>
class SegmentStream {
public:
    SegmentStream(FeedPlan<S>& plan, const MotionLimits<S>& limits) noexcept;

    /// Writes the next feed segment. `starved`: the plan has none yet; nothing was lost.
    Pull next(FeedSegment& out) noexcept;

private:
    Pull sample() noexcept;
    Pull enter_cell() noexcept;
    [[nodiscard]] S position_in_cell() const noexcept;
    void push_control(const PerAxis<Position>& position) noexcept;

    FeedPlan<S>* plan_;
    PerAxis<std::uint64_t> steps_per_mm_q32_{};
    S segments_per_s_{};
    S elapsed_{};                                    // time since the start of the cell [segment durations]
    S duration_{};                                   // time for the cell [segment durations]
    S entry_{};                                      // 2 v0 / (v0 + v1), see position_in_cell
    std::array<PerAxis<std::int64_t>, 4> control_{}; // the window of control points [6 units]
    std::uint64_t index_ = 0;
    std::uint32_t segment_ticks_ = 0;
    std::uint32_t waypoint_ = 0;
    int axes_ = 0;
    int hold_ = 0; // control points still to repeat at a stop
    bool started_ = false;
    bool in_cell_ = false;
    bool hop_ = false;      // the cell is entered and left at rest
    bool advanced_ = false; // elapsed_ already holds the next sample's time
};

} // namespace splinefeed
