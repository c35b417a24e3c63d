// SPDX-License-Identifier: MIT
// shipped_profiles: the drive profiles that are part of the program, and those that a user writes.
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

/// In order of their names.
[[nodiscard]] std::span<const ShippedProfile> shipped_profiles() noexcept;

/// The shipped profile of that name, or where it ends in .toml the file. Throws InputError for what is wrong in it, and
/// UsageError where there is no such profile, with the nearest name.
[[nodiscard]] hal::modbus::DriveProfile find_profile(const std::string& name_or_file);

/// What `splinefeed drive --list-profiles` prints: a row for each with its name, how it streams, its wires, its drive.
[[nodiscard]] std::string list_profiles();

} // namespace splinefeed::host
