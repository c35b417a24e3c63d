// SPDX-License-Identifier: MIT
// WorkOffsets: where the coordinates of a program lie on the machine. What a state file stores.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/s0_program/text/decimal.hpp"

namespace splinefeed {

/// G54 to G59.3.
inline constexpr int work_systems = 9;

/// One of them.
struct WorkSystem {
    PerAxis<Decimal> origin{}; ///< in machine coordinates [mm or degrees]
    Decimal rotation_deg{};    ///< about Z (G10 L2 R)
};

/// In the axes of the machine, mm and degrees, whatever units the program has.
struct WorkOffsets {
    std::array<WorkSystem, work_systems> systems{};
    int active = 0;           ///< 0: G54
    PerAxis<Decimal> g92{};   ///< G92 and G52, in the rotated system
    bool g92_applies = false; ///< false after G92.1 and G92.2
    PerAxis<Decimal> tool{};  ///< G43, G43.1
    PerAxis<Decimal> g28{};   ///< stored positions, in machine coordinates
    PerAxis<Decimal> g30{};
    std::int32_t tool_number = 0; ///< in the spindle

    friend constexpr bool operator==(const WorkOffsets&, const WorkOffsets&) noexcept = default;
};

constexpr bool operator==(const WorkSystem& a, const WorkSystem& b) noexcept {
    return a.origin == b.origin && a.rotation_deg == b.rotation_deg;
}

} // namespace splinefeed
