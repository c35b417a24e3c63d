// SPDX-License-Identifier: MIT
// ElementCurves: the shapes of an element file as moves in the axes of a machine.
#pragma once

#include "host_sim/program/element_program.hpp"
#include "host_sim/program/element_shapes.hpp"

#include <array>
#include <string>
#include <vector>

namespace splinefeed::host {

/// x, y, z, a, b, c; in mm and degrees
using AxisPoint = std::array<double, 6>;

struct ProgrammedNurbs {
    int degree = 3;
    std::vector<Vector3> points;
    std::vector<double> weights;
    std::vector<double> knots;
};

/// A Bezier segment of a spline.
struct SplinePart {
    std::size_t degree = 5;
    double to = 1.0; ///< where it ends, as a part of the spline's parameter
    std::array<Vector3, 6> points{};
};

/// Adds moves to a program. Lines and arcs stay what they are; a spline becomes Bezier segments. Those are exact if all
/// weights are equal and the degree is at most 5; otherwise, as for arcs that the core does not take (the machine's
/// first axes are not x, y, z, or the radius changes much), they are within hermite_error_mm. Axes a, b, c turn in
/// proportion to the parameter of the shape. Every member throws DescriptionError.
class ElementCurves {
public:
    /// `program` must outlive it.
    ElementCurves(ElementProgram& program, const std::vector<std::string>& axes);

    void start(const AxisPoint& from);
    void require_connected(const AxisPoint& from, double gap_mm) const;

    void add_line(const ElementProgram::Move& move, const AxisPoint& to);
    void add_arc(const ElementProgram::Move& move, const AxisPoint& to, const Vector3& centre, const Vector3& axis,
                 double angle);
    void add_bezier(const ElementProgram::Move& move, const AxisPoint& to, const std::vector<Vector3>& points);
    void add_nurbs(const ElementProgram::Move& move, const AxisPoint& to, const ProgrammedNurbs& nurbs);

private:
    [[nodiscard]] PerAxis<Position> position(const AxisPoint& place) const noexcept;
    void require_reachable(const AxisPoint& to) const;
    void require_still(std::size_t axis, double way) const;
    void require_ends(const Vector3& first, const Vector3& last, const AxisPoint& to) const;
    void add_pieces(const ElementProgram::Move& move, const AxisPoint& to, const std::vector<HermitePiece>& pieces);
    void add_part(const ElementProgram::Move& move, const AxisPoint& start, const AxisPoint& to, const SplinePart& part,
                  bool last);
    void add_piece(ElementProgram::Move move, const AxisPoint& from, const AxisPoint& to, const Vector3* points,
                   std::size_t degree);

    ElementProgram* program_;
    std::vector<std::string> names_;
    std::array<int, 6> index_{}; // of x, y, ... among the machine's axes; -1: it lacks the axis
    bool takes_arcs_ = false;    // the machine's first axes are x, y, z
    AxisPoint here_{};
};

} // namespace splinefeed::host
