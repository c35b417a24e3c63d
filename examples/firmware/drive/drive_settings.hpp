// SPDX-License-Identifier: MIT
// What the drive is, apart from its board: change this file for yours.
#pragma once

#include "step_generator.hpp"

#include <cstdint>

#ifdef FIRMWARE_BOARD
#include "board.hpp"
#endif

namespace firmware {

inline constexpr unsigned drive_axes = 3;
inline constexpr std::uint8_t drive_unit = 1;

#ifdef FIRMWARE_BOARD
inline constexpr std::uint32_t drive_tick_us = board::tick_us;
inline constexpr std::uint32_t drive_steps_per_s = board::steps_per_s;
inline constexpr std::size_t drive_ring = 4 * board::parts; ///< segments
#else                                                       // tests on a host
inline constexpr std::uint32_t drive_tick_us = 50;
inline constexpr std::uint32_t drive_steps_per_s = 8000;
inline constexpr std::size_t drive_ring = 64;
#endif

/// The motion is computed in slots, each a cubic: where the axes are at its end, on the segments of the host.
inline constexpr std::uint32_t slot_us = 20 * drive_tick_us;
inline constexpr std::uint32_t slot_ticks = slot_us * 8; ///< [1/8 us]
/// Of a quick stop, and of a fault: from the largest speed to standstill in a twentieth of a second.
inline constexpr std::uint32_t drive_stop_steps_s2 = 20 * drive_steps_per_s;

/// So far an axis may go from a limit switch on which a motion began, until it is left.
inline constexpr std::uint32_t drive_leaving_steps = 800;

using DriveSteps = StepGenerator<drive_axes>;
inline constexpr Lookahead no_lookahead{.start = 1, .reserve_log2 = 0, .slew = DriveSteps::full_rate};
inline constexpr std::size_t slots_ahead = 2; ///< in the ring, beside the one that is made: time to answer a request

static_assert(drive_ring >= 16, "docs/reference/pvt_map.md: a ring holds at least 16 segments");
static_assert(drive_ring < 65536);

} // namespace firmware
