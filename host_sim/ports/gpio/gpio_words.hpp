// SPDX-License-Identifier: MIT
// What --help and messages say of the GPIO target, whether this build has it or not.
#pragma once

namespace splinefeed::host {

inline constexpr const char* gpio_names = "gpio:// (docs/reference/gpio.md)";
inline constexpr const char* gpio_help =
    "gpio:///dev/gpiochip0?map=FILE.toml or gpio://label=NAME?map=FILE.toml: step lines";

} // namespace splinefeed::host
