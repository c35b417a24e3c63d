// SPDX-License-Identifier: MIT
#include "splinefeed/s3_feed_plan/jerk/straight_leg.hpp"

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

namespace {

template <Floating R>
constexpr double same_cap = std::same_as<R, double> ? 1e-6 : 4e-6;
constexpr double end_part = 1e-6; // of a cell: a move that ends this near ends with the cell

/// Largest v^2 of the acceleration-limited plan in the cell after a node, with the largest override.
template <Floating R>
R fastest_sq(const JerkNode<R>& node, const JerkNode<R>& next) noexcept {
    return smaller(node.most_sq, larger(node.at_most_sq, next.at_most_sq));
}

MoveState state_of(const SpeedState& state) noexcept {
    return {0.0, square_root(state.b), 0.5 * state.slope};
}

} // namespace

template <Scalar S, Floating R>
bool StraightLeg<S, R>::is_straight(const JerkWindow<S, R>& window, std::size_t first, std::size_t end) noexcept {
    const R cap = window.node(first).cap_sq;
    for (std::size_t i = first; i < end; ++i) {
        if (absolute(window.node(i).cap_sq - cap) > R(same_cap<R>) * cap ||
            !window.limits_of(i).straight(fastest_sq(window.node(i), window.node(i + 1)))) {
            return false;
        }
    }
    return true;
}

template <Scalar S, Floating R>
StraightLeg<S, R>::StraightLeg(JerkWindow<S, R>& window) noexcept : window_(&window) {
    find_cells();
    const JerkNode<R>& front = window.node(0);
    if (front.travel == Travel::rest_to_rest) {
        limits_ = window.limits_of(0).move_limits(front.most_sq);
        return;
    }
    limits_ = {square_root(to_double(front.most_sq)), largest<double>(), largest<double>()};
    for (std::size_t i = 0; i < cells_; ++i) {
        const JerkCell<R> cell = window.limits_of(i);
        const MoveLimits of_cell = cell.move_limits(fastest_sq(window.node(i), window.node(i + 1)));
        const double most_sq = to_double(smaller(cell.most_sq[0], cell.most_sq[1]));
        limits_.speed_mm_s = smaller(limits_.speed_mm_s, square_root(most_sq));
        limits_.acceleration_mm_s2 = smaller(limits_.acceleration_mm_s2, of_cell.acceleration_mm_s2);
        limits_.jerk_mm_s3 = smaller(limits_.jerk_mm_s3, of_cell.jerk_mm_s3);
    }
}

template <Scalar S, Floating R>
StraightLeg<S, R>::StraightLeg(JerkWindow<S, R>& window, const MoveLimits& limits) noexcept
    : window_(&window), limits_(limits) {
    find_cells();
}

template <Scalar S, Floating R>
void StraightLeg<S, R>::find_cells() noexcept {
    while (window_->node(0).travel != Travel::rest_to_rest && !window_->cell(cells_ - 1).stop_at_end) {
        SPLINEFEED_ASSERT(cells_ < window_->size()); // a straight leg ends at a stop
        ++cells_;
    }
}

// The limits, with the caps of the cells.
template <Scalar S, Floating R>
MoveLimits StraightLeg<S, R>::capped() const noexcept {
    MoveLimits limits = limits_;
    for (std::size_t i = 0; i < cells_; ++i) {
        limits.speed_mm_s = smaller(limits.speed_mm_s, square_root(to_double(window_->node(i).cap_sq)));
    }
    return limits;
}

template <Scalar S, Floating R>
double StraightLeg<S, R>::length_mm() const noexcept {
    double length = 0.0;
    for (std::size_t i = 0; i < cells_; ++i) {
        length += to_double(window_->node(i).length_mm);
    }
    return length;
}

template <Scalar S, Floating R>
SCurveProfile StraightLeg<S, R>::from_rest() const noexcept {
    return SCurveProfile(length_mm(), capped());
}

template <Scalar S, Floating R>
bool StraightLeg<S, R>::to_rest(double from, const SpeedState& state) noexcept {
    move_ = SCurveProfile::to_rest(state_of(state), limits_);
    double left = from * to_double(window_->node(0).length_mm) + move_.length_mm();
    std::size_t i = 0;
    while (i < cells_ && left > to_double(window_->node(i).length_mm)) {
        left -= to_double(window_->node(i).length_mm);
        ++i;
    }
    if (i == cells_) {
        return false;
    }
    // A part of almost zero length is not split off: the move goes a little farther, or to the end of the cell.
    constexpr double least = JerkWindow<S, R>::shortest_mm;
    const double length = to_double(window_->node(i).length_mm);
    const bool whole = larger(left, least) > length - least;
    // A cell is split at a number of its scalar: the next one behind the place.
    const S cut = from_double<S>(larger(left, least) / length) + scale2(from_integer<S>(1), last_digit_log2<S>);
    const double more = (whole ? length : to_double(cut) * length) - left;
    if (whole ? i + 1 == cells_ : window_->room() == 0) {
        return false;
    }
    if (more > 0.0) {
        move_ = SCurveProfile::to_length(state_of(state), move_.length_mm() + more, limits_);
    }
    if (!whole) {
        window_->split(i, to_double(cut));
    }
    cells_ = i + 1;
    return true;
}

template <Scalar S, Floating R>
bool StraightLeg<S, R>::to_end(double from, const SpeedState& state) noexcept {
    const double left = length_mm() - from * to_double(window_->node(0).length_mm);
    MoveLimits wanted = limits_;
    for (std::size_t i = 0; i < cells_; ++i) {
        wanted.speed_mm_s = smaller(wanted.speed_mm_s, square_root(to_double(window_->node(i).wanted_sq)));
    }
    move_ = SCurveProfile::to_length(state_of(state), left, wanted);
    if (!(move_.length_mm() <= left * (1.0 + end_part))) {
        return false;
    }
    for (std::size_t i = 0; i < cells_; ++i) {
        window_->node(i).cap_sq = window_->node(i).wanted_sq;
    }
    return true;
}

#define SPLINEFEED_INSTANTIATE(S, R) template class StraightLeg<S, R>;
SPLINEFEED_EACH_JERK_PLAN(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
