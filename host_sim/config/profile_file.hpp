// SPDX-License-Identifier: MIT
// profile_file: reads a drive profile .toml; docs/reference/profiles.md explains every key.
#pragma once

#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

#include <string>
#include <string_view>

namespace splinefeed::host {

/// Reads the file and checks every key. Throws InputError, with the line of the error.
[[nodiscard]] hal::modbus::DriveProfile read_profile_file(const std::string& path);

/// The same for a text; `file` is its name in messages.
[[nodiscard]] hal::modbus::DriveProfile parse_profile(std::string_view text, const std::string& file);

} // namespace splinefeed::host
