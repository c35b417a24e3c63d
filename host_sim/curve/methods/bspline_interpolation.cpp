// SPDX-License-Identifier: MIT
#include "splinefeed/splines/bspline_interpolation.hpp"

#include "host_sim/curve/methods/joint_report.hpp"
#include "host_sim/curve/methods/method_table.hpp"
#include "host_sim/curve/methods/points_input.hpp"
#include "splinefeed/splines/knot_insertion.hpp"
#include "splinefeed/splines/spline_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

using nlohmann::json;

constexpr int warned_degree =
    8; ///< condition for 25 points, docs/explanation/numbers.md: 5 in degree 3, 445 in degree 9

/// What the description asks for.
struct Request {
    PointList list;
    InterpolationKind kind;
    Parameterization how = Parameterization::chordal;
    KnotRule rule = KnotRule::average;
    std::vector<double> parameters; ///< given ones
    std::vector<double> knots;      ///< given ones
    double domain = 1.0;
    PerAxis<double> start{}; ///< derivatives by t
    PerAxis<double> end{};
};

/// An array of numbers under `key`; empty where it is something else.
std::vector<double> given(const json& input, const char* key) {
    const auto found = input.find(key);
    const bool array = found != input.end() && found->is_array();
    return array ? numbers_in(input, key, found->size(), 0.0) : std::vector<double>{};
}

void read_degree(const json& input, Request& request) {
    const std::size_t points = request.list.points.size();
    InterpolationKind& kind = request.kind;
    const int highest =
        kind.closed ? max_degree : static_cast<int>(kind.controls(std::min<std::size_t>(points, 20))) - 1;
    const bool absent = !input.contains("degree") || input["degree"].is_null();
    kind.degree = integer_in(input, "degree", 1, max_degree, std::min(3, highest));
    if (kind.degree > highest) {
        if (!absent && points > 2) {
            throw DescriptionError("\"degree\" is {}; {} points{} determine a curve of degree {} at most", kind.degree,
                                   points, kind.end_derivatives ? " with end tangents" : "", highest);
        }
        kind.degree = highest; // two points: a straight line
    }
    if (kind.end_derivatives && kind.degree < 2) {
        throw DescriptionError("end derivatives need degree 2 at least");
    }
}

Request read_request(const json& input) {
    require_known(input, {"points", "degree", "parameters", "knots", "domain_length", "derivative_start",
                          "derivative_end", "closed"});
    Request request;
    request.list = points_in(input, "points", 2);
    request.kind.closed = flag_in(input, "closed", false);
    const bool start = vector_in(input, "derivative_start", request.list.axes, request.start);
    const bool end = vector_in(input, "derivative_end", request.list.axes, request.end);
    if (start != end) {
        throw DescriptionError("\"derivative_start\" and \"derivative_end\" must both be given, or neither");
    }
    request.kind.end_derivatives = start;
    if (request.kind.closed) {
        if (start) {
            throw DescriptionError("a closed curve has no ends: leave out \"derivative_start\" and \"derivative_end\"");
        }
        drop_repeated_end(request.list);
    }
    read_degree(input, request);
    const std::size_t points = request.list.points.size();
    request.parameters = given(input, "parameters");
    if (request.parameters.empty()) {
        constexpr std::array how{Parameterization::uniform, Parameterization::chordal, Parameterization::chordal,
                                 Parameterization::centripetal};
        request.how = how[choice_in(input, "parameters", {"uniform", "chord", "chordal", "centripetal"}, 1)];
    } else if (request.parameters.size() != points) {
        throw DescriptionError("\"parameters\" has {} numbers; it must have {}, one a point", request.parameters.size(),
                               points);
    }
    request.knots = given(input, "knots");
    const std::size_t needed = request.kind.knots(points);
    if (request.knots.empty()) {
        const KnotRule usual = request.kind.end_derivatives   ? KnotRule::average_tangents
                               : !request.kind.closed         ? KnotRule::average
                               : request.kind.degree % 2 != 0 ? KnotRule::params
                                                              : KnotRule::midpoints;
        request.rule = static_cast<KnotRule>(
            choice_in(input, "knots", {"uniform", "average", "average_tangents", "params", "midpoints"},
                      static_cast<std::size_t>(usual)));
    } else if (request.knots.size() != needed) {
        throw DescriptionError("\"knots\" has {} numbers; degree {} through {} points needs {}", request.knots.size(),
                               request.kind.degree, points, needed);
    }
    const double spans = static_cast<double>(points) - (request.kind.closed ? 0.0 : 1.0);
    const double usual = !request.kind.closed && !request.parameters.empty() ? request.parameters.back() : spans;
    request.domain = number_in(input, "domain_length", usual);
    if (!(request.domain > 0.0)) {
        throw DescriptionError("\"domain_length\" must be greater than 0");
    }
    return request;
}

template <Scalar S>
std::vector<S> in_units(const std::vector<double>& values, double unit) {
    std::vector<S> out;
    for (const double value : values) {
        if (!(std::fabs(value / unit) < 0x1p24)) {
            throw DescriptionError("parameters and knots must lie within the domain");
        }
        out.push_back(from_double<S>(value / unit));
    }
    return out;
}

/// k minus the largest multiplicity of a knot inside the domain: what any data has.
template <Scalar S>
int least_continuity(const std::vector<S>& knots, const InterpolationKind& kind) {
    const auto k = static_cast<std::size_t>(kind.degree);
    std::size_t most = 0;
    std::size_t run = 0;
    const std::size_t first = kind.closed ? k : k + 1U;
    for (std::size_t i = first; i + k + 1U < knots.size(); ++i) {
        run = i > first && knots[i] == knots[i - 1U] ? run + 1U : 1U;
        most = std::max(most, run);
    }
    return kind.degree - static_cast<int>(most);
}

/// Derivative number `order` by t of a piece at its start or end, on one axis.
double derivative_of(PerDegree<double> row, int degree, int order, double span, bool at_end) {
    double factor = 1.0;
    for (int d = 0; d < order; ++d) {
        for (const unsigned i : indices(degree - d)) {
            row[i] = row[i + 1U] - row[i];
        }
        factor *= (degree - d) / span;
    }
    return factor * row[at_end ? static_cast<unsigned>(degree - order) : 0U];
}

/// Whether derivative number `order` by t agrees at a joint, beyond rounding.
bool agrees(const DescribedCurve& curve, std::size_t from, std::size_t to, int order, const Agreement& agreement) {
    const BezierPiece<double>& before = curve.pieces[from];
    const BezierPiece<double>& after = curve.pieces[to];
    const double h0 = curve.intervals[from].to - curve.intervals[from].from;
    const double h1 = curve.intervals[to].to - curve.intervals[to].from;
    double size = 0.0;
    for (const unsigned k : indices(curve.axes)) {
        for (unsigned i = 0; i <= static_cast<unsigned>(before.degree); ++i) {
            size = std::max({size, std::fabs(before.control[k][i]), std::fabs(after.control[k][i])});
        }
    }
    const double noise =
        agreement.rounding * size * std::pow(2.0 * before.degree, order) * std::pow(std::min(h0, h1), -order);
    for (const unsigned k : indices(curve.axes)) {
        const double a = derivative_of(before.control[k], before.degree, order, h0, true);
        const double b = derivative_of(after.control[k], after.degree, order, h1, false);
        if (!(std::fabs(a - b) <= agreement.relative * std::max(std::fabs(a), std::fabs(b)) + noise)) {
            return false;
        }
    }
    return true;
}

/// The number of derivatives by t that agree at all joints: what the knots grant, and more where the data makes it so.
int continuity_order(const DescribedCurve& curve, int least, int degree, const Agreement& agreement) {
    const std::size_t joints = curve.closed ? curve.pieces.size() : curve.pieces.size() - 1U;
    for (int order = least + 1; order <= degree; ++order) {
        for (std::size_t i = 0; i < joints; ++i) {
            if (!agrees(curve, i, (i + 1U) % curve.pieces.size(), order, agreement)) {
                return order - 1;
            }
        }
    }
    return degree;
}

template <Scalar S>
DescribedCurve computed(const Request& request, const Unit<S>& unit, Error& error) {
    const InterpolationKind& kind = request.kind;
    const PointList& list = request.list;
    const std::vector<Point<S>> points = unit.in(list);
    const double t_unit = parameter_unit<S>(request.domain);
    const S domain = from_double<S>(request.domain / t_unit);
    std::vector<S> parameters = in_units<S>(request.parameters, t_unit);
    if (parameters.empty()) {
        parameters.resize(points.size());
        require(spline_parameters<S>(points, list.axes, request.how, kind.closed, domain, parameters));
    }
    std::vector<S> knots = in_units<S>(request.knots, t_unit);
    if (knots.empty()) {
        knots.resize(kind.knots(points.size()));
        require(kind.closed ? closed_knots<S>(request.rule, parameters, kind.degree, domain, knots)
                            : open_knots<S>(request.rule, parameters, kind.degree, kind.end_derivatives, knots));
    }
    const BandShape band = kind.band(points.size());
    std::vector<S> entries(band.entries());
    std::vector<std::uint8_t> interchanges(band.interchanges());
    BsplineInterpolation<S> system;
    require(system.prepare(kind, parameters, knots, entries, interchanges));
    EndDerivatives<S> ends;
    for (const unsigned k : indices(list.axes)) {
        ends.start[k] = unit.in(request.start[k] * t_unit);
        ends.end[k] = unit.in(request.end[k] * t_unit);
    }
    std::vector<Point<S>> controls(kind.controls(points.size()));
    DescribedCurve curve;
    error = system.interpolate(points, kind.end_derivatives ? &ends : nullptr, list.axes, controls).error();
    if (error != Error::none) {
        return curve;
    }
    const std::size_t count = bezier_piece_count<S>(knots, kind.degree);
    std::vector<BezierPiece<S>> pieces(count);
    std::vector<S> breaks(count + 1U);
    require(bezier_pieces<S>(knots, kind.degree, controls, list.axes, kind.closed, pieces, breaks));
    curve.axes = list.axes;
    curve.closed = kind.closed;
    curve.pieces = unit.out(pieces);
    for (std::size_t i = 0; i < count; ++i) {
        curve.intervals.push_back({to_double(breaks[i]) * t_unit, to_double(breaks[i + 1U]) * t_unit});
    }
    curve.results["params"] = out_of_units(parameters, t_unit);
    curve.results["knots"] = out_of_units(knots, t_unit);
    curve.results["control_points"] = to_json(controls, list.axes, unit);
    const bool plain = !kind.closed && !kind.end_derivatives;
    curve.results["schoenberg_whitney_slack"] = plain ? json(to_double(system.slack()) * t_unit) : json(nullptr);
    curve.results["continuity_order_in_t"] =
        continuity_order(curve, least_continuity(knots, kind), kind.degree, agreement_of<S>);
    return curve;
}

template <Scalar S>
DescribedCurve computed(const Request& request) {
    double largest = request.list.largest();
    for (const unsigned k : indices(request.list.axes)) {
        const double reach = std::max(std::fabs(request.start[k]), std::fabs(request.end[k])) * request.domain;
        largest = std::max(largest, reach);
    }
    return in_fitting_unit<S>(largest,
                              [&](const Unit<S>& unit, Error& error) { return computed(request, unit, error); });
}

} // namespace

template <Scalar S>
DescribedCurve describe_bspline_interpolation(const nlohmann::json& input) {
    const Request request = read_request(input);
    DescribedCurve curve = computed<S>(request);
    if (request.kind.degree >= warned_degree) {
        curve.warnings.push_back(fmt::format("degree {} is high: the condition grows with it, and the curve swings "
                                             "between the points; 3 or 5 is usual",
                                             request.kind.degree));
    }
    return curve;
}

nlohmann::json interpolation_input(const CurveChoice& choice, const std::vector<PerAxis<double>>& points, int axes) {
    nlohmann::json input;
    input["closed"] = choice.closed;
    input["points"] = points_json(points, 0, points.size(), axes);
    constexpr std::array<const char*, 3> parameters{"uniform", "chord", "centripetal"};
    input["degree"] = choice.degree;
    input["parameters"] = parameters[static_cast<std::size_t>(choice.parameterization)];
    const bool tangents = choice.start_tangent && choice.end_tangent;
    if (choice.start_tangent.has_value() != choice.end_tangent.has_value()) {
        throw DescriptionError("bspline-interpolation takes both end tangents, or none; give --start-tangent and "
                               "--end-tangent");
    }
    if (choice.knots) {
        input["knots"] = *choice.knots == "uniform" ? "uniform" : tangents ? "average_tangents" : "average";
    } else if (tangents) {
        input["knots"] = "average_tangents";
    } else if (choice.closed) {
        input["knots"] = choice.degree % 2 == 1 ? "params" : "midpoints";
    } else {
        input["knots"] = "average";
    }
    input["derivative_start"] = tangent_json(choice.start_tangent, axes);
    input["derivative_end"] = tangent_json(choice.end_tangent, axes);
    return input;
}

template DescribedCurve describe_bspline_interpolation<double>(const nlohmann::json&);
template DescribedCurve describe_bspline_interpolation<float>(const nlohmann::json&);
template DescribedCurve describe_bspline_interpolation<Fixed>(const nlohmann::json&);

} // namespace splinefeed::host
