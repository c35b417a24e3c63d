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

/// The largest distance of the programmed points between two of them from the line through these, or
/// largest<S>() where they go back along it. `chord` becomes the way between the two. Cost: a root for each point.
template <Scalar S>
[[nodiscard]] S off_line(const ChainPoints<S>& points, std::uint64_t from, std::uint64_t to,
                         PerAxis<S>& chord) noexcept;

} // namespace splinefeed
