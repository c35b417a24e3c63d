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
constexpr double most_kept = 0.45;   // by all kinks together
constexpr double ramps_beside = 1.0; // ramps of a jerk limit that cells with the cap of a kink may take

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
JerkCell<R> jerk_cell_of(const Cell<S>& cell, const AxisLimits<R>& limits, R cap_sq, float kept) noexcept {
    JerkCell<R> out;
    out.limits = limits;
    out.share = R(1) - R(kept);
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

// Where dq/ds jumps by d, the velocity of the axis jumps by v d; where q'' does, its acceleration by v^2 d. In samples
// these are jerks of v d / T^2 and 3/4 v^2 d / T. The reserve of MotionLimits::make is not counted.
template <Scalar S, Floating R>
typename JerkWindow<S, R>::Kink JerkWindow<S, R>::kink_at(std::size_t i, R speed_mm_s) const noexcept {
    const JerkCell<R> before = limits_of(i - 1);
    const JerkCell<R> after = limits_of(i);
    const R noise = R(bend_noise<S, R>) / smaller(before.length_mm, after.length_mm);
    const R frequency = segments_per_s_;
    Kink found;
    for (const unsigned k : indices(limits_.axes)) {
        const R jerk = limits_.jerk_mm_s3[k];
        const R turn = to_floating<R>(cell(i).shape[k].tangent[0] - cell(i - 1).shape[k].tangent[1]);
        const R jump = larger(R(0), absolute(turn) - R(detail::direction_noise<S>)) * speed_mm_s * frequency;
        const R bend = larger(R(0), absolute(after.end[0][k].second - before.end[1][k].second) - noise);
        found.turn = larger(found.turn, larger(jump * frequency / jerk, jump / limits_.acceleration_mm_s2[k]));
        found.bend = larger(found.bend, R(detail::jump_in_jerk) * bend * speed_mm_s * speed_mm_s * frequency / jerk);
    }
    return found;
}

// Within two periods of a kink, third differences see it. false: it becomes a stop.
template <Scalar S, Floating R>
bool JerkWindow<S, R>::pass_kink(std::size_t i) noexcept {
    JerkNode<R>& before = node(i - 1);
    JerkNode<R>& here = node(i);
    R speed = square_root(smaller(here.at_most_sq, smaller(here.most_sq, before.most_sq)));
    const Kink kink = kink_at(i, speed);
    R share = kink.turn + kink.bend;
    if (!(share > R(detail::jerk_reserve))) {
        return true;
    }
    const R most = R(detail::kink_share);
    if (share > most) {
        // The root of turn x + bend x^2 = most. Cells that get this cap take no longer than braking would.
        speed *= R(2) * most / (kink.turn + square_root(kink.turn * kink.turn + R(4) * kink.bend * most));
        R ramp_s{};
        for (const unsigned k : indices(limits_.axes)) {
            ramp_s = larger(ramp_s, limits_.acceleration_mm_s2[k] / limits_.jerk_mm_s3[k]);
        }
        if (before.length_mm + here.length_mm > R(ramps_beside) * ramp_s * speed) {
            return false;
        }
        share = most;
        const R cap_sq = speed * speed;
        here.at_most_sq = smaller(here.at_most_sq, cap_sq);
        for (JerkNode<R>* const beside : {&before, &here}) {
            for (R JerkNode<R>::*const cap : {&JerkNode<R>::cap_sq, &JerkNode<R>::most_sq, &JerkNode<R>::wanted_sq}) {
                beside->*cap = smaller(beside->*cap, cap_sq);
            }
        }
    }
    R steepest{};
    for (const unsigned k : indices(limits_.axes)) {
        steepest = larger(steepest, limits_.acceleration_mm_s2[k]);
    }
    const R reach_mm = R(2) / segments_per_s_ * (speed + R(2) / segments_per_s_ * steepest);
    const auto kept = static_cast<float>(share);
    bool fits = here.kept + kept < float(most_kept);
    R way{};
    for (std::size_t n = i; n-- > 0 && way < reach_mm; way += node(n).length_mm) {
        node(n).kept += kept;
        fits = fits && node(n).kept < float(most_kept);
    }
    here.kept += kept;
    keeping_ = kept + (here.length_mm < keeping_mm_ ? keeping_ : 0.0F);
    keeping_mm_ = larger(reach_mm, keeping_mm_);
    return fits;
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
    here.kept = keeping_mm_ > R(0) ? keeping_ : 0.0F;
    if (size_ > 0 && !cell(size_ - 1).stop_at_end && !pass_kink(size_)) {
        Cell<S>& before = cell(size_ - 1);
        before.stop_at_end = true;
        before.end = added.origin;
    }
    keeping_mm_ = larger(R(0), keeping_mm_ - here.length_mm);
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
    keeping_mm_ = R(0);
    if (!storage_.nodes.empty()) {
        storage_.nodes[0] = {}; // standstill; all others are written before they are read
    }
}

#define SPLINEFEED_INSTANTIATE(S, R)                                                                                   \
    template AxisLimits<R> axis_limits_of(const MotionLimits<S>&) noexcept;                                            \
    template JerkCell<R> jerk_cell_of(const Cell<S>&, const AxisLimits<R>&, R, float) noexcept;                        \
    template class JerkWindow<S, R>;
SPLINEFEED_EACH_JERK_PLAN(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
