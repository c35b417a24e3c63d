// SPDX-License-Identifier: MIT
// SwitchFacts: what a machine that is served has of switches, and what they may stop it for.
#pragma once

#include <cstdint>
#include <string>

namespace splinefeed::host {

/// What stops a machine, beside the failures of its port.
enum class StopCause : std::uint8_t { none, drive_fault, limit_switch, emergency_stop };

/// What a target has of switches, for the settings that senders ask for. Axes are bits.
struct SwitchFacts {
    std::uint32_t limits = 0;         ///< axes with limit switches
    std::uint32_t homes = UINT32_MAX; ///< that find a reference,
    std::uint32_t homes_low = 0;      ///< at their low end
    bool probe = false;
    std::uint32_t debounce_us = 0;
    double pull_off_mm = 0.0;
    double seek_mm_s = 0.0;  ///< of the slowest axis
    double latch_mm_s = 0.0; ///< likewise
    std::string no_home;     ///< of axes that find none, what would be right; empty: the controller's own sentence
};

} // namespace splinefeed::host
