// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/chip_lookup.hpp"

#include "splinefeed/hal/gpio/pin_request.hpp"
#include "support/catch.hpp"

#include <array>

using namespace splinefeed::hal::gpio;

TEST_CASE("a chip is found by its label, whatever its number") {
    const std::array chips{ChipName{"/dev/gpiochip0", "expander"}, ChipName{"/dev/gpiochip4", "pinctrl-bcm2711"},
                           ChipName{"/dev/gpiochip5", "expander"}};
    CHECK(path_of("pinctrl-bcm2711", chips) == "/dev/gpiochip4");
    CHECK_THROWS_WITH(path_of("expander", chips), "/dev/gpiochip0 and /dev/gpiochip5 are both labelled 'expander'; "
                                                  "name the one that is meant by its path");
    CHECK_THROWS_WITH(path_of("pinctrl", std::span(chips).first(2)),
                      "there is no GPIO chip with the label 'pinctrl'; this machine has /dev/gpiochip0 ('expander'), "
                      "/dev/gpiochip4 ('pinctrl-bcm2711')");
    CHECK_THROWS_WITH(path_of("x", {}), "there is no GPIO chip with the label 'x'; this machine has none that may be "
                                        "opened");
}

TEST_CASE("a path is its own, and no label is looked for") {
    CHECK(find_chip("/dev/gpiochip99") == "/dev/gpiochip99");
    CHECK_THROWS_AS(find_chip("label=of no chip here"), GpioError);
    CHECK(names_chip("/dev/gpiochip0"));
    CHECK(names_chip("label=a"));
    CHECK_FALSE(names_chip("/"));
    CHECK_FALSE(names_chip("label="));
    CHECK_FALSE(names_chip("gpiochip0"));
}
