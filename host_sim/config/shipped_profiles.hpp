// SPDX-License-Identifier: MIT
// shipped_profiles: the drive profiles that are part of the program, and profiles of the user.
#pragma once

#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

#include <span>
#include <string>
#include <string_view>

namespace splinefeed::host {

struct ShippedProfile {
    std::string_view name;
    std::string_view text; ///< the file hal/profiles/NAME.toml
};

/// Sorted by name.
[[nodiscard]] std::span<const ShippedProfile> shipped_profiles() noexcept;

/// The shipped profile with this name, or the file if the name ends in .toml. Throws InputError for an error in the
/// file, and UsageError, with the nearest name, if there is no such profile.
[[nodiscard]] hal::modbus::DriveProfile find_profile(const std::string& name_or_file);

/// The text of `splinefeed drive --list-profiles`: a row per profile with its name, its kind of stream, its wires and
/// its drive.
[[nodiscard]] std::string list_profiles();

} // namespace splinefeed::host
