// SPDX-License-Identifier: MIT
// catmull_rom_points: the original Catmull-Rom curve through points that are all known.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"

namespace splinefeed {

/// Pieces of a curve through `count` points.
[[nodiscard]] constexpr std::size_t pieces_through(std::size_t count, bool closed) noexcept {
    return closed ? count : count - 1;
}

/// Tangents m (P_{i+1} - P_{i-1}) and the cubics between the points, Borysenko & Ustenko (2)-(5); ends by doubled end
/// points, r' = m (P_1 - P_0), along P0P1 and P2P3 (printed: P3P4). The tangents are parallel to P0P2 and P1P3
/// (printed: P0P1 and P2P3), and b_x has -m (x3 - x1) (printed: plus). Interpolates. Class C1; m = 0 gives the polygon,
/// with a zero tangent at every point; m < 0 turns tangents round. Bezier points leave the box of the points by (m/3)
/// of its size. Errors: too_few_points (2 open, 3 closed), tension_out_of_range (not 0 to 10), storage_too_small. Cost:
/// 3 products a point and axis. CatmullRom is the streaming form.
/// @param tangents  one a point
/// @param pieces    pieces_through(points.size(), closed)
/// @pre |coordinate| < 2^25 in Fixed
template <Scalar S>
Status catmull_rom_points(std::span<const Point<S>> points, int axes, bool closed, S tension,
                          std::span<Point<S>> tangents, std::span<BezierPiece<S>> pieces) noexcept;

} // namespace splinefeed
