// SPDX-License-Identifier: MIT
// BezierPiece: the output of the whole-curve methods: one polynomial piece, in the unit of the input points.
//
// These methods need all points at once and compute in plain scalars, in a unit that the caller chooses. That is mm in
// double and float, and in Fixed a power of two of mm that makes good use of the digits for the largest coordinate. The
// caller owns the storage. The streaming methods are in s1_curve and share the arithmetic of a segment with the
// functions here.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/base/status.hpp"
#include "splinefeed/number/scalar.hpp"

#include <span>

namespace splinefeed {

/// A point, a chord or a derivative: one value per axis.
template <Scalar S>
using Point = PerAxis<S>;

template <Scalar S>
struct BezierPiece {
    int degree = 0;                  ///< 1 to max_degree
    PerAxis<PerDegree<S>> control{}; ///< control[axis][i]: Bezier point i

    /// Bezier point i, 0 to degree.
    [[nodiscard]] Point<S> point(int i) const noexcept {
        Point<S> out{};
        for (const unsigned k : indices(max_axes)) {
            out[k] = control[k][static_cast<unsigned>(i)];
        }
        return out;
    }
    void set_point(int i, const Point<S>& point) noexcept {
        for (const unsigned k : indices(max_axes)) {
            control[k][static_cast<unsigned>(i)] = point[k];
        }
    }
};

} // namespace splinefeed
