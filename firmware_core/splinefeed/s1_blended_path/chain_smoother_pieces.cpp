// SPDX-License-Identifier: MIT
// What a ChainSmoother passes on: lines and quintics of the points that it knows.
#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"
#include "splinefeed/s1_blended_path/chain_fit.hpp"
#include "splinefeed/s1_blended_path/chain_line.hpp"
#include "splinefeed/s1_blended_path/chain_smoother.hpp"
#include "splinefeed/s1_blended_path/chain_state.hpp"

namespace splinefeed {

namespace {

constexpr std::uint64_t unsettled = 8;    // the last points of a chain that goes on: no quintic ends there
constexpr std::uint64_t fewest_lines = 3; // of a chain

// Shares of the tolerance. The quintic is measured at places: between them it is at most 1/64 of a bow of 1.5 farther.
constexpr double whole_share = 0.96;
constexpr double edge = 0.48;            // at the ends of a chain: the other half is that of the joint
constexpr double of_joint = 0.03;        // behind a quintic that took its whole share
constexpr double rest = 0.75;            // where places were left out
constexpr std::uint64_t most_parts = 32; // of a line
constexpr int straight_log2 = -4;        // points of one line are off by less

} // namespace

// The last point that a quintic from the present one may end at.
template <Scalar S>
std::uint64_t ChainSmoother<S>::farthest() const noexcept {
    const std::uint64_t most = kind_ == Kind::closed ? points_.last() : points_.last() - unsettled;
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
    const bool at_edge = front_ == points_.oldest() || (kind_ == Kind::closed && to == points_.last());
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

// Where all that is known is one line, it is passed on as one; half of it, where it is of many parts.
template <Scalar S>
bool ChainSmoother<S>::pass_straight(PathElement<S>& out, LineParts& parts) noexcept {
    const std::uint64_t last = points_.last();
    if (!straight_ || last == front_ + 1) {
        return false;
    }
    S off{};
    if (!is_line(points_, front_, last, scale2(tolerance_, straight_log2), off)) {
        return false;
    }
    const std::uint64_t to =
        smaller(last > front_ + most_parts ? front_ + smaller(most_parts, (last - front_ + 1) / 2) : last, farthest());
    if (!parts.has_room(static_cast<std::uint32_t>(to - front_ - 1), passed_)) {
        return false;
    }
    for (std::uint64_t i = front_ + 1; i < to; ++i) {
        parts.add({points_[i].place, points_[i].index, passed_});
    }
    const S kept = scale2(off, to < last ? 1 : 0);
    const S share = merged(to) ? literal<S>(rest) : from_integer<S>(1);
    out.tolerance_mm = scale2(share * tolerance_ - kept + spare_, chord_unit_log2);
    points_[to].moved = {};
    out.to = points_[to].place;
    points_.programmed(front_, to, state_.tangent);
    divide(state_.tangent, norm(state_.tangent, points_.axes()), points_.axes());
    state_.bend = {};
    front_ = to;
    return true;
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
    straight_ = false;
    const S all = merged(to) ? literal<S>(rest) * tolerance_ : tolerance_;
    out.tolerance_mm = scale2(larger(all - limit, literal<S>(of_joint) * tolerance_) + spare_, chord_unit_log2);
    const bool ends = kind_ == Kind::closed && to == points_.last();
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
Pull ChainSmoother<S>::next(IndexedMove<S>& out, LineParts& parts) noexcept {
    if (kind_ == Kind::nothing) {
        return finished_ ? Pull::finished : Pull::starved;
    }
    if (kind_ == Kind::single) {
        out = kept_;
        ++passed_;
        begin_pending(out.element.to);
        return Pull::item;
    }
    if (kind_ == Kind::chain && points_.last() - front_ < look_ahead) {
        if (!finished_ && end_.passes_end()) {
            return Pull::starved;
        }
        close(); // behind a stop nothing goes on
    }
    const ChainPoint<S>& ahead = points_[front_ + 1];
    out.element = {};
    out.element.feed_mm_s = ahead.feed_mm_s;
    out.element.max_feed_mm_s = ahead.max_feed_mm_s;
    out.element.feed_along_path = end_.feed_along_path; // then all of them have it, and no tolerance of a chain
    const bool few = kind_ == Kind::closed && front_ == points_.oldest() && points_.last() - front_ < fewest_lines;
    if (!pass_straight(out.element, parts) && (few || !(tolerance_ > S{}) || !pass_piece(out.element))) {
        pass_line(out.element);
    }
    ++passed_;
    out.index = points_[front_].index;
    if (kind_ == Kind::closed && front_ == points_.last()) {
        out.element.mode = end_.mode;
        out.element.stop_at_end = end_.stop_at_end;
        begin_pending(points_[front_].place);
    }
    return Pull::item;
}

#if SPLINEFEED_MAX_DEGREE >= 5
#define SPLINEFEED_INSTANTIATE(S) template Pull ChainSmoother<S>::next(IndexedMove<S>&, LineParts&) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE
#endif

} // namespace splinefeed
