// SPDX-License-Identifier: MIT
#include "splinefeed/s1_blended_path/chain_smoother.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"
#include "splinefeed/s1_blended_path/chain_line.hpp"
#include "splinefeed/s1_blended_path/chain_smoothing.hpp"

namespace splinefeed {

namespace {

constexpr std::uint64_t smoothed_points = 16; // that a new point moves, but for the last three

constexpr double shortest_line = 4e-4;  // 0.1 nm: a shorter line is none
constexpr double sharpest_turn = 0.684; // 2 sin(phi / 2) at 40 degrees
constexpr double most_bow = 12.0;       // h phi in tolerances: a bow of 1.5
constexpr double most_uneven = 12.0;    // longer line over the shorter one, unless h phi is below one tolerance

// Share of the tolerance: places nearer than this to the one before, or to the line past them, are left out.
constexpr double left_out = 0.25;

} // namespace

template <Scalar S>
bool ChainSmoother<S>::has_room() const noexcept {
    return !has_pending_ && kind_ != Kind::closed && (kind_ != Kind::chain || points_.last() - front_ < look_ahead);
}

template <Scalar S>
void ChainSmoother<S>::push(const PathElement<S>& element, std::uint32_t index) noexcept {
    if (left_out_ && !may_leave_out(element)) {
        restore();
    }
    if (kind_ == Kind::nothing) {
        begin(element, index, start_);
    } else if (kind_ == Kind::chain && goes_on(element)) {
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
    left_out_ = false;
    straight_ = true;
    tolerance_ = tolerance_of(element);
    spare_ = scale2(element.tolerance_mm, -chord_unit_log2) - tolerance_;
    PerAxis<S> direction{};
    const S length = length_to(element.to, direction);
    if (element.shape != MoveShape::line || element.mode != PathMode::continuous || !(element.tolerance_mm > S{}) ||
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
    const bool rounds = tolerance_ > S{};
    if (element.shape != MoveShape::line || !end_.passes_end() || element.tolerance_mm != end_.tolerance_mm ||
        tolerance_of(element) != tolerance_ || !(length < literal<S>(longest_line)) ||
        (!rounds && !element.has_feed_of(end_))) {
        return false;
    }
    const S before = points_[points_.last()].chord;
    if (too_short(length) && !element.has_feed_of(end_)) {
        return false; // it would be left out, and its feed with it
    }
    const S longer = larger(length, before);
    for (const unsigned k : indices(points_.axes())) {
        direction[k] = direction[k] - direction_[k];
    }
    const S turn = norm(direction, points_.axes());
    if (turn * length < literal<S>(left_out) * tolerance_ && too_short(length) && element.passes_end()) {
        return true;
    }
    if (!rounds) { // one line, or none
        return turn * smaller(length, before) <= line_rounding(longer);
    }
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

// How far the place that was left out is off the line to the end of an element.
template <Scalar S>
S ChainSmoother<S>::off_left_out(const PathElement<S>& element) const noexcept {
    PerAxis<S> out{};
    PerAxis<S> direction{};
    const S far = length_to(end_.to, out);
    const S length = length_to(element.to, direction);
    for (const unsigned k : indices(points_.axes())) {
        out[k] = far * out[k];
    }
    const S along = larger(S{}, smaller(dot(out, direction, points_.axes()), length));
    for (const unsigned k : indices(points_.axes())) {
        out[k] = out[k] - along * direction[k];
    }
    return norm(out, points_.axes());
}

// Whether the place that was left out is near enough to the last point, or to the line to the end of an element.
template <Scalar S>
bool ChainSmoother<S>::may_leave_out(const PathElement<S>& element) const noexcept {
    PerAxis<S> out{};
    const S near = literal<S>(left_out) * tolerance_;
    return length_to(end_.to, out) < near || (element.shape == MoveShape::line && element.has_feed_of(end_) &&
                                              !too_short(length_to(element.to, out)) && off_left_out(element) < near);
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
    if (left_out_ && off_left_out(element) <= line_rounding(length)) { // it is on the path, so nothing is lost by it
        left_out_ = false;
        points_[points_.last()].merged = merged_before_;
    }
    merged_before_ = left_out_ || points_[points_.last()].merged;
    left_out_ =
        tolerance_ > S{} && (length < literal<S>(left_out) * tolerance_ || (element.passes_end() && too_short(length)));
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
    if (last < 4 || !(tolerance_ > S{})) {
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
    if (tolerance_ > S{}) {
        measure_last_point(points_, tolerance_);
    }
}

// The chain ends: its last place is met exactly, and its last points are smoothed with what is known.
template <Scalar S>
void ChainSmoother<S>::close() noexcept {
    PerAxis<S> chord{};
    if (left_out_ && !(length_to(end_.to, chord) < literal<S>(left_out) * tolerance_)) {
        restore();
    }
    kind_ = Kind::closed;
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
    if (!(tolerance_ > S{})) {
        return;
    }
    const std::uint64_t low = larger(front_ + 1, last < smoothed_points ? 1 : last + 1 - smoothed_points);
    for (std::uint64_t n = low; n < last; ++n) {
        smooth_point(points_, n);
    }
    for (std::uint64_t n = last; n-- > low;) {
        smooth_point(points_, n);
    }
}

#if SPLINEFEED_MAX_DEGREE >= 5
#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template bool ChainSmoother<S>::has_room() const noexcept;                                                         \
    template void ChainSmoother<S>::push(const PathElement<S>&, std::uint32_t) noexcept;                               \
    template void ChainSmoother<S>::begin_pending(const PerAxis<Position>&) noexcept;                                  \
    template void ChainSmoother<S>::close() noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE
#endif

} // namespace splinefeed
