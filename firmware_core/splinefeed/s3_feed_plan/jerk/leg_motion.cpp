// SPDX-License-Identifier: MIT
//
// The middle Bezier points m_i of b in the cells (lengths L_i) are the control points of a C1 quadratic spline, so
//
//   b_i = (L_i m_{i-1} + L_{i-1} m_i) / (L_{i-1} + L_i),  b'_i = 2 (m_i - m_{i-1}) / (L_{i-1} + L_i),
//   u_i = (b'_{i+1} - b'_i) / L_i.
//
// A cell next to standstill has constant jerk along the path: b' = 4 b / (3 L) at its moving end (jerk_cell.cpp).
#include "splinefeed/s3_feed_plan/jerk/leg_motion.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/scalar.hpp"

namespace splinefeed {

template <Floating R>
void LegMotion<R>::join(R first_most_sq, R last_most_sq) noexcept {
    const std::size_t n = cells_;
    const auto own_share = [this](std::size_t moving, R other_mm, R rest_mm) { // beside a cell next to standstill
        const R share = R(1) / (R(1) + R(2) * other_mm / (R(3) * rest_mm));
        LegNode<R>& node = node_[moving];
        node.of_before = node.of_own = node.slope_of_before = node.slope_of_own = R(0);
        return share;
    };
    for (std::size_t i = 0; i < n; ++i) {
        node_[i].per_length = R(1) / node_[i].length_mm;
        node_[i].weight_mm = R(0.5) * ((i > 0 ? node_[i - 1].length_mm : R(0)) + node_[i].length_mm);
    }
    for (std::size_t i = 1; i < n; ++i) {
        LegNode<R>& node = node_[i];
        const R before = node_[i - 1].length_mm;
        const R sum = R(1) / (before + node.length_mm);
        node.of_before = node.length_mm * sum;
        node.of_own = before * sum;
        node.slope_of_own = R(2) * sum;
        node.slope_of_before = -node.slope_of_own;
    }
    if (rests()) {
        LegNode<R>& node = node_[1];
        const R share = own_share(1, node.length_mm, node_[0].length_mm);
        node.of_own = share;
        node.slope_of_own = share * R(detail::rise_from_rest) * node_[0].per_length;
        node.weight_mm += R(2.5) * node_[0].length_mm; // t = 3 L / v
        node.cap_sq = smaller(node.cap_sq, first_most_sq / share);
    }
    LegNode<R>& last = node_[n - 1];
    const R share = own_share(n - 1, node_[n - 2].length_mm, last.length_mm);
    last.of_before = share;
    last.slope_of_before = -share * R(detail::rise_from_rest) * last.per_length;
    last.weight_mm += R(2.5) * last.length_mm;
    node_[n - 2].cap_sq = smaller(node_[n - 2].cap_sq, last_most_sq / share);
    node_[n - 1].curvature = R(0);
    node_[n].b = node_[n].slope = R(0);
    node_[n].of_before = node_[n].of_own = node_[n].slope_of_before = node_[n].slope_of_own = R(0);
}

template <Floating R>
void LegMotion<R>::evaluate() noexcept {
    for (std::size_t i = 1; i < cells_; ++i) {
        LegNode<R>& before = node_[i - 1];
        LegNode<R>& node = node_[i];
        node.b = node.of_before * before.middle_sq + node.of_own * node.middle_sq;
        node.slope = node.slope_of_before * before.middle_sq + node.slope_of_own * node.middle_sq;
        before.curvature = (node.slope - before.slope) * before.per_length;
    }
}

template <Floating R>
SpeedState LegMotion<R>::first(const SpeedState& start) const noexcept {
    const auto b = static_cast<double>(node_[1].b);
    return rests() ? SpeedState{b, detail::rise_from_rest * b / static_cast<double>(node_[0].length_mm)} : start;
}

// The last parabola ends with b' = -4 b / (3 L), L of the cell behind it.
template <Floating R>
SpeedState LegMotion<R>::behind(std::size_t i, const SpeedState& state) const noexcept {
    const auto length = static_cast<double>(node_[i].length_mm);
    auto u = static_cast<double>(node_[i].curvature);
    if (i + 2 == cells_) {
        const double per = -detail::rise_from_rest / static_cast<double>(node_[i + 1].length_mm);
        u = (per * (state.b + state.slope * length) - state.slope) / (length - 0.5 * per * length * length);
    }
    return {state.b + (state.slope + 0.5 * u * length) * length, state.slope + u * length};
}

template <Floating R>
void LegMotion<R>::settle(const SpeedState& start, bool by_gains) noexcept {
    SpeedState state = first(start);
    for (std::size_t i = first_; i + 1 < cells_; ++i) {
        LegNode<R>& node = node_[i];
        if (by_gains) {
            node.curvature += node.gain[1] * static_cast<R>(state.b - static_cast<double>(node.b)) +
                              node.gain[2] * static_cast<R>(state.slope - static_cast<double>(node.slope));
        }
        const SpeedState next = behind(i, state);
        const auto length = static_cast<double>(node.length_mm);
        node.b = static_cast<R>(state.b);
        node.slope = static_cast<R>(state.slope);
        node.middle_sq = static_cast<R>(state.b + 0.5 * state.slope * length);
        if (i + 2 == cells_) {
            node.curvature = static_cast<R>((next.slope - state.slope) / length);
        }
        state = next;
    }
    node_[cells_ - 1].b = static_cast<R>(state.b);
    node_[cells_ - 1].slope = static_cast<R>(state.slope);
}

#define SPLINEFEED_INSTANTIATE(R) template class LegMotion<R>;
SPLINEFEED_EACH_JERK_REAL(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
