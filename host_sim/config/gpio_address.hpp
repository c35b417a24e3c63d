// SPDX-License-Identifier: MIT
// GpioAddress: the address of a GPIO chip in --target.
#pragma once

#include <string>

namespace splinefeed::host {

struct GpioAddress {
    std::string chip; ///< chip of the lines for which the map file names no other: "/dev/gpiochip0", "label=NAME"
    std::string map;  ///< path of the map file
};

/// Whether a target has the form of such an address.
[[nodiscard]] bool is_gpio_address(const std::string& text);

/// Reads gpio:///dev/gpiochip0?map=FILE.toml, or gpio://label=NAME?map=FILE.toml. Throws AddressError. The path cannot
/// contain &.
[[nodiscard]] GpioAddress parse_gpio_address(const std::string& text);

} // namespace splinefeed::host
