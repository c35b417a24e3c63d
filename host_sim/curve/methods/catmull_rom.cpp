// SPDX-License-Identifier: MIT
#include "host_sim/curve/methods/method_table.hpp"

#include "splinefeed/splines/catmull_rom_points.hpp"

namespace splinefeed::host {

template <Scalar S>
DescribedCurve describe_catmull_rom(const nlohmann::json& input) {
    DescribedCurve curve;
    require_known(input, {"points", "tension", "closed"});
    curve.closed = flag_in(input, "closed", false);
    PointList list = points_in(input, "points", 2);
    if (curve.closed) {
        drop_repeated_end(list);
    }
    const double tension = number_in(input, "tension", 0.5);
    if (tension < 0.0 || tension > 10.0) {
        require(Error::tension_out_of_range);
    }
    curve.axes = list.axes;
    const Unit<S> unit(list.largest(), 1.0 + 2.0 * tension); // tangents reach 2 m of the largest coordinate
    const std::vector<Point<S>> points = unit.in(list);
    std::vector<Point<S>> tangents(points.size());
    std::vector<BezierPiece<S>> pieces(pieces_through(points.size(), curve.closed));
    require(catmull_rom_points<S>(points, list.axes, curve.closed, from_double<S>(tension), tangents, pieces));
    curve.pieces = unit.out(pieces);
    curve.results["tangents"] = to_json(tangents, list.axes, unit);
    return curve;
}

template DescribedCurve describe_catmull_rom<double>(const nlohmann::json&);
template DescribedCurve describe_catmull_rom<float>(const nlohmann::json&);
template DescribedCurve describe_catmull_rom<Fixed>(const nlohmann::json&);

} // namespace splinefeed::host
