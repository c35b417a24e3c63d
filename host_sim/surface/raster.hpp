// SPDX-License-Identifier: MIT
// Raster: a tool path of iso-parametric lines on a surface.
#pragma once

#include "host_sim/surface/described_surface.hpp"

#include <limits>
#include <optional>

namespace splinefeed::host {

/// How the surface is travelled.
struct RasterOptions {
    SurfaceDirection along = SurfaceDirection::u; ///< the parameter that changes along a line
    std::optional<int> lines;                     ///< number of lines, evenly spread over the other parameter
    std::optional<double> scallop_mm;             ///< or: spacing so that ridges have at most this height
    double ball_radius_mm = 0.0;                  ///< 0: the path lies on the surface
    bool tip = false;                             ///< the path is that of the ball's lowest point; otherwise of its
                                                  ///< centre
    bool zigzag = true;                           ///< otherwise one way, lifted for the way back
    double lift_mm = 5.0;                         ///< above ToolSurface::highest_mm
    double step_mm = 1.0;                         ///< largest distance of waypoints along a line
};

/// Inner knots at which a surface may have a crease: knots as many times as its degree.
[[nodiscard]] std::vector<double> creases(std::span<const double> knots, int degree);

/// The place where a ball touches the surface.
struct Contact {
    Point<double> position{};
    Point<double> direction{}; ///< derivative along the line
    Point<double> normal{};    ///< unit vector towards the tool
};

/// Points of the surface, offset for the tool. The normal is on the side of the surface that looks up (z) on the whole.
class ToolSurface {
public:
    /// Throws DescriptionError if the points do not have three coordinates, if a ball would jump at a crease, or if the
    /// surface has no upper side: the mean of the normals is horizontal within 1e-6. `surface` must outlive it.
    ToolSurface(const DescribedSurface& surface, const RasterOptions& options);

    /// Domain of the parameter along a line, and across the lines.
    [[nodiscard]] double first_along() const noexcept { return along_u_ ? view_.first_u() : view_.first_v(); }
    [[nodiscard]] double last_along() const noexcept { return along_u_ ? view_.last_u() : view_.last_v(); }
    [[nodiscard]] double first_across() const noexcept { return along_u_ ? view_.first_v() : view_.first_u(); }
    [[nodiscard]] double last_across() const noexcept { return along_u_ ? view_.last_v() : view_.last_u(); }

    /// The parameter of the surface along a line (or across the lines).
    [[nodiscard]] SurfaceDirection along() const noexcept {
        return along_u_ ? SurfaceDirection::u : SurfaceDirection::v;
    }
    [[nodiscard]] SurfaceDirection across() const noexcept {
        return along_u_ ? SurfaceDirection::v : SurfaceDirection::u;
    }

    [[nodiscard]] SurfaceJet<double> jet(double along, double across) const noexcept;
    /// Throws DescriptionError if there is no normal.
    [[nodiscard]] Contact contact(double along, double across) const;
    /// Unit vector away from the surface, towards the tool. Throws DescriptionError if there is none.
    [[nodiscard]] Point<double> normal(double along, double across) const;
    /// Position of the tool's centre or tip. Throws DescriptionError.
    [[nodiscard]] Point<double> tool(double along, double across) const;
    /// The centre of the ball.
    [[nodiscard]] Point<double> centre(double along, double across) const;
    /// A height that the tool never exceeds, on the lines or between them: the height of the highest control point,
    /// because the surface lies in the hull of its net; the centre of a ball is at most a radius above it, its tip not
    /// at all.
    [[nodiscard]] double highest_mm() const noexcept;
    /// The largest curvature of the surface towards the tool at this place [1/mm]; nothing at a pole.
    [[nodiscard]] std::optional<double> hollow(double along, double across) const;
    /// Height of the ridge that balls on two lines leave between them, or depth to which they cut there: the largest
    /// value found along the lines. At each place the ray along the normal ends at the nearer of the two balls. The
    /// places are at least 65 along and 7 between the lines, 5 in every knot span of both, and where the balls meet. To
    /// first order it is w^2/8 (1/r + kappa), with kappa > 0 where the surface bulges towards the tool. At least the
    /// radius if the balls do not touch. The search ends at the first ridge above `enough`.
    [[nodiscard]] double scallop_mm(double across, double next_across,
                                    double enough = std::numeric_limits<double>::infinity()) const;

    [[nodiscard]] const BSplineSurface<double>& view() const noexcept { return view_; }
    [[nodiscard]] const RasterOptions& options() const noexcept { return *options_; }

private:
    BSplineSurface<double> view_;
    const RasterOptions* options_;
    bool along_u_;
    double side_ = 1.0; ///< sign of S_u x S_v
};

/// A part of the path: with one parameter constant, or straight.
struct CellInterval {
    enum class Kind { along, across, straight };
    Kind kind = Kind::along;
    double constant = 0.0; ///< the constant parameter
    double from = 0.0;     ///< start of the other parameter
    double to = 0.0;
    Point<double> start{}; ///< straight: start point
    Point<double> end{};
};

/// Parameters of the lines. Throws DescriptionError for more than 100000 lines.
[[nodiscard]] std::vector<double> line_parameters(const ToolSurface& surface);

/// The whole path in order. Throws DescriptionError if the ball does not fit into a hollow of the surface (checked at
/// every waypoint and at 9 places in every knot span that the path crosses), or for more than 100 million waypoints.
[[nodiscard]] std::vector<CellInterval> raster(const ToolSurface& surface);

/// Throws DescriptionError for more than 100 million waypoints.
void require_count(double count);

/// Parameters of the waypoints of a part that is not straight, both ends included.
[[nodiscard]] std::vector<double> stretch_parameters(const ToolSurface& surface, const CellInterval& stretch);

/// A point of the path; corner: the end of a part, where the machine stops.
struct ToolPoint {
    Point<double> position{};
    bool corner = false;
};
/// The path as waypoints, at most step_mm apart on the surface; coincident points are merged.
[[nodiscard]] std::vector<ToolPoint> waypoints(const ToolSurface& surface, const std::vector<CellInterval>& path);

/// The path as Bezier pieces. Without a ball: the lines themselves, exactly (knot insertion). With a ball: cubics
/// through the waypoints with the derivatives of the path there (class C1 within a line). Pieces of length zero are
/// omitted.
[[nodiscard]] std::vector<BezierPiece<double>> pieces(const ToolSurface& surface,
                                                      const std::vector<CellInterval>& path);

} // namespace splinefeed::host
