// SPDX-License-Identifier: MIT
//
// A change is a leg of its own (leg_plan.cpp), planned over pieces of the cells ahead. The pieces are short enough for
// the change of the speed, and next to the standstill they are graded like cells next to stops.
//
// First the motion that brakes as hard as it can is solved for, from the plan in force on. For a hold it tells the
// nearest place of a standstill: that of the node where b is so small that the rest of the way is shortest. The leg
// that is adopted is the fastest one to that place, or to a place a little farther away if there is none.
//
// For a lower speed, the caps of the cells are what is wanted, but not below that motion: so there is a leg. For a
// higher speed the caps are what is wanted.
#include "splinefeed/s3_feed_plan/jerk/jerk_change.hpp"

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/s2_arc_length/cell_part.hpp"

#include <iterator>

namespace splinefeed {

namespace {

constexpr double pieces = 8.0;              // in the braking distance, at least
constexpr double pieces_to_brake = 24.0;    // the same, for the motion that tells where a standstill is possible
constexpr double next_to_rest = 1.0 / 48.0; // of the longest piece
constexpr double part_before = 0.4;         // longest piece before the standstill, of the distance to it
constexpr double part_from_start = 0.6;     // longest piece after a start, of the distance from it
constexpr double sliver = 1e-3;             // of a piece: a shorter part is not split off
constexpr double longer = 1.25;             // pieces, if there is no room for all of them
constexpr double part_behind = 0.6;         // longest piece after the standstill, of the distance from it
constexpr double far_behind = 10.0;         // the same, for another attempt when the window has little room
constexpr double far = 2.5;                 // times the expected distance: so far braking is looked at
constexpr double slow_part = 0.04;          // of the square of the speed that is braked from, for that place
constexpr double left_to_brake = 2.0;       // times the speed's square that a node may have beside a standstill
constexpr double farther[] = {1.03, 1.06, 1.1, 1.2, 1.4, 1.8, 2.5, 4.0, 8.0}; // than the place that braking tells
constexpr double roomy = 1.5; // of what braking needs, if it need not be the least
constexpr int most_steps = 40;
constexpr double no_start_mm = 1e9; // before the machine, within reach

} // namespace

template <Scalar S, Floating R>
void JerkChange<S, R>::begin(double from, const SpeedState& state, std::size_t planned) noexcept {
    leg_.take();
    from_ = from;
    state_ = state;
    old_planned_ = planned;
    changed_ = 1;
    attempts_ = 0;
    const JerkNode<R>& front = window_->node(0);
    const R here_sq = static_cast<R>(state.b);
    along_ = window_->limits_of(0).move_limits(smaller(front.cap_sq, larger(here_sq, front.wanted_sq)));
    start_mm_ = state.slope > 0.0 ? 4.0 / 3.0 * state.b / state.slope : no_start_mm;
    known_mm_ = 0.0;
    for (std::size_t i = 0; i < window_->size(); ++i) {
        known_mm_ += to_double(window_->node(i).length_mm) * (i == 0 ? 1.0 - from : 1.0);
        if (window_->cell(i).stop_at_end) {
            break;
        }
    }
    const double v = square_root(state_.b);
    const double a = 0.5 * larger(state_.slope, 0.0);
    const double peak = v + 0.5 * a * a / along_.jerk_mm_s3; // the acceleration falls to zero first
    guess_mm_ = larger(ramp_mm(peak, 0.0) + v * a / along_.jerk_mm_s3, pieces * JerkWindow<S, R>::shortest_mm);
    rest_mm_ = guess_mm_;
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
    const double length = to_double(window_->node(cell).length_mm);
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
        const double length = to_double(window_->node(i + first).length_mm);
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
            if (at_mm < cuts.end_mm - least && at_mm + 1.5 * piece > cuts.end_mm) { // no short piece is left before it
                piece = at_mm + piece > cuts.end_mm ? cuts.end_mm - at_mm : 0.5 * (cuts.end_mm - at_mm);
            }
            piece = left - piece < larger(least, sliver * piece) ? left : piece;
            const double to = piece < left ? from + piece / length : 1.0;
            SPLINEFEED_ASSERT(to > from);
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
bool JerkChange<S, R>::fit(WorkBudget& work) noexcept {
    for (int step = 0; step < most_steps; ++step) {
        pieces_ = cells_ = 0;
        fits_ = step == 0;
        const std::size_t most = window_->longest_leg() + window_->size();
        each_piece(cuts_, 0, [&](std::size_t i, double, double, double) {
            ++pieces_;
            cells_ = i + 1;
            return pieces_ < most;
        });
        work.charge(static_cast<unsigned>(pieces_));
        if (pieces_ <= cells_ + window_->room() && pieces_ <= window_->longest_leg()) {
            return true;
        }
        cuts_.coarsest_mm *= longer;
        cuts_.finest_mm *= longer;
    }
    return false;
}

// Builds the leg to the end of the cuts. @param wanted  the caps are those that are wanted
template <Scalar S, Floating R>
bool JerkChange<S, R>::lay(WorkBudget& work, bool wanted) noexcept {
    if (!(cuts_.end_mm > 0.0) || !fit(work)) {
        return false;
    }
    const double least = least_mm(cuts_);
    bool known = true; // up to here the old plan has a motion
    leg_->begin(state_);
    each_piece(cuts_, 0, [&](std::size_t i, double from, double to, double at_mm) {
        if (at_mm >= cuts_.end_mm - least) {
            return false;
        }
        const JerkNode<R>& whole = window_->node(i);
        const Cell<S> part = part_of(window_->cell(i), CellInterval<S>{from_double<S>(from), from_double<S>(to)});
        leg_->add(window_->limits_of(part, wanted ? whole.wanted_sq : whole.cap_sq, whole.kept),
                  whole.at_most_sq + static_cast<R>(to) * (window_->node(i + 1).at_most_sq - whole.at_most_sq));
        known = known && knows(i);
        if (known) {
            const SpeedState state = known_state(i, from);
            leg_->know(static_cast<R>(state.b + 0.5 * state.slope * (to - from) * to_double(whole.length_mm)));
        }
        return true;
    });
    return leg_->cells() >= LegPlan<R>::fewest_cells;
}

// Splits the cells of the window, and gives them the motion of the leg.
template <Scalar S, Floating R>
void JerkChange<S, R>::adopt() noexcept {
    planned_ = leg_->cells();
    const std::size_t more = pieces_ - cells_;
    window_->open(0, more); // no piece comes after the present place of its cell
    Cell<S> whole;
    JerkNode<R> start;
    R at_end{};
    std::size_t n = 0;
    each_piece(cuts_, more, [&](std::size_t i, double from, double to, double) {
        if (n == 0 || from == 0.0) {
            whole = window_->cell(i + more);
            start = window_->node(i + more);
            at_end = window_->node(i + more + 1).at_most_sq;
        }
        window_->cell(n) = part_of(whole, CellInterval<S>{from_double<S>(from), from_double<S>(to)});
        JerkNode<R>& node = window_->node(n);
        node = start;
        node.length_mm = to_floating<R>(window_->cell(n).length_mm);
        node.cap_sq = rests_ || n < changed_ ? start.cap_sq : start.wanted_sq;
        node.at_most_sq = start.at_most_sq + static_cast<R>(from) * (at_end - start.at_most_sq);
        node.travel = Travel::curve;
        ++n;
        return true;
    });
    leg_->each_cell([&](std::size_t i, double b, double middle_sq) {
        window_->node(i).b = b;
        window_->node(i).middle_sq = middle_sq;
    });
    window_->node(planned_).b = 0.0;
    for (std::size_t i = n; i < window_->size() && !rests_; ++i) {
        window_->node(i).cap_sq = window_->node(i).wanted_sq;
    }
}

template <Scalar S, Floating R>
void JerkChange<S, R>::brake(WorkBudget& work) noexcept {
    if (lay(work, false)) {
        leg_->brake();
        stage_ = Stage::brake;
    } else if (rests_) {
        attempt_rest(work);
    } else {
        cancel();
    }
}

// Below the speed v = a^2 / (2 j) the last phase of a straight move leads to standstill, with b growing with s^(4/3).
template <Scalar S, Floating R>
double JerkChange<S, R>::nearest_rest_mm() const noexcept {
    const R slow = static_cast<R>(0.5 * along_.acceleration_mm_s2 * along_.acceleration_mm_s2 / along_.jerk_mm_s3);
    const R per = R(1) / power_two_thirds(static_cast<R>(4.5 * along_.jerk_mm_s3));
    auto nearest = largest<R>();
    R at_mm{};
    for (std::size_t i = 1; i + 1 < leg_->cells(); ++i) {
        at_mm += leg_->length_mm(i - 1);
        if (leg_->b(i) < larger(slow * slow, R(slow_part) * leg_->b(0))) {
            const R root = detail::hardware_square_root(R(left_to_brake) * leg_->b(i) * per);
            nearest = smaller(nearest, at_mm + root * detail::hardware_square_root(root));
        }
    }
    return nearest < largest<R>() ? static_cast<double>(nearest) : guess_mm_;
}

// Another place for a standstill. The machine starts again in the cells behind it, and later changes of the steering
// need short cells there. But a window that is small, or was split before, may not have room for these and for the
// cells in which it has to stop.
template <Scalar S, Floating R>
void JerkChange<S, R>::attempt_rest(WorkBudget& work) noexcept {
    for (; attempts_ < 2 * std::size(farther); ++attempts_) {
        const bool second = attempts_ % 2 == 1;
        const double end_mm = smaller(rest_mm_ * farther[attempts_ / 2], known_mm_);
        if ((second && fits_) || (attempts_ > 1 && !second && !(rest_mm_ * farther[attempts_ / 2 - 1] < known_mm_))) {
            continue;
        }
        const double longest = guess_mm_ / pieces;
        cuts_ = {end_mm, end_mm + guess_mm_, longest, larger(longest * next_to_rest, JerkWindow<S, R>::shortest_mm),
                 second ? far_behind : part_behind};
        if (lay(work, false)) {
            leg_->search();
            stage_ = Stage::attempt;
            ++attempts_;
            return;
        }
        fits_ = false;
    }
    cancel();
}

// First with the caps that are wanted, if the machine is not faster; then with a motion that brakes.
template <Scalar S, Floating R>
void JerkChange<S, R>::attempt_wanted(WorkBudget& work) noexcept {
    const double wanted_sq = to_double(window_->node(0).wanted_sq);
    const double v = square_root(state_.b);
    const double wanted = square_root(wanted_sq);
    const double ramp = ramp_mm(v, wanted);
    const double longest = larger(larger(ramp / pieces, sliver * known_mm_), JerkWindow<S, R>::shortest_mm);
    const double stop = roomy * ramp_mm(larger(v, wanted), 0.0);
    cuts_ = {smaller(ramp + stop, known_mm_), ramp, longest, longest, part_behind};
    ++attempts_;
    if (attempts_ == 1 && state_.b <= wanted_sq && lay(work, true)) {
        leg_->search();
        stage_ = Stage::attempt;
    } else if (attempts_ <= 2) {
        attempts_ = 2;
        brake(work);
    } else {
        cancel();
    }
}

// Caps that allow the motion that brakes. The cells in which it is faster than what is wanted belong to the change.
template <Scalar S, Floating R>
void JerkChange<S, R>::follow_braking() noexcept {
    changed_ = 1;
    std::size_t n = 0;
    R before{};
    R here{};
    const auto cap = [&](R next) { // of piece n - 1, between its neighbours
        changed_ = leg_->middle_sq(n - 1) > here ? n : changed_;
        leg_->cap(n - 1, smaller(smaller(before, here), next));
        before = here;
        here = next;
    };
    each_piece(cuts_, 0, [&](std::size_t i, double, double, double) {
        const R wanted_sq = window_->node(i).wanted_sq;
        if (n == 0) {
            before = here = wanted_sq;
        } else {
            cap(wanted_sq);
        }
        return ++n < leg_->cells();
    });
    cap(here);
    leg_->search();
    stage_ = Stage::attempt;
}

template <Scalar S, Floating R>
void JerkChange<S, R>::to_rest(WorkBudget& work) noexcept {
    rests_ = true;
    const double longest = larger(guess_mm_ / pieces_to_brake, JerkWindow<S, R>::shortest_mm);
    const double end_mm = smaller(far * guess_mm_, known_mm_);
    cuts_ = {end_mm, end_mm, longest, longest, part_behind};
    brake(work);
}

template <Scalar S, Floating R>
void JerkChange<S, R>::to_wanted(WorkBudget& work) noexcept {
    rests_ = false;
    attempt_wanted(work);
}

template <Scalar S, Floating R>
Search JerkChange<S, R>::search(WorkBudget& work) noexcept {
    while (running()) {
        if (!work.take(leg_->step_work())) {
            return Search::running;
        }
        const Search found = leg_->step();
        if (found == Search::running) {
            continue;
        }
        if (stage_ == Stage::brake) {
            if (!rests_ && found == Search::found) {
                follow_braking();
                continue;
            }
            rest_mm_ = rests_ && found == Search::found ? nearest_rest_mm() : guess_mm_;
        } else if (found == Search::found) {
            adopt();
            cancel();
            return Search::found;
        }
        const std::size_t before = attempts_;
        if (rests_) {
            attempt_rest(work);
        } else {
            attempt_wanted(work);
        }
        SPLINEFEED_ASSERT(attempts_ > before || !running());
    }
    return Search::none;
}

#define SPLINEFEED_INSTANTIATE(S, R) template class JerkChange<S, R>;
SPLINEFEED_EACH_JERK_PLAN(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
