// SPDX-License-Identifier: MIT
// chip_lookup: finds chips by their label, which stays where a new kernel numbers the chips differently.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace splinefeed::hal::gpio {

/// Before the label of a chip, where another one has its path.
inline constexpr std::string_view label_prefix = "label=";

/// Whether a text names a chip: by its whole path, "/dev/gpiochip0", or by its label, "label=pinctrl-bcm2711".
[[nodiscard]] constexpr bool names_chip(std::string_view chip) noexcept {
    return (chip.size() > 1 && chip.front() == '/') ||
           (chip.starts_with(label_prefix) && chip.size() > label_prefix.size());
}

struct ChipName {
    std::string path;
    std::string label;
};

/// The path of the one chip with that label. Throws GpioError if there is none, or more than one.
[[nodiscard]] std::string path_of(std::string_view label, std::span<const ChipName> chips);

/// The path of a chip: `chip` itself, or that of the chip of this machine with its label. Throws GpioError.
[[nodiscard]] std::string find_chip(const std::string& chip);

} // namespace splinefeed::hal::gpio
