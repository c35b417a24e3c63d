// SPDX-License-Identifier: MIT
#include "host_sim/config/gpio_address.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;

TEST_CASE("GPIO address: a chip and the map of its lines") {
    const GpioAddress address = parse_gpio_address("gpio:///dev/gpiochip0?map=lines/mill.toml");
    CHECK(address.chip == "/dev/gpiochip0");
    CHECK(address.map == "lines/mill.toml");
    CHECK(parse_gpio_address("gpio:///dev/gpiochip-a?map=/a=b.toml").map == "/a=b.toml");
    CHECK(parse_gpio_address("gpio://label=pinctrl-bcm2711?map=a.toml").chip == "label=pinctrl-bcm2711");
}
