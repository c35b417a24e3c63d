// SPDX-License-Identifier: MIT
// Fault: why the simulated machine stopped.
#pragma once

#include <cstdint>
#include <string>

namespace splinefeed::host {

enum class FaultKind : std::uint8_t {
    chain,    ///< a segment does not start where the last one ended, in position or velocity
    duration, ///< the duration of a segment is zero
    velocity,
    acceleration,
    braking, ///< acceleration against the velocity
    jerk,
    feed, ///< speed along the path
    travel,
    travel_end, ///< too fast near an end of the travel
    underrun,   ///< the queue ran empty in motion
};

/// The name of the kind: "chain", "velocity", ...
[[nodiscard]] const char* fault_name(FaultKind kind) noexcept;

/// The first violation.
struct Fault {
    FaultKind kind{};
    std::string axis;           ///< empty: the path, or the whole machine
    double time_s = 0.0;        ///< since the start of the first segment
    double value = 0.0;         ///< in `unit`; chain: the gap
    double limit = 0.0;         ///< as the machine file states it
    const char* unit = "";      ///< "mm", "mm/s", ...
    std::uint64_t waypoint = 0; ///< index of the nearest waypoint, from 0
    bool rotary = false;        ///< a rotary axis: degrees where the unit says mm
};

/// The fault as one sentence without a full stop.
/// @param place  what it happened near; empty: the waypoint of the fault
[[nodiscard]] std::string describe(const Fault& fault, const std::string& place = {});

} // namespace splinefeed::host
