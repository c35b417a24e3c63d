// SPDX-License-Identifier: MIT
#include "host_sim/curve/methods/joint_report.hpp"
#include "host_sim/curve/methods/method_table.hpp"

#include "splinefeed/splines/catmull_rom_modified.hpp"

#include <cmath>

namespace splinefeed::host {

namespace {

// Classes when every piece has its chord as its interval.
template <Scalar S>
nlohmann::ordered_json joints_in_s(const DescribedCurve& curve, const std::vector<double>& chords) {
    DescribedCurve by_s = curve;
    double s = 0.0;
    for (const double chord : chords) {
        by_s.intervals.push_back({s, s + chord});
        s += chord;
    }
    nlohmann::ordered_json classes = nlohmann::ordered_json::array();
    for (const auto& joint : joint_report(by_s, agreement_of<S>)) {
        classes.push_back(joint["class"]);
    }
    return classes;
}

// As the core has them, in mm.
template <Scalar S>
void require_in_range(double factor, bool chord_mode, const Unit<S>& unit) {
    const double most = chord_mode ? 2.0 : std::same_as<S, Fixed> ? std::ldexp(1.0, 20 + unit.exponent()) : 0x1p20;
    if (factor < 0.0 || factor > most) {
        throw DescriptionError("\"factor\" is {:g}; {} must lie between 0 and {:.10g}{}", factor,
                               chord_mode ? "with \"mode\": \"chord\" it" : "as a constant length it", most,
                               chord_mode ? ""
                               : std::same_as<S, Fixed>
                                   ? " mm in fixed-point numbers with these points; use --scalar double"
                                   : " mm");
    }
}

} // namespace

template <Scalar S>
DescribedCurve describe_catmull_rom_modified(const nlohmann::json& input) {
    DescribedCurve curve;
    require_known(input, {"points", "mode", "factor", "closed"});
    curve.closed = flag_in(input, "closed", false);
    PointList list = points_in(input, "points", 2);
    if (curve.closed) {
        drop_repeated_end(list);
    }
    curve.axes = list.axes;
    const bool chord_mode = choice_in(input, "mode", {"constant", "chord"}, 1) == 1;
    const double factor = chord_mode ? number_in(input, "factor", 1.0) : number_in(input, "factor");
    for (std::size_t i = 0; i + (curve.closed ? 0U : 1U) < list.points.size(); ++i) {
        const std::size_t next = (i + 1) % list.points.size();
        if (list.points.size() > 1 && list.points[i] == list.points[next]) {
            throw DescriptionError("\"points\": points {} and {} are the same; leave one out, the modified "
                                   "curve divides by their distance",
                                   i + 1, next + 1);
        }
    }
    // The largest coordinate becomes 2^17 to 2^18 in Fixed, see farthest_coordinate.
    const Unit<S> unit(list.largest(), 128.0);
    ModifiedTangents<S> tangents;
    tangents.mode = chord_mode ? ChordFactor::chord : ChordFactor::constant;
    require_in_range(factor, chord_mode, unit);
    tangents.factor = chord_mode ? from_double<S>(factor) : unit.in(factor);
    const std::vector<Point<S>> points = unit.in(list);
    std::vector<S> chords(points.size());
    std::vector<Point<S>> derivatives(points.size());
    std::vector<BezierPiece<S>> pieces(points.size());
    const auto segments = modified_catmull_rom<S>(points, curve.closed, tangents, {chords, derivatives, pieces});
    require(segments.error());
    pieces.resize(*segments);
    curve.pieces = unit.out(pieces);
    std::vector<double> lengths;
    for (std::size_t i = 0; i < *segments; ++i) {
        lengths.push_back(unit.out(chords[i]));
    }
    curve.results["chords"] = lengths;
    auto& slopes = curve.results["derivatives_ds"] = nlohmann::ordered_json::array();
    for (const Point<S>& derivative : derivatives) {
        PerAxis<double> slope{};
        for (const unsigned k : indices(list.axes)) {
            slope[k] = to_double(derivative[k]); // mm by mm
        }
        slopes.push_back(to_json(slope, list.axes));
    }
    if (chord_mode) {
        curve.results["joints_in_s"] = joints_in_s<S>(curve, lengths);
    }
    return curve;
}

template DescribedCurve describe_catmull_rom_modified<double>(const nlohmann::json&);
template DescribedCurve describe_catmull_rom_modified<float>(const nlohmann::json&);
template DescribedCurve describe_catmull_rom_modified<Fixed>(const nlohmann::json&);

} // namespace splinefeed::host
