// SPDX-License-Identifier: MIT
#include "splinefeed/s1_blended_path/chain_smoother.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"
#include "splinefeed/s1_blended_path/chain_fit.hpp"
#include "splinefeed/s1_blended_path/chain_smoothing.hpp"
#include "splinefeed/s1_blended_path/chain_state.hpp"

namespace splinefeed {

namespace {

constexpr std::uint64_t look_ahead = 64;
constexpr std::uint64_t smoothed_points = 16; // that a new point moves, but for the last three
constexpr std::uint64_t unsettled = 8;        // the last points of a chain that goes on: no quintic ends there
constexpr std::uint64_t fewest_lines = 3;     // of a chain

constexpr double shortest_line = 4e-4;  // 0.1 nm: a shorter line is none
constexpr double longest_line = 0x1p27; // 33 m, of a line and of a piece: half of what a move may be
constexpr double sharpest_turn = 0.684; // 2 sin(phi / 2) at 40 degrees
constexpr double most_bow = 12.0;       // h phi in tolerances: a bow of 1.5
constexpr double most_uneven = 12.0;    // longer line over the shorter one, unless h phi is below one tolerance

// Shares of the tolerance. The quintic is measured at places: between them it is at most 1/64 of a bow of 1.5 farther.
constexpr double whole_share = 0.96;
constexpr double edge = 0.48;     // at the ends of a chain: the other half is that of the joint
constexpr double of_joint = 0.03; // behind a quintic that took its whole share
constexpr double left_out = 0.25; // places nearer than this to the one before, or to the line past them, are left out
constexpr double rest = 0.75;

} // namespace

template <Scalar S>
bool ChainSmoother<S>::has_room() const noexcept {
    return !has_pending_ && (kind_ != Kind::chain || (!closed_ && points_.last() - front_ < look_ahead));
}

template <Scalar S>
void ChainSmoother<S>::push(const PathElement<S>& element, std::uint32_t index) noexcept {
    if (left_out_ && !may_leave_out(element)) {
        restore();
    }
    if (kind_ == Kind::nothing) {
        begin(element, index, start_);
    } else if (kind_ == Kind::chain && !closed_ && goes_on(element)) {
        append(element, index);
    } else {
        pending_ = {element, index};
        has_pending_ = true;
        if (kind_ == Kind::chain) {
            close();
        }
    }
    start_ = element.to;
}

// The line from the last point of the chain to a place.
template <Scalar S>
S ChainSmoother<S>::length_to(const PerAxis<Position>& place, PerAxis<S>& direction) const noexcept {
    const PerAxis<Position>& from = points_[points_.last()].place;
    for (const unsigned k : indices(points_.axes())) {
        direction[k] = distance<S>(from[k], place[k], chord_unit_log2);
    }
    const S length = norm(direction, points_.axes());
    if (length > literal<S>(shortest_line)) {
        for (const unsigned k : indices(points_.axes())) {
            direction[k] = direction[k] / length;
        }
    }
    return length;
}

template <Scalar S>
void ChainSmoother<S>::begin(const PathElement<S>& element, std::uint32_t index,
                             const PerAxis<Position>& from) noexcept {
    points_.start(from);
    front_ = 0;
    closed_ = left_out_ = false;
    tolerance_ = tolerance_of(element);
    spare_ = scale2(element.tolerance_mm, -chord_unit_log2) - tolerance_;
    PerAxis<S> direction{};
    const S length = length_to(element.to, direction);
    if (element.shape != MoveShape::line || element.mode == PathMode::exact_stop || !(tolerance_ > S{}) ||
        !(length > literal<S>(shortest_line) && length < literal<S>(longest_line))) {
        kind_ = Kind::single;
        kept_ = {element, index};
        return;
    }
    kind_ = Kind::chain;
    end_ = element;
    end_index_ = index;
    add_point(element.to, index);
}

template <Scalar S>
void ChainSmoother<S>::begin_pending(const PerAxis<Position>& from) noexcept {
    kind_ = Kind::nothing;
    if (has_pending_) {
        has_pending_ = false;
        begin(pending_.element, pending_.index, from);
    }
}

template <Scalar S>
bool ChainSmoother<S>::goes_on(const PathElement<S>& element) const noexcept {
    PerAxis<S> direction{};
    const S length = length_to(element.to, direction);
    if (element.shape != MoveShape::line || !end_.passes_end() || element.tolerance_mm != end_.tolerance_mm ||
        tolerance_of(element) != tolerance_ || !(length < literal<S>(longest_line))) {
        return false;
    }
    const S before = points_[points_.last()].chord;
    if (too_short(length) && !element.has_feed_of(end_)) {
        return false; // it would be left out, and its feed with it
    }
    if (too_short(length) && element.passes_end()) {
        return true;
    }
    const S longer = larger(length, before);
    for (const unsigned k : indices(points_.axes())) {
        direction[k] = direction[k] - direction_[k];
    }
    const S turn = norm(direction, points_.axes());
    if (turn > literal<S>(sharpest_turn) || (most_turn_ > S{} && turn > most_turn_)) {
        return false;
    }
    const S per_tolerance = quotient_or_max(longer, tolerance_); // the product of length and turn may leave the range
    const S bow = quotient_or_max(turn, quotient_or_max(from_integer<S>(1), per_tolerance));
    return bow <= literal<S>(most_bow) &&
           (longer <= literal<S>(most_uneven) * smaller(length, before) || bow < from_integer<S>(1));
}

// A line so short that its end may be no point of the chain: it is near the last point, or its direction is chance.
template <Scalar S>
bool ChainSmoother<S>::too_short(S length) const noexcept {
    return length < literal<S>(left_out) * tolerance_ ||
           literal<S>(most_uneven) * length < points_[points_.last()].chord;
}

// Whether the place that was left out is near enough to the line to the end of an element.
template <Scalar S>
bool ChainSmoother<S>::may_leave_out(const PathElement<S>& element) const noexcept {
    PerAxis<S> out{};
    const S far = length_to(end_.to, out);
    if (far < literal<S>(left_out) * tolerance_) {
        return true;
    }
    PerAxis<S> direction{};
    const S length = length_to(element.to, direction);
    for (const unsigned k : indices(points_.axes())) {
        out[k] = far * out[k];
    }
    const S along = larger(S{}, smaller(dot(out, direction, points_.axes()), length));
    for (const unsigned k : indices(points_.axes())) {
        out[k] = out[k] - along * direction[k];
    }
    return element.shape == MoveShape::line && element.has_feed_of(end_) && !too_short(length) &&
           norm(out, points_.axes()) < literal<S>(left_out) * tolerance_;
}

// The place that was left out becomes a point.
template <Scalar S>
void ChainSmoother<S>::restore() noexcept {
    left_out_ = false;
    points_[points_.last()].merged = merged_before_;
    add_point(end_.to, end_index_);
    smooth_newest();
}

template <Scalar S>
void ChainSmoother<S>::append(const PathElement<S>& element, std::uint32_t index) noexcept {
    PerAxis<S> direction{};
    const S length = length_to(element.to, direction);
    merged_before_ = left_out_ || points_[points_.last()].merged;
    left_out_ = length < literal<S>(left_out) * tolerance_ || (element.passes_end() && too_short(length));
    end_ = element;
    end_index_ = index;
    if (left_out_) {
        points_[points_.last()].merged = true;
        return;
    }
    add_point(element.to, index);
    smooth_newest();
}

// Alternating directions: what one point moves reaches the others from both sides.
template <Scalar S>
void ChainSmoother<S>::smooth_newest() noexcept {
    const std::uint64_t last = points_.last();
    if (last < fewest_lines + 1) {
        return;
    }
    const std::uint64_t high = last - 3;
    const std::uint64_t low = larger(front_ + 1, last < smoothed_points ? 1 : last + 1 - smoothed_points);
    for (std::uint64_t n = low; n <= high; ++n) {
        smooth_point(points_, last % 2 == 0 ? n : low + high - n);
    }
}

template <Scalar S>
void ChainSmoother<S>::add_point(const PerAxis<Position>& place, std::uint32_t index) noexcept {
    const bool beside = points_[points_.last()].merged;
    const S chord = length_to(place, direction_);
    ChainPoint<S>& point = points_.append();
    point.place = place;
    point.chord = chord;
    point.feed_mm_s = end_.feed_mm_s;
    point.max_feed_mm_s = end_.max_feed_mm_s;
    point.index = index;
    point.merged = beside;
    measure_last_point(points_, tolerance_);
}

// The chain ends: its last place is met exactly, and its last points are smoothed with what is known.
template <Scalar S>
void ChainSmoother<S>::close() noexcept {
    PerAxis<S> chord{};
    if (left_out_ && !(length_to(end_.to, chord) < literal<S>(left_out) * tolerance_)) {
        restore();
    }
    closed_ = true;
    const std::uint64_t last = points_.last();
    if (left_out_) {
        ChainPoint<S>& point = points_[last];
        point.place = end_.to;
        points_.programmed(last - 1, last, chord);
        point.chord = norm(chord, points_.axes());
        point.index = end_index_;
        measure_last_point(points_, tolerance_);
        left_out_ = false;
    }
    points_[last].moved = {};
    const std::uint64_t low = larger(front_ + 1, last < smoothed_points ? 1 : last + 1 - smoothed_points);
    for (std::uint64_t n = low; n < last; ++n) {
        smooth_point(points_, n);
    }
    for (std::uint64_t n = last; n-- > low;) {
        smooth_point(points_, n);
    }
}

// The last point that a quintic from the present one may end at.
template <Scalar S>
std::uint64_t ChainSmoother<S>::farthest() const noexcept {
    const std::uint64_t most = closed_ ? points_.last() : points_.last() - unsettled;
    const ChainPoint<S>& first = points_[front_ + 1];
    S way = first.chord;
    for (std::uint64_t i = front_ + 1; i < most; ++i) { // a feed ends where its line does
        const ChainPoint<S>& behind = points_[i + 1];
        way += behind.chord;
        if (!(way < literal<S>(longest_line)) || behind.feed_mm_s != first.feed_mm_s ||
            behind.max_feed_mm_s != first.max_feed_mm_s) {
            return i;
        }
    }
    return most;
}

template <Scalar S>
bool ChainSmoother<S>::merged(std::uint64_t to) const noexcept {
    for (std::uint64_t i = front_; i <= to; ++i) {
        if (points_[i].merged) {
            return true;
        }
    }
    return to < points_.last() && points_[to + 1].merged;
}

template <Scalar S>
S ChainSmoother<S>::limit_of(std::uint64_t to) const noexcept {
    const bool at_edge = front_ == points_.oldest() || (closed_ && to == points_.last());
    const S share = at_edge ? literal<S>(edge) : literal<S>(whole_share);
    return share * (merged(to) ? literal<S>(rest) * tolerance_ : tolerance_);
}

// The end of the longest quintic that is found by doubling and halving; front_ if there is none.
template <Scalar S>
std::uint64_t ChainSmoother<S>::longest_piece(PathState<S>& end, BezierShape<S>& shape, S& limit) noexcept {
    ChainFit<S> fit(points_, front_, state_);
    std::uint64_t good = front_;
    const auto try_to = [&](std::uint64_t to, S within) {
        if (!fit.reaches(to, within)) {
            return false;
        }
        good = to;
        end = fit.end_state();
        shape.degree = 5;
        shape.points = fit.quintic();
        limit = within;
        return true;
    };
    const std::uint64_t most = farthest();
    std::uint64_t bad = most + 1;
    std::uint64_t to = smaller(front_ + span_, most);
    while (to > good && to < bad) {
        if (try_to(to, limit_of(to))) {
            to = bad > most ? smaller(most, front_ + 2 * (to - front_)) : (good + bad) / 2;
            if (to == good || (bad <= most && 8 * (bad - good) <= good - front_)) {
                break;
            }
        } else {
            bad = to;
            to = good == front_ ? front_ + (bad - front_) / 2 : (good + bad) / 2;
            if (good > front_ && 8 * (bad - good) <= good - front_) {
                break;
            }
        }
    }
    if (good == front_) {
        const S share = merged(front_ + 1) ? literal<S>(whole_share * rest) : literal<S>(whole_share);
        static_cast<void>(try_to(front_ + 1, share * tolerance_));
    }
    return good;
}

// A line stays one.
template <Scalar S>
void ChainSmoother<S>::pass_line(PathElement<S>& out) noexcept {
    bool exact = true;
    for (const unsigned k : indices(points_.axes())) {
        exact = exact && !(absolute(points_[front_].moved[k]) > S{});
    }
    const S share = !exact ? literal<S>(of_joint) : merged(front_ + 1) ? literal<S>(rest) : from_integer<S>(1);
    out.tolerance_mm = scale2(share * tolerance_ + spare_, chord_unit_log2);
    ++front_;
    points_.cut(front_);
    out.to = points_[front_].place;
}

template <Scalar S>
bool ChainSmoother<S>::pass_piece(PathElement<S>& out) noexcept {
    const bool first = front_ == points_.oldest();
    if (first) {
        chain_state(points_, front_, state_);
    }
    PathState<S> end;
    S limit{};
    const std::uint64_t to = longest_piece(end, out.bezier, limit);
    if (to == front_) {
        return false;
    }
    out.shape = MoveShape::bezier;
    out.joined = !first;
    const S all = merged(to) ? literal<S>(rest) * tolerance_ : tolerance_;
    out.tolerance_mm = scale2(larger(all - limit, literal<S>(of_joint) * tolerance_) + spare_, chord_unit_log2);
    const bool ends = closed_ && to == points_.last();
    for (const unsigned k : indices(points_.axes())) {
        out.to[k] =
            ends ? points_[to].place[k] : displaced(points_[to].place[k], points_[to].moved[k], chord_unit_log2);
    }
    span_ = to - front_;
    chains_ += first ? 1U : 0U;
    front_ = to;
    state_ = end;
    return true;
}

template <Scalar S>
Pull ChainSmoother<S>::next(IndexedMove<S>& out) noexcept {
    if (kind_ == Kind::nothing) {
        return finished_ ? Pull::finished : Pull::starved;
    }
    if (kind_ == Kind::single) {
        out = kept_;
        begin_pending(out.element.to);
        return Pull::item;
    }
    if (!closed_) {
        if (finished_) {
            close();
        } else if (points_.last() - front_ < look_ahead) {
            if (end_.passes_end()) {
                return Pull::starved;
            }
            close(); // behind a stop nothing goes on
        }
    }
    const ChainPoint<S>& ahead = points_[front_ + 1];
    out.element = {};
    out.element.feed_mm_s = ahead.feed_mm_s;
    out.element.max_feed_mm_s = ahead.max_feed_mm_s;
    const bool few = closed_ && front_ == points_.oldest() && points_.last() - front_ < fewest_lines;
    if (few || !pass_piece(out.element)) {
        pass_line(out.element);
    }
    out.index = points_[front_].index;
    if (closed_ && front_ == points_.last()) {
        out.element.mode = end_.mode;
        out.element.stop_at_end = end_.stop_at_end;
        begin_pending(points_[front_].place);
    }
    return Pull::item;
}

#if SPLINEFEED_MAX_DEGREE >= 5
SPLINEFEED_INSTANTIATE_CLASS(ChainSmoother)
#endif

} // namespace splinefeed
