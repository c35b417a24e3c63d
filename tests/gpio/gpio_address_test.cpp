// SPDX-License-Identifier: MIT
#include "host_sim/config/gpio_address.hpp"

#include "host/refusal.hpp"
#include "host_sim/config/target_address.hpp"
#include "support/catch.hpp"

using namespace splinefeed::host;

namespace {

std::string refusal(const std::string& text) {
    return splinefeed_test::refusal_of<AddressError>([&] { static_cast<void>(parse_gpio_address(text)); });
}

} // namespace

TEST_CASE("GPIO address: a chip and the map of its lines") {
    const GpioAddress address = parse_gpio_address("gpio:///dev/gpiochip0?map=lines/mill.toml");
    CHECK(address.chip == "/dev/gpiochip0");
    CHECK(address.map == "lines/mill.toml");
    CHECK(parse_gpio_address("gpio:///dev/gpiochip-a?map=/a=b.toml").map == "/a=b.toml");
}

TEST_CASE("GPIO address: what is wrong with one, and what would be right") {
    const std::string right = "gpio:///dev/gpiochip0?map=lines.toml";
    CHECK(refusal("modbus-tcp://a") == "'modbus-tcp://a' is no address of a GPIO chip; write " + right);
    CHECK(refusal("gpio:/dev/gpiochip0?map=a") ==
          "'gpio:/dev/gpiochip0?map=a' is no address of a GPIO chip; write " + right);
    CHECK(refusal("gpio://gpiochip0?map=a") ==
          "the chip is 'gpiochip0'; it must be its whole path, with three slashes in all: " + right);
    CHECK(refusal("gpio://?map=a").find("the chip is ''") == 0);
    CHECK(refusal("gpio:///?map=a").find("the chip is '/'") == 0);
    CHECK(refusal("gpio:///dev/gpiochip0") == "there is no map, which says what the lines are for; write " + right);
    CHECK(refusal("gpio:///dev/gpiochip0?").find("there is no map") == 0);
    CHECK(refusal("gpio:///dev/gpiochip0?map=") == "map has no value; write " + right);
    CHECK(refusal("gpio:///dev/gpiochip0?map") == "map has no value; write " + right);
    CHECK(refusal("gpio:///dev/gpiochip0?mpa=a") == "unknown key 'mpa'; did you mean 'map'?");
    CHECK(refusal("gpio:///dev/gpiochip0?map=a&baud=9600") == "unknown key 'baud'; known are map");
    CHECK(refusal("gpio:///dev/gpiochip0?map=a&map=b").find("there are two maps; give one") == 0);
}
