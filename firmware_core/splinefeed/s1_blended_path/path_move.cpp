// SPDX-License-Identifier: MIT
//
// An arc with the frames (x, y) at one of its ends - x from the axis to the path, y along the path - is at an angle d
// from that end at r (x cos d + y sin d) from the axis. Near an end only the difference is computed,
//     r (-x versine(d) + y sin(d)),
// so its error is one of the way and not of the radius. Angle and radius are those of the whole arc at that way: where
// two blends meet in an arc, both have the same state, though its radii differ.
//
// A spiral is at r(w) x(w) + w H, with the way w, x from the axis to the path, y across it, R its mean radius. Angle
// and radius change evenly with w: x' = t y / R, y' = -t x / R, r' = g. So with a = t r / R
//     C' = g x + a y + H,   C'' = (t / R) (2 g y - a x),   |C'|' = C' C'' / |C'| = (t / R) g a / |C'|.
// The quintic over a way h has these at both ends: its error is h^6 |C| / 46080.
#include "splinefeed/s1_blended_path/path_move.hpp"

#include "splinefeed/number/angle.hpp"
#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

namespace {

// 0.1 um in units of 2^-40 mm: a shorter move is dropped, as waypoints that coincide are.
constexpr std::int64_t merge_raw = (std::int64_t{1} << Position::fraction_bits) / 10000;
constexpr std::int64_t longest_raw = std::int64_t{65536} << Position::fraction_bits;
constexpr double shortest_move = 4e-4;  // chord units, 0.1 nm
constexpr double longest_move = 0x1p28; // 65 m
constexpr double two_pi = 6.28318530717958647692;
constexpr double most_of_piece = 0.4; // [rad]
constexpr std::int32_t most_turns = 10000;
constexpr double least_growth = 0x1p-7; // 1.9e-6 mm: the quintics of a circle leave such a spiral by a fifth of it
constexpr double fine_radius = 23000.0; // 5.6 mm: quintics of 0.4 rad leave a spiral by 5e-7 mm
constexpr double first_share = 0.49;    // of an arc is seen from its start; blends that share it hardly meet just there

// Of the radius, for each unit of the chord: directions have so many digits.
template <Scalar S>
constexpr int growth_digits = std::same_as<S, float>    ? 20
                              : std::same_as<S, double> ? 48
                                                        : 28;

// floor(x) for 0 <= x < 2^20.
template <Scalar S>
int whole_part(S x) noexcept {
    int whole = 0;
    for (int bit = 1 << 19; bit > 0; bit >>= 1) {
        whole += from_integer<S>(whole + bit) <= x ? bit : 0;
    }
    return whole;
}

} // namespace

template <Scalar S>
Status PathMove<S>::set(const PerAxis<Position>& from, const PathElement<S>& element, int axes) noexcept {
    axes_ = axes;
    from_ = from;
    to_ = element.to;
    shape_ = element.shape;
    length_ = S{};
    bool moves = false;
    PerAxis<S> chord{};
    for (const unsigned k : indices(axes)) {
        const std::int64_t move = to_[k].raw - from[k].raw;
        if (move > longest_raw || move < -longest_raw) {
            return Error::move_too_long;
        }
        moves = moves || move >= merge_raw || move <= -merge_raw;
        chord[k] = distance<S>(from[k], to_[k], chord_unit_log2);
    }
    if (shape_ == MoveShape::arc) {
        return set_arc(element.arc);
    }
    if (shape_ == MoveShape::bezier) {
        return set_bezier(element.bezier, chord);
    }
    if (!moves) {
        return {};
    }
    length_ = longest_way_ = norm(chord, axes);
    divide(chord, length_, axes);
    along_ = chord;
    return {};
}

template <Scalar S>
Status PathMove<S>::set_bezier(const BezierShape<S>& bezier, const PerAxis<S>& to) noexcept {
    if (bezier.degree < 1 || bezier.degree > 5) {
        return Error::curve_invalid;
    }
    bezier_.set(bezier, to, axes_);
    const S length = bezier_.polygon();
    if (!(length > literal<S>(shortest_move))) {
        return {};
    }
    if (!(length < literal<S>(longest_move)) || !bezier_.has_directions()) {
        return Error::curve_invalid;
    }
    length_ = length;
    longest_way_ = scale2(length, -1);
    return {};
}

// Fills a frame at `place` and returns the radius there; 0 where the place lies on the axis.
template <Scalar S>
S PathMove<S>::frame_at(const PerAxis<Position>& place, const ArcShape<S>& arc, Frame& out) const noexcept {
    std::array<S, 3> arm{};
    for (unsigned k = 0; k < in_plane(); ++k) {
        arm[k] = distance<S>(arc.centre[k], place[k], chord_unit_log2);
    }
    subtract(arm, dot(arm, arc.normal, 3), arc.normal, 3);
    const S radius = norm(arm, 3);
    if (!(radius > S{})) {
        return radius;
    }
    divide(arm, radius, 3);
    out.radial = arm;
    const std::array<S, 3>& n = arc.normal;
    const std::array<S, 3>& x = out.radial;
    const bool clockwise = arc.sweep_rad < S{};
    for (unsigned k = 0; k < 3; ++k) {
        const unsigned i = (k + 1) % 3;
        const unsigned j = (k + 2) % 3;
        const S across = n[i] * x[j] - n[j] * x[i];
        out.along[k] = clockwise ? -across : across;
    }
    return radius;
}

template <Scalar S>
Status PathMove<S>::set_arc(const ArcShape<S>& arc) noexcept {
    for (unsigned k = 0; k < in_plane(); ++k) {
        for (const Position end : {from_[k], to_[k]}) {
            // Modulo 2^64: the centre may be anywhere, and no wrong difference is small, for the ends are checked.
            const auto arm = static_cast<std::int64_t>(static_cast<std::uint64_t>(arc.centre[k].raw) -
                                                       static_cast<std::uint64_t>(end.raw));
            if (arm > longest_raw || arm < -longest_raw) {
                return Error::move_too_long;
            }
        }
    }
    radius_start_ = frame_at(from_, arc, start_);
    radius_end_ = frame_at(to_, arc, end_);
    const S radius = scale2(radius_start_ + radius_end_, -1);
    // 0.1 um at least, and ends on one circle within 1/16 of its radius.
    if (!(radius > literal<S>(shortest_move)) || absolute(radius_start_ - radius_end_) > scale2(radius, -4)) {
        return Error::arc_invalid;
    }
    // The ends say where the arc ends, the sweep how many turns it makes.
    const S turn = literal<S>(two_pi);
    const S seen = angle_of(dot(start_.radial, end_.radial, 3), dot(start_.along, end_.radial, 3));
    const S asked = absolute(arc.sweep_rad);
    const S turns = (asked - seen) / turn + literal<S>(0.5);
    if (!(turns < from_integer<S>(most_turns))) {
        return Error::arc_invalid;
    }
    sweep_ = seen + turn * from_integer<S>(whole_part(larger(turns, S{})));
    if (!(sweep_ > S{})) {
        return Error::arc_invalid;
    }
    if (!(sweep_ < quotient_or_max(literal<S>(longest_move), radius))) {
        return Error::move_too_long;
    }
    std::array<S, 3> chord{};
    for (unsigned k = 0; k < in_plane(); ++k) {
        chord[k] = distance<S>(from_[k], to_[k], chord_unit_log2);
    }
    // Of large radii the difference has few digits. The difference of their squares is (b - a) (b + a).
    const S start_share = quotient_or_max(scale2(radius_start_, -1), radius);
    growth_ =
        start_share * dot(chord, start_.radial, 3) + (from_integer<S>(1) - start_share) * dot(chord, end_.radial, 3);
    spiral_ = absolute(growth_) > larger(literal<S>(least_growth), scale2(norm(chord, 3), -growth_digits<S>));
    PerAxis<S> rise{};
    S height{};
    for (unsigned k = 0; k < in_plane(); ++k) {
        height += chord[k] * arc.normal[k];
    }
    for (unsigned k = 0; k < in_plane(); ++k) {
        rise[k] = height * arc.normal[k];
    }
    for (unsigned k = 3; k < static_cast<unsigned>(smaller(axes_, max_axes)); ++k) {
        rise[k] = distance<S>(from_[k], to_[k], chord_unit_log2);
    }
    const std::array<S, 3> legs{radius * sweep_, norm(rise, axes_), growth_};
    length_ = norm(legs, spiral_ ? 3 : 2);
    in_plane_ = legs[0] / length_;
    divide(rise, length_, axes_);
    along_ = rise;
    longest_way_ = smaller(length_, scale2(smaller(radius_start_, radius_end_), -1));
    return {};
}

template <Scalar S>
typename PathMove<S>::Pace PathMove<S>::pace_at(S radius) const noexcept {
    const S around = in_plane_ * (radius / mean_radius());
    const std::array<S, 3> parts{growth_ / length_, around, norm(along_, axes_)};
    return {parts[0], around, norm(parts, 3)};
}

template <Scalar S>
void PathMove<S>::turned_outwards(const Frame& frame, S cosine, S sine, S radius, PathState<S>& out) const noexcept {
    const Pace pace = pace_at(radius);
    // t / R in units of 2^-bend_log2. The radius is above 1/8, for it changes by a sixteenth at most.
    const S turn = literal<S>(0x1p20) * in_plane_ / mean_radius();
    const S faster = pace.outwards * pace.around * turn / pace.speed;
    const S speed_sq = pace.speed * pace.speed;
    out.tangent = along_;
    for (unsigned k = 0; k < in_plane(); ++k) {
        const S radial = cosine * frame.radial[k] + sine * frame.along[k];
        const S across = cosine * frame.along[k] - sine * frame.radial[k];
        out.offset[k] = radius * radial;
        out.tangent[k] += pace.outwards * radial + pace.around * across;
        out.bend[k] = turn * (scale2(pace.outwards * across, 1) - pace.around * radial);
    }
    divide(out.tangent, pace.speed, axes_);
    add(out.bend, -faster, out.tangent, axes_);
    divide(out.bend, speed_sq, axes_);
}

// The state on a circle where (cosine, sine) is the direction from its axis in a frame; the offset is from the axis.
template <Scalar S>
void PathMove<S>::turned(const Frame& frame, S cosine, S sine, S radius, PathState<S>& out) const noexcept {
    // K = cos^2(pitch) / r, in units of 2^-bend_log2.
    out = {};
    if (spiral_) {
        turned_outwards(frame, cosine, sine, radius, out);
        return;
    }
    const S bend = quotient_or_max(literal<S>(0x1p20) * in_plane_ * in_plane_, radius);
    out.tangent = along_;
    for (unsigned k = 0; k < in_plane(); ++k) {
        const S radial = cosine * frame.radial[k] + sine * frame.along[k];
        out.offset[k] = radius * radial;
        out.tangent[k] += in_plane_ * (cosine * frame.along[k] - sine * frame.radial[k]);
        out.bend[k] = -(bend * radial);
    }
}

// The state at a way from an end of an arc, negative: before it; the offset is from that end.
template <Scalar S>
void PathMove<S>::near(bool at_end, S way, PathState<S>& out) const noexcept {
    const Frame& frame = at_end ? end_ : start_;
    const S angle = way * in_plane_ / mean_radius(); // as a share of the sweep it would lose digits
    const S sine = small_sine(angle);
    const S versine = small_versine(angle);
    const S wider = (spiral_ ? growth_ : radius_end_ - radius_start_) * (way / length_);
    const S radius = (at_end ? radius_end_ : radius_start_) + wider;
    turned(frame, from_integer<S>(1) - versine, sine, radius, out);
    out.offset = along_;
    scale(out.offset, way, axes_);
    for (unsigned k = 0; k < in_plane(); ++k) {
        out.offset[k] += radius * (sine * frame.along[k] - versine * frame.radial[k]) + wider * frame.radial[k];
    }
}

// From the nearer end, with one place between them: what is a way from one end is the same where it is seen from the
// other one.
template <Scalar S>
void PathMove<S>::on_arc(bool at_end, S way, PathState<S>& out) const noexcept {
    const S from_start = at_end ? length_ - way : way;
    const bool from_end = from_start > literal<S>(first_share) * length_;
    near(from_end, !from_end ? from_start : at_end ? -way : way - length_, out);
    for (unsigned k = 0; from_end != at_end && k < static_cast<unsigned>(axes_); ++k) {
        const S chord = distance<S>(from_[k], to_[k], chord_unit_log2);
        out.offset[k] = at_end ? out.offset[k] - chord : out.offset[k] + chord;
    }
}

template <Scalar S>
void PathMove<S>::behind_start(S way, PathState<S>& out) const noexcept {
    if (shape_ == MoveShape::arc) {
        on_arc(false, way, out);
        return;
    }
    if (shape_ == MoveShape::bezier) {
        bezier_.state(way / length_, false, out);
        return;
    }
    out = {};
    out.tangent = out.offset = along_;
    scale(out.offset, way, axes_);
}

template <Scalar S>
void PathMove<S>::before_end(S way, PathState<S>& out) const noexcept {
    if (shape_ == MoveShape::line) {
        behind_start(-way, out);
    } else if (shape_ == MoveShape::arc) {
        on_arc(true, way, out);
    } else {
        bezier_.state(from_integer<S>(1) - way / length_, true, out);
    }
}

template <Scalar S>
S PathMove<S>::distance_near(bool at_end, const PerAxis<S>& point) const noexcept {
    if (shape_ == MoveShape::bezier) {
        return bezier_.distance_near(at_end, point);
    }
    S way{};
    if (shape_ == MoveShape::line) {
        way = dot(point, along_, axes_);
    } else {
        const Frame& frame = at_end ? end_ : start_;
        S across = at_end ? radius_end_ : radius_start_;
        S along{};
        for (unsigned k = 0; k < in_plane(); ++k) {
            across += point[k] * frame.radial[k];
            along += point[k] * frame.along[k];
        }
        way = angle_of(across, along) * mean_radius() * in_plane_; // and how far it has risen, and grown
        if (spiral_) {
            const std::array<S, 2> arm{across, along};
            way += (norm(arm, 2) - (at_end ? radius_end_ : radius_start_)) * (growth_ / length_);
        }
        for (const unsigned k : indices(axes_)) {
            way += point[k] * along_[k];
        }
    }
    way = at_end ? smaller(way, S{}) : larger(way, S{});
    way = at_end ? larger(way, -longest_way_) : smaller(way, longest_way_);
    PathState<S> nearest;
    if (at_end) {
        before_end(-way, nearest);
    } else {
        behind_start(way, nearest);
    }
    return norm(difference(point, nearest.offset, axes_), axes_);
}

template <Scalar S>
int PathMove<S>::pieces(S trim_start, S trim_end) const noexcept {
    if (shape_ != MoveShape::arc) {
        return 1;
    }
    const S angle = sweep_ * ((length_ - trim_start - trim_end) / length_);
    S most = literal<S>(most_of_piece);
    // Half the angle is 1/64 of the error, which grows with the radius.
    for (S radius = mean_radius(); spiral_ && radius > literal<S>(fine_radius); radius = scale2(radius, -6)) {
        most = scale2(most, -1);
    }
    return 1 + whole_part(larger(angle / most, S{}));
}

template <Scalar S>
Handles<S> PathMove<S>::handles(S way, S piece, bool ends) const noexcept {
    Handles<S> out{literal<S>(0.2) * piece, literal<S>(0.4) * piece};
    if (spiral_) {
        const Pace pace = pace_at(radius_start_ + growth_ * (way / length_));
        const S turned = in_plane_ * (piece / mean_radius());
        const S faster = literal<S>(0.05) * turned * pace.outwards * pace.around / pace.speed * piece;
        out.first = out.first * pace.speed;
        out.second = out.second * pace.speed + (ends ? -faster : faster);
    }
    return out;
}

template <Scalar S>
S PathMove<S>::piece_length(S trim_start, S trim_end, int count) const noexcept {
    return (length_ - trim_start - trim_end) / from_integer<S>(count);
}

template <Scalar S>
int PathMove<S>::bezier_part(S trim_start, S trim_end, PerAxis<PerDegree<S>>& out) const noexcept {
    const S one = from_integer<S>(1);
    bezier_.part(trim_start > S{} ? trim_start / length_ : S{}, trim_end > S{} ? one - trim_end / length_ : one, out);
    return bezier_.degree();
}

// The angle from the start is found anew for each piece: nothing accumulates along many turns.
template <Scalar S>
void PathMove<S>::piece_end(S trim_start, S trim_end, int index, int count, PathState<S>& out) const noexcept {
    const S way = trim_start + piece_length(trim_start, trim_end, count) * from_integer<S>(index + 1);
    const S share = way / length_;
    const S angle = sweep_ * share;
    const S turn = literal<S>(two_pi);
    const S within = angle - turn * from_integer<S>(whole_part(angle / turn));
    const S part = scale2(within, -4); // below 0.4
    S cosine = from_integer<S>(1) - small_versine(part);
    S sine = small_sine(part);
    for (int doubling = 0; doubling < 4; ++doubling) {
        const S twice = scale2(sine * cosine, 1);
        cosine = cosine * cosine - sine * sine;
        sine = twice;
    }
    const S radius = radius_start_ + (spiral_ ? growth_ : radius_end_ - radius_start_) * share;
    turned(start_, cosine, sine, radius, out);
    add(out.offset, way, along_, axes_);
    for (unsigned k = 0; k < in_plane(); ++k) {
        out.offset[k] -= radius_start_ * start_.radial[k];
    }
}

#if SPLINEFEED_MAX_DEGREE >= 5
SPLINEFEED_INSTANTIATE_CLASS(PathMove)
#endif

} // namespace splinefeed
