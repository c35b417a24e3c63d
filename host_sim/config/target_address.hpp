// SPDX-License-Identifier: MIT
// TargetAddress: what --target, `drive = ` in a machine file and --listen say: where a drive is, and what it speaks.
#pragma once

#include "splinefeed/hal/modbus/link/link_address.hpp"

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

namespace splinefeed::host {

/// What is wrong with an address, and what would be right; whoever read it adds where it stands.
struct AddressError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct TargetAddress {
    std::string text; ///< as it was given
    hal::modbus::LinkAddress link;
    std::string profile = "splinefeed-pvt"; ///< a name, or the path of a .toml
    int axis = 0;                           ///< of the drive, where it has several
    bool resample = true; ///< longer segments where the line is too slow for those of the machine file
    /// What a drive whose profile has no register for ramps is set to. [counts/s^2]
    std::optional<double> ramp_counts_s2;
    /// The following error beyond which the drive faults [counts]; 0: none. Without it the drive keeps its own.
    std::optional<std::int64_t> following_window_counts;
    bool states_unit = false; ///< link.unit was given; else the profile's counts, as for the two below
    bool states_baud = false;
    bool states_parity = false;
};

/// modbus-tcp://HOST[:PORT] or modbus-rtu://DEVICE, then ?key=value&...: profile, unit, axis, resample (yes, no), ramp,
/// following_window, of a serial line baud, parity (N, E, O) and stop (1, 2). Throws AddressError.
[[nodiscard]] TargetAddress parse_target_address(const std::string& text);

} // namespace splinefeed::host
