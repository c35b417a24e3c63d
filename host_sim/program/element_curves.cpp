// SPDX-License-Identifier: MIT
#include "host_sim/program/element_curves.hpp"

#include "host_sim/curve/methods/description.hpp"

#include "splinefeed/splines/knot_insertion.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr std::array<const char*, 6> letters{"x", "y", "z", "a", "b", "c"};
constexpr double still_mm = 1e-9;
constexpr double arc_mismatch_mm = 0.01; // of a rounded angle; the end of the element is what counts
constexpr double least_radius_mm = 2e-4;
constexpr double end_gap_mm = 1e-6;
constexpr double core_radius_change_mm = 0.002; // of the core's arcs: what rounding to 3 decimals makes
constexpr double arc_step = 0.4;                // [rad]

constexpr const char* not_followed = "it cannot be followed within 1e-6 mm; check its centre, or its weights and knots";

/// The Bezier pieces of a NURBS, in homogeneous coordinates; `breaks` gets the parameters where they begin and end.
std::vector<BezierPiece<double>> pieces_of(const ProgrammedNurbs& nurbs, std::vector<double>& breaks) {
    const auto degree = static_cast<std::size_t>(nurbs.degree);
    const std::size_t count = nurbs.points.size();
    if (count < degree + 1) {
        throw DescriptionError("there are {} control points; an order of {} needs as many at least", count, degree + 1);
    }
    if (nurbs.weights.size() != count || nurbs.knots.size() != count + degree + 1) {
        throw DescriptionError("there are {} weights and {} knots; {} control points of order {} need {} and {}",
                               nurbs.weights.size(), nurbs.knots.size(), count, degree + 1, count, count + degree + 1);
    }
    const auto [lightest, heaviest] = std::ranges::minmax_element(nurbs.weights);
    if (!(*lightest > 0.0) || *heaviest > 1e6 * *lightest) {
        throw DescriptionError("every weight must be above 0, and the largest at most a million times the smallest");
    }
    if (!std::ranges::is_sorted(nurbs.knots) || !(nurbs.knots[count] > nurbs.knots[degree])) {
        throw DescriptionError(
            "\"knots\" must not decrease, and the curve needs an interval between knots of the middle");
    }
    std::vector<Point<double>> controls(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double weight = nurbs.weights[i] / *heaviest; // exactly 1 if all are equal
        for (std::size_t k = 0; k < 3; ++k) {
            controls[i][k] = nurbs.points[i][k] * weight;
        }
        controls[i][3] = weight;
    }
    std::vector<BezierPiece<double>> pieces(bezier_piece_count<double>(nurbs.knots, nurbs.degree));
    breaks.resize(pieces.size() + 1);
    if (const Status status = bezier_pieces<double>(nurbs.knots, nurbs.degree, controls, 4, false, pieces, breaks);
        !status.ok()) {
        throw DescriptionError(describe(status.error()));
    }
    return pieces;
}

/// A piece as the core takes it: itself if all weights are equal and its degree is at most 5, otherwise quintics.
void add_parts(const BezierPiece<double>& piece, double from, double width, std::vector<SplinePart>& parts) {
    const auto degree = static_cast<std::size_t>(piece.degree);
    const auto* const weights = piece.control[3].begin();
    const bool rational =
        std::any_of(weights, weights + degree + 1, [](double weight) { return std::fabs(weight - 1.0) > 1e-12; });
    if (!rational && degree <= 5) {
        SplinePart& part = parts.emplace_back(SplinePart{degree, from + width, {}});
        for (std::size_t p = 0; p <= degree; ++p) {
            part.points[p] = {piece.control[0][p], piece.control[1][p], piece.control[2][p]};
        }
        return;
    }
    const auto within = [&piece](double t) {
        return rational_state(piece, t);
    };
    const std::vector<HermitePiece> quintics = hermite_pieces(within, {0.0, 1.0}); // alone: a knot may be a kink
    if (quintics.empty()) {
        throw DescriptionError(not_followed);
    }
    for (const HermitePiece& quintic : quintics) {
        parts.push_back({5, from + quintic.to * width, quintic.points});
    }
}

Vector3 linear(const AxisPoint& place) {
    return {place[0], place[1], place[2]};
}

} // namespace

ElementCurves::ElementCurves(ElementProgram& program, const std::vector<std::string>& axes)
    : program_(&program), names_(axes) {
    for (std::size_t j = 0; j < letters.size(); ++j) {
        const auto found = std::ranges::find(axes, letters[j]);
        index_[j] = found == axes.end() ? -1 : static_cast<int>(found - axes.begin());
    }
    const std::size_t first = std::min<std::size_t>(axes.size(), 3);
    takes_arcs_ = axes.size() >= 2;
    for (std::size_t j = 0; j < first; ++j) {
        takes_arcs_ = takes_arcs_ && axes[j] == letters[j];
    }
}

PerAxis<Position> ElementCurves::position(const AxisPoint& place) const noexcept {
    PerAxis<Position> out{};
    for (std::size_t j = 0; j < index_.size(); ++j) {
        if (index_[j] >= 0) {
            out[static_cast<unsigned>(index_[j])] = position_from_mm(place[j]);
        }
    }
    return out;
}

void ElementCurves::start(const AxisPoint& from) {
    here_ = from;
    program_->set_start(position(from));
}

void ElementCurves::require_connected(const AxisPoint& from, double gap_mm) const {
    for (std::size_t j = 0; j < from.size(); ++j) {
        if (std::fabs(from[j] - here_[j]) > gap_mm) {
            throw DescriptionError("it starts at {} {:.9g}, but the element before it ends at {:.9g}; they must meet "
                                   "within {} mm",
                                   letters[j], from[j], here_[j], gap_mm);
        }
    }
}

void ElementCurves::require_still(std::size_t axis, double way) const {
    if (index_[axis] < 0 && way > still_mm) {
        throw DescriptionError("it moves axis {}, and the machine has none; it has {}", letters[axis],
                               fmt::join(names_, ", "));
    }
}

void ElementCurves::require_reachable(const AxisPoint& to) const {
    for (std::size_t j = 0; j < to.size(); ++j) {
        const double way = std::fabs(to[j] - here_[j]);
        require_still(j, way);
        if (way > longest_mm) {
            throw DescriptionError("it moves {} by {:.9g} mm; an element must be at most {} mm long", letters[j], way,
                                   longest_mm);
        }
    }
}

void ElementCurves::require_ends(const Vector3& first, const Vector3& last, const AxisPoint& to) const {
    for (std::size_t j = 0; j < 3; ++j) {
        if (std::fabs(first[j] - here_[j]) > end_gap_mm || std::fabs(last[j] - to[j]) > end_gap_mm) {
            throw DescriptionError(
                "the curve must begin at \"from\" and end at \"to\" within {} mm; it goes from {} {:.9g} "
                "to {:.9g}",
                end_gap_mm, letters[j], first[j], last[j]);
        }
    }
}

void ElementCurves::add_line(const ElementProgram::Move& move, const AxisPoint& to) {
    require_reachable(to);
    ElementProgram::Move line = move;
    line.to = position(to);
    program_->add_line(line);
    here_ = to;
}

void ElementCurves::add_arc(const ElementProgram::Move& move, const AxisPoint& to, const Vector3& centre,
                            const Vector3& axis, double angle) {
    require_reachable(to);
    const double norm = std::hypot(axis[0], axis[1], axis[2]);
    if (!(norm > 1e-6)) {
        throw DescriptionError("\"axis\" has no direction; it must be a vector like [0, 0, 1]");
    }
    const Vector3 normal{axis[0] / norm, axis[1] / norm, axis[2] / norm};
    const ProgrammedArc arc(linear(here_), linear(to), centre, normal, angle);
    const double smaller = std::fmin(arc.radius_from(), arc.radius_to());
    if (smaller < least_radius_mm) {
        throw DescriptionError("its radius is {:.3g} mm; it must be at least {} mm: check \"centre\"", smaller,
                               least_radius_mm);
    }
    if (arc.length() > longest_mm || arc.radius_from() + arc.radius_to() > longest_mm) {
        throw DescriptionError("an arc's length and diameter must be at most {} mm; make it of several, or of lines",
                               longest_mm);
    }
    if (arc.mismatch() > arc_mismatch_mm) {
        throw DescriptionError("\"angle\" {:.9g} ends {:.3g} mm from \"to\"; to end there it would be {:.9g}", angle,
                               arc.mismatch(), arc.angle());
    }
    if (angle == 0.0) {
        throw DescriptionError("\"angle\" is 0: an arc must turn; a full circle has 6.283185307");
    }
    if (std::fabs(arc.angle()) * smaller < least_radius_mm) { // no further from its chord than rounding is
        add_line(move, to);
        return;
    }
    for (std::size_t j = 0; j < 3; ++j) {
        require_still(j, index_[j] < 0 && arc.extent(j) > end_gap_mm ? arc.extent(j) : 0.0);
    }
    const double change = std::fabs(arc.radius_to() - arc.radius_from());
    if (takes_arcs_ && change <= std::fmin(core_radius_change_mm, 0.03 * smaller)) {
        ElementProgram::Move turn = move;
        turn.to = position(to);
        ArcShape<double> shape;
        shape.centre = position({centre[0], centre[1], centre[2], 0.0, 0.0, 0.0});
        shape.normal = normal;
        shape.sweep_rad = arc.angle();
        program_->add_arc(turn, shape);
        here_ = to;
        return;
    }
    const auto steps = static_cast<std::size_t>(std::ceil(std::fabs(arc.angle()) / arc_step));
    std::vector<double> breaks;
    for (std::size_t i = 0; i <= steps; ++i) {
        breaks.push_back(static_cast<double>(i) / static_cast<double>(steps));
    }
    add_pieces(move, to, hermite_pieces([&arc](double w) { return arc.at(w); }, breaks));
}

void ElementCurves::add_bezier(const ElementProgram::Move& move, const AxisPoint& to,
                               const std::vector<Vector3>& points) {
    if (points.size() < 2 || points.size() > 6) {
        throw DescriptionError("there are {} control points; a Bezier segment has 2 to 6 (degree 1 to 5)",
                               points.size());
    }
    require_reachable(to);
    require_ends(points.front(), points.back(), to);
    add_piece(move, here_, to, points.data(), points.size() - 1);
}

void ElementCurves::add_nurbs(const ElementProgram::Move& move, const AxisPoint& to, const ProgrammedNurbs& nurbs) {
    std::vector<double> breaks;
    const std::vector<BezierPiece<double>> pieces = pieces_of(nurbs, breaks);
    require_reachable(to);
    require_ends(rational_state(pieces.front(), 0.0).point, rational_state(pieces.back(), 1.0).point, to);
    const double domain = breaks.back() - breaks.front();
    std::vector<SplinePart> parts;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const double from = (breaks[i] - breaks.front()) / domain;
        add_parts(pieces[i], from, (breaks[i + 1] - breaks[i]) / domain, parts);
    }
    const AxisPoint start = here_;
    for (const SplinePart& part : parts) {
        add_part(move, start, to, part, &part == &parts.back());
    }
}

// The pieces of an arc.
void ElementCurves::add_pieces(const ElementProgram::Move& move, const AxisPoint& to,
                               const std::vector<HermitePiece>& pieces) {
    if (pieces.empty()) {
        throw DescriptionError(not_followed);
    }
    const AxisPoint start = here_;
    for (const HermitePiece& piece : pieces) {
        add_part(move, start, to, {5, piece.to, piece.points}, &piece == &pieces.back());
    }
}

// One of the pieces of an element; the element stops, if at all, at its end.
void ElementCurves::add_part(const ElementProgram::Move& move, const AxisPoint& start, const AxisPoint& to,
                             const SplinePart& part, bool last) {
    AxisPoint end = to;
    for (std::size_t j = 0; j < end.size() && !last; ++j) {
        end[j] = j < 3 ? part.points[part.degree][j] : start[j] + part.to * (to[j] - start[j]);
    }
    ElementProgram::Move piece = move;
    piece.mode = !last && move.mode == PathMode::exact_stop ? PathMode::exact_path : move.mode;
    add_piece(piece, here_, end, part.points.data(), part.degree);
}

void ElementCurves::add_piece(ElementProgram::Move move, const AxisPoint& from, const AxisPoint& to,
                              const Vector3* points, std::size_t degree) {
    BezierShape<double> shape;
    shape.degree = static_cast<int>(degree);
    for (std::size_t j = 0; j < from.size(); ++j) {
        for (std::size_t i = 0; i <= degree; ++i) {
            const double value =
                j < 3 ? points[i][j]
                      : from[j] + static_cast<double>(i) / static_cast<double>(degree) * (to[j] - from[j]);
            const double offset = value - from[j];
            require_still(j, std::fabs(offset) > end_gap_mm ? std::fabs(offset) : 0.0);
            if (std::fabs(offset) > longest_mm) {
                throw DescriptionError("a control point is {:.9g} mm from the start along {}; it must be at most {} mm",
                                       std::fabs(offset), letters[j], longest_mm);
            }
            if (index_[j] >= 0) {
                shape.points[static_cast<unsigned>(index_[j])][static_cast<unsigned>(i)] = offset * chord_units_per_mm;
            }
        }
    }
    move.to = position(to);
    if (degree == 1) {
        program_->add_line(move);
    } else {
        program_->add_bezier(move, shape);
    }
    here_ = to;
}

} // namespace splinefeed::host
