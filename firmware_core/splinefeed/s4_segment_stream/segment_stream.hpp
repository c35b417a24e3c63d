// SPDX-License-Identifier: MIT
// SegmentStream: turns the planned motion into feed segments of equal duration: cubics in time, in integers.
//
// The planned motion q(t) is sampled once per segment. The samples are the control points of a uniform cubic B-spline
// in time. Its velocity, acceleration and jerk are convex combinations of differences of samples, and these differences
// are averages of the planned derivatives. So a limit that the plan keeps is also kept at every instant of the emitted
// motion. The price is a path deviation of at most T^2 |A| / 6 (0.29 um for 1000 mm/s^2 on three axes at 1 ms).
// Derivation: segment_stream.cpp.
#pragma once

#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"
#include "splinefeed/s4_segment_stream/sampler.hpp"

namespace splinefeed {

/// Stage 4. Memory: constant. Cost of next(): one sample, and one integer product per axis.
template <Scalar S>
class SegmentStream {
public:
    SegmentStream(Sampler<S>& sampler, const MotionLimits<S>& limits) noexcept;

    /// Writes the next feed segment. `starved`: the plan has none yet; nothing was lost. `held`: the machine stands.
    /// `busy`: the budget is spent; call again.
    Pull next(FeedSegment& out, UnderrunPolicy underrun, WorkBudget& work) noexcept;
    /// The same without a bound.
    Pull next(FeedSegment& out, UnderrunPolicy underrun = UnderrunPolicy::wait) noexcept {
        WorkBudget unlimited;
        return next(out, underrun, unlimited);
    }
    /// Writes a segment of standstill at the present position. false: the machine moves, or its position is not known
    /// because no motion has begun.
    [[nodiscard]] bool stand(FeedSegment& out) noexcept;

    /// Whether the position of the machine is known.
    [[nodiscard]] bool begun() const noexcept { return started_; }
    /// Whether the last segment ended at standstill, or there was none.
    [[nodiscard]] bool at_rest() const noexcept { return sampler_->at_rest(); }
    /// Position of the last control point: where the machine stands, once it is at standstill.
    [[nodiscard]] const PerAxis<Position>& position() const noexcept { return sampler_->position(); }

private:
    friend struct CounterSeam;

    void push_control(const PerAxis<Position>& position) noexcept;
    void repeat_control() noexcept;
    void write(FeedSegment& out) noexcept;

    Sampler<S>* sampler_;
    PerAxis<std::uint64_t> steps_per_mm_q32_{};
    std::array<PerAxis<std::int64_t>, 4> control_{}; // the window of control points [6 units]
    std::uint64_t index_ = 0;
    std::uint32_t segment_ticks_ = 0;
    int axes_ = 0;
    bool started_ = false;
};

} // namespace splinefeed
