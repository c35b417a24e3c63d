// SPDX-License-Identifier: MIT
// FanucFault: why words of coordinates are not understood as they stand.
#pragma once

#include <cstdint>

namespace splinefeed {

/// Why ProgramError::coordinates_unsuited.
enum class FanucFault : std::uint8_t {
    none,
    system_number,
    rotation_angle,
    rotation_centre,
    rotation_step,
    rotation_again,
    scale_factor,
    scale_parts,
    order,
    mirror_axes,
    local_step,
    origin_word,
    with_turned,
    scaled_cycle,
    mirrored_side,
    place_unstated,
    step_behind_end,
    dwell_point,
};
/// One sentence. It names no option of a host.
[[nodiscard]] const char* describe(FanucFault fault) noexcept;

} // namespace splinefeed
