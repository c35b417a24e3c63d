// SPDX-License-Identifier: MIT
#include "splinefeed/s3_feed_plan/jerk/jerk_window.hpp"

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/s2_arc_length/cell_part.hpp"

namespace splinefeed {

namespace {

// The ratio of the error of the third derivative, times the length, to that of the second. An error x (1-x) (1-2x) of
// q'' has the slope 1 at the ends and reaches 0.096. That of the inverse, c x^3 (1-x)^3 (x-1/2), gives 24, but five
// times that error is allowed for.
constexpr double ripple = 10.4;
// Rounding of q'' where two cells meet, times their length: in Fixed about 2^-27 each, and in R as many digits as the
// difference of two numbers up to 1 has.
template <Scalar S, Floating R>
constexpr double bend_noise = std::same_as<S, double>&& std::same_as<R, double> ? 0x1p-48
                              : std::same_as<R, double>                         ? 0x1p-25
                                                                                : 0x1p-23;

} // namespace

template <Floating R, Scalar S>
AxisLimits<R> axis_limits_of(const MotionLimits<S>& limits) noexcept {
    AxisLimits<R> out;
    out.axes = limits.axes;
    for (const unsigned k : indices(limits.axes)) {
        out.velocity_mm_s[k] = to_floating<R>(limits.velocity_mm_s[k]);
        out.acceleration_mm_s2[k] = to_floating<R>(smaller(limits.acceleration_mm_s2[k], limits.braking_mm_s2[k]));
        out.jerk_mm_s3[k] = to_floating<R>(limits.jerk_mm_s3[k]);
    }
    return out;
}

template <Floating R, Scalar S>
JerkCell<R> jerk_cell_of(const Cell<S>& cell, const AxisLimits<R>& limits, R cap_sq) noexcept {
    JerkCell<R> out;
    out.limits = limits;
    out.length_mm = to_floating<R>(cell.length_mm);
    out.cap_sq = cap_sq;
    const R per_length = R(1) / out.length_mm;
    const R half = R(0.5) * per_length;
    const R per_measured = R(ripple) / to_floating<R>(cell.measured_mm);
    for (const unsigned k : indices(cell.axes)) {
        const AxisShape<S>& shape = cell.shape[k];
        for (unsigned e = 0; e < 2; ++e) {
            AxisEnd<R>& at = out.end[e][k];
            at.first = to_floating<R>(shape.tangent[e]);
            at.second = half * to_floating<R>(shape.bend[2 * e]);
            at.third = per_length * per_length * to_floating<R>(shape.bend[1 + e] - shape.bend[e]);
            at.second_spread = half * to_floating<R>(shape.error_bound);
            at.third_spread = per_measured * half * to_floating<R>(shape.shape_error());
        }
        // The error of q'' adds up from the nearer end of the cell that was measured.
        out.limit_velocity(k,
                           R(0.25) * to_floating<R>(shape.error_bound) * to_floating<R>(cell.measured_mm) * per_length);
    }
    return out;
}

template <Scalar S, Floating R>
JerkWindow<S, R>::JerkWindow(const MotionLimits<S>& limits, const JerkStorage<S, R>& storage) noexcept
    : limits_(axis_limits_of<R>(limits)), segments_per_s_(to_floating<R>(limits.segments_per_s)), storage_(storage),
      scratch_(storage.scratch), spare_(storage.cells.size() / 4) {
    spare_ = spare_ < most_spare ? spare_ : most_spare;
    clear();
}

template <Scalar S, Floating R>
SpeedState JerkWindow<S, R>::state(std::size_t i) const noexcept {
    const JerkNode<R>& here = node(i);
    const auto length = static_cast<double>(here.length_mm);
    if (i < size_ && here.b > 0.0 && !(node(i + 1).b > 0.0)) { // constant jerk to standstill
        return {here.b, -4.0 / 3.0 * here.b / length};
    }
    return {here.b, here.b > 0.0 ? 2.0 * (here.middle_sq - here.b) / length : 0.0};
}

// Where q'' jumps by d, the acceleration jumps by d v^2. A jump above the reserve of MotionLimits::make becomes a stop.
template <Scalar S, Floating R>
bool JerkWindow<S, R>::bend_jumps(std::size_t i) const noexcept {
    const R per_s = R(detail::jump_in_jerk) * segments_per_s_;
    const JerkCell<R> before = limits_of(i - 1);
    const JerkCell<R> after = limits_of(i);
    const R noise = R(bend_noise<S, R>) / smaller(before.length_mm, after.length_mm);
    for (const unsigned k : indices(limits_.axes)) {
        const R jump = absolute(after.end[0][k].second - before.end[1][k].second);
        const R reserve = R(detail::jerk_reserve) * limits_.jerk_mm_s3[k];
        if ((jump - noise) * smaller(node(i).at_most_sq, node(i).most_sq) * per_s > reserve) {
            return true;
        }
    }
    return false;
}

template <Scalar S, Floating R>
void JerkWindow<S, R>::append(const Cell<S>& added, R most_sq, R wanted_sq, R exit_at_most_sq) noexcept {
    SPLINEFEED_ASSERT(room() > 0);
    cell(size_) = added;
    JerkNode<R>& here = node(size_);
    here.length_mm = to_floating<R>(added.length_mm);
    here.cap_sq = here.wanted_sq = wanted_sq;
    here.most_sq = most_sq;
    here.travel = Travel::curve;
    if (size_ > 0 && bend_jumps(size_)) {
        Cell<S>& before = cell(size_ - 1);
        before.stop_at_end = true;
        before.end = added.origin;
    }
    node(size_ + 1).at_most_sq = exit_at_most_sq;
    ++size_;
}

template <Scalar S, Floating R>
void JerkWindow<S, R>::pop() noexcept {
    head_ = ring_index(head_ + 1, storage_.cells.size());
    ++travelled_;
    --size_;
}

template <Scalar S, Floating R>
void JerkWindow<S, R>::forget_travelled() noexcept {
    for (std::size_t i = 0; travelled_ > 0 && i <= size_; ++i) {
        storage_.nodes[i] = storage_.nodes[travelled_ + i];
    }
    travelled_ = 0;
}

template <Scalar S, Floating R>
void JerkWindow<S, R>::open(std::size_t first, std::size_t more) noexcept {
    SPLINEFEED_ASSERT(travelled_ == 0 && more <= room());
    for (std::size_t i = size_ + 1; i-- > first;) {
        if (i < size_) {
            cell(i + more) = cell(i);
        }
        node(i + more) = node(i);
    }
    size_ += more;
}

template <Scalar S, Floating R>
void JerkWindow<S, R>::split(std::size_t i, double fraction) noexcept {
    open(i, 1);
    const S cut = from_double<S>(fraction);
    cell(i) = part_of(cell(i + 1), CellInterval<S>{S{}, cut});
    cell(i + 1) = part_of(cell(i + 1), CellInterval<S>{cut, from_integer<S>(1)});
    JerkNode<R>& before = node(i);
    JerkNode<R>& after = node(i + 1);
    before = after;
    after.at_most_sq += static_cast<R>(fraction) * (node(i + 2).at_most_sq - after.at_most_sq);
    after.b = 0.0;
    for (std::size_t k = i; k < i + 2; ++k) {
        node(k).length_mm = to_floating<R>(cell(k).length_mm);
    }
}

template <Scalar S, Floating R>
void JerkWindow<S, R>::clear() noexcept {
    size_ = travelled_ = 0;
    if (!storage_.nodes.empty()) {
        storage_.nodes[0] = {}; // standstill; all others are written before they are read
    }
}

#define SPLINEFEED_INSTANTIATE(S, R)                                                                                   \
    template AxisLimits<R> axis_limits_of(const MotionLimits<S>&) noexcept;                                            \
    template JerkCell<R> jerk_cell_of(const Cell<S>&, const AxisLimits<R>&, R) noexcept;                               \
    template class JerkWindow<S, R>;
SPLINEFEED_EACH_JERK_PLAN(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
