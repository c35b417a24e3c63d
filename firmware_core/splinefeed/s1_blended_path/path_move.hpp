// SPDX-License-Identifier: MIT
// PathMove: the geometry of one programmed move: its length, and its states near its ends.
#pragma once

#include "splinefeed/base/status.hpp"
#include "splinefeed/s1_blended_path/path_bezier.hpp"

namespace splinefeed {

/// A line, an arc that may rise along its axis and change its radius evenly, or a Bezier segment, whose ways are shares
/// of the length of its control polygon. Ways on a spiral are shares of its angle. Lengths are in chord units (2^-12
/// mm).
template <Scalar S>
class PathMove {
public:
    /// The move from `from` to element.to. Errors: move_too_long, arc_invalid, curve_invalid. A move of no length has
    /// length() 0.
    [[nodiscard]] Status set(const PerAxis<Position>& from, const PathElement<S>& element, int axes) noexcept;

    [[nodiscard]] const PerAxis<Position>& from() const noexcept { return from_; }
    [[nodiscard]] const PerAxis<Position>& to() const noexcept { return to_; }
    [[nodiscard]] MoveShape shape() const noexcept { return shape_; }
    [[nodiscard]] bool straight() const noexcept { return shape_ == MoveShape::line; }
    [[nodiscard]] S length() const noexcept { return length_; }
    /// The state `way` behind the start; offset from the start. @pre of an arc: way is at most longest_way()
    void behind_start(S way, PathState<S>& out) const noexcept;
    /// The state `way` before the end; offset from the end. @pre as behind_start
    void before_end(S way, PathState<S>& out) const noexcept;
    /// Of an arc half of its radius, of a Bezier segment half of its length; the length if that is shorter.
    [[nodiscard]] S longest_way() const noexcept { return longest_way_; }
    /// Distance of a point from the move, near its end or, if not `at_end`, near its start. `point` is an offset from
    /// that end. Not less than the distance; more by the square of the distance over the radius. On a Bezier segment: a
    /// few steps of Newton's rule from the nearest of five places.
    [[nodiscard]] S distance_near(bool at_end, const PerAxis<S>& point) const noexcept;

    /// Number of segments for the part between `trim_start` and `trim_end` of its ends. An arc has quintics each of
    /// which turns by 0.4 rad at most, where the radius is off by 9e-8 of itself. Those of a spiral turn by less where
    /// that would be more than 5e-7 mm.
    [[nodiscard]] int pieces(S trim_start, S trim_end) const noexcept;
    /// The state where piece `index` of `count` ends; offset from the start of the move. @pre index is below count
    void piece_end(S trim_start, S trim_end, int index, int count, PathState<S>& out) const noexcept;
    /// Length of one of `count` pieces.
    [[nodiscard]] S piece_length(S trim_start, S trim_end, int count) const noexcept;
    /// The handles of Hermite's quintic over a piece of so much length that begins `way` behind the start of the move,
    /// or ends there.
    [[nodiscard]] Handles<S> handles(S way, S piece, bool ends) const noexcept;
    /// The Bezier points of the part between `trim_start` and `trim_end` of the ends, as offsets from the start of the
    /// move. Returns their degree. @pre a Bezier segment
    int bezier_part(S trim_start, S trim_end, PerAxis<PerDegree<S>>& out) const noexcept;

private:
    /// Unit vectors in the plane of an arc: from its axis to the path, and along the path.
    struct Frame {
        std::array<S, 3> radial{};
        std::array<S, 3> along{};
    };

    /// Of a spiral where it has some radius, for each unit of way. All are near 1 or below.
    struct Pace {
        S outwards{}; ///< from the axis
        S around{};   ///< about it
        S speed{};    ///< along the path
    };

    [[nodiscard]] Status set_arc(const ArcShape<S>& arc) noexcept;
    [[nodiscard]] Status set_bezier(const BezierShape<S>& bezier, const PerAxis<S>& to) noexcept;
    [[nodiscard]] S frame_at(const PerAxis<Position>& place, const ArcShape<S>& arc, Frame& out) const noexcept;
    void near(bool at_end, S way, PathState<S>& out) const noexcept;
    void on_arc(bool at_end, S way, PathState<S>& out) const noexcept;
    void turned(const Frame& frame, S cosine, S sine, S radius, PathState<S>& out) const noexcept;
    [[nodiscard]] Pace pace_at(S radius) const noexcept;
    void turned_outwards(const Frame& frame, S cosine, S sine, S radius, PathState<S>& out) const noexcept;
    [[nodiscard]] S mean_radius() const noexcept { return scale2(radius_start_ + radius_end_, -1); }
    [[nodiscard]] unsigned in_plane() const noexcept { return static_cast<unsigned>(smaller(axes_, 3)); }

    int axes_ = 0;
    MoveShape shape_ = MoveShape::line;
    bool spiral_ = false; // an arc whose radius changes by more than rounding
    PerAxis<Position> from_{};
    PerAxis<Position> to_{};
    S length_{};
    S longest_way_{};
    PerAxis<S> along_{}; // a line: unit tangent; an arc: its rise for each unit of length
    Frame start_{};
    Frame end_{};
    S radius_start_{};
    S radius_end_{};
    S growth_{};   // of the radius
    S sweep_{};    // [rad], positive
    S in_plane_{}; // part of the length that is about the axis, as a cosine; of a spiral at its mean radius
    PathBezier<S> bezier_{};
};

} // namespace splinefeed
