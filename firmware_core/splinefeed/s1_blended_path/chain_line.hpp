// SPDX-License-Identifier: MIT
// Whether the points of a chain are one line.
#pragma once

#include "splinefeed/s1_blended_path/chain_points.hpp"

namespace splinefeed {

/// What rounding may take a point off a line of this length, in chord units: 0.24 nm and some digits of it. The former
/// is half a unit of seven decimals on either side. At most a nanometre, but in float.
template <Scalar S>
[[nodiscard]] S line_rounding(S length) noexcept {
    const S least = literal<S>(0x1p-10);
    if constexpr (std::same_as<S, float>) {
        return least + scale2(length, -22);
    }
    return smaller(literal<S>(0x1p-8), least + scale2(length, -30));
}

/// Whether the programmed points between two of them are on the line through these, to rounding or as near as said, and
/// in order. `off` becomes their largest distance from it; 0: rounding. Cost: a root for each point, up to the first
/// that is not.
template <Scalar S>
[[nodiscard]] bool is_line(const ChainPoints<S>& points, std::uint64_t from, std::uint64_t to, S within,
                           S& off) noexcept;

} // namespace splinefeed
