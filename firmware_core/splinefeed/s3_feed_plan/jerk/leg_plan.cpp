// SPDX-License-Identifier: MIT
//
// LegSolver keeps the limits at the nodes. Within the cells they are proved (cell_use.cpp): a cell that fails gets a
// smaller share of its limits, and the solver goes on from where it is, until every cell passes. So what is planned
// keeps every limit, whether the solver converged or not.
//
// A start from standstill begins with the envelopes of leg_guess.cpp. A start in motion leads from the plan in force
// over to them, late at first, and later yet where that fails.
#include "splinefeed/s3_feed_plan/jerk/leg_plan.hpp"

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/scalar.hpp"
#include "splinefeed/s3_feed_plan/jerk/cell_use.hpp"
#include "splinefeed/s3_feed_plan/jerk/leg_guess.hpp"

#include <iterator>

namespace splinefeed {

namespace {

constexpr int steps_of_a_leg = 40;
constexpr int steps_again = 6; // after a change of the shares
constexpr int most_passes = 6;
// Accuracies. In float, for small processors, a plan takes 0.2 % longer, and a third less of work.
template <Floating R>
constexpr double rough = std::same_as<R, double> ? 3e-3 : 4e-3;
template <Floating R>
constexpr double fine = std::same_as<R, double> ? 3e-4 : 2e-3;
constexpr double from_rest = 0.1;
constexpr double in_motion = 0.02;
constexpr double margin = 0.1;
constexpr double margin_again = 0.001;
template <Floating R> // of a limit: the first time less is asked for already here
constexpr double almost = std::same_as<R, double> ? 0.9995 : 0.998;
constexpr double per_excess = 1.5; // by how much the share is reduced
template <Floating R>              // and this at least
constexpr double at_least = std::same_as<R, double> ? 0.0005 : 0.002;
constexpr double most_fall = 0.97; // to the use at the ends, at once
constexpr double most_use = 1.25;  // a larger one comes from the bounds and falls faster
// Of a limit, as it is computed: in float, terms of opposite signs leave some 1e-5 of it.
template <Floating R>
constexpr double proved = std::same_as<R, double> ? 1.0 : 0.9999;
constexpr double leads[] = {0.3, 0.6, 0.85};
constexpr double lead_to_brake = 0.0;
constexpr double most_slowing = 4.0;       // use of a limit, as it is counted
constexpr double margin_of_slowing = 0.95; // of b
constexpr double slower = 16.0; // than expected: the square of the speed that a motion begins with which is to brake
constexpr int most_scalings = 12;
constexpr double of_spread = 0.8; // of the jerk limit: what a cell's distance from the curve may take

// What a cell's third derivative is off by takes J = spread b^(3/2). A smaller share of the limit does not lower the b
// at which nothing is left of it, so a cap does.
template <Floating R>
R spread_cap(const JerkCell<R>& cell, R cap_sq) noexcept {
    const R faster = cap_sq * detail::hardware_square_root(cap_sq);
    R most{};
    for (const unsigned k : indices(cell.limits.axes)) {
        const R spread = larger(cell.end[0][k].third_spread, cell.end[1][k].third_spread);
        most = larger(most, spread / cell.limits.jerk_mm_s3[k]);
    }
    return most * faster > R(of_spread) ? power_two_thirds(R(of_spread) / most) : cap_sq;
}

} // namespace

template <Floating R>
void LegPlan<R>::begin(const SpeedState& start) noexcept {
    cells_ = known_ = 0;
    rests_ = !(start.b > 0.0);
    start_ = start;
    LegNode<R>& node = nodes_[0];
    node = {};
    node.b = static_cast<R>(start.b);
    node.slope = rests_ ? R(0) : static_cast<R>(start.slope);
}

template <Floating R>
void LegPlan<R>::add(const JerkCell<R>& cell, R at_most_sq) noexcept {
    const R cap_sq = spread_cap(cell, R(proved<R>) * cell.cap_sq);
    LegNode<R>& node = nodes_[cells_];
    LegNode<R>& next = nodes_[cells_ + 1];
    const bool first = cells_ == 0;
    node.length_mm = cell.length_mm;
    node.most_share = cell.share;
    node.cap_sq = first ? cap_sq : smaller(cap_sq, node.cap_sq);
    const bool stops = !(at_most_sq > R(0));
    node.likely_sq = first   ? (stops ? cap_sq : at_most_sq)
                     : stops ? node.likely_sq
                             : smaller(at_most_sq, node.likely_sq);
    next = {};
    next.cap_sq = cap_sq;
    next.likely_sq = stops ? node.likely_sq : at_most_sq;
    if (!first) {
        LegNode<R>& before = nodes_[cells_ - 1];
        before.cap_sq = smaller(before.cap_sq, cap_sq);
    }
    limits_ = cell.limits;
    for (const unsigned k : indices(limits_.axes)) {
        const AxisEnd<R>& from = cell.end[0][k];
        const AxisEnd<R>& to = cell.end[1][k];
        LegAxis<R>& here = node.axis[k];
        const R jump = first ? R(0) : absolute(from.second - here.second);
        const R last = first ? from.third : R(here.third[0]);
        here.first = from.first;
        here.second = from.second;
        here.third = Pair<R>{last, from.third};
        here.second_spread = Pair<R>{first ? R(0) : here.second_spread[0] + jump, from.second_spread};
        here.third_spread = Pair<R>{first ? R(0) : here.third_spread[0], from.third_spread};
        LegAxis<R>& there = next.axis[k];
        there.first = to.first;
        there.second = to.second;
        there.third = Pair<R>{to.third, to.third};
        there.second_spread = Pair<R>{to.second_spread, to.second_spread};
        there.third_spread = Pair<R>{to.third_spread, to.third_spread};
    }
    limit_middles(cell);
    if (first) {
        first_most_sq_ = rests_ ? cell.largest_from_rest(1) : R(0);
        node.middle_sq = rests_ ? R(0) : node.b + R(0.5) * node.slope * node.length_mm;
    }
    last_most_sq_ = cell.largest_from_rest(0);
    ++cells_;
}

// The velocities of the axes allow b up to a line in each cell. At a node b lies on the line from one middle to the
// next. So any line through what both cells allow at the node may bound the middles beside it; this one has the mean
// slope of both.
template <Floating R>
void LegPlan<R>::limit_middles(const JerkCell<R>& cell) noexcept {
    LegNode<R>& node = nodes_[cells_];
    const R entry = R(proved<R>) * cell.most_sq[0];
    const R exit = R(proved<R>) * cell.most_sq[1];
    const R slope = (exit - entry) / cell.length_mm;
    node.most_sq = R(0.5) * (entry + exit);
    if (cells_ > 0) {
        LegNode<R>& before = nodes_[cells_ - 1];
        const R at_node = smaller(entry, exit_most_sq_);
        const R steepest = at_node / larger(before.length_mm, cell.length_mm); // both stay above half of it
        const R mean = R(0.5) * (slope + most_slope_);
        const R half_slope = R(0.5) * larger(-steepest, smaller(mean, steepest));
        before.most_sq = smaller(before.most_sq, at_node - half_slope * before.length_mm);
        before.cap_sq = smaller(before.cap_sq, before.most_sq);
        node.most_sq = smaller(node.most_sq, at_node + half_slope * cell.length_mm);
    }
    node.cap_sq = smaller(node.cap_sq, node.most_sq);
    exit_most_sq_ = exit;
    most_slope_ = slope;
}

template <Floating R>
void LegPlan<R>::know(R middle_sq) noexcept {
    nodes_[cells_ - 1].known_sq = middle_sq;
    known_ = cells_;
}

template <Floating R>
void LegPlan<R>::limit(R most_sq) noexcept {
    for (std::size_t i = 0; i < cells_; ++i) {
        LegNode<R>& node = nodes_[i];
        const R in_force = i < known_ ? R(above_braking) * node.known_sq : R(0);
        node.cap_sq = smaller(node.cap_sq, larger(most_sq, in_force));
    }
}

template <Floating R>
void LegPlan<R>::begin_visit(Stage stage) noexcept {
    stage_ = stage;
    at_ = rests_ ? 1 : 0;
    proof_ = {};
}

// The end of the next cells.
template <Floating R>
std::size_t LegPlan<R>::visit_some() noexcept {
    at_ = smaller(at_ + most_proved, cells_ - 1);
    return at_;
}

// Of some cells more. Whether these were the last ones.
template <Floating R>
bool LegPlan<R>::prove(R from, bool tighten) noexcept {
    Proof& proof = proof_;
    // Behind a start in motion that uses all of a limit, the plan in force may be the only motion there is: nothing is
    // taken from its limits before it exceeds them.
    const std::size_t near_start = rests_ ? 0 : known_ / 4;
    for (std::size_t i = at_, end = visit_some(); i < end; ++i) {
        LegNode<R>& node = nodes_[i];
        const CellUse<R> use = cell_use(node, nodes_[i + 1], limits_);
        proof.most = larger(proof.most, larger(use.acceleration.most, use.jerk.most));
        proof.kept = proof.kept && (i == 0 || !(R(proved<R>) * node.middle_sq > node.cap_sq));
        // Where the use at the ends is less than their share, a smaller share changes nothing until it is less, too.
        const auto less = [&](R& share, const LimitUse<R>& used) {
            if (!(used.most <= (i < near_start ? R(proved<R>) : from))) {
                proof.kept = false;
                if (tighten) {
                    share = larger(smaller(share, used.ends), R(most_fall) * share) /
                            (R(1.0 + at_least<R>) + R(per_excess) * (smaller(used.most, R(most_use)) - R(1)));
                }
            }
        };
        less(node.acceleration_share, use.acceleration);
        less(node.jerk_share, use.jerk);
    }
    return visited();
}

template <Floating R>
void LegPlan<R>::join() noexcept {
    solver_ = LegSolver<R>(leg(), limits_, rests_);
    motion_ = LegMotion<R>(leg(), rests_);
    motion_.join(first_most_sq_, last_most_sq_);
}

template <Floating R>
void LegPlan<R>::guess(double lead) noexcept {
    for (LegNode<R>& node : leg()) {
        node.jerk_share = node.acceleration_share = node.most_share;
    }
    guess_leg<R>(leg(), limits_, rests_);
    if (!rests_ && known_ > 1) {
        lead_over<R>(leg(), known_, R(lead));
    }
    motion_.evaluate();
}

template <Floating R>
void LegPlan<R>::search() noexcept {
    join();
    stage_ = Stage::guess;
    lead_ = 0;
}

template <Floating R>
void LegPlan<R>::brake() noexcept {
    join();
    const auto scale = [this](R factor) {
        for (LegNode<R>& node : leg()) {
            node.likely_sq *= factor;
        }
    };
    scale(R(1.0 / slower)); // exact: a power of two
    guess(lead_to_brake);
    scale(R(slower));
    solver_.begin({steps_of_a_leg, R(from_rest), R(rough<R>), R(in_motion), false, nodes_[0].b});
    stage_ = Stage::brake;
}

template <Floating R>
void LegPlan<R>::cap(std::size_t i, R cap_sq) noexcept {
    LegNode<R>& node = nodes_[i];
    node.cap_sq =
        larger(smaller(R(proved<R>) * cap_sq, node.most_sq), smaller(node.cap_sq, R(above_braking) * node.middle_sq));
    node.known_sq = node.middle_sq;
    known_ = cells_;
}

// The jerk grows with the power 3/2 of b: so much slower, what exceeds a limit in its middle would keep it.
template <Floating R>
bool LegPlan<R>::slow_down() noexcept {
    const std::size_t near_start = rests_ ? 1 : 1 + known_ / 4;
    for (std::size_t i = larger(at_, near_start), end = larger(visit_some(), i); i < end; ++i) {
        LegNode<R>& node = nodes_[i];
        const CellUse<R> use = cell_use(node, nodes_[i + 1], limits_);
        const R most = smaller(larger(use.acceleration.most, use.jerk.most), R(most_slowing));
        if (most > R(proved<R>)) {
            node.cap_sq = smaller(node.cap_sq, R(margin_of_slowing) * node.middle_sq * power_two_thirds(R(1) / most));
        }
    }
    return visited();
}

// Another attempt, if there is one: where the limits were kept at the nodes, with less speed between them; where they
// were not, with another first motion.
template <Floating R>
Search LegPlan<R>::fail() noexcept {
    const bool solved = stage_ != Stage::first;
    begin_visit(solved ? Stage::slow_down : Stage::guess);
    if (++lead_ == std::size(leads) || (!solved && (rests_ || known_ < 2))) {
        return Search::none;
    }
    return Search::running;
}

template <Floating R>
Search LegPlan<R>::step() noexcept {
    switch (stage_) {
    case Stage::guess:
        SPLINEFEED_ASSERT(lead_ < std::size(leads));
        guess(leads[lead_]);
        solver_.begin({steps_of_a_leg, R(rests_ ? from_rest : in_motion), R(rough<R>), R(margin)});
        stage_ = Stage::first;
        return Search::running;
    case Stage::prove_first:
        if (!prove(R(almost<R>), true)) {
            return Search::running;
        }
        solver_.begin({steps_again, R(rough<R> * 0.6), R(fine<R>), R(margin_again), true});
        stage_ = Stage::again;
        passes_ = 0;
        return Search::running;
    case Stage::prove:
        if (!prove(R(proved<R>), true)) {
            return Search::running;
        }
        if (proof_.kept) {
            return Search::found;
        }
        solver_.begin({steps_again, R(fine<R> * 2.0), R(fine<R>), R(margin_again), true});
        stage_ = Stage::again;
        return ++passes_ == most_passes ? fail() : Search::running;
    case Stage::slow_down: stage_ = slow_down() ? Stage::guess : stage_; return Search::running;
    case Stage::brake: return solver_.step();
    case Stage::first:
    case Stage::again:
    case Stage::anew: break;
    }
    const Search solved = solver_.step();
    if (solved == Search::found) {
        motion_.settle(start_, true);
        begin_visit(stage_ == Stage::first ? Stage::prove_first : Stage::prove);
    } else if (solved == Search::none && stage_ == Stage::again) {
        solver_.begin({steps_of_a_leg, R(in_motion), R(fine<R>), R(margin_again)});
        stage_ = Stage::anew;
    } else if (solved == Search::none) {
        return fail();
    }
    return Search::running;
}

template <Floating R>
bool LegPlan<R>::fastest() noexcept {
    search();
    Search found = Search::running;
    while (found == Search::running) {
        found = step();
    }
    return found == Search::found;
}

// Scaled by kappa, the parts of the limits that a motion uses scale with kappa (acceleration) and kappa^(3/2).
template <Floating R>
bool LegPlan<R>::slow() noexcept {
    join();
    guess_leg<R>(leg(), limits_, rests_);
    R kappa = R(0.9);
    for (int i = 0; i < most_scalings; ++i) {
        for (LegNode<R>& node : leg()) {
            node.middle_sq *= kappa;
        }
        motion_.evaluate();
        motion_.settle(start_, false);
        begin_visit(Stage::prove);
        while (!prove(R(proved<R>), false)) {
        }
        if (proof_.kept) {
            return true;
        }
        kappa = R(0.99) * power_two_thirds(R(1) / smaller(proof_.most, R(1e4)));
    }
    return false;
}

#define SPLINEFEED_INSTANTIATE(R) template class LegPlan<R>;
SPLINEFEED_EACH_JERK_REAL(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
