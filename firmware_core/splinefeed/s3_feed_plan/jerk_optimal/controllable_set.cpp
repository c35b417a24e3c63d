// SPDX-License-Identifier: MIT
//
// In a cell of length L, b is a parabola with the Bezier points b0, m, b1: m = b0 + b0' L/2 = b1 - b1' L/2. A motion
// from one end to the other keeps m, and u = (b1' - b0') / L: in the coordinates (m, b') it is a shift of b'.
//
// The jerk limit at a point of the cell (jerk_cell.cpp) is | q' u/2 + 3/2 q'' b' + q''' b | <= J / sqrt(b). The right
// side is convex in b, so its tangent at an expected r lies below it: J (3/2 r^(-1/2) - 1/2 r^(-3/2) b) keeps the limit
// for every b. Let the second factor g = 1/2 r^(-3/2) be linear from one end to the other. Then the first, 3/2 (2
// g)^(1/3), is concave and lies above the line between its ends. So with linear g, and also linear a = 3/2 r^(-1/2),
//
//   | q' u/2 + 3/2 q'' b' + q''' b | + J g b <= J a
//
// keeps the limit all along the cell. With q' a cubic, q'' a parabola and q''' its derivative, both sides are cubics,
// and if their Bezier points satisfy the inequality, so do the polynomials. The acceleration, q' b'/2 + q'' b, has five
// Bezier points; the first and the last belong to the nodes (cut_to_node). All are linear in (m, b0', b1').
//
// An exit (m, b1') allows the values of b0' between the largest of some linear functions and the smallest of others. If
// no such b0' is left, the pair that is violated most gives a half-plane with which the exits are cut. The possible
// motions are a convex polyhedron in (m, b0', b1'). For every corner of the exits the two ends of its range of b0' are
// computed; the result is the hull of these points, in the order of m, which is a part of the projection.
#include "splinefeed/s3_feed_plan/jerk_optimal/controllable_set.hpp"

#include "splinefeed/number/scalar.hpp"
#include "splinefeed/s3_feed_plan/jerk_optimal/axis_points.hpp"

namespace splinefeed {

namespace {

constexpr double negligible = 1e-9; // of a coefficient, compared with the other one
constexpr double rounding = 1e-12;  // of a bound, compared with the sum from which it comes
constexpr double third = 1.0 / 3.0;

constexpr std::size_t most_places = StatePolygon::capacity / 2;
using Chain = std::array<SpeedState, most_places>;

// Appends a state to a chain of corners, from left to right, that bends to one side. sign: 1 to the left
void append_to_chain(Chain& chain, std::size_t& n, const SpeedState& state, double sign) noexcept {
    if (n > 0 && state.b <= chain[n - 1].b) {
        if (sign * (state.slope - chain[n - 1].slope) >= 0.0) {
            return;
        }
        --n;
    }
    const auto straight = [&] {
        const SpeedState& a = chain[n - 2];
        const SpeedState& b = chain[n - 1];
        return sign * ((b.b - a.b) * (state.slope - a.slope) - (b.slope - a.slope) * (state.b - a.b)) <= 0.0;
    };
    while (n > 1 && straight()) {
        --n;
    }
    chain[n++] = state;
}

// A linear function of the parabola.
struct Form {
    double middle = 0.0;
    double entry = 0.0;
    double exit = 0.0;
};

} // namespace

ControllableSet::ControllableSet(const CellPassage& passage, const ExpectedSpeeds& expected) noexcept
    : length_mm_(passage.cell->length_mm) {
    add_jerk(passage, expected);
    add_acceleration(passage);
}

// Bezier points of b as a cubic: b0, (b0 + 2 m) / 3, (2 m + b1) / 3, b1 with b0 = m - b0' L/2, b1 = m + b1' L/2.
void ControllableSet::add_jerk(const CellPassage& passage, const ExpectedSpeeds& expected) noexcept {
    const JerkCell& cell = *passage.cell;
    const double half = 0.5 * length_mm_;
    const double per_length = 1.0 / length_mm_;
    const double r0 = larger(expected.entry_sq, ExpectedSpeeds::smallest);
    const double r1 = larger(expected.exit_sq, ExpectedSpeeds::smallest);
    const double root0 = 1.0 / square_root(r0);
    const double root1 = 1.0 / square_root(r1);
    const double a0 = 1.5 * root0;
    const double a1 = 1.5 * root1;
    const double g0 = 0.5 * root0 / r0;
    const double g1 = 0.5 * root1 / r1;
    for (const unsigned k : indices(cell.axes)) {
        const AxisEnd& from = passage.entry()[k];
        const AxisEnd& to = passage.exit()[k];
        const AxisPoints q(from, to, passage.direction(), length_mm_, per_length);
        const double jerk = cell.jerk_mm_s3[k];
        // The factors of b0, m and b1 in the four Bezier points of a linear function times b.
        const auto times_b = [&](double f0, double f1) {
            const double f0_third = f0 * third;
            const double f1_third = f1 * third;
            return std::array<Form, 4>{Form{f0, -half * f0, 0.0},
                                       Form{2.0 * f0_third + f1_third, -half * f1_third, 0.0},
                                       Form{f0_third + 2.0 * f1_third, 0.0, half * f0_third}, Form{f1, 0.0, half * f1}};
        };
        const auto by_third = times_b(q.third[0], q.third[1]);
        const auto careful = times_b(from.third_spread + jerk * g0, to.third_spread + jerk * g1);
        const Form by_second[4] = {{0.0, 1.5 * q.second[0], 0.0},
                                   {0.0, q.second[1], 0.5 * q.second[0]},
                                   {0.0, 0.5 * q.second[2], q.second[1]},
                                   {0.0, 0.0, 1.5 * q.second[2]}};
        const double limit[4] = {jerk * a0, jerk * (2.0 * a0 + a1) * third, jerk * (a0 + 2.0 * a1) * third, jerk * a1};
        for (unsigned j = 0; j < 4; ++j) {
            const double by_u = 0.5 * per_length * q.first[j];
            const double entry = by_second[j].entry + by_third[j].entry - by_u;
            const double exit = by_second[j].exit + by_third[j].exit + by_u;
            const Form& more = careful[j];
            row_[rows_++] = {more.middle + by_third[j].middle, more.entry + entry, more.exit + exit, limit[j]};
            row_[rows_++] = {more.middle - by_third[j].middle, more.entry - entry, more.exit - exit, limit[j]};
        }
    }
}

void ControllableSet::add_acceleration(const CellPassage& passage) noexcept {
    const JerkCell& cell = *passage.cell;
    const double half = 0.5 * length_mm_;
    const double per_length = 1.0 / length_mm_;
    for (const unsigned k : indices(cell.axes)) {
        const AxisEnd& from = passage.entry()[k];
        const AxisEnd& to = passage.exit()[k];
        const AxisPoints q(from, to, passage.direction(), length_mm_, per_length);
        const double* p = q.second;
        const double error_bound = larger(from.second_spread, to.second_spread);
        // Factors of b0, m, b1, and of b0', b1'.
        const auto add = [&](double b0, double m, double b1, double entry, double exit, const Form& more) {
            const double middle = b0 + m + b1;
            entry -= half * b0;
            exit += half * b1;
            row_[rows_++] = {more.middle + middle, more.entry + entry, more.exit + exit,
                             smaller(from.most_forward, to.most_forward)};
            row_[rows_++] = {more.middle - middle, more.entry - entry, more.exit - exit,
                             smaller(from.most_backward, to.most_backward)};
        };
        add(0.5 * p[1], 0.5 * p[0], 0.0, 0.375 * q.first[1], 0.125 * q.first[0],
            {error_bound, -0.5 * half * error_bound, 0.0});
        add(p[2] / 6.0, 4.0 * p[1] / 6.0, p[0] / 6.0, 0.25 * q.first[2], 0.25 * q.first[1],
            {error_bound, -half * error_bound / 6.0, half * error_bound / 6.0});
        add(0.0, 0.5 * p[2], 0.5 * p[1], 0.125 * q.first[3], 0.375 * q.first[2],
            {error_bound, 0.0, 0.5 * half * error_bound});
    }
}

// The line with the smallest slack at a state. sign: 1 for upper bounds, -1 for lower ones. With a good guess almost no
// branch is taken, so no comparison waits for the one before.
std::size_t ControllableSet::Lines::closest(const SpeedState& state, double sign, std::size_t guess) const noexcept {
    std::size_t best = guess;
    double least = sign * line[guess].at(state);
    for (std::size_t i = 0; i < size; ++i) {
        const double value = sign * line[i].at(state);
        if (value < least) [[unlikely]] {
            best = i;
            least = value;
        }
    }
    return best;
}

// Removes the lines that in the whole of a box lie beyond the one that is closest in its middle.
void ControllableSet::Lines::keep_what_matters(const SpeedState& center, const SpeedState& half, double sign) noexcept {
    const std::size_t first = closest(center, sign, 0);
    const Line best = line[first];
    line[first] = line[0];
    line[0] = best;
    std::size_t n = 1;
    for (std::size_t i = 1; i < size; ++i) {
        const Line difference{line[i].of_middle - best.of_middle, line[i].of_exit - best.of_exit,
                              line[i].constant - best.constant};
        if (sign * difference.at(center) <
            absolute(difference.of_middle) * half.b + absolute(difference.of_exit) * half.slope) {
            line[n++] = line[i];
        }
    }
    size = n;
}

// NOLINTNEXTLINE(readability-function-cognitive-complexity): one pass round the corners
StatePolygon ControllableSet::from(const StatePolygon& exits_of_b) const noexcept {
    const double half_length = 0.5 * length_mm_;
    StatePolygon exits; // (m, b')
    SpeedState least{largest<double>(), largest<double>()};
    SpeedState most_state{-largest<double>(), -largest<double>()};
    for (const SpeedState& corner : exits_of_b.corners()) {
        const SpeedState state{corner.b - half_length * corner.slope, corner.slope};
        exits.append(state);
        least = {smaller(least.b, state.b), smaller(least.slope, state.slope)};
        most_state = {larger(most_state.b, state.b), larger(most_state.slope, state.slope)};
    }
    const SpeedState center{0.5 * (least.b + most_state.b), 0.5 * (least.slope + most_state.slope)};
    const SpeedState half{0.5 * (most_state.b - least.b), 0.5 * (most_state.slope - least.slope)};

    Lines lows;
    Lines highs;
    for (std::size_t i = 0; i < rows_; ++i) {
        const Row& row = row_[i];
        if (absolute(row.entry) <= negligible * absolute(row.exit)) {
            exits.cut({row.middle, row.exit, row.limit});
            continue;
        }
        const double inverse = 1.0 / row.entry;
        Lines& lines = row.entry > 0.0 ? highs : lows;
        lines.line[lines.size++] = {-row.middle * inverse, -row.exit * inverse, row.limit * inverse};
    }
    if (exits.corners().size() > most_places) {
        exits.simplify();
    }
    lows.keep_what_matters(center, half, -1.0);
    highs.keep_what_matters(center, half, 1.0);

    std::array<std::size_t, StatePolygon::capacity> below;
    std::array<std::size_t, StatePolygon::capacity> above;
    for (std::size_t i = 0; i < exits.corners().size();) {
        const SpeedState state = exits.corners()[i];
        below[i] = lows.closest(state, -1.0, i > 0 ? below[i - 1] : 0);
        above[i] = highs.closest(state, 1.0, i > 0 ? above[i - 1] : 0);
        const Line& low = lows.line[below[i]];
        const Line& high = highs.line[above[i]];
        const StateBound cut{low.of_middle - high.of_middle, low.of_exit - high.of_exit, high.constant - low.constant};
        if (cut.excess(state) > rounding * (low.size_at(state) + high.size_at(state))) {
            // Corners before this one are inside and stay where they are.
            i = exits.cut(cut) == i ? i : 0;
            if (exits.corners().size() > most_places) {
                exits.simplify();
                i = 0;
            }
            continue;
        }
        ++i;
    }

    // Around the exits: corners, and the places on a side where another line becomes active.
    const auto corners = exits.corners();
    std::array<SpeedState, most_places> place;
    std::array<double, most_places> low;
    std::array<double, most_places> high;
    std::size_t n = 0;
    const auto add = [&](const SpeedState& state, std::size_t lowest, std::size_t highest) {
        place[n] = state;
        low[n] = lows.line[lowest].at(state);
        high[n++] = highs.line[highest].at(state);
    };
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::size_t next = i + 1 < corners.size() ? i + 1 : 0;
        const SpeedState& from = corners[i];
        const SpeedState& to = corners[next];
        add(from, below[i], above[i]);
        const double at_low = crossing(lows.line[below[i]], lows.line[below[next]], from, to);
        const double at_high = crossing(highs.line[above[i]], highs.line[above[next]], from, to);
        for (const double share : {smaller(at_low, at_high), larger(at_low, at_high)}) {
            if (share < 1.0 && n + corners.size() - i < most_places) {
                const SpeedState state{from.b + share * (to.b - from.b), from.slope + share * (to.slope - from.slope)};
                add(state, lows.closest(state, -1.0, below[next]), highs.closest(state, 1.0, above[next]));
            }
        }
    }
    if (n == 0) {
        return exits;
    }

    // In the order of m: those of the lower and of the upper side in turn.
    const auto after = [&](std::size_t i) {
        return i + 1 < n ? i + 1 : 0;
    };
    const auto before = [&](std::size_t i) {
        return i > 0 ? i - 1 : n - 1;
    };
    std::size_t next = 0;
    for (std::size_t i = 1; i < n; ++i) {
        next = place[i].b < place[next].b ? i : next;
    }
    Chain bottom;
    Chain top;
    std::size_t bottoms = 0;
    std::size_t tops = 0;
    std::size_t lower = after(next);
    std::size_t upper = before(next);
    for (std::size_t i = 0; i < n; ++i) {
        append_to_chain(bottom, bottoms, {place[next].b, low[next]}, 1.0);
        append_to_chain(top, tops, {place[next].b, high[next]}, -1.0);
        if (place[lower].b < place[upper].b) {
            next = lower;
            lower = after(lower);
        } else {
            next = upper;
            upper = before(upper);
        }
    }
    StatePolygon entries;
    const auto append = [&](const SpeedState& state) {
        entries.append({state.b - half_length * state.slope, state.slope});
    };
    for (std::size_t i = 0; i < bottoms; ++i) {
        append(bottom[i]);
    }
    for (std::size_t i = tops; i-- > 0;) {
        const bool closed = (i + 1 == tops && !(top[i].slope > bottom[bottoms - 1].slope)) ||
                            (i == 0 && !(top[i].slope > bottom[0].slope));
        if (!closed) {
            append(top[i]);
        }
    }
    return entries;
}

CurvatureRange ControllableSet::range(const SpeedState& entry, const StatePolygon& exits) const noexcept {
    const double half_length = 0.5 * length_mm_;
    const double m = entry.b + half_length * entry.slope;
    auto low = -largest<double>();
    auto high = largest<double>();
    const auto bind = [&](double of_exit, double scale, double limit) {
        if (absolute(of_exit) <= negligible * scale) {
            return; // limits m alone, which the entry keeps
        }
        if (of_exit > 0.0 && of_exit * high > limit) {
            high = limit / of_exit;
        } else if (of_exit < 0.0 && of_exit * low > limit) {
            low = limit / of_exit;
        }
    };
    for (std::size_t i = 0; i < rows_; ++i) {
        const Row& row = row_[i];
        bind(row.exit, absolute(row.entry), row.limit - row.middle * m - row.entry * entry.slope);
    }
    std::array<StateBound, StatePolygon::capacity + 4> sides;
    const std::size_t n = exits.bounds(sides);
    for (std::size_t i = 0; i < n; ++i) {
        const double by_b = sides[i].of_b * half_length;
        bind(by_b + sides[i].of_slope, absolute(by_b) + absolute(sides[i].of_slope),
             sides[i].limit - sides[i].of_b * m);
    }
    const double per_length = 1.0 / length_mm_;
    return {(low - entry.slope) * per_length, (high - entry.slope) * per_length};
}

void cut_to_node(StatePolygon& states, const CellPassage& before, const CellPassage& after,
                 double at_most_sq) noexcept {
    const double before_cap = before.cell->cap_sq;
    const double after_cap = after.cell->cap_sq;
    const double per_before = 2.0 / before.cell->length_mm;
    const double per_after = 2.0 / after.cell->length_mm;
    // Most bounds hold in the whole of a box around the states.
    SpeedState least{largest<double>(), largest<double>()};
    SpeedState most_state{-largest<double>(), -largest<double>()};
    for (const SpeedState& corner : states.corners()) {
        least = {smaller(least.b, corner.b), smaller(least.slope, corner.slope)};
        most_state = {larger(most_state.b, corner.b), larger(most_state.slope, corner.slope)};
    }
    const auto cut = [&](const StateBound& bound) {
        const SpeedState farthest{bound.of_b > 0.0 ? most_state.b : least.b,
                                  bound.of_slope > 0.0 ? most_state.slope : least.slope};
        if (bound.excess(farthest) > 0.0) {
            states.cut(bound);
        }
    };
    cut({1.0, 0.0, smaller(at_most_sq, smaller(before_cap, after_cap))});
    cut({-1.0, 0.0, 0.0});
    // The middle control points of both parabolas, b - b' L/2 and b + b' L/2, are between 0 and the cells' caps.
    cut({-per_after, -1.0, 0.0});
    cut({-per_before, 1.0, 0.0});
    cut({per_after, 1.0, after_cap * per_after});
    cut({per_before, -1.0, before_cap * per_before});
    const double half = 0.5 * after.direction();
    for (const unsigned k : indices(after.cell->axes)) {
        const AxisEnd& left = before.exit()[k];
        const AxisEnd& right = after.entry()[k];
        const bool smooth = absolute(left.second - right.second) <= 1e-2 * left.second_spread &&
                            absolute(left.first - right.first) <= negligible;
        for (const AxisEnd* at : {&left, &right}) {
            if (smooth && at == &right) {
                continue;
            }
            cut({at->second_spread + at->second, half * at->first, at->most_forward});
            cut({at->second_spread - at->second, -half * at->first, at->most_backward});
        }
    }
}

StatePolygon states_at(const CellPassage& before, const CellPassage& after, double at_most_sq) noexcept {
    const double max_path_acceleration =
        2.0 * larger(before.cell->cap_sq / before.cell->length_mm, after.cell->cap_sq / after.cell->length_mm);
    StatePolygon states(smaller(at_most_sq, smaller(before.cell->cap_sq, after.cell->cap_sq)), max_path_acceleration);
    cut_to_node(states, before, after, at_most_sq);
    return states;
}

} // namespace splinefeed
