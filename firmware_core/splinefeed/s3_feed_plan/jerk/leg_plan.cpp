// SPDX-License-Identifier: MIT
//
// LegSolver keeps the limits at the nodes. Within the cells they are proved (cell_use.cpp): a cell that fails gets a
// smaller share of its limits, and the solver goes on from where it is, until every cell passes. So what is planned
// keeps every limit, whether the solver converged or not.
//
// A start from standstill begins with the envelopes of leg_guess.cpp. A start in motion leads from the plan in force
// over to them, late at first, and later yet where that fails.
#include "splinefeed/s3_feed_plan/jerk/leg_plan.hpp"

#include "splinefeed/number/scalar.hpp"
#include "splinefeed/s3_feed_plan/jerk/cell_use.hpp"
#include "splinefeed/s3_feed_plan/jerk/leg_guess.hpp"

#include <iterator>

namespace splinefeed {

namespace {

using R = LegPlan::R;
constexpr int steps_of_a_leg = 40;
constexpr int steps_again = 6; // after a change of the shares
constexpr int most_passes = 6;
constexpr R rough = 3e-3; // accuracies
constexpr R fine = 3e-4;
constexpr R from_rest = 0.1;
constexpr R in_motion = 0.02;
constexpr R margin = 0.1;
constexpr R margin_again = 0.001;
constexpr R almost = 0.9995;   // of a limit: the first time less is asked for already here
constexpr R per_excess = 1.5;  // by how much the share is reduced
constexpr R at_least = 0.0005; // and this at least
constexpr R most_use = 1.25;   // a larger one comes from the bounds and falls faster
constexpr R leads[] = {0.3, 0.6, 0.85};
constexpr int most_scalings = 12;

} // namespace

void LegPlan::begin(const SpeedState& start) noexcept {
    cells_ = known_ = 0;
    rests_ = !(start.b > 0.0);
    LegNode<R>& node = nodes_[0];
    node = {};
    node.b = start.b;
    node.slope = rests_ ? 0.0 : start.slope;
}

void LegPlan::add(const JerkCell& cell, R at_most_sq) noexcept {
    const R cap_sq = cell.cap_sq;
    LegNode<R>& node = nodes_[cells_];
    LegNode<R>& next = nodes_[cells_ + 1];
    const bool first = cells_ == 0;
    node.length_mm = cell.length_mm;
    node.cap_sq = first ? cap_sq : smaller(cap_sq, node.cap_sq);
    const bool stops = !(at_most_sq > 0.0);
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
    limits_.axes = static_cast<unsigned>(cell.axes);
    for (const unsigned k : indices(cell.axes)) {
        limits_.jerk_mm_s3[k] = cell.jerk_mm_s3[k];
        limits_.acceleration_mm_s2[k] = smaller(cell.end[0][k].most_forward, cell.end[0][k].most_backward);
        const AxisEnd& from = cell.end[0][k];
        const AxisEnd& to = cell.end[1][k];
        LegAxis<R>& here = node.axis[k];
        const R jump = first ? 0.0 : absolute(from.second - here.second);
        const R last = first ? from.third : R(here.third[0]);
        here.first = from.first;
        here.second = from.second;
        here.third = Pair<R>{last, from.third};
        here.second_spread = Pair<R>{first ? 0.0 : here.second_spread[0] + jump, from.second_spread};
        here.third_spread = Pair<R>{first ? 0.0 : here.third_spread[0], from.third_spread};
        LegAxis<R>& there = next.axis[k];
        there.first = to.first;
        there.second = to.second;
        there.third = Pair<R>{to.third, to.third};
        there.second_spread = Pair<R>{to.second_spread, to.second_spread};
        there.third_spread = Pair<R>{to.third_spread, to.third_spread};
    }
    if (first) {
        first_most_sq_ = rests_ ? cell.largest_from_rest(1) : 0.0;
        node.middle_sq = rests_ ? 0.0 : node.b + 0.5 * node.slope * node.length_mm;
    }
    last_most_sq_ = cell.largest_from_rest(0);
    ++cells_;
}

void LegPlan::know(R middle_sq) noexcept {
    nodes_[cells_ - 1].known_sq = middle_sq;
    known_ = cells_;
}

LegPlan::Proof LegPlan::prove(R from, bool tighten) noexcept {
    Proof proof;
    for (std::size_t i = rests_ ? 1 : 0; i + 1 < cells_; ++i) {
        LegNode<R>& node = nodes_[i];
        const CellUse<R> use = cell_use(node, nodes_[i + 1], limits_);
        proof.most = larger(proof.most, larger(use.acceleration, use.jerk));
        const auto less = [&](R& share, R used) {
            if (!(used <= from)) {
                proof.kept = false;
                share = tighten ? share / (1.0 + per_excess * (smaller(used, most_use) - 1.0) + at_least) : share;
            }
        };
        less(node.acceleration_share, use.acceleration);
        less(node.jerk_share, use.jerk);
    }
    return proof;
}

void LegPlan::join() noexcept {
    solver_ = LegSolver<R>(leg(), limits_, rests_);
    solver_.join(first_most_sq_, last_most_sq_);
}

void LegPlan::guess() noexcept {
    for (LegNode<R>& node : leg()) {
        node.jerk_share = node.acceleration_share = 1.0;
    }
    guess_leg<R>(leg(), limits_, rests_);
    if (!rests_ && known_ > 1) {
        lead_over<R>(leg(), known_, leads[lead_]);
    }
    solver_.begin({steps_of_a_leg, rests_ ? from_rest : in_motion, rough, margin});
}

void LegPlan::search() noexcept {
    join();
    stage_ = Stage::guess;
    lead_ = 0;
}

// Another attempt, if there is one.
Search LegPlan::fail() noexcept {
    stage_ = Stage::guess;
    return rests_ || known_ < 2 || ++lead_ == std::size(leads) ? Search::none : Search::running;
}

Search LegPlan::step() noexcept {
    switch (stage_) {
    case Stage::guess:
        guess();
        stage_ = Stage::first;
        return Search::running;
    case Stage::prove_first:
        prove(almost, true);
        solver_.begin({steps_again, rough * 0.6, fine, margin_again, true});
        stage_ = Stage::again;
        passes_ = 0;
        return Search::running;
    case Stage::prove:
        if (prove(1.0, true).kept) {
            seconds_ = solver_.seconds();
            return Search::found;
        }
        solver_.begin({steps_again, fine * 2.0, fine, margin_again, true});
        stage_ = Stage::again;
        return ++passes_ == most_passes ? fail() : Search::running;
    case Stage::first:
    case Stage::again:
    case Stage::anew: break;
    }
    const Search solved = solver_.step();
    if (solved == Search::found) {
        stage_ = stage_ == Stage::first ? Stage::prove_first : Stage::prove;
    } else if (solved == Search::none && stage_ == Stage::again) {
        solver_.begin({steps_of_a_leg, in_motion, fine, margin_again});
        stage_ = Stage::anew;
    } else if (solved == Search::none) {
        return fail();
    }
    return Search::running;
}

bool LegPlan::fastest() noexcept {
    search();
    Search found = Search::running;
    while (found == Search::running) {
        found = step();
    }
    return found == Search::found;
}

// Scaled by kappa, the parts of the limits that a motion uses scale with kappa (acceleration) and kappa^(3/2).
bool LegPlan::slow() noexcept {
    join();
    guess_leg<R>(leg(), limits_, rests_);
    R kappa = 0.9;
    for (int i = 0; i < most_scalings; ++i) {
        for (LegNode<R>& node : leg()) {
            node.middle_sq *= kappa;
        }
        solver_.evaluate();
        const Proof proof = prove(1.0, false);
        if (proof.kept) {
            seconds_ = solver_.seconds();
            return true;
        }
        kappa = 0.99 * power_two_thirds(1.0 / smaller(proof.most, 1e4));
    }
    return false;
}

} // namespace splinefeed
