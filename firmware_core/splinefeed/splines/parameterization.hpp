// SPDX-License-Identifier: MIT
// Parameterization: how the curve parameter is spaced between the points of a curve.
#pragma once

#include <cstdint>

namespace splinefeed {

/// Spacing of the curve parameter between waypoints: 1, |chord| or sqrt(|chord|).
enum class Parameterization : std::uint8_t { uniform, chordal, centripetal };

} // namespace splinefeed
