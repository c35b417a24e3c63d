// SPDX-License-Identifier: MIT
//
// Backward from the end, the sets of states from which it can be reached are computed (controllable_set.cpp). Then
// forward from the start, each cell takes the largest u that leads into the next set. This motion keeps every limit and
// has the fastest start, but it brakes for bends as late and as hard as possible and is slow after them. The same
// computation against the direction of travel gives the motion that is fast after bends and slow before them. Both are
// solutions of the same linear inequalities, so their mean is one, too. Time is a convex function of b: the mean is
// faster than either, usually by several per cent.
//
//       early:  steep rise, late and hard braking, slow after the bend
//     b |  .--.        .--.
//       | /    '.    .'    |
//       |/       '..'      |   late: the mirror image; the mean of both is symmetric where the path is
//       +--------------------> s
//
// The limit J / sqrt(b) is replaced by its tangent at the expected b (controllable_set.cpp). The result of a pass is
// the expected b of the next one; every pass keeps the limits.
#include "splinefeed/s3_feed_plan/jerk_optimal/jerk_leg.hpp"

#include "splinefeed/number/scalar.hpp"

#include <array>

namespace splinefeed {

namespace {

constexpr int most_passes = 2; // a third one gains 0.1 % and takes half as much time again
// Weights of the early motion in the mean, besides one half. They are closer together near the middle, where the
// fastest mean of a long leg lies. A mean costs a sum over the nodes, a pass thirty times that.
constexpr std::array<double, 8> other_shares{0.0, 0.3, 0.4, 0.45, 0.55, 0.6, 0.7, 1.0};
constexpr double least_gain = 0.002;    // of the time, for another pass
constexpr double least_expected = 0.05; // of at_most_sq: from a smaller value b would grow only threefold per pass
constexpr double slowest = 1e-4;        // of at_most_sq: away from standstill the motion is not slower
constexpr double least_last = 1e-2;     // of the largest b next to standstill: with less the last cell would take too
                                        // long
constexpr double empty_range = 1e-7;    // of u, by which a range may be empty

SpeedState rotated(const SpeedState& state) noexcept {
    return {state.b, -state.slope};
}

bool possible(const CurvatureRange& range, const SpeedState& state, double length_mm) noexcept {
    const double u = absolute(range.high) + (absolute(state.slope) + state.b / length_mm) / length_mm;
    return range.low <= range.high + empty_range * u;
}

SpeedState middle_of(const SpeedState& a, const SpeedState& b, double share_of_a) noexcept {
    return {b.b + share_of_a * (a.b - b.b), b.slope + share_of_a * (a.slope - b.slope)};
}

} // namespace

// Plans in the direction of travel, or against it: then nodes are counted from the end, and slopes have the opposite
// sign.
// NOLINTNEXTLINE(readability-function-cognitive-complexity): backward, then forward, with the same lambdas
bool JerkLeg::sweep(bool backward) noexcept {
    const std::size_t n = cells();
    const auto node = [&](std::size_t i) -> JerkNode& {
        return nodes_[backward ? n - i : i];
    };
    const auto cell = [&](std::size_t i) {
        return CellPassage{&nodes_[backward ? n - 1 - i : i].cell, backward};
    };
    const auto expected = [&](std::size_t i) {
        return ExpectedSpeeds{node(i).expected_sq, node(i + 1).expected_sq};
    };
    const auto keep = [&](std::size_t i, const StatePolygon& states) {
        node(i).corners = 0;
        for (const SpeedState& corner : states.corners()) {
            node(i).corner[node(i).corners++] = corner;
        }
        return !states.empty();
    };
    const auto kept = [&](std::size_t i) {
        return StatePolygon({node(i).corner.data(), node(i).corners});
    };

    CellPassage after = cell(n - 1);
    CellPassage before = cell(n - 2);
    StatePolygon states = states_at(before, after, node(n - 1).at_most_sq);
    if (backward && start_ != nullptr) { // it ends at the start, in motion: the states that can be reached from there
        StatePolygon turned_states;
        const auto corners = states.corners();
        for (std::size_t i = corners.size(); i-- > 0;) { // reversed, and so is the order of the corners
            turned_states.append(rotated(corners[i]));
        }
        if (turned_states.empty()) {
            return false;
        }
        turned_states.simplify();
        const JerkCell& first = nodes_[0].cell;
        const CurvatureRange range = ControllableSet({&first, false}, {nodes_[0].expected_sq, nodes_[1].expected_sq})
                                         .range(*start_, turned_states);
        // Two corners that almost coincide are not a line: its sides would have any direction.
        const double u =
            absolute(range.high) + (absolute(start_->slope) + start_->b / first.length_mm) / first.length_mm;
        if (!(range.high - range.low > empty_range * u)) {
            return false;
        }
        states.clear();
        states.append(rotated(travelled(*start_, range.low, first.length_mm)));
        states.append(rotated(travelled(*start_, range.high, first.length_mm)));
    } else {
        const double largest_b = smaller(after.cell->largest_from_rest(backward ? 1 : 0), node(n - 1).at_most_sq);
        const StatePolygon alone = states;
        states.clear();
        const double per_b = -4.0 / (3.0 * after.cell->length_mm);
        states.append({least_last * largest_b, least_last * largest_b * per_b});
        states.append({largest_b, largest_b * per_b});
        if (!alone.empty()) {
            std::array<StateBound, StatePolygon::capacity + 4> sides;
            const std::size_t count = alone.bounds(sides);
            for (std::size_t i = 0; i < count; ++i) {
                states.cut(sides[i]);
            }
        }
    }
    if (!keep(n - 1, states)) {
        return false;
    }
    for (std::size_t i = n - 1; i-- > 1;) {
        after = before;
        before = cell(i - 1);
        const ControllableSet reach(after, expected(i));
        const StatePolygon exits = states;
        states = reach.from(exits);
        cut_to_node(states, before, after, node(i).at_most_sq);
        // A speed of almost zero would take too long; it stays only if nothing else is possible.
        const StatePolygon slow = states;
        states.cut({-1.0, 0.0, -slowest * node(i).at_most_sq});
        states = states.empty() ? slow : states;
        states.simplify();
        if (!backward && i < known_) {
            // The earlier plan is possible, although simplification may have removed it from the set.
            const CurvatureRange range = reach.range(node(i).state, exits);
            if (possible(range, node(i).state, after.cell->length_mm) && states.corners().size() > 2) {
                states.include(node(i).state);
            }
        }
        if (!keep(i, states)) {
            return false;
        }
    }

    const auto write = [&](std::size_t i, const SpeedState& state) {
        (backward ? node(i).late : node(i).early) = backward ? rotated(state) : state;
    };
    SpeedState state{0.0, 0.0};
    std::size_t i = 0;
    if (!backward && start_ != nullptr) {
        state = *start_;
        write(0, state);
    } else { // from standstill, as far along its line as the next set reaches
        write(0, state);
        const JerkCell& first = *before.cell;
        double largest_b = smaller(first.largest_from_rest(backward ? 0 : 1), node(1).at_most_sq);
        double least_b = 0.0;
        const double slope = 4.0 / (3.0 * first.length_mm);
        std::array<StateBound, StatePolygon::capacity + 4> sides;
        const std::size_t count = kept(1).bounds(sides);
        for (std::size_t k = 0; k < count; ++k) {
            const double along = sides[k].of_b + sides[k].of_slope * slope;
            if (along > 0.0) {
                largest_b = smaller(largest_b, sides[k].limit / along);
            } else if (along < 0.0) {
                least_b = larger(least_b, (1.0 - empty_range) * sides[k].limit / along);
            }
        }
        state = {largest_b, slope * largest_b};
        if (!(largest_b > 0.0) || least_b > largest_b) {
            return false;
        }
        write(1, state);
        i = 1;
    }
    for (; i + 1 < n; ++i) {
        const CellPassage here = cell(i);
        const CurvatureRange range = ControllableSet(here, expected(i)).range(state, kept(i + 1));
        if (!possible(range, state, here.cell->length_mm)) {
            return false;
        }
        state = travelled(state, range.high, here.cell->length_mm);
        state.b = larger(state.b, 0.0);
        write(i + 1, state);
    }
    write(n, backward && start_ != nullptr ? rotated(*start_) : SpeedState{0.0, 0.0});
    return true;
}

// By Simpson's rule: used to compare motions.
template <class StateAt>
double JerkLeg::time(StateAt&& state_at) const noexcept {
    double sum = 0.0;
    const std::size_t n = cells();
    SpeedState from = state_at(nodes_[0]);
    const auto per_speed = [](double b) {
        return 1.0 / square_root(larger(b, ExpectedSpeeds::smallest));
    };
    double at_from = per_speed(from.b);
    for (std::size_t i = 0; i < n; ++i) {
        const SpeedState to = state_at(nodes_[i + 1]);
        const double at_to = per_speed(to.b);
        const double l = nodes_[i].cell.length_mm;
        if ((i == 0 && start_ == nullptr) || i + 1 == n) {
            sum += 3.0 * l * (i == 0 ? at_to : at_from);
        } else {
            const double middle = 0.5 * (from.b + to.b) + (from.slope - to.slope) * l * 0.125;
            sum += l * (at_from + 4.0 * per_speed(middle) + at_to) * (1.0 / 6.0);
        }
        from = to;
        at_from = at_to;
    }
    return sum;
}

double JerkLeg::mean_time(double share) const noexcept {
    return time([share](const JerkNode& node) { return middle_of(node.early, node.late, share); });
}

double JerkLeg::seconds() const noexcept {
    return time([](const JerkNode& node) { return node.state; });
}

bool JerkLeg::plan() noexcept {
    auto best_time = largest<double>();
    for (int pass = 0; pass < most_passes; ++pass) {
        if (!sweep(false)) {
            break;
        }
        const bool both = sweep(true); // the sets are reduced to few corners: one direction may have no motion left
        for (JerkNode& node : nodes_) {
            node.late = both ? node.late : node.early;
        }
        double share = 0.5;
        double shortest = mean_time(share);
        for (const double other : other_shares) {
            if (const double t = mean_time(other); t < shortest) {
                shortest = t;
                share = other;
            }
        }
        const bool best = shortest < best_time;
        const bool last = !(shortest < (1.0 - least_gain) * best_time);
        best_time = smaller(best_time, shortest);
        for (JerkNode& node : nodes_) {
            const SpeedState state = middle_of(node.early, node.late, share);
            if (best) {
                node.state = state;
            }
            node.expected_sq = larger(state.b, least_expected * node.at_most_sq);
        }
        if (last) {
            break;
        }
    }
    return best_time < largest<double>();
}

} // namespace splinefeed
