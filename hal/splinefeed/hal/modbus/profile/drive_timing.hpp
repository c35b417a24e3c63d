// SPDX-License-Identifier: MIT
// drive_timing: the line timing that a drive's profile requires.
#pragma once

#include "splinefeed/hal/modbus/link/link_address.hpp"
#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

namespace splinefeed::hal::modbus {

/// Timing that the drive requires of its wire.
[[nodiscard]] constexpr LinkTiming timing_of(const LinkSettings& link) noexcept {
    return {link.response_timeout_us + link.turnaround_us, link.silence_before_us + link.silence_after_us,
            link.retries};
}

} // namespace splinefeed::hal::modbus
