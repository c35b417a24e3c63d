// SPDX-License-Identifier: MIT
#include "host_sim/base/address_text.hpp"
#include "support/catch.hpp"

using splinefeed::host::AddressText;
using splinefeed::host::split_address;

TEST_CASE("Address text: scheme, place and settings, as they are written") {
    const AddressText address = split_address("rtu:///dev/ttyUSB0?baud=9600&parity=N&map=a=b");
    CHECK(address.scheme == "rtu");
    CHECK(address.place == "/dev/ttyUSB0");
    CHECK(address.rest == "/dev/ttyUSB0?baud=9600&parity=N&map=a=b");
    REQUIRE(address.settings.size() == 3);
    CHECK(address.settings[0].key == "baud");
    CHECK(address.settings[0].value == "9600");
    CHECK(address.settings[1].text == "parity=N");
    CHECK(address.settings[2].key == "map");
    CHECK(address.settings[2].value == "a=b");
}

TEST_CASE("Address text: parts that are not there are empty") {
    CHECK(split_address("").place.empty());
    CHECK(split_address("drive:502").scheme.empty());
    CHECK(split_address("drive:502").place == "drive:502");
    CHECK(split_address("tcp://").scheme == "tcp");
    CHECK(split_address("tcp://").place.empty());
    CHECK(split_address("tcp://h?").settings.empty());
    const AddressText address = split_address("tcp://h?unit&&baud=");
    REQUIRE(address.settings.size() == 3);
    CHECK(address.settings[0].key == "unit");
    CHECK(address.settings[0].value.empty());
    CHECK(address.settings[1].text.empty());
    CHECK(address.settings[2].key == "baud");
    CHECK(address.settings[2].value.empty());
}
