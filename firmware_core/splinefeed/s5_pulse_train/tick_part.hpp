// SPDX-License-Identifier: MIT
// TickPart: up to 1024 ticks of a feed segment, for an interrupt that only adds.
#pragma once

#include "splinefeed/base/capacity.hpp"

#include <cstdint>

namespace splinefeed {

/// A cubic at successive ticks, in 2^-62 count and modulo 4 counts: the two highest bits of `position`, which half a
/// count is added to, are those of the count that the axis stands at.
struct DifferenceTable {
    static constexpr int count_shift = 62;

    std::uint64_t position = 0; ///< at the part's first tick
    std::uint64_t first = 0;    ///< from there to the next one
    std::uint64_t second = 0;
    std::uint64_t third = 0;
};

struct TickPart {
    PerAxis<DifferenceTable> table{};
    std::uint32_t ticks = 0; ///< at least one
};

} // namespace splinefeed
