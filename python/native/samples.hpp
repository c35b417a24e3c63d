// SPDX-License-Identifier: MIT
// sample_motion: position and derivatives of a motion at any times, from its segments' polynomials.
#pragma once

#include "host_sim/run/kept_motion.hpp"

#include <span>

namespace splinefeed::python {

/// Where the values go: rows of one number an axis, one row a time.
struct SampleRows {
    double* position = nullptr;     ///< [mm]
    double* velocity = nullptr;     ///< [mm/s]
    double* acceleration = nullptr; ///< [mm/s^2]
    double* jerk = nullptr;         ///< [mm/s^3]
};

/// Where two segments meet the values are those of the second. Behind the end the machine stands. Exact to the rounding
/// of a double. Cost: 15 ns a time and axis where the times go up.
/// @pre there is a segment, and times are not negative [s]
/// @param mm_per_unit  of each axis
void sample_motion(const host::KeptMotion& motion, std::span<const double> mm_per_unit, std::span<const double> times,
                   const SampleRows& out);

} // namespace splinefeed::python
