// SPDX-License-Identifier: MIT
// GpioAddress: what --target says of a GPIO chip.
#pragma once

#include <string>

namespace splinefeed::host {

struct GpioAddress {
    std::string chip; ///< of the lines for which the map file names no other: "/dev/gpiochip0"
    std::string map;  ///< path of the map file
};

/// Whether a target is meant to be one.
[[nodiscard]] bool is_gpio_address(const std::string& text);

/// gpio:///dev/gpiochip0?map=FILE.toml. Throws AddressError. A path with & in it cannot be given.
[[nodiscard]] GpioAddress parse_gpio_address(const std::string& text);

} // namespace splinefeed::host
