// SPDX-License-Identifier: MIT
#include "splinefeed/splines/catmull_rom_points.hpp"

namespace splinefeed {

template <Scalar S>
Status catmull_rom_points(std::span<const Point<S>> points, int axes, bool closed, S tension,
                          std::span<Point<S>> tangents, std::span<BezierPiece<S>> pieces) noexcept {
    const std::size_t count = points.size();
    if (count < (closed ? 3U : 2U)) {
        return Error::too_few_points;
    }
    if (tension < S{} || tension > from_integer<S>(10)) {
        return Error::tension_out_of_range;
    }
    if (tangents.size() < count || pieces.size() < pieces_through(count, closed)) {
        return Error::storage_too_small;
    }
    const auto n = static_cast<unsigned>(axes);
    for (std::size_t i = 0; i < count; ++i) {
        // The end points count twice.
        const std::size_t before = i > 0 ? i - 1 : closed ? count - 1 : 0;
        const std::size_t after = i + 1 < count ? i + 1 : closed ? 0 : i;
        for (unsigned k = 0; k < n; ++k) {
            tangents[i][k] = tension * (points[after][k] - points[before][k]);
        }
    }
    const S three = from_integer<S>(3);
    for (std::size_t i = 0; i < pieces_through(count, closed); ++i) {
        const std::size_t j = i + 1 < count ? i + 1 : 0;
        BezierPiece<S>& piece = pieces[i];
        piece.degree = 3;
        for (unsigned k = 0; k < n; ++k) {
            piece.control[k][0] = points[i][k];
            piece.control[k][1] = points[i][k] + tangents[i][k] / three;
            piece.control[k][2] = points[j][k] - tangents[j][k] / three;
            piece.control[k][3] = points[j][k];
        }
    }
    return {};
}

template Status catmull_rom_points(std::span<const Point<double>>, int, bool, double, std::span<Point<double>>,
                                   std::span<BezierPiece<double>>) noexcept;
template Status catmull_rom_points(std::span<const Point<float>>, int, bool, float, std::span<Point<float>>,
                                   std::span<BezierPiece<float>>) noexcept;
template Status catmull_rom_points(std::span<const Point<Fixed>>, int, bool, Fixed, std::span<Point<Fixed>>,
                                   std::span<BezierPiece<Fixed>>) noexcept;

} // namespace splinefeed
