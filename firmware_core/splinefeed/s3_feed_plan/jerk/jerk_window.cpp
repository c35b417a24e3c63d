// SPDX-License-Identifier: MIT
#include "splinefeed/s3_feed_plan/jerk/jerk_window.hpp"

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/s2_arc_length/cell_part.hpp"

namespace splinefeed {

namespace {

// The ratio of the error of the third derivative, times the length, to that of the second. An error x (1-x) (1-2x) of
// q'' has the slope 1 at the ends and reaches 0.096. That of the inverse, c x^3 (1-x)^3 (x-1/2), gives 24, but five
// times that error is allowed for.
constexpr double ripple = 10.4;
// Rounding of q'' where two cells meet, times their length: in Fixed about 2^-27 each.
template <Scalar S>
constexpr double bend_noise = std::same_as<S, double> ? 0x1p-48 : 0x1p-25;

} // namespace

template <Scalar S>
JerkCell jerk_cell_of(const Cell<S>& cell, const MotionLimits<S>& limits, double cap_sq) noexcept {
    JerkCell out;
    out.axes = cell.axes;
    out.length_mm = to_double(cell.length_mm);
    out.cap_sq = cap_sq;
    const double per_length = 1.0 / out.length_mm;
    for (const unsigned k : indices(cell.axes)) {
        const AxisShape<S>& shape = cell.shape[k];
        out.jerk_mm_s3[k] = to_double(limits.jerk_mm_s3[k]);
        for (unsigned e = 0; e < 2; ++e) {
            AxisEnd& at = out.end[e][k];
            at.first = to_double(shape.tangent[e]);
            at.second = 0.5 * per_length * to_double(shape.bend[2 * e]);
            at.third = per_length * per_length * to_double(shape.bend[1 + e] - shape.bend[e]);
            at.second_spread = 0.5 * per_length * to_double(shape.error_bound);
            at.third_spread = ripple * 0.5 * per_length * per_length * to_double(shape.shape_error());
            at.most_forward = at.most_backward =
                to_double(smaller(limits.acceleration_mm_s2[k], limits.braking_mm_s2[k]));
        }
    }
    return out;
}

template <Scalar S>
JerkWindow<S>::JerkWindow(const MotionLimits<S>& limits, const JerkStorage<S>& storage) noexcept
    : limits_(&limits), storage_(storage), spare_(storage.cells.size() / 4) {
    spare_ = spare_ < most_spare ? spare_ : most_spare;
    clear();
}

template <Scalar S>
SpeedState JerkWindow<S>::state(std::size_t i) const noexcept {
    const JerkNode& here = node(i);
    if (i < size_ && here.b > 0.0 && !(node(i + 1).b > 0.0)) { // constant jerk to standstill
        return {here.b, -4.0 / 3.0 * here.b / here.length_mm};
    }
    return {here.b, here.b > 0.0 ? 2.0 * (here.middle_sq - here.b) / here.length_mm : 0.0};
}

// Where q'' jumps by d, the acceleration jumps by d v^2, and a third difference over T^3 contains up to 3/4 of that
// over T. A jump above the reserve of MotionLimits::make becomes a stop.
template <Scalar S>
bool JerkWindow<S>::bend_jumps(std::size_t i) const noexcept {
    const double per_s = 0.75 * to_double(limits_->segments_per_s);
    const JerkCell before = limits_of(i - 1);
    const JerkCell after = limits_of(i);
    const double noise = bend_noise<S> / smaller(before.length_mm, after.length_mm);
    for (const unsigned k : indices(after.axes)) {
        const double jump = absolute(after.end[0][k].second - before.end[1][k].second);
        const double reserve = detail::jerk_reserve * after.jerk_mm_s3[k];
        if ((jump - noise) * smaller(node(i).at_most_sq, node(i).most_sq) * per_s > reserve) {
            return true;
        }
    }
    return false;
}

template <Scalar S>
void JerkWindow<S>::append(const Cell<S>& added, double most_sq, double wanted_sq, double exit_at_most_sq) noexcept {
    SPLINEFEED_ASSERT(room() > 0);
    cell(size_) = added;
    JerkNode& here = node(size_);
    here.length_mm = to_double(added.length_mm);
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

template <Scalar S>
void JerkWindow<S>::pop() noexcept {
    head_ = ring_index(head_ + 1, storage_.cells.size());
    ++travelled_;
    --size_;
}

template <Scalar S>
void JerkWindow<S>::forget_travelled() noexcept {
    for (std::size_t i = 0; travelled_ > 0 && i <= size_; ++i) {
        storage_.nodes[i] = storage_.nodes[travelled_ + i];
    }
    travelled_ = 0;
}

template <Scalar S>
void JerkWindow<S>::open(std::size_t first, std::size_t more) noexcept {
    SPLINEFEED_ASSERT(travelled_ == 0 && more <= room());
    for (std::size_t i = size_ + 1; i-- > first;) {
        if (i < size_) {
            cell(i + more) = cell(i);
        }
        node(i + more) = node(i);
    }
    size_ += more;
}

template <Scalar S>
void JerkWindow<S>::split(std::size_t i, double fraction) noexcept {
    open(i, 1);
    const S cut = from_double<S>(fraction);
    const Cell<S> whole = cell(i + 1);
    cell(i) = part_of(whole, CellInterval<S>{S{}, cut});
    cell(i + 1) = part_of(whole, CellInterval<S>{cut, from_integer<S>(1)});
    JerkNode& before = node(i);
    JerkNode& after = node(i + 1);
    before = after;
    after.at_most_sq += fraction * (node(i + 2).at_most_sq - after.at_most_sq);
    after.b = 0.0;
    for (std::size_t k = i; k < i + 2; ++k) {
        node(k).length_mm = to_double(cell(k).length_mm);
    }
}

template <Scalar S>
void JerkWindow<S>::clear() noexcept {
    size_ = travelled_ = 0;
    if (!storage_.nodes.empty()) {
        storage_.nodes[0] = {}; // standstill; all others are written before they are read
    }
}

template JerkCell jerk_cell_of(const Cell<double>&, const MotionLimits<double>&, double) noexcept;
template JerkCell jerk_cell_of(const Cell<float>&, const MotionLimits<float>&, double) noexcept;
template JerkCell jerk_cell_of(const Cell<Fixed>&, const MotionLimits<Fixed>&, double) noexcept;
template class JerkWindow<double>;
template class JerkWindow<float>;
template class JerkWindow<Fixed>;

} // namespace splinefeed
