// SPDX-License-Identifier: MIT
// What ferguson makes of points and joints, with storage of its own.
#pragma once

#include "splinefeed/splines/ferguson.hpp"

#include <vector>

namespace splinefeed_test {

using namespace splinefeed;

template <Scalar S>
struct Made {
    Error error = Error::none;
    FergusonReport<S> report;
    std::vector<Point<S>> in;
    std::vector<Point<S>> out;
    std::vector<BezierPiece<S>> pieces;
};

template <Scalar S>
Made<S> make(const std::vector<Point<S>>& points, const std::vector<FergusonJoint<S>>& joints, bool closed = false,
             const Point<S>& start = {}, const Point<S>& end = {}) {
    Made<S> made;
    made.in.resize(points.size());
    made.out.resize(points.size());
    made.pieces.resize(points.size());
    std::vector<CyclicRow<S>> system(joints.size());
    made.error =
        ferguson<S>({points, joints, closed, start, end}, {made.in, made.out, made.pieces, system}, made.report)
            .error();
    made.pieces.resize(made.report.segments);
    return made;
}

} // namespace splinefeed_test
