// SPDX-License-Identifier: MIT
// AxisPoints: bounds of an axis's derivatives over a cell.
#pragma once

#include "splinefeed/s3_feed_plan/jerk_optimal/jerk_cell.hpp"

namespace splinefeed {

/// Derivatives of an axis as Bezier points over the cell, in the direction of travel. q' is the cubic through its
/// values and slopes at both ends; the others are its derivatives.
struct AxisPoints {
    double first[4];
    double second[3];
    double third[2];

    AxisPoints(const AxisEnd& entry, const AxisEnd& exit, double direction, double length_mm,
               double per_length) noexcept {
        const double step = length_mm * (1.0 / 3.0);
        first[0] = direction * entry.first;
        first[3] = direction * exit.first;
        first[1] = first[0] + step * entry.second;
        first[2] = first[3] - step * exit.second;
        second[0] = entry.second;
        second[1] = 3.0 * per_length * (first[2] - first[1]);
        second[2] = exit.second;
        third[0] = 2.0 * per_length * (second[1] - second[0]);
        third[1] = 2.0 * per_length * (second[2] - second[1]);
    }
};

} // namespace splinefeed
