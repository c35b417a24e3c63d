// SPDX-License-Identifier: MIT
// DriveAddress: the address of a drive and its profile, as in --target, `drive = ` of a machine file, and --listen.
#pragma once

#include "host_sim/base/input_error.hpp"
#include "splinefeed/hal/modbus/link/link_address.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace splinefeed::host {

/// What is wrong with an address, and what would be right; the caller adds where the address is.
struct AddressError : TextError {
    using TextError::TextError;
};

struct DriveAddress {
    std::string text; ///< the text as given
    hal::modbus::LinkAddress link;
    std::string profile = "splinefeed-pvt"; ///< a name, or the path of a .toml
    int axis = 0;                           ///< axis within the drive, if it has several
    bool resample = true; ///< true: use longer segments if the line is too slow for those of the machine file
    /// Ramp of a drive whose profile has no register for ramps. [counts/s^2]
    std::optional<double> ramp_counts_s2;
    /// A larger following error is a fault of the drive [counts]; 0: none. Nothing: the drive keeps its own value.
    std::optional<std::int64_t> following_window_counts;
    bool states_unit = false; ///< link.unit was given; otherwise the profile's value counts, and so for the two below
    bool states_baud = false;
    bool states_parity = false;
};

/// Reads modbus-tcp://HOST[:PORT] or modbus-rtu://DEVICE, then ?key=value&...: profile, unit, axis, resample (yes, no),
/// ramp, following_window; for a serial line also baud, parity (N, E, O) and stop (1, 2). Throws AddressError.
[[nodiscard]] DriveAddress parse_drive_address(const std::string& text);

} // namespace splinefeed::host
