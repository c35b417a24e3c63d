// SPDX-License-Identifier: MIT
// hermite_pieces: a curve of any kind as polynomial Bezier segments.
#pragma once

#include <array>
#include <functional>
#include <vector>

namespace splinefeed::host {

/// x, y, z
using Vector3 = std::array<double, 3>;

/// A point of a curve with its derivatives by the parameter.
struct CurveState {
    Vector3 point{};
    Vector3 first{};
    Vector3 second{};
};

/// The Bezier points of a quintic over a part of the parameter.
struct HermitePiece {
    double from = 0.0;
    double to = 1.0;
    std::array<Vector3, 6> points{};
};

/// How far the pieces are from the curve at most, at eight parameters of each. [mm]
inline constexpr double hermite_error_mm = 5e-7;

/// Quintics that share point and both derivatives with the curve where they meet, so the joints are as smooth as the
/// curve. A piece is halved until it is near enough. Empty if that takes more than 4096 pieces.
/// @param breaks  increasing parameters: at least one piece between two of them
[[nodiscard]] std::vector<HermitePiece> hermite_pieces(const std::function<CurveState(double)>& curve,
                                                       const std::vector<double>& breaks);

} // namespace splinefeed::host
