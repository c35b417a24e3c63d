// SPDX-License-Identifier: MIT
// change_setting: a `$` setting of a machine that keeps them.
#pragma once

#include "splinefeed/controller/setting_list.hpp"

namespace splinefeed {

enum class SettingFault : std::uint8_t {
    none,
    unknown,      ///< there is no such number
    fixed,        ///< nothing sets it
    out_of_range, ///< of what the number may be
    absent,       ///< the machine has nothing for it
};

/// As many numbers may be kept, whatever axes a machine has.
inline constexpr std::size_t most_kept_settings = 49;
/// The i-th of them. @pre i < most_kept_settings
[[nodiscard]] std::int32_t kept_setting(std::size_t i) noexcept;

/// Sets the number. A velocity also makes the limit along the path that of the fastest axis, as grbl has it. Not for
/// motion: its arithmetic is in double. After a fault the settings are of no use.
[[nodiscard]] SettingFault change_setting(std::int32_t number, Decimal value, ControllerSettings& settings,
                                          SenderSettings& sender) noexcept;
/// The limit along the path that of the fastest axis, of a linear one where there is one.
void limit_path_by_axes(ControllerSettings& settings) noexcept;
/// Writes what would be right. @pre there is a fault
void explain(SettingFault fault, std::int32_t number, AnswerText& out) noexcept;

} // namespace splinefeed
