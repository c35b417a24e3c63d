// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/cycles/spline_points.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/s1_blended_path/path_bezier.hpp"

namespace splinefeed {

namespace {

constexpr std::int64_t near_raw = (std::int64_t{1} << Position::fraction_bits) / 10000; // as WaypointCurve merges
constexpr double longest_polygon = 0x1p28;                                              // that a path takes

// Not used where the largest degree is 3.
[[maybe_unused]] bool is_near(const PerAxis<Position>& from, const PerAxis<Position>& to, int axes) noexcept {
    for (const unsigned k : indices(axes)) {
        const std::int64_t way = to[k].raw - from[k].raw;
        if (way >= near_raw || way <= -near_raw) {
            return false;
        }
    }
    return true;
}

} // namespace

template <Scalar S>
void SplinePoints<S>::begin(const PerAxis<Position>& from, const MoveManner& manner, int axes) noexcept {
    CurveOptions<S> options;
    options.axes = axes;
    options.longest_move_mm = 65536; // of float, too: the path is told the geometry alone
    curve_.build(options);
    manner_ = manner;
    axes_ = axes;
    here_ = knot_ = last_ = from;
    count_ = 0;
    joined_ = finished_ = false;
    Waypoint<S> start;
    start.position = from;
    const Status status = curve_->push(start);
    SPLINEFEED_ASSERT(status.ok());
    static_cast<void>(status);
}

template <Scalar S>
void SplinePoints<S>::add(const typename PointCurve<S>::Point& point) noexcept {
    last_ = point.to;
    if (is_near(knot_, point.to, axes_)) {
        return;
    }
    Waypoint<S> waypoint;
    waypoint.position = knot_ = point.to;
    waypoint.feed_mm_s = point.feed_mm_s;
    legs_[++count_ % most_known] = {point.feed, point.line};
    const Status status = curve_->push(waypoint);
    SPLINEFEED_ASSERT(status.ok());
    static_cast<void>(status);
}

template <Scalar S>
void SplinePoints<S>::finish() noexcept {
    if (!finished_) {
        finished_ = true;
        static_cast<void>(curve_->finish()); // all points may be near the first one
    }
}

template <Scalar S>
bool SplinePoints<S>::next(ProgramItem<S>& out) noexcept {
    PathElement<S>& element = out.element;
    CurveSegment<S> piece;
    const bool given = curve_->next(piece) == Pull::item;
    if (!given && (!finished_ || here_ == last_)) {
        return false;
    }
    const Leg& leg = legs_[(given ? piece.waypoint : count_) % most_known];
    out.line = leg.line;
    out.feed = leg.feed;
    element.stop_at_end = false;
    if (given) {
        element.feed_mm_s = piece.feed_mm_s;
        fill_piece(piece, element);
    } else {
        element.shape = MoveShape::line;
        element.joined = false;
        element.to = last_;
    }
    here_ = element.to;
    return true;
}

template <Scalar S>
void SplinePoints<S>::fill_piece(const CurveSegment<S>& piece, PathElement<S>& out) noexcept {
    PerAxis<S> chord{};
    out.shape = MoveShape::bezier;
    out.joined = joined_;
    out.to = piece.end;
    out.bezier.degree = piece.degree;
    out.bezier.points = {};
    for (const unsigned k : indices(axes_)) {
        chord[k] = distance<S>(here_[k], out.to[k], chord_unit_log2);
        for (unsigned i = 1; i <= static_cast<unsigned>(piece.degree); ++i) {
            out.bezier.points[k][i] = scale2(piece.control[k][i], piece.unit_log2 - chord_unit_log2);
        }
    }
    PathBezier<S> curve;
    curve.set(out.bezier, chord, axes_);
    joined_ = !piece.stop_at_end;
    if (!curve.has_directions() || !(curve.polygon() < literal<S>(longest_polygon))) {
        out.shape = MoveShape::line;
        out.joined = joined_ = false;
    }
}

#if SPLINEFEED_MAX_DEGREE >= 5
SPLINEFEED_INSTANTIATE_CLASS(SplinePoints)
#endif

} // namespace splinefeed
