// SPDX-License-Identifier: MIT
// PathState: a point of a path with its direction and curvature, and the quintic between two of them.
#pragma once

#include "splinefeed/s1_curve/curve_segment.hpp"

namespace splinefeed {

/// Curvature vectors are in units of 2^-20 per chord unit (2^-12 mm): in Fixed a radius of 0.1 um to 100 m has digits.
inline constexpr int bend_log2 = 20;

template <Scalar S>
struct PathState {
    PerAxis<S> offset{};  ///< from a point that the context names, in chord units
    PerAxis<S> tangent{}; ///< unit vector
    PerAxis<S> bend{};    ///< curvature vector, see bend_log2
    S bend_error{};       ///< what rounding may have done to it
};

/// How far the inner points of a quintic are from the end beside them. [chord units]
template <Scalar S>
struct Handles {
    S first{};
    S second{};
};

/// The Bezier points of the quintic that leaves `from` and arrives at `to` with their directions and curvatures. The
/// points next to the ends are `first` away from them, the next ones `second`:
///     C1 = C0 + first T,  C2 = C0 + second T + 5/4 first^2 K
/// With first = h/5 and second = 2h/5 it is Hermite's quintic with |C'| = h at the ends and without tangential
/// acceleration there. Lengths in chord units. @pre first |K| is at most about 1
template <Scalar S>
void quintic_between(const PathState<S>& from, const PathState<S>& to, S first, S second, int axes,
                     PerAxis<PerDegree<S>>& points) noexcept;
/// The same with other handles at either end. With second = 2 first + h^2 A / 20 and, at the end, 2 first - h^2 A / 20,
/// A is the tangential acceleration there.
template <Scalar S>
void quintic_between(const PathState<S>& from, const PathState<S>& to, const Handles<S>& begin, const Handles<S>& end,
                     int axes, PerAxis<PerDegree<S>>& points) noexcept;

} // namespace splinefeed
