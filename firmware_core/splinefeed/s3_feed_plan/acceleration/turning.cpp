// SPDX-License-Identifier: MIT
//
// A segment averages the plan over three durations T. In none of them may an axis brake with what is meant for
// accelerating; where it turns round in that time, it may do neither with more than the smaller limit. With at most A,
// the larger one, an axis that stands within 4 T is no farther away from there than A (4 T)^2 / 2, and so it is after
// it stood: a cell keeps its way if the axis travels 8 A T^2 between it and the next place, on either side, where it
// may turn round. At a stop between cells that it leaves the way it came it does not.
#include "splinefeed/s3_feed_plan/acceleration/turning.hpp"

namespace splinefeed {

namespace {

// The least |q'| in a cell with its sign; 0 where q' may vanish.
template <Scalar S>
S least_tangent(const Cell<S>& cell, unsigned axis, int shape_log2) noexcept {
    if ((cell.length_mm + cell.length_mm) * cell.curvature_max[axis] > literal<S>(Cell<S>::sharp_turn)) {
        return S{}; // the shape has no sign
    }
    const AxisShape<S>& shape = cell.shape[axis];
    const S sixth = literal<S>(1.0 / 6.0);
    const S t1 = shape.tangent[0] + sixth * shape.bend[0];
    const S t2 = shape.tangent[1] - sixth * shape.bend[2];
    const S lowest = smaller(smaller(shape.tangent[0], shape.tangent[1]), smaller(t1, t2)) - shape.error_bound;
    const S highest = larger(larger(shape.tangent[0], shape.tangent[1]), larger(t1, t2)) + shape.error_bound;
    return scale2(lowest > S{} ? lowest : highest < S{} ? highest : S{}, -shape_log2);
}

} // namespace

template <Scalar S>
S Turning<S>::near_mm_of(unsigned axis) const noexcept {
    const S speeding = limits_->acceleration_mm_s2[axis];
    const S braking = limits_->braking_mm_s2[axis];
    return speeding == braking
               ? S{}
               : scale2(larger(speeding, braking) / limits_->segments_per_s / limits_->segments_per_s, 3);
}

template <Scalar S>
void Turning<S>::clear() noexcept {
    for (unsigned k = 0; k < static_cast<unsigned>(limits_->axes); ++k) {
        travelled_mm_[k] = near_mm_of(k); // the axis stood
    }
    way_ = {};
}

template <Scalar S>
int Turning<S>::way_in(const Cell<S>& cell, unsigned axis, const MotionLimits<S>& limits) noexcept {
    const S least = least_tangent(cell, axis, limits.refinement.shape_log2);
    return least > S{} ? 1 : least < S{} ? -1 : 0;
}

template <Scalar S>
S Turning<S>::travel_in(const Cell<S>& cell, unsigned axis, const MotionLimits<S>& limits) noexcept {
    return absolute(least_tangent(cell, axis, limits.refinement.shape_log2)) * cell.length_mm;
}

template class Turning<double>;
template class Turning<float>;
template class Turning<Fixed>;

} // namespace splinefeed
