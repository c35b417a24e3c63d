// SPDX-License-Identifier: MIT
#include "splinefeed/s1_blended_path/blended_path.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

namespace {

constexpr std::int64_t farthest_raw = std::int64_t{1} << (Position::fraction_bits + 20);
constexpr double most_tolerance_mm = 100.0;
constexpr double least_corner = 1e-4; // sin(phi/2): a smaller change of direction is none
constexpr double sliver = 0.25;       // 6e-5 mm: what is left of a move between two blends is more, or nothing

// What one end of a move gets of its length, where it and the other end wish so much.
template <Scalar S>
S share(S own, S other, S length) noexcept {
    return own + other <= length ? own : smaller(own, larger(scale2(length, -1), length - other));
}

// What a blend leaves of a move whose other end has none: where it meets the move it is off by 2^-32 of the length.
template <Scalar S>
S rest_of(const PathMove<S>& move) noexcept {
    return larger(literal<S>(sliver), scale2(move.length(), -7));
}

// How much longer a blend may be on a move than its way. On a line that changes neither direction nor curvature, and
// its deviation by 1e-4; on others the curvature, in the last digits.
template <Scalar S>
S absorbed(const PathMove<S>& move, S way) noexcept {
    return scale2(way, move.straight() ? -12 : -26);
}

template <Scalar S>
PerAxis<Position> offset_by(const PerAxis<Position>& from, const PerAxis<S>& offset, int axes) noexcept {
    PerAxis<Position> place{};
    for (const unsigned k : indices(axes)) {
        place[k] = displaced(from[k], offset[k], chord_unit_log2);
    }
    return place;
}

// De Casteljau's construction at 1/2: `points` becomes the first half, `rest` the second one.
template <Scalar S>
void halve(PerAxis<PerDegree<S>>& points, PerAxis<PerDegree<S>>& rest, int degree, int axes) noexcept {
    const auto n = static_cast<unsigned>(degree);
    for (const unsigned k : indices(axes)) {
        rest[k] = points[k];
        for (unsigned step = 1; step <= n; ++step) {
            for (unsigned i = 0; i + step <= n; ++i) {
                rest[k][i] = scale2(rest[k][i] + rest[k][i + 1], -1);
            }
            points[k][step] = rest[k][0];
        }
    }
}

} // namespace

template <Scalar S>
Status BlendedPath<S>::start(const PerAxis<Position>& position) noexcept {
    if (for_any(axes_, [&](unsigned k) { return position[k].raw > farthest_raw || position[k].raw < -farthest_raw; })) {
        return Error::position_out_of_range;
    }
    last_ = here_ = position;
    started_ = true;
    return {};
}

template <Scalar S>
Status BlendedPath<S>::measure(const PerAxis<Position>& from, const PathElement<S>& element, int axes,
                               PathMove<S>& out) noexcept {
    const PerAxis<Position>& to = element.to;
    if (for_any(axes, [&](unsigned k) { return to[k].raw > farthest_raw || to[k].raw < -farthest_raw; })) {
        return Error::position_out_of_range;
    }
    if (!(element.tolerance_mm >= S{} && element.tolerance_mm <= literal<S>(most_tolerance_mm)) ||
        !(element.chain_tolerance_mm >= S{})) {
        return Error::tolerance_out_of_range;
    }
    return out.set(from, element, axes);
}

template <Scalar S>
Result<S> BlendedPath<S>::length_of(const PerAxis<Position>& from, const PathElement<S>& element, int axes) noexcept {
    PathMove<S> move;
    if (const Status status = measure(from, element, axes, move); !status.ok()) {
        return status.error();
    }
    return move.length();
}

template <Scalar S>
Status BlendedPath<S>::push(const PathElement<S>& element, std::uint32_t index) noexcept {
    SPLINEFEED_ASSERT(started_);
    if (finished_) {
        return Error::input_finished;
    }
    if (!has_room()) {
        return Error::no_room;
    }
    PathMove<S> move;
    if (const Status status = measure(last_, element, axes_, move); !status.ok()) {
        return status;
    }
    const bool stops = element.stop_at_end || element.mode == PathMode::exact_stop;
    const S tolerance = scale2(element.tolerance_mm, -chord_unit_log2);
    if (!(move.length() > S{})) {
        if (known_ > 0) { // its joints become one with that of the move before it, which is off by what is left out
            Entry& before = entry(known_ - 1);
            const PerAxis<S> off = distances<S>(last_, element.to, chord_unit_log2, axes_);
            before.stop_at_end = before.stop_at_end || stops;
            before.tolerance_at_end = smaller(before.tolerance_at_end, tolerance);
            before.left_out = larger(before.left_out, norm(off, axes_));
            before.mode = before.mode < element.mode ? element.mode : before.mode;
        }
        return {};
    }
    Entry& fresh = entry(known_);
    fresh = {};
    fresh.move = move;
    fresh.tolerance = fresh.tolerance_at_end = tolerance;
    fresh.feed_mm_s = element.feed_mm_s;
    fresh.max_feed_mm_s = element.max_feed_mm_s;
    fresh.feed_along_path = element.feed_along_path;
    fresh.mode = element.mode;
    fresh.stop_at_end = stops;
    fresh.joined = element.joined;
    fresh.index = index;
    last_ = element.to;
    if (known_++ > 0) {
        decide(known_ - 2);
    }
    return {};
}

template <Scalar S>
Status BlendedPath<S>::finish() noexcept {
    finished_ = true;
    return known_ > 0 ? Status{} : Error::too_few_waypoints;
}

// What becomes of the joint of moves i and i + 1.
template <Scalar S>
void BlendedPath<S>::decide(std::uint64_t i) noexcept {
    Entry& before = entry(i);
    const Entry& after = entry(i + 1);
    if (before.stop_at_end) {
        return; // a joint is a stop by itself
    }
    if (after.joined) {
        before.joint.kind = JointKind::through;
        return;
    }
    const S tolerance = smaller(before.tolerance_at_end, after.tolerance) - before.left_out;
    before.joint =
        decide_joint(before.move, after.move, before.mode,
                     {larger(S{}, tolerance), joint_tolerance_, sharpest_, rounds_curvature_, smooth_, kink_}, axes_);
}

// What the joint at the end of move i wishes to take of the moves beside it.
template <Scalar S>
S BlendedPath<S>::wish(std::uint64_t i) const noexcept {
    const Joint<S>& joint = entry(i).joint;
    return joint.kind == JointKind::blend && i + 1 < known_ ? joint.way : S{};
}

// Decides the blend at the end of the present move. @pre the two moves behind it are known, or there is a stop before
// them, or the input has finished
template <Scalar S>
void BlendedPath<S>::fit_joint() noexcept {
    Entry& present = entry(next_);
    const PathMove<S>& move = present.move;
    after_ = S{};
    stops_ = present.joint.kind == JointKind::stop || next_ + 1 == known_;
    const S wished = wish(next_);
    if (wished > S{}) {
        const PathMove<S>& behind = entry(next_ + 1).move;
        const S before = before_ > S{} ? before_ : rest_of(move);
        const S here = smaller(share(wished, before_wish_, move.length()), move.length() - before);
        const S wished_behind = wish(next_ + 1);
        S there = share(wished, wished_behind, behind.length());
        if (!(wished_behind > literal<S>(sliver))) { // its end stays
            there = smaller(there, behind.length() - rest_of(behind));
        }
        S room = smaller(here, there);
        // Between two blends there is something like a move, or nothing: what rounding leaves goes to the blend behind.
        room = smaller(room, wished);
        const S left = move.length() - before_ - room;
        const S least = larger(literal<S>(sliver), scale2(room, -3));
        if (before_ > S{} && left < least && left > absorbed(move, room)) {
            room = room - (least - left);
        }
        if (fit_blend(present.joint, move, behind, room, axes_, blend_, roundest_)) {
            after_ = blend_.way;
        } else {
            stops_ = present.joint.half_sine > literal<S>(least_corner);
        }
    }
    before_wish_ = wished;
    ++(stops_ ? counts_.stopped : after_ > S{} ? counts_.blended : counts_.through);
    piece_ = 0;
    const bool nothing_left =
        after_ > S{} && before_ > S{} && move.length() - before_ - after_ <= absorbed(move, after_);
    pieces_ = nothing_left ? 0 : move.pieces(before_, after_);
    stage_ = pieces_ > 0 ? Stage::body : Stage::blend;
}

template <Scalar S>
void BlendedPath<S>::describe(const Entry& of, int degree, CurveSegment<S>& out) const noexcept {
    out.axes = axes_;
    out.degree = degree;
    out.feed_mm_s = of.feed_mm_s;
    out.max_feed_mm_s = of.max_feed_mm_s;
    out.feed_along_path = of.feed_along_path;
    out.stop_at_end = false;
    out.waypoint = entry(next_).index;
}

// The next segment of the move between its blends.
template <Scalar S>
void BlendedPath<S>::emit_body(CurveSegment<S>& out) noexcept {
    const Entry& present = entry(next_);
    bool last = ++piece_ == pieces_;
    PerAxis<PerDegree<S>> points{};
    PerAxis<Position> there{};
    int degree = 1;
    if (present.move.shape() == MoveShape::bezier) {
        degree = present.move.bezier_part(before_, after_, points);
        const PerAxis<S> end = control_at(points, static_cast<unsigned>(degree), axes_);
        there = after_ > S{} ? offset_by(present.move.from(), end, axes_) : present.move.to();
        place_ends(points, degree, there);
    } else {
        degree = piece_of(present.move, last, points, there);
    }
    describe(present, degree, out);
    if (present.move.shape() == MoveShape::line && pass_part<S>(parts_, here_, axes_, there, out.waypoint)) {
        ++counts_.through;
        --piece_;
        last = false;
        for (const unsigned k : indices(axes_)) {
            points[k][1] = distance<S>(here_[k], there[k], chord_unit_log2);
        }
    }
    out.origin = here_;
    out.end = there;
    out.assign(points);
    if (last) {
        stage_ = Stage::blend;
        if (!(after_ > S{})) {
            leave(out);
        }
    }
    here_ = there;
}

// A line, or one quintic of an arc: its points as offsets from here_, and its end. Returns its degree.
template <Scalar S>
int BlendedPath<S>::piece_of(const PathMove<S>& move, bool last, PerAxis<PerDegree<S>>& points,
                             PerAxis<Position>& there) const noexcept {
    PathState<S> from;
    PathState<S> to;
    if (last) {
        move.before_end(after_, to);
    } else {
        move.piece_end(before_, after_, piece_ - 1, pieces_, to);
    }
    there = last && !(after_ > S{}) ? move.to() : offset_by(last ? move.to() : move.from(), to.offset, axes_);
    for (const unsigned k : indices(axes_)) {
        from.offset[k] = S{};
        to.offset[k] = points[k][1] = distance<S>(here_[k], there[k], chord_unit_log2);
    }
    if (move.straight()) {
        return 1;
    }
    const PerAxis<S> end = to.offset;
    if (piece_ == 1) {
        move.behind_start(before_, from);
    } else {
        move.piece_end(before_, after_, piece_ - 2, pieces_, from);
    }
    from.offset = {};
    to.offset = end;
    const S length = move.piece_length(before_, after_, pieces_);
    const S way = before_ + length * from_integer<S>(piece_ - 1);
    quintic_between(from, to, move.handles(way, length, false), move.handles(way + length, length, true), axes_,
                    points);
    return 5;
}

// Makes offsets from the start of the present move to offsets from here_, with both ends where the path is: they were
// rounded to positions, at most 2^-41 mm away.
template <Scalar S>
void BlendedPath<S>::place_ends(PerAxis<PerDegree<S>>& points, int degree,
                                const PerAxis<Position>& there) const noexcept {
    const auto n = static_cast<unsigned>(degree);
    for (const unsigned k : indices(axes_)) {
        const S start = points[k][0];
        for (unsigned i = 0; i < n; ++i) {
            points[k][i] = points[k][i] - start;
        }
        points[k][n] = distance<S>(here_[k], there[k], chord_unit_log2);
    }
}

// The blend behind the present move, or its first half if the feeds differ; then the second half.
template <Scalar S>
void BlendedPath<S>::emit_blend(CurveSegment<S>& out) noexcept {
    const Entry& present = entry(next_);
    const Entry& behind = entry(next_ + 1);
    const PerAxis<Position>& vertex = present.move.to();
    const auto degree = static_cast<unsigned>(blend_.degree);
    PerAxis<PerDegree<S>> points = blend_.points;
    bool last = true;
    if (stage_ == Stage::blend) {
        for (const unsigned k : indices(axes_)) {
            points[k][0] = distance<S>(vertex[k], here_[k], chord_unit_log2);
        }
        if (present.feed_mm_s != behind.feed_mm_s || present.max_feed_mm_s != behind.max_feed_mm_s ||
            present.feed_along_path != behind.feed_along_path) {
            halve(points, blend_.points, blend_.degree, axes_);
            stage_ = Stage::second_half;
            last = false;
        }
    }
    describe(stage_ == Stage::second_half && last ? behind : present, blend_.degree, out);
    const PerAxis<S> end = control_at(points, degree, axes_);
    out.origin = vertex;
    here_ = out.end = offset_by(vertex, end, axes_);
    out.assign(points);
    if (last) {
        leave(out);
    }
}

// Goes on to the next move.
template <Scalar S>
void BlendedPath<S>::leave(CurveSegment<S>& out) noexcept {
    out.stop_at_end = stops_ && entry(next_).stop_at_end;
    parts_.pass_before(entry(next_).index);
    before_ = after_;
    ++next_;
    stage_ = Stage::joint;
}

template <Scalar S>
Pull BlendedPath<S>::next(CurveSegment<S>& out) noexcept {
    if (stage_ == Stage::joint) {
        if (next_ == known_) {
            return finished_ ? Pull::finished : Pull::starved;
        }
        // What comes behind a stop does not shape what comes before it.
        if (!finished_ && next_ + 2 >= known_ && !entry(known_ - 1).stop_at_end) {
            return Pull::starved;
        }
        fit_joint();
    }
    if (stage_ == Stage::body) {
        emit_body(out);
    } else {
        emit_blend(out);
    }
    return Pull::item;
}

#if SPLINEFEED_MAX_DEGREE >= 5
SPLINEFEED_INSTANTIATE_CLASS(BlendedPath)
#endif

} // namespace splinefeed
