// SPDX-License-Identifier: MIT
// The sections of a drive profile .toml, for profile_file.cpp. Each throws InputError.
#pragma once

#include "host_sim/base/toml_checker.hpp"
#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

namespace splinefeed::host {

void read_link(const TomlChecker& check, const toml::table& root, hal::modbus::DriveProfile& profile);
/// [[field]] and [[group]]. @pre the link was read
void read_fields(const TomlChecker& check, const toml::table& root, hal::modbus::DriveProfile& profile);
void read_groups(const TomlChecker& check, const toml::table& root, hal::modbus::DriveProfile& profile);
/// Everything that refers to fields: states, commands, motion, watchdog, init, identity, stays_on. @pre fields were
/// read
void read_states(const TomlChecker& check, const toml::table& root, hal::modbus::DriveProfile& profile);
void read_commands(const TomlChecker& check, const toml::table& root, hal::modbus::DriveProfile& profile);
void read_motion(const TomlChecker& check, const toml::table& root, hal::modbus::DriveProfile& profile);
void read_watchdog(const TomlChecker& check, const toml::table& root, hal::modbus::DriveProfile& profile);
void read_init(const TomlChecker& check, const toml::table& root, hal::modbus::DriveProfile& profile);
void read_checks(const TomlChecker& check, const toml::table& root, hal::modbus::DriveProfile& profile);

/// The field that a key names, which must be readable or writable.
enum class FieldUse { read, write };
[[nodiscard]] hal::modbus::FieldIndex named_field(const TomlChecker& check, const toml::node& node,
                                                  std::string_view key, const hal::modbus::DriveProfile& profile,
                                                  FieldUse use);

} // namespace splinefeed::host
