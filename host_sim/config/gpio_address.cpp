// SPDX-License-Identifier: MIT
#include "host_sim/config/gpio_address.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/config/target_address.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string_view>

namespace splinefeed::host {

namespace {

constexpr std::string_view scheme = "gpio://";
constexpr std::string_view example = "gpio:///dev/gpiochip0?map=lines.toml";

} // namespace

bool is_gpio_address(const std::string& text) {
    return std::string_view(text).substr(0, scheme.size()) == scheme;
}

GpioAddress parse_gpio_address(const std::string& text) {
    constexpr std::array<std::string_view, 1> keys{"map"};
    std::string_view rest = text;
    if (!is_gpio_address(text)) {
        throw AddressError(fmt::format("{} is no address of a GPIO chip; write {}", in_quotes(text), example));
    }
    rest.remove_prefix(scheme.size());
    const std::size_t query = rest.find('?');
    GpioAddress address;
    address.chip = rest.substr(0, query);
    if (address.chip.size() < 2 || address.chip.front() != '/') {
        throw AddressError(fmt::format("the chip is {}; it must be its whole path, with three slashes in all: {}",
                                       in_quotes(address.chip), example));
    }
    rest.remove_prefix(query == std::string_view::npos ? rest.size() : query + 1);
    while (!rest.empty()) {
        const std::string_view pair = rest.substr(0, rest.find('&'));
        rest.remove_prefix(std::min(rest.size(), pair.size() + 1));
        const std::string_view key = pair.substr(0, pair.find('='));
        if (key != keys.front()) {
            throw AddressError(fmt::format("unknown key {}{}", in_quotes(key), suggestion(key, keys)));
        }
        if (pair.size() < key.size() + 2) {
            throw AddressError(fmt::format("map has no value; write {}", example));
        }
        if (!address.map.empty()) {
            throw AddressError("there are two maps; give one, in which lines may be of several chips");
        }
        address.map = pair.substr(key.size() + 1);
    }
    if (address.map.empty()) {
        throw AddressError(fmt::format("there is no map, which says what the lines are for; write {}", example));
    }
    return address;
}

} // namespace splinefeed::host
