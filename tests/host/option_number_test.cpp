// SPDX-License-Identifier: MIT
#include "host_sim/base/option_number.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;

TEST_CASE("The number of an option: from its lowest to its highest value, both included") {
    CHECK(read_option_number("--ring", "-1.5", -1.5, 64.0) == -1.5);
    CHECK(read_option_number("--ring", "+6.4e1", -1.5, 64.0) == 64.0);
    CHECK(read_option_integer("--axes", "1", 1, 6) == 1);
    CHECK(read_option_integer("--axes", "6.0", 1, 6) == 6);
}
