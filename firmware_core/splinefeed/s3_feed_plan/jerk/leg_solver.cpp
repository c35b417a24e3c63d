// SPDX-License-Identifier: MIT
//
// The unknowns are the middle Bezier points m of b = v^2 in the cells (leg_motion.cpp).
//
// Rows |p| <= h at every node, for each axis:
//
//   acceleration  p = q'' b + q' b' / 2                    h = A - s2 b
//   jerk          p = q''' b + 3/2 q'' b' + q' u / 2       h = J b^(-1/2) - s3 b, with u of the cell before and behind
//
// and m <= cap. Objective: the time, the sum of w b^(-1/2).
//
// Primal-dual interior-point method (Mehrotra 1992; Rao, Wright, Rawlings 1998 for the recursion): each step minimises
// a quadratic model of the time and of the barrier over db, db', du. State x = (b, b') and input u make a linear system
// along the path, so the model is solved by a Riccati recursion: from the last node to the first the cost of the rest
// of the way, then from the first to the last the step. Two multipliers a row would be one for each sign of p: only the
// nearer side has one, the far side is a primal barrier. The weight of a row's barrier is mu tau, tau = w b^(-1/2): so
// mu is a share of the time, however uneven the cells are.
//
// To brake, the objective is the sum of w b / b_0^(3/2), whose terms are w b_0^(-1/2) at first: tau = w b_0^(-1/2). b
// stays positive by a barrier of its own, -mu tau log m.
//
// h is concave or convex in b: its curvature, weighted by the multipliers, is taken from that of the time, as far as
// the model stays convex.
//
// A first motion may exceed the limits: those of node i are widened by phi times its excess, and phi goes to 0 with the
// steps.
#include "splinefeed/s3_feed_plan/jerk/leg_solver.hpp"

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/s3_feed_plan/jerk/leg_rows.hpp"

namespace splinefeed {

namespace {

template <Floating R>
constexpr R no_row = R(1e9);             // share of a limit beside the first and the last cell: there is no row
constexpr double least_left = 0.2;       // of middle_sq, after a step
constexpr double least_curvature = 0.05; // of the time's own
constexpr double least_shrink = 0.1;     // of the gap in a step
constexpr double stuck_step = 0.02;      // a step below is one that leads nowhere
constexpr int most_stuck = 3;
constexpr double good_step = 0.5; // the last step reaches so far, at least

constexpr double no_excess = 1e-5;
constexpr double small_excess = 1e-4;

template <Floating R>
inline R of_gains(const LegNode<R>& node, R b, R slope) noexcept {
    return node.gain[0] + node.gain[1] * b + node.gain[2] * slope;
}

} // namespace

template <Floating R>
typename LegSolver<R>::Change LegSolver<R>::first_change() const noexcept {
    const R b = first_ > 0 ? first_step_ : R(0);
    const R slope = R(detail::rise_from_rest) * node_[0].per_length * b;
    return {b, slope, of_gains(node_[first_], b, slope)};
}

template <Floating R>
typename LegSolver<R>::Change LegSolver<R>::next_change(std::size_t i, const Change& change) const noexcept {
    const R length = node_[i].length_mm;
    const R slope = change.slope + change.curvature * length;
    const R b = change.b + R(0.5) * (change.slope + slope) * length;
    return {b, slope, i + 2 < cells_ ? of_gains(node_[i + 1], b, slope) : R(0)};
}

// Takes a part of the step.
template <Floating R>
void LegSolver<R>::move(R part) noexcept {
    Change change = first_change();
    for (std::size_t i = first_; i < cells_; ++i) {
        LegNode<R>& node = node_[i];
        node.b += part * change.b;
        node.slope += part * change.slope;
        node.curvature += part * change.curvature;
        if (i + 1 < cells_) {
            node.middle_sq += part * (change.b + R(0.5) * node.length_mm * change.slope);
        }
        change = next_change(i, change);
    }
}

template <Floating R>
typename LegSolver<R>::Row LegSolver<R>::row_at(std::size_t i) const noexcept {
    const LegNode<R>& node = node_[i];
    const bool left = i > first_;
    const bool right = i + 1 < cells_;
    Row row;
    row.b = node.b;
    row.slope = node.slope;
    row.root = R(1) / detail::hardware_square_root(node.b);
    row.per_b = row.root * row.root;
    row.pull = barrier_ * node.weight_mm * (brake_root_ > R(0) ? brake_root_ : row.root);
    row.excess = infeasibility_ * node.excess;
    row.wider = R(1) + row.excess;
    row.acceleration_share =
        i > 0 ? smaller(node_[i - 1].acceleration_share, node.acceleration_share) : no_row<R>; // a given state
    row.share = Pair<R>{left ? node_[i - 1].jerk_share : no_row<R>, right ? node.jerk_share : no_row<R>};
    row.curvature = Pair<R>{i > 0 ? node_[i - 1].curvature : R(0), node.curvature};
    return row;
}

// By how much the first motion exceeds the limits, less a margin. Returns 1 if it does anywhere.
template <Floating R>
R LegSolver<R>::measure_excess(R margin) noexcept {
    R any{};
    for (std::size_t i = first_; i < cells_; ++i) {
        LegNode<R>& node = node_[i];
        const Row row = row_at(i);
        R most{};
        for (const unsigned k : indices(limits_.axes)) {
            most = larger(most, detail::use_of_node(node.axis[k], limits_.acceleration_mm_s2[k], limits_.jerk_mm_s3[k],
                                                    row, i > 0));
        }
        const R free = i == 0 ? R(1e-3) : margin; // nothing can change the state of the first node
        node.excess = most > R(1) - free ? most - R(1) + free : R(0);
        any = node.excess > R(0) ? R(1) : any;
    }
    return any;
}

template <Floating R>
void LegSolver<R>::forget_multipliers() noexcept {
    for (LegNode<R>& node : node_) {
        node.cap_multiplier = R(0);
        for (const unsigned k : indices(limits_.axes)) {
            node.axis[k].acceleration_multiplier = R(0);
            node.axis[k].jerk_multiplier = Pair<R>{};
        }
    }
}

// The cap of the middle of the cell behind a node, b + b' L / 2.
template <Floating R>
inline void LegSolver<R>::add_cap(LegNode<R>& node, const Row& row, Value& value) noexcept {
    const R slack = R(1) / (node.cap_sq - node.middle_sq);
    const R central = row.pull * slack;
    R multiplier = node.cap_multiplier > R(0) ? node.cap_multiplier : central;
    multiplier = smaller(multiplier, R(detail::most_multiplier) * central);
    node.cap_multiplier = multiplier;
    node.per_cap_slack = slack;
    gap_ += (node.cap_sq - node.middle_sq) * multiplier;
    nominal_gap_ += row.pull;
    const R above = brake_root_ > R(0) ? R(1) / node.middle_sq : R(0); // of its barrier at 0
    const R second = multiplier * slack + row.pull * above * above;
    const R first = central - row.pull * above;
    const R half = R(0.5) * node.length_mm;
    value.bb += second;
    value.bs += second * half;
    value.ss += second * half * half;
    value.b += first;
    value.s += first * half;
}

// Takes the cost of the rest of the way from the end of a cell to its start: y = A x + B u, A = [1 L; 0 1], B = (L^2/2,
// L), and u = k + K x as is best for it. The cost at the start is that of y and u along x = (1, 0) and (0, 1): a sum of
// squares in exact numbers. (As P - N N' / r it would be a difference, which float has no digits for in short cells.)
template <Floating R>
inline void LegSolver<R>::pass_cell(std::size_t i, const Terms& terms, Value& value) noexcept {
    LegNode<R>& node = node_[i];
    const R length = node.length_mm;
    const R b0 = R(0.5) * length * length;
    const R wb = value.bb * b0 + value.bs * length + value.ub;
    const R ws = value.bs * b0 + value.ss * length + value.us;
    const R of_u = value.u + terms.u[1];
    const R nu = of_u + value.b * b0 + value.s * length;
    if (i + 2 == cells_) { // b' = -4 b / (3 L) at its end
        const R per = R(-detail::rise_from_rest) * node_[cells_ - 1].per_length;
        const R inverse = R(1) / (length - per * b0);
        node.gain = {R(0), per * inverse, (per * length - R(1)) * inverse};
    } else {
        const R uu = value.uu + terms.uu[1] + value.ub * b0 + value.us * length + wb * b0 + ws * length;
        const R inverse = R(1) / larger(uu, R(1e-30));
        node.gain = {-nu * inverse, -(wb + terms.ub[1]) * inverse, -(wb * length + ws + terms.us[1]) * inverse};
    }
    const Change by_b{R(1) + b0 * node.gain[1], length * node.gain[1], node.gain[1]};
    const Change by_s{length + b0 * node.gain[2], R(1) + length * node.gain[2], node.gain[2]};
    const auto cost = [&](const Change& x, const Change& y) {
        return x.b * (value.bb * y.b + value.bs * y.slope + value.ub * y.curvature) +
               x.slope * (value.bs * y.b + value.ss * y.slope + value.us * y.curvature) +
               x.curvature * (value.ub * y.b + value.us * y.slope + (value.uu + terms.uu[1]) * y.curvature);
    };
    const auto slope = [&](const Change& x) {
        return x.b * value.b + x.slope * value.s + x.curvature * of_u;
    };
    const R bb = cost(by_b, by_b) + R(2) * terms.ub[1] * by_b.curvature;
    const R bs = cost(by_b, by_s) + terms.ub[1] * by_s.curvature + terms.us[1] * by_b.curvature;
    const R ss = cost(by_s, by_s) + R(2) * terms.us[1] * by_s.curvature;
    const R b = slope(by_b);
    value.s = slope(by_s);
    value.bb = bb;
    value.bs = bs;
    value.ss = ss;
    value.b = b;
}

template <Floating R>
void LegSolver<R>::begin_step() noexcept {
    ahead_ = false;
    at_ = cells_;
    value_ = {};
    gap_ = nominal_gap_ = R(0);
}

// The cost of the rest of the way, from the last node to the first, and the step there.
template <Floating R>
void LegSolver<R>::backward() noexcept {
    Value value = value_;
    const std::size_t end = at_ > first_ + most_nodes ? at_ - most_nodes : first_;
    for (std::size_t i = at_; i-- > end;) {
        LegNode<R>& node = node_[i];
        const Row row = row_at(i);
        Terms terms;
        for (const unsigned k : indices(limits_.axes)) {
            detail::add_acceleration(node.axis[k], limits_.acceleration_mm_s2[k], row, terms);
            detail::add_jerk(node.axis[k], limits_.jerk_mm_s3[k], row, terms);
        }
        gap_ += terms.gap + sum_of<R>(terms.jerk_gap);
        nominal_gap_ += row.pull * static_cast<R>(3 * limits_.axes);
        R bb = terms.bb + sum_of<R>(terms.jbb);
        R first = terms.b + sum_of<R>(terms.jb);
        const R slowness = node.weight_mm * row.root * row.per_b;
        const R own = R(0.75) * slowness * row.per_b;
        const R of_limits =
            R(0.75) * row.per_b * row.per_b *
            ((i > first_ ? R(terms.limit_curvature[0]) : R(0)) + (i + 1 < cells_ ? R(terms.limit_curvature[1]) : R(0)));
        if (brake_root_ > R(0)) {
            first += node.weight_mm * brake_root_ * brake_root_ * brake_root_;
        } else {
            bb += larger(R(least_curvature) * own, own - of_limits);
            first -= R(0.5) * slowness;
        }
        if (i + 1 < cells_) {
            pass_cell(i, terms, value);
            if (i > 0) {
                add_cap(node, row, value);
            }
        }
        value.bb = larger(value.bb + bb, R(0));
        value.bs += terms.bs + sum_of<R>(terms.jbs);
        value.ss = larger(value.ss + terms.ss + sum_of<R>(terms.jss), R(0));
        value.b += first;
        value.s += terms.s + sum_of<R>(terms.js);
        value.ub = terms.ub[0];
        value.us = terms.us[0];
        value.uu = terms.uu[0];
        value.u = terms.u[0];
    }
    at_ = end;
    value_ = value;
    if (at_ > first_) {
        return;
    }
    const R slope = R(detail::rise_from_rest) * node_[0].per_length;
    first_step_ = -(value.b + slope * value.s) / (value.bb + R(2) * slope * value.bs + slope * slope * value.ss);
    ahead_ = true;
    reach_ = {};
    reach_.change = first_change();
}

// The step of every node and multiplier, from the first to the last. Whether it has come so far.
template <Floating R>
bool LegSolver<R>::forward() noexcept {
    auto [most, most_jerk, before, change] = reach_;
    const std::size_t end = smaller(at_ + most_nodes, cells_);
    for (std::size_t i = at_; i < end; ++i) {
        LegNode<R>& node = node_[i];
        const Row row = row_at(i);
        const bool right = i + 1 < cells_;
        const detail::LegStep<R> step{change.b, change.slope, Pair<R>{before, change.curvature}};
        for (const unsigned k : indices(limits_.axes)) {
            detail::follow_acceleration(node.axis[k], limits_.acceleration_mm_s2[k], row, step, most);
            detail::follow_jerk(node.axis[k], limits_.jerk_mm_s3[k], row, step, most_jerk);
        }
        if (i > 0 && right) {
            const R middle = change.b + R(0.5) * node.length_mm * change.slope;
            most = larger(most, middle * node.per_cap_slack * R(detail::per_way));
            most = larger(most, -middle * R(1.0 / (1.0 - least_left)) / node.middle_sq);
            node.cap_multiplier = larger(R(detail::least_multiplier) * node.cap_multiplier,
                                         (row.pull + node.cap_multiplier * middle) * node.per_cap_slack);
        }
        before = change.curvature;
        change = next_change(i, change);
    }
    at_ = end;
    reach_ = {most, most_jerk, before, change};
    return at_ == cells_;
}

template <Floating R>
void LegSolver<R>::begin(const LegEffort<R>& effort) noexcept {
    effort_ = effort;
    infeasibility_ = measure_excess(effort.margin);
    if (!effort.again) {
        forget_multipliers();
    }
    barrier_ = effort.start_accuracy;
    const R from_sq = effort.brakes_from_sq;
    brake_root_ = from_sq > R(0) ? R(1) / detail::hardware_square_root(from_sq) : R(0);
    steps_ = stuck_ = 0;
    begin_step();
}

template <Floating R>
Search LegSolver<R>::step() noexcept {
    SPLINEFEED_ASSERT(steps_ < effort_.steps);
    if (!ahead_) {
        backward();
        return Search::running;
    }
    if (!forward()) {
        return Search::running;
    }
    const R inverse = larger(reach_.most, larger_of<R>(reach_.most_jerk));
    stuck_ = inverse > R(1.0 / stuck_step) ? stuck_ + 1 : 0;
    if (!(gap_ > R(0)) || !(inverse < R(1e8)) || stuck_ > most_stuck) {
        return Search::none;
    }
    const R part = R(1) / inverse;
    move(part);
    infeasibility_ *= R(1) - part;
    infeasibility_ = infeasibility_ < R(no_excess) ? R(0) : infeasibility_;
    const bool close = barrier_ <= effort_.accuracy * R(1.001) && part > R(good_step) && !(infeasibility_ > R(0));
    if (close || ++steps_ == effort_.steps) {
        return finish();
    }
    const R rest = R(1) - part;
    const R next = barrier_ * (gap_ / nominal_gap_) * larger(R(least_shrink), rest * rest);
    barrier_ = larger(effort_.accuracy, smaller(barrier_, next));
    begin_step();
    return Search::running;
}

// Whether what is left of the first excess is small at every node.
template <Floating R>
Search LegSolver<R>::finish() noexcept {
    for (std::size_t i = first_; i < cells_; ++i) {
        if (infeasibility_ * node_[i].excess > R(small_excess)) {
            return Search::none;
        }
    }
    return Search::found;
}

#define SPLINEFEED_INSTANTIATE(R) template class LegSolver<R>;
SPLINEFEED_EACH_JERK_REAL(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
