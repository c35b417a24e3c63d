// SPDX-License-Identifier: MIT
// Raster: a surface as a tool path of iso-parametric lines.
#pragma once

#include "host_sim/surface/described_surface.hpp"

#include <limits>
#include <optional>

namespace splinefeed::host {

/// How the surface is to be travelled.
struct RasterOptions {
    SurfaceDirection along = SurfaceDirection::u; ///< the parameter that runs along a line
    std::optional<int> lines;                     ///< evenly spread over the other parameter
    std::optional<double> scallop_mm;             ///< or as far apart as leaves ridges of this height at most
    double ball_radius_mm = 0.0;                  ///< 0: the path lies on the surface
    bool tip = false;                             ///< the path is that of the ball's lowest point, not of its centre
    bool zigzag = true;                           ///< else one way, lifted for the way back
    double lift_mm = 5.0;                         ///< above ToolSurface::highest_mm
    double step_mm = 1.0;                         ///< largest distance of waypoints along a line
};

/// Inner knots at which a surface may have a crease: as many times there as its degree.
[[nodiscard]] std::vector<double> creases(std::span<const double> knots, int degree);

/// Where a ball touches the surface.
struct Contact {
    Point<double> position{};
    Point<double> direction{}; ///< of the line, its derivative
    Point<double> normal{};    ///< unit vector towards the tool
};

/// Points of the surface offset for the tool. Its normal is the side of the surface that looks up (z) on the whole.
class ToolSurface {
public:
    /// Throws DescriptionError where the points have not three coordinates, a ball would jump at a crease, or has no
    /// side: the mean of the normals is level within 1e-6. `surface` must outlive it.
    ToolSurface(const DescribedSurface& surface, const RasterOptions& options);

    /// Domain of the parameter along a line, and across.
    [[nodiscard]] double first_along() const noexcept { return along_u_ ? view_.first_u() : view_.first_v(); }
    [[nodiscard]] double last_along() const noexcept { return along_u_ ? view_.last_u() : view_.last_v(); }
    [[nodiscard]] double first_across() const noexcept { return along_u_ ? view_.first_v() : view_.first_u(); }
    [[nodiscard]] double last_across() const noexcept { return along_u_ ? view_.last_v() : view_.last_u(); }

    /// The parameter of the surface that runs along a line (or across).
    [[nodiscard]] SurfaceDirection along() const noexcept {
        return along_u_ ? SurfaceDirection::u : SurfaceDirection::v;
    }
    [[nodiscard]] SurfaceDirection across() const noexcept {
        return along_u_ ? SurfaceDirection::v : SurfaceDirection::u;
    }

    [[nodiscard]] SurfaceJet<double> jet(double along, double across) const noexcept;
    /// Throws DescriptionError where there is no normal.
    [[nodiscard]] Contact contact(double along, double across) const;
    /// Unit vector away from the surface, towards the tool. Throws DescriptionError where there is none.
    [[nodiscard]] Point<double> normal(double along, double across) const;
    /// Where the tool's centre or tip is. Throws DescriptionError.
    [[nodiscard]] Point<double> tool(double along, double across) const;
    /// The centre of the ball.
    [[nodiscard]] Point<double> centre(double along, double across) const;
    /// A height that the tool exceeds nowhere, on the lines or between them: that of the highest control point, as the
    /// surface lies in the hull of its net; the centre of a ball is a radius above it at most, its tip not at all.
    [[nodiscard]] double highest_mm() const noexcept;
    /// The largest curvature of the surface towards the tool there [1/mm]; nothing at a pole.
    [[nodiscard]] std::optional<double> hollow(double along, double across) const;
    /// Height of the ridge that balls on two lines leave between them, or depth to which they cut there, the largest
    /// found along the lines. At each place that is looked at the ray along the normal ends at the nearer of the two
    /// balls. Looked at are 65 places along at least and 7 between the lines, 5 in every knot span of both, and where
    /// the balls meet. To first order w^2/8 (1/r + kappa), kappa > 0 where the surface bulges towards the tool. The
    /// radius at least where the balls do not touch. The search ends at the first ridge above `enough`.
    [[nodiscard]] double scallop_mm(double across, double next_across,
                                    double enough = std::numeric_limits<double>::infinity()) const;

    [[nodiscard]] const BSplineSurface<double>& view() const noexcept { return view_; }
    [[nodiscard]] const RasterOptions& options() const noexcept { return *options_; }

private:
    BSplineSurface<double> view_;
    const RasterOptions* options_;
    bool along_u_;
    double side_ = 1.0; ///< of S_u x S_v
};

/// A stretch of the path: with one parameter constant, or straight.
struct CellInterval {
    enum class Kind { along, across, straight };
    Kind kind = Kind::along;
    double constant = 0.0; ///< the parameter that does not change
    double from = 0.0;     ///< of the other one
    double to = 0.0;
    Point<double> start{}; ///< straight: its ends
    Point<double> end{};
};

/// Parameters of the lines. Throws DescriptionError: more than 100000 lines.
[[nodiscard]] std::vector<double> line_parameters(const ToolSurface& surface);

/// The whole path in order. Throws DescriptionError: the ball does not fit into a hollow of the surface, looked for at
/// every waypoint and at 9 places in every knot span that the path runs through; more than 100 million waypoints.
[[nodiscard]] std::vector<CellInterval> raster(const ToolSurface& surface);

/// Throws DescriptionError: so many waypoints are more than 100 million.
void require_count(double count);

/// Parameters of the waypoints of a stretch that is not straight, both ends included.
[[nodiscard]] std::vector<double> stretch_parameters(const ToolSurface& surface, const CellInterval& stretch);

/// A point of the path; corner: where a stretch ends, the machine stops.
struct ToolPoint {
    Point<double> position{};
    bool corner = false;
};
/// The path as waypoints, at most step_mm apart on the surface; points that coincide are one.
[[nodiscard]] std::vector<ToolPoint> waypoints(const ToolSurface& surface, const std::vector<CellInterval>& path);

/// The path as Bezier pieces: without a ball the lines themselves, exactly (knot insertion); with one, cubics through
/// the waypoints with the derivatives that the path has there (class C1 within a line). Pieces without length are left
/// out.
[[nodiscard]] std::vector<BezierPiece<double>> pieces(const ToolSurface& surface,
                                                      const std::vector<CellInterval>& path);

} // namespace splinefeed::host
