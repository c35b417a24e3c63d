// SPDX-License-Identifier: MIT
// device_access: devices below /dev, for messages: which there are, and who may open one.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace splinefeed::hal {

/// The devices whose names begin with one of these: "/dev/gpiochip0, /dev/gpiochip1". Empty: there is none.
[[nodiscard]] std::string devices_here(std::initializer_list<std::string_view> prefixes);

/// Which group may open a device, and how to become a member: "group dialout may; ...".
/// @param subsystem, group  the system's names for such devices, for a rule where only root may: "tty", "dialout"
[[nodiscard]] std::string who_may_open(const std::string& path, std::string_view subsystem, std::string_view group);

} // namespace splinefeed::hal
