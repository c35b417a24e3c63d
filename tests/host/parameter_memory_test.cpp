// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/parameter_memory.hpp"

#include "support/catch.hpp"

using namespace splinefeed;
using splinefeed::host::ParameterMemory;

TEST_CASE("Parameters have no value until one is written") {
    ParameterMemory memory;
    Decimal value{7};
    CHECK_FALSE(memory.read(1, value));
    CHECK(memory.write(1, Decimal::from_integer(3)));
    CHECK(memory.read(1, value));
    CHECK(value == Decimal::from_integer(3));
    CHECK_FALSE(memory.write(ParameterMemory::largest_number + 1, value));
    CHECK_FALSE(memory.read(-1, value));
}

TEST_CASE("Names differ neither by case nor by spaces, and their number is bounded") {
    ParameterMemory memory;
    Decimal value;
    CHECK_FALSE(memory.read("depth", value));
    CHECK(memory.write("De pth", Decimal{5}));
    CHECK(memory.read(" dEPTH", value));
    CHECK(value == Decimal{5});
    for (std::size_t i = 1; i < ParameterMemory::most_names; ++i) {
        REQUIRE(memory.write("n" + std::to_string(i), value));
    }
    CHECK_FALSE(memory.write("one_more", value));
    CHECK(memory.write("depth", value));
}
