// SPDX-License-Identifier: MIT
// Vector: a vector of three-dimensional space, for surfaces and tools.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"

namespace splinefeed::host {

using Vector = Point<double>;

[[nodiscard]] inline double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// a + factor b.
[[nodiscard]] inline Vector plus(const Vector& a, double factor, const Vector& b) {
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

} // namespace splinefeed::host
