// SPDX-License-Identifier: MIT
#include "host_sim/config/gpio_address.hpp"

#include "host_sim/base/address_text.hpp"
#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/config/drive_address.hpp"
#include "splinefeed/hal/gpio/chip_lookup.hpp"

#include <array>
#include <string_view>

namespace splinefeed::host {

namespace {

constexpr std::string_view example = "gpio:///dev/gpiochip0?map=lines.toml";
constexpr std::string_view labelled = "gpio://label=NAME?map=lines.toml";

} // namespace

bool is_gpio_address(const std::string& text) {
    return split_address(text).scheme == "gpio";
}

GpioAddress parse_gpio_address(const std::string& text) {
    constexpr std::array<std::string_view, 1> keys{"map"};
    if (!is_gpio_address(text)) {
        throw AddressError("{} is no address of a GPIO chip; write {}", in_quotes(text), example);
    }
    const AddressText parts = split_address(text);
    GpioAddress address;
    address.chip = parts.place;
    if (!hal::gpio::names_chip(address.chip)) {
        throw AddressError("the chip is {}; it must be its whole path, with three slashes in all: {}; or its label: {}",
                           in_quotes(address.chip), example, labelled);
    }
    for (const AddressText::Setting& setting : parts.settings) {
        if (setting.key != keys.front()) {
            throw AddressError("unknown key {}{}", in_quotes(setting.key), suggestion(setting.key, keys));
        }
        if (setting.value.empty()) {
            throw AddressError("map has no value; write {}", example);
        }
        if (!address.map.empty()) {
            throw AddressError("there are two maps; give one, in which lines may be of several chips");
        }
        address.map = setting.value;
    }
    if (address.map.empty()) {
        throw AddressError("there is no map, which says what the lines are for; write {}", example);
    }
    return address;
}

} // namespace splinefeed::host
