// SPDX-License-Identifier: MIT
// TickPart: up to 1024 ticks of a feed segment, in the form that an interrupt can travel by additions alone.
#pragma once

#include "splinefeed/base/capacity.hpp"

#include <cstdint>

namespace splinefeed {

/// The difference table of a cubic at successive ticks, in 2^-62 count and modulo 4 counts; for SampleDda in 2^-60
/// count and modulo 16. Half a count is added to `position`: its highest bits then belong to the count at which the
/// axis stands.
struct DifferenceTable {
    static constexpr int count_shift = 62;

    std::uint64_t position = 0; ///< at the part's first tick
    std::uint64_t first = 0;    ///< difference from there to the next tick
    std::uint64_t second = 0;
    std::uint64_t third = 0;
};

struct TickPart {
    PerAxis<DifferenceTable> table{};
    std::uint32_t ticks = 0; ///< at least one
};

} // namespace splinefeed
