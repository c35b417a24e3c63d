// SPDX-License-Identifier: MIT
// AxisStop: brings each axis to standstill by itself, as hard as it can: off the path.
#pragma once

#include "drive/path_motion.hpp"

namespace firmware {

/// The next slot of a stop: each velocity falls by the same amount, to 0.
[[nodiscard]] constexpr AxisPlaces stopped_slot(const AxisPlaces& from) noexcept {
    constexpr std::int64_t microseconds = 1'000'000;
    constexpr std::int64_t change =
        splinefeed::units_per_count * drive_stop_steps_s2 / microseconds * slot_us / microseconds * slot_us;
    AxisPlaces to = from;
    for (unsigned k = 0; k < drive_axes; ++k) {
        const std::int64_t v = from.velocity[k];
        to.velocity[k] = v > change ? v - change : v < -change ? v + change : 0;
        to.position[k] += (v + to.velocity[k]) / 2;
    }
    return to;
}

[[nodiscard]] constexpr bool stands(const AxisPlaces& places) noexcept {
    for (unsigned k = 0; k < drive_axes; ++k) {
        if (places.velocity[k] != 0) {
            return false;
        }
    }
    return true;
}

} // namespace firmware
