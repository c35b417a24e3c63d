// SPDX-License-Identifier: MIT
// CurveSegment: the common form of every curve method: a polynomial Bezier segment.
//
// Control points are offsets from an exact integer origin, in units of 2^unit_log2 mm. The unit is chosen so that the
// largest offset is in [2^15, 2^16). Fixed then has 47 bits below the size of the segment, however small the segment
// is, and float has its full 24. A plain Q31.32 in mm would leave 26 bits for the curvature of a 0.2 mm segment.
#pragma once

#include "splinefeed/s1_curve/waypoint.hpp"

namespace splinefeed {

/// Chords and spline offsets are in units of 2^-12 mm: in Fixed a range of 131 m and a resolution of 6e-14 mm.
inline constexpr int chord_unit_log2 = -12;
inline constexpr double chord_units_per_mm = 1 << -chord_unit_log2;

/// Lengths below this, in the units of a segment, count as zero, and a shorter tangent as a cusp: 2^-30 of the segment
/// (float: 2^-14).
template <Scalar S>
inline constexpr S negligible_units = literal<S>(1.0 / 16384.0);
template <>
inline constexpr float negligible_units<float> = 4.0F;

/// As a programmed feed: as fast as the machine can, and subject to the override of rapids, not of feeds.
template <Scalar S>
inline constexpr S rapid_feed = from_integer<S>(-1);

template <Scalar S>
struct CurveSegment {
    int axes = 0;
    int degree = 0;    ///< 1 to max_degree
    int unit_log2 = 0; ///< control is in units of 2^unit_log2 mm
    PerAxis<Position> origin{};
    PerAxis<Position> end{};         ///< the exact end point; meaningful if the machine stops at the end
    PerAxis<PerDegree<S>> control{}; ///< control[axis][i], offset of Bezier point i from origin
    S feed_mm_s{};                   ///< programmed feed; 0: the machine's feed; or rapid_feed
    S max_feed_mm_s{};               ///< upper limit for every feed override; 0: none
    bool feed_along_path = false;    ///< both feeds count all axes
    bool stop_at_end = false;        ///< the feed is zero at the end (a corner)
    std::uint32_t waypoint = 0;      ///< index of the waypoint at its end (or index of the segment in a file), modulo
                                     ///< 2^32

    /// The feed without an override: the programmed feed, limited by max_feed_mm_s; 0: the machine's feed.
    [[nodiscard]] constexpr S block_feed_mm_s() const noexcept {
        return feed_mm_s > S{} && max_feed_mm_s > S{} ? smaller(feed_mm_s, max_feed_mm_s)
                                                      : larger(feed_mm_s, max_feed_mm_s);
    }

    /// Stores offsets in chord units (2^-12 mm) as `control`, and chooses the unit. Cost: one pass.
    /// @pre axes, degree, origin are set; |offset| < 2^30 chord units
    void assign(const PerAxis<PerDegree<S>>& offsets) noexcept;

    /// A segment of 10 um or more whose points lie on its chord, in order, becomes that line: the same places, which a
    /// plan passes without cells. Cost: a root, and a product and a sum for each coordinate.
    void straighten() noexcept;

    /// Where it begins, with the rounding of its control points.
    [[nodiscard]] constexpr Position start(unsigned axis) const noexcept {
        return displaced(origin[axis], control[axis][0], unit_log2);
    }

    /// Bezier point i of an axis in mm. For files, on the host.
    [[nodiscard]] double control_mm(int axis, int i) const noexcept {
        const auto k = static_cast<unsigned>(axis);
        return to_mm(origin[k]) + scale2(to_double(control[k][static_cast<unsigned>(i)]), unit_log2);
    }
};

} // namespace splinefeed
