// SPDX-License-Identifier: MIT
// PathElement: one programmed move, as a program states it: a line, an arc, or a polynomial Bezier segment.
#pragma once

#include "splinefeed/s1_curve/curve_segment.hpp"

namespace splinefeed {

/// How the machine passes from a move to the next one.
enum class PathMode : std::uint8_t {
    continuous, ///< corners are rounded within the tolerance
    exact_path, ///< the programmed path; the machine stops where the direction jumps
    exact_stop, ///< the machine stops at the end of every move
};

/// The shape of a move.
enum class MoveShape : std::uint8_t { line, arc, bezier };

/// An arc, a spiral or a helix in any plane. The first three axes are x, y, z; the others turn in proportion.
template <Scalar S>
struct ArcShape {
    PerAxis<Position> centre{}; ///< any point of the arc's axis
    std::array<S, 3> normal{};  ///< unit vector of that axis; the arc turns about it by the right-hand rule
    S sweep_rad{};              ///< angle, negative: clockwise. It tells the number of turns; the ends tell the rest
};

/// A Bezier segment. Its ends are those of the move, whatever the first and the last point say.
template <Scalar S>
struct BezierShape {
    int degree = 0;                 ///< 1 to 5
    PerAxis<PerDegree<S>> points{}; ///< offsets from the start of the move, in chord units (2^-12 mm)
};

/// One move from where the move before it ended.
template <Scalar S>
struct PathElement {
    MoveShape shape = MoveShape::line;
    PathMode mode = PathMode::continuous; ///< at its end
    bool stop_at_end = false;             ///< the machine stops at the end whatever the mode is, e.g. for a dwell
    bool joined = false; ///< it goes on with the direction and curvature of the move before it: there is no joint
    PerAxis<Position> to{};
    ArcShape<S> arc{};
    BezierShape<S> bezier{};
    S tolerance_mm{}; ///< largest distance between the path and the moves, both ways; 0: the path is exact
    /// The same where short lines are joined into one curve; above tolerance_mm it is that; 0: they are not joined.
    S chain_tolerance_mm = from_integer<S>(100);
    S feed_mm_s{};     ///< programmed feed; 0: the machine's; or rapid_feed
    S max_feed_mm_s{}; ///< upper limit for every feed override; 0: none
    /// Both feeds count all axes; else the linear ones if any of them moves, else the rotary ones. TolerancePath sets
    /// it.
    bool feed_along_path = false;

    [[nodiscard]] bool has_feed_of(const PathElement& other) const noexcept {
        return feed_mm_s == other.feed_mm_s && max_feed_mm_s == other.max_feed_mm_s &&
               feed_along_path == other.feed_along_path;
    }
    /// Whether its end may be rounded.
    [[nodiscard]] bool passes_end() const noexcept { return mode == PathMode::continuous && !stop_at_end; }
};

} // namespace splinefeed
