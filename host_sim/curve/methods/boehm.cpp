// SPDX-License-Identifier: MIT
#include "host_sim/curve/methods/method_table.hpp"

#include "splinefeed/splines/boehm.hpp"

namespace splinefeed::host {

template <Scalar S>
DescribedCurve describe_boehm(const nlohmann::json& input) {
    DescribedCurve curve;
    require_known(input, {"vertices", "degree", "closed"});
    curve.closed = flag_in(input, "closed", false);
    const int degree = integer_in(input, "degree", 2, 3, 3);
    const std::size_t fewest = curve.closed ? 3 : static_cast<std::size_t>(degree) + 1;
    PointList list = points_in(input, "vertices", fewest);
    if (curve.closed) {
        drop_repeated_end(list);
    }
    curve.axes = list.axes;
    const Unit<S> unit(list.largest(), 1.0); // nothing leaves the hull of the vertices
    const std::vector<Point<S>> vertices = unit.in(list);
    const std::int64_t count = boehm_pieces(static_cast<std::int64_t>(vertices.size()), degree, curve.closed);
    if (count < 1) {
        throw DescriptionError("\"vertices\" has {} different points; {} need at least {}", vertices.size(),
                               curve.closed ? "closed curves" : "open ones", fewest);
    }
    std::vector<BezierPiece<S>> pieces(static_cast<std::size_t>(count));
    require(boehm<S>(vertices, degree, curve.closed, pieces));
    curve.pieces = unit.out(pieces);
    return curve;
}

template DescribedCurve describe_boehm<double>(const nlohmann::json&);
template DescribedCurve describe_boehm<float>(const nlohmann::json&);
template DescribedCurve describe_boehm<Fixed>(const nlohmann::json&);

} // namespace splinefeed::host
