// SPDX-License-Identifier: MIT
#include "splinefeed/s1_blended_path/tolerance_path.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

namespace {

// Distances are peaks of parabolas through measured places, which are up to 2.4e-5 lower than the largest distance.
template <Scalar S>
constexpr S inside(S tolerance_mm) noexcept {
    return tolerance_mm - scale2(tolerance_mm, -14);
}

// Of the path. Directions of a cell tell this share to five digits. feed_share() decides at a smaller one, so it never
// decides otherwise than here.
constexpr int least_share_log2 = -12;

} // namespace

template <Scalar S>
Status TolerancePath<S>::start(const PerAxis<Position>& position) noexcept {
    const Status status = blended_.start(position);
    if (status.ok()) {
        last_ = position;
        chains_.start(position);
    }
    return status;
}

// Where the linear axes move by a tiny part of a line, their feed is that part of the feed along the path. From the
// ends of the move it is known to more digits than from its cells.
template <Scalar S>
void TolerancePath<S>::feed_along_path(PathElement<S>& element) const noexcept {
    const PerAxis<S> all = distances<S>(last_, element.to, chord_unit_log2, axes_);
    const S counted = norm(each(axes_, [&](unsigned k) { return rotary_[k] ? S{} : all[k]; }), axes_);
    const S way = norm(all, axes_);
    element.feed_along_path = element.shape == MoveShape::line && counted > S{} && !(element.feed_mm_s < S{}) &&
                              counted < scale2(way, least_share_log2);
    if (element.feed_along_path) {
        const S ratio = quotient_or_max(way, counted);
        for (S* const feed : {&element.feed_mm_s, &element.max_feed_mm_s}) {
            const S most = literal<S>(0x1p24); // faster than any machine
            *feed = *feed > quotient_or_max(most, ratio) ? most : *feed * ratio;
        }
        element.chain_tolerance_mm = S{}; // of a chain the share is another
    }
}

template <Scalar S>
Status TolerancePath<S>::push(const PathElement<S>& element) noexcept {
    if (finished_) {
        return Error::input_finished;
    }
    if (!has_room()) {
        return Error::no_room;
    }
    const Result<S> length = BlendedPath<S>::length_of(last_, element, axes_);
    if (!length.has_value()) {
        return length.error();
    }
    moves_ = moves_ || length.value() > S{};
    PathElement<S> kept = element;
    if (has_rotary_) { // else the linear part is the whole
        feed_along_path(kept);
    }
    last_ = element.to;
    kept.tolerance_mm = inside(element.tolerance_mm);
    kept.chain_tolerance_mm = inside(kept.chain_tolerance_mm);
    chains_.push(kept, static_cast<std::uint32_t>(counts_.moves++));
    while (pass_on()) {
    }
    return {};
}

template <Scalar S>
Status TolerancePath<S>::finish() noexcept {
    finished_ = true;
    chains_.finish();
    while (pass_on()) {
    }
    return moves_ ? Status{} : Error::too_few_waypoints;
}

// One move from the chains to the blends.
template <Scalar S>
bool TolerancePath<S>::pass_on() noexcept {
    if (!blended_.has_room()) {
        return false;
    }
    IndexedMove<S> move;
    switch (chains_.next(move, blended_.parts())) {
    case Pull::item: break;
    case Pull::finished: static_cast<void>(blended_.finish()); return false;
    default: return false;
    }
    Status status = blended_.push(move.element, move.index); // it was checked, and a piece of a chain is shorter
    if (!status.ok() && move.element.shape == MoveShape::arc) {
        // Its start has moved: what lay before it was too short to be a move. Only an arc of micrometres notices.
        move.element.shape = MoveShape::line;
        status = blended_.push(move.element, move.index);
    }
    SPLINEFEED_ASSERT(status.ok());
    static_cast<void>(status);
    return true;
}

template <Scalar S>
Pull TolerancePath<S>::next(CurveSegment<S>& out) noexcept {
    Pull pull = blended_.next(out);
    while (pull != Pull::item && pass_on()) {
        pull = blended_.next(out);
    }
    if (pull == Pull::starved && finished_) { // the last move was passed on
        static_cast<void>(pass_on());
        pull = blended_.next(out);
    }
    counts_.segments += pull == Pull::item ? 1U : 0U;
    return pull;
}

#if SPLINEFEED_MAX_DEGREE >= 5
SPLINEFEED_INSTANTIATE_CLASS(TolerancePath)
#endif

} // namespace splinefeed
