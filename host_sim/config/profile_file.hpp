// SPDX-License-Identifier: MIT
// profile_file: reads a drive profile .toml; docs/reference/profiles.md says what each key means.
#pragma once

#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

#include <string>
#include <string_view>

namespace splinefeed::host {

/// Reads and checks the file, every key of it. Throws InputError, with the line of what is wrong.
[[nodiscard]] hal::modbus::DriveProfile read_profile_file(const std::string& path);

/// The same for a text; `file` is its name in messages.
[[nodiscard]] hal::modbus::DriveProfile parse_profile(std::string_view text, const std::string& file);

} // namespace splinefeed::host
