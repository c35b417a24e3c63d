// SPDX-License-Identifier: MIT
// element_shapes: the curves of an element file, with their derivatives.
#pragma once

#include "host_sim/program/hermite_pieces.hpp"

#include "splinefeed/s1_blended_path/path_element.hpp"
#include "splinefeed/splines/bezier_piece.hpp"

namespace splinefeed::host {

/// An arc, a spiral or a helix: radius, angle and height change evenly from `from` to `to`. [mm]
class ProgrammedArc {
public:
    /// @param axis  unit vector
    /// @param angle  [rad], right-hand rule, several turns at will. The end decides it but for the whole turns.
    ProgrammedArc(const Vector3& from, const Vector3& to, const Vector3& centre, const Vector3& axis, double angle);

    [[nodiscard]] double radius_from() const noexcept { return radius_from_; }
    [[nodiscard]] double radius_to() const noexcept { return radius_to_; }
    /// Along the axis, from `from` to `to`. [mm]
    [[nodiscard]] double rise() const noexcept { return rise_; }
    /// The angle that leads to the end.
    [[nodiscard]] double angle() const noexcept { return angle_; }
    /// Between the end that the stated angle leads to and the end. [mm]
    [[nodiscard]] double mismatch() const noexcept { return mismatch_; }
    /// The largest distance from `from` along axis k. [mm]
    [[nodiscard]] double extent(std::size_t k) const noexcept;
    /// The smallest and the largest coordinate of axis k. [mm] Cost: each half turn takes some microseconds.
    struct Range {
        double low = 0.0;
        double high = 0.0;
    };
    [[nodiscard]] Range range(std::size_t k) const noexcept;
    /// Length [mm], to 1e-6 of itself where the radius stays above a tenth of what it changes.
    /// @param others_sq  the square of what further axes go meanwhile, in proportion
    [[nodiscard]] double length(double others_sq = 0.0) const noexcept;
    /// The smallest radius of curvature. [mm] @param others_sq  as above
    [[nodiscard]] double least_radius(double others_sq = 0.0) const noexcept;
    /// @param w  0 to 1
    [[nodiscard]] CurveState at(double w) const noexcept;

    /// Where a point is about the axis.
    struct Cylindrical {
        double angle = 0.0;  ///< from the direction of the start [rad], -pi to pi, positive: right-hand rule
        double growth = 0.0; ///< of the radius since the start [mm]
        double rise = 0.0;   ///< along the axis since the start [mm]
    };
    [[nodiscard]] Cylindrical polar(const Vector3& point) const noexcept;

private:
    [[nodiscard]] double slope(std::size_t k, double w) const noexcept;
    [[nodiscard]] double speed_sq(double radius, double others_sq) const noexcept;

    Vector3 centre_;
    Vector3 axis_;
    Vector3 x_{}; // from the centre to the start
    Vector3 y_{};
    double radius_from_ = 0.0;
    double radius_to_ = 0.0;
    double angle_ = 0.0;
    double mismatch_ = 0.0;
    double height_ = 0.0; // of the start above the centre
    double rise_ = 0.0;
};

/// The arc that a move is. @pre its shape is an arc
[[nodiscard]] ProgrammedArc arc_of(const PerAxis<Position>& from, const PathElement<double>& move, int axes) noexcept;

/// A rational Bezier segment: axes 0 to 2 of the piece are x w, y w, z w, axis 3 is w.
[[nodiscard]] CurveState rational_state(const BezierPiece<double>& piece, double t) noexcept;

} // namespace splinefeed::host
