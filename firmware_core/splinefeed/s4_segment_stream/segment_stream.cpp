// SPDX-License-Identifier: MIT
//
// With the samples c_k = q(k T) as control points, the emitted curve over segment k runs from
//
//   p = (c_{k-1} + 4 c_k + c_{k+1}) / 6   with velocity   (c_{k+1} - c_{k-1}) / (2 T)   and acceleration
//   (c_{k+1} - 2 c_k + c_{k-1}) / T^2     to the same of k+1,
//
// and its acceleration is linear in between. A first, second or third difference of samples over T, T^2, T^3 is an
// average of q', q'' or q''' over the samples' span, and so inside every limit that the plan keeps. p differs from c_k
// by a sixth of a second difference: at most T^2 |A| / 6.
//
// Control points are rounded to multiples of 6 units. Then p, and 3 (c_{k+1} - c_{k-1}), which is the velocity in units
// per segment, are whole numbers, and the chain is C2 in exact arithmetic. Errors do not accumulate: every control
// point is rounded from an absolute position.
//
// At a stop the control point is repeated three times: the position is exact, and velocity and acceleration are zero at
// one instant. The dwell is 2 T; ProfileSampler says when it begins and ends.
#include "splinefeed/s4_segment_stream/segment_stream.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

namespace {

// From 2^-40 mm times Q32.32 counts per mm to multiples of 6 units: 6 units are 2^-29 counts.
constexpr int control_shift = Position::fraction_bits + 32 - 29;

} // namespace

template <Scalar S>
SegmentStream<S>::SegmentStream(Sampler<S>& sampler, const MotionLimits<S>& limits) noexcept
    : sampler_(&sampler), steps_per_mm_q32_(limits.steps_per_mm_q32), segment_ticks_(limits.segment_ticks),
      axes_(limits.axes) {}

template <Scalar S>
void SegmentStream<S>::repeat_control() noexcept {
    control_[0] = control_[1];
    control_[1] = control_[2];
    control_[2] = control_[3];
}

template <Scalar S>
void SegmentStream<S>::push_control(const PerAxis<Position>& position) noexcept {
    repeat_control();
    for (const unsigned k : indices(axes_)) {
        control_[3][k] = scaled(position[k], steps_per_mm_q32_[k], control_shift);
    }
}

template <Scalar S>
Pull SegmentStream<S>::next(FeedSegment& out, UnderrunPolicy underrun, WorkBudget& work) noexcept {
    const Pull pull = sampler_->next(underrun, work);
    if (!started_ && (pull == Pull::item || pull == Pull::held)) {
        for (int i = 0; i < 3; ++i) {
            push_control(sampler_->origin());
        }
        started_ = true;
    }
    if (pull == Pull::item) {
        push_control(sampler_->position());
        write(out);
    }
    return pull;
}

template <Scalar S>
bool SegmentStream<S>::stand(FeedSegment& out) noexcept {
    if (!started_ || !at_rest()) {
        return false;
    }
    repeat_control();
    write(out);
    return true;
}

template <Scalar S>
void SegmentStream<S>::write(FeedSegment& out) noexcept {
    out.index = index_++;
    out.duration_ticks = segment_ticks_;
    out.waypoint = sampler_->waypoint();
    for (const unsigned k : indices(axes_)) {
        const std::int64_t c0 = control_[0][k];
        const std::int64_t c1 = control_[1][k];
        const std::int64_t c2 = control_[2][k];
        const std::int64_t c3 = control_[3][k];
        out.start[k] = c0 + 4 * c1 + c2;
        out.end[k] = c1 + 4 * c2 + c3;
        out.start_velocity[k] = 3 * (c2 - c0);
        out.end_velocity[k] = 3 * (c3 - c1);
    }
}

SPLINEFEED_INSTANTIATE_CLASS(SegmentStream)

} // namespace splinefeed
