// SPDX-License-Identifier: MIT
//
// A motion to standstill at a given place is a leg (jerk_leg.cpp), planned over pieces of the cells ahead. The pieces
// are short enough for the change of the speed, and next to the standstill they are graded like cells next to stops.
// The nearest place for which such a leg exists is found by bisection: if a stop is possible at a place, it is possible
// beyond it, with more room.
//
// For a lower speed, the caps of the cells change from some place on: the nearest one for which a leg exists. That leg
// ends at standstill, as far beyond that place as braking from the wanted speed takes, so that a leg exists for the
// rest of the path, too. Before that place the caps stay as they were. For a higher speed the place is where the
// machine is.
#include "splinefeed/s3_feed_plan/jerk/jerk_change.hpp"

#include "splinefeed/s2_arc_length/cell_part.hpp"

namespace splinefeed {

namespace {

constexpr double pieces = 8.0;              // in the braking distance, at least
constexpr double next_to_rest = 1.0 / 48.0; // of the longest piece
constexpr double part_before = 0.4;         // longest piece before the standstill, of the distance to it
constexpr double part_from_start = 0.6;     // longest piece after a start, of the distance from it
constexpr double sliver = 1e-3;             // of a piece: a shorter part is not split off
constexpr double longer = 1.25;             // pieces, if there is no room for all of them
constexpr double part_behind = 0.6;         // longest piece after the standstill, of the distance from it
constexpr double far_behind = 10.0;         // the same, for the second attempt when the window has little room
constexpr double late = 1.4;                // times the expected distance: the standstill is late
constexpr double close = 0.004;             // relative error of a distance that is close enough
constexpr double farther = 1.4;             // than a guess that was too near
constexpr double roomy = 1.5;               // of what braking needs, if it need not be the least
constexpr int most_steps = 40;

} // namespace

template <Scalar S, Floating R>
JerkChange<S, R>::JerkChange(JerkWindow<S, R>& window, double from, const SpeedState& state,
                             std::size_t planned) noexcept
    : window_(&window), leg_(window.leg()), from_(from), state_(state), old_planned_(planned),
      along_(window.limits_of(0).move_limits(
          smaller(window.node(0).cap_sq, larger(static_cast<R>(state.b), window.node(0).wanted_sq)))) {
    if (state.slope > 0.0) {
        start_mm_ = 4.0 / 3.0 * state.b / state.slope;
    }
    for (std::size_t i = 0; i < window.size(); ++i) {
        known_mm_ += to_double(window.node(i).length_mm) * (i == 0 ? 1.0 - from : 1.0);
        if (window.cell(i).stop_at_end) {
            break;
        }
    }
}

// The distance from one steady speed to another, with constant limits along the path.
template <Scalar S, Floating R>
double JerkChange<S, R>::ramp_mm(double from_mm_s, double to_mm_s) const noexcept {
    const double a = along_.acceleration_mm_s2;
    const double j = along_.jerk_mm_s3;
    const double change = absolute(from_mm_s - to_mm_s);
    const double seconds = change * j > a * a ? change / a + a / j : 2.0 * square_root(change / j);
    return 0.5 * (from_mm_s + to_mm_s) * seconds;
}

// Whether the old plan has a parabola in a cell.
template <Scalar S, Floating R>
bool JerkChange<S, R>::knows(std::size_t cell) const noexcept {
    return cell < old_planned_ && window_->node(cell).travel == Travel::curve &&
           (cell == 0 || window_->node(cell).b > 0.0) && window_->node(cell + 1).b > 0.0;
}

// The state on that parabola. The state at the start of the front cell is not that of its node, but the machine's is
// known.
template <Scalar S, Floating R>
SpeedState JerkChange<S, R>::known_state(std::size_t cell, double fraction) const noexcept {
    const double length = window_->node(cell).length_mm;
    const SpeedState end = window_->state(cell + 1);
    const double start = cell == 0 ? from_ : 0.0;
    const SpeedState from = cell == 0 ? state_ : window_->state(cell);
    const double s = (fraction - start) * length;
    const double u = (end.slope - from.slope) / ((1.0 - start) * length);
    return {from.b + (from.slope + 0.5 * u * s) * s, from.slope + u * s};
}

// Pieces are graded towards a standstill and away from it; after the finely split part up to the first long cells.
template <Scalar S, Floating R>
double JerkChange<S, R>::longest_piece(const Cuts& cuts, double at_mm) noexcept {
    const double part =
        at_mm < cuts.end_mm ? (cuts.end_mm - at_mm) * part_before : (at_mm - cuts.end_mm) * cuts.part_behind;
    if (at_mm < cuts.fine_mm - least_mm(cuts)) {
        return larger(cuts.finest_mm, smaller(cuts.coarsest_mm, part));
    }
    return cuts.graded() ? larger(cuts.finest_mm, part) : largest<double>();
}

// Whether a cell that begins there is split or planned.
template <Scalar S, Floating R>
bool JerkChange<S, R>::concerns(const Cuts& cuts, double at_mm, double length_mm) noexcept {
    return at_mm < larger(cuts.end_mm, cuts.fine_mm) - least_mm(cuts) ||
           (cuts.graded() && cuts.part_behind * (at_mm - cuts.end_mm) < length_mm);
}

// Pieces shorter than this are not split off.
template <Scalar S, Floating R>
double JerkChange<S, R>::least_mm(const Cuts& cuts) noexcept {
    return larger(sliver * cuts.finest_mm, 0.1 * JerkWindow<S, R>::shortest_mm);
}

// Calls visit(cell, from, to, at_mm) for every piece of the cells from the front on, as far as they are split or
// planned, until it returns false. Cell 0 is number `first` of the window.
template <Scalar S, Floating R>
template <class Visit>
void JerkChange<S, R>::each_piece(const Cuts& cuts, std::size_t first, Visit&& visit) const noexcept {
    const double least = least_mm(cuts);
    double at_mm = 0.0;
    for (std::size_t i = 0; i + first < window_->size(); ++i) {
        const double length = window_->node(i + first).length_mm;
        if (!concerns(cuts, at_mm, length)) {
            return;
        }
        double from = i == 0 ? from_ : 0.0;
        while (from < 1.0) {
            const double left = (1.0 - from) * length;
            // Next to a start, too, the speed changes over distances as short as the distance so far.
            const double longest =
                larger(cuts.finest_mm, smaller(longest_piece(cuts, at_mm), part_from_start * (start_mm_ + at_mm)));
            double piece = left <= longest ? left : left < 2.0 * longest ? 0.5 * left : longest;
            for (const double mark : {cuts.change_mm, cuts.end_mm}) {
                if (at_mm < mark - least && at_mm + 1.5 * piece > mark) { // no short piece is left before it
                    piece = at_mm + piece > mark ? mark - at_mm : 0.5 * (mark - at_mm);
                }
            }
            piece = left - piece < larger(least, sliver * piece) ? left : piece;
            const double to = piece < left ? from + piece / length : 1.0;
            if (!visit(i, from, to, at_mm)) {
                return;
            }
            at_mm += piece;
            from = to;
        }
    }
}

// Uses longer pieces if the window has too little room for all of them.
template <Scalar S, Floating R>
bool JerkChange<S, R>::fit(Cuts& cuts) noexcept {
    for (int step = 0; step < most_steps; ++step) {
        pieces_ = cells_ = 0;
        const std::size_t most = window_->longest_leg() + window_->size();
        each_piece(cuts, 0, [&](std::size_t i, double, double, double) {
            ++pieces_;
            cells_ = i + 1;
            return pieces_ < most;
        });
        if (pieces_ <= cells_ + window_->room() && pieces_ <= window_->longest_leg()) {
            return true;
        }
        cuts.coarsest_mm *= longer;
        cuts.finest_mm *= longer;
    }
    return false;
}

// Plans the leg to cuts.end_mm.
template <Scalar S, Floating R>
bool JerkChange<S, R>::attempt(const Cuts& cuts) noexcept {
    const double least = least_mm(cuts);
    std::size_t changed = 0;
    bool known = true; // up to here the old plan has a motion
    leg_.begin(state_);
    each_piece(cuts, 0, [&](std::size_t i, double from, double to, double at_mm) {
        if (at_mm >= cuts.end_mm - least) {
            return false;
        }
        const JerkNode<R>& whole = window_->node(i);
        const bool before = at_mm < cuts.change_mm - least;
        const R cap = before ? whole.cap_sq : whole.wanted_sq;
        const Cell<S> part = part_of(window_->cell(i), CellInterval<S>{from_double<S>(from), from_double<S>(to)});
        leg_.add(window_->limits_of(part, cap),
                 whole.at_most_sq + static_cast<R>(to) * (window_->node(i + 1).at_most_sq - whole.at_most_sq));
        known = known && knows(i);
        if (known) {
            const SpeedState state = known_state(i, from);
            leg_.know(static_cast<R>(state.b + 0.5 * state.slope * (to - from) * to_double(whole.length_mm)));
        }
        changed += before ? 1U : 0U;
        return true;
    });
    if (leg_.cells() < LegPlan<R>::fewest_cells || !leg_.fastest()) {
        return false;
    }
    seconds_ = leg_.seconds();
    planned_ = leg_.cells();
    changed_ = changed > 0 ? changed : 1;
    return true;
}

// Splits the cells of the window, and gives them the motion of the last attempt.
template <Scalar S, Floating R>
void JerkChange<S, R>::adopt(const Cuts& cuts) noexcept {
    const double least = least_mm(cuts);
    const std::size_t more = pieces_ - cells_;
    window_->open(0, more); // no piece comes after the present place of its cell
    Cell<S> whole;
    JerkNode<R> start;
    R at_end{};
    std::size_t n = 0;
    each_piece(cuts, more, [&](std::size_t i, double from, double to, double at_mm) {
        if (n == 0 || from == 0.0) {
            whole = window_->cell(i + more);
            start = window_->node(i + more);
            at_end = window_->node(i + more + 1).at_most_sq;
        }
        window_->cell(n) = part_of(whole, CellInterval<S>{from_double<S>(from), from_double<S>(to)});
        JerkNode<R>& node = window_->node(n);
        node = start;
        node.length_mm = to_floating<R>(window_->cell(n).length_mm);
        node.cap_sq = at_mm < cuts.change_mm - least ? start.cap_sq : start.wanted_sq;
        node.at_most_sq = start.at_most_sq + static_cast<R>(from) * (at_end - start.at_most_sq);
        node.travel = Travel::curve;
        ++n;
        return true;
    });
    leg_.each_cell([&](std::size_t i, double b, double middle_sq) {
        window_->node(i).b = b;
        window_->node(i).middle_sq = middle_sq;
    });
    window_->node(planned_).b = 0.0;
    for (std::size_t i = n; i < window_->size(); ++i) {
        JerkNode<R>& node = window_->node(i);
        node.cap_sq = cuts.change_mm < known_mm_ ? node.wanted_sq : node.cap_sq;
    }
}

// Finds the smallest distance for which a motion exists. 0: none.
template <Scalar S, Floating R>
template <class CutsAt>
double JerkChange<S, R>::nearest(double guess_mm, CutsAt&& cuts_at) noexcept {
    const auto possible_at = [&](double distance_mm) {
        Cuts cuts = cuts_at(distance_mm);
        return possible(cuts);
    };
    double low = 0.0;
    double high = smaller(guess_mm, known_mm_);
    while (!possible_at(high)) {
        if (!(high < known_mm_)) {
            return 0.0;
        }
        low = high;
        high = smaller(high * farther, known_mm_);
    }
    while (high - low > close * high) {
        const double middle = 0.5 * (low + high);
        (possible_at(middle) ? high : low) = middle;
    }
    // The nearest place leaves no room to brake as hard as possible: a place slightly farther away may be reached
    // sooner.
    double best = high;
    auto least_s = largest<double>();
    for (const double more : {1.0, 1.005, 1.01, 1.02, 1.04, 1.08}) {
        const double distance = smaller(high * more, known_mm_);
        if (possible_at(distance) && seconds_ < least_s) {
            least_s = seconds_;
            best = distance;
        }
    }
    return best;
}

// Plans the result of nearest() once more, and adopts it.
template <Scalar S, Floating R>
bool JerkChange<S, R>::take(Cuts cuts) noexcept {
    if (!(cuts.end_mm > 0.0) || !possible(cuts)) {
        return false;
    }
    adopt(cuts);
    return true;
}

template <Scalar S, Floating R>
bool JerkChange<S, R>::to_rest() noexcept {
    const double v = square_root(state_.b);
    const double a = 0.5 * larger(state_.slope, 0.0);
    const double peak = v + 0.5 * a * a / along_.jerk_mm_s3; // the acceleration falls to zero first
    const double guess = larger(ramp_mm(peak, 0.0) + v * a / along_.jerk_mm_s3, pieces * JerkWindow<S, R>::shortest_mm);
    const auto cuts_at = [&](double end_mm, double behind) {
        const double longest = guess / pieces;
        const double finest = larger(longest * next_to_rest, JerkWindow<S, R>::shortest_mm);
        return Cuts{end_mm, largest<double>(), end_mm + guess, longest, finest, behind};
    };
    const auto nearest_rest = [&](double behind) {
        return nearest(guess, [&](double end_mm) { return cuts_at(end_mm, behind); });
    };
    // The machine starts again in the cells after the standstill, and later changes of the steering need short cells
    // there. But a window that is small, or was split before, may not have room for these and for the cells in which it
    // has to stop.
    const double rest_mm = nearest_rest(part_behind);
    if (!(rest_mm > 0.0) || rest_mm > late * guess) {
        const double nearer_mm = nearest_rest(far_behind);
        if (nearer_mm > 0.0 && (!(rest_mm > 0.0) || nearer_mm < rest_mm)) {
            return take(cuts_at(nearer_mm, far_behind));
        }
    }
    return rest_mm > 0.0 && take(cuts_at(rest_mm, part_behind));
}

template <Scalar S, Floating R>
bool JerkChange<S, R>::to_wanted() noexcept {
    const double v = square_root(state_.b);
    const double wanted = square_root(window_->node(0).wanted_sq);
    const double ramp = ramp_mm(v, wanted);
    const double longest = larger(larger(ramp / pieces, sliver * known_mm_), JerkWindow<S, R>::shortest_mm);
    const double stop = roomy * ramp_mm(larger(v, wanted), 0.0);
    const auto cuts_at = [&](double change_mm) {
        return Cuts{
            smaller(change_mm + ramp + stop, known_mm_), change_mm, change_mm + ramp, longest, longest, part_behind};
    };
    if (take(cuts_at(0.0))) {
        return true;
    }
    const double change_mm = nearest(larger(ramp, longest), cuts_at);
    return change_mm > 0.0 && take(cuts_at(change_mm));
}

template class JerkChange<double, double>;
template class JerkChange<double, float>;
template class JerkChange<Fixed, double>;
template class JerkChange<Fixed, float>;

} // namespace splinefeed
