// SPDX-License-Identifier: MIT
// Compile-time capacities. The number of axes and the degree are chosen at run time, up to these values. A small target
// lowers them (CMake: SPLINEFEED_MAX_AXES, SPLINEFEED_MAX_DEGREE): every window then needs less memory. See DESIGN.md,
// "Numbers and axes".
#pragma once

#include "splinefeed/base/indices.hpp"

#include <array>

#ifndef SPLINEFEED_MAX_AXES
#define SPLINEFEED_MAX_AXES 6
#endif
#ifndef SPLINEFEED_MAX_DEGREE
#define SPLINEFEED_MAX_DEGREE 9
#endif

namespace splinefeed {

inline constexpr int max_axes = SPLINEFEED_MAX_AXES;     ///< largest number of axes, 1 to 9
inline constexpr int max_degree = SPLINEFEED_MAX_DEGREE; ///< largest degree of a Bezier segment, 3 to 9
inline constexpr auto all_axes = static_cast<unsigned>(max_axes);

static_assert(max_axes >= 1 && max_axes <= 9, "a machine has one to six axes, some have nine");
static_assert(max_degree >= 3 && max_degree <= 9, "the curve methods emit cubics at least, degree 9 at most");

/// One value per axis; only the first `axes` entries are meaningful.
template <class T>
using PerAxis = std::array<T, static_cast<unsigned>(max_axes)>;

/// Bezier points or polynomial coefficients of one axis; the index is 0 to degree.
template <class T>
using PerDegree = std::array<T, static_cast<unsigned>(max_degree) + 1U>;

} // namespace splinefeed
