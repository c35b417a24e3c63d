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

TEST_CASE("A call has its own #1 to #30 and names, and shares the rest") {
    ParameterMemory memory;
    memory.write(1, Decimal{1});
    memory.write(31, Decimal{31});
    memory.write("local", Decimal{2});
    memory.write("_global", Decimal{3});
    memory.enter({Decimal{10}, Decimal{20}});
    Decimal value;
    CHECK((memory.read(1, value) && value == Decimal{10}));
    CHECK((memory.read(2, value) && value == Decimal{20}));
    CHECK((memory.read(3, value) && value == Decimal{}));
    CHECK((memory.read(31, value) && value == Decimal{31}));
    CHECK_FALSE(memory.read("local", value));
    CHECK((memory.read("_GLOBAL", value) && value == Decimal{3}));
    memory.write("_global", Decimal{4});
    memory.write(31, Decimal{32});
    memory.leave();
    CHECK((memory.read(1, value) && value == Decimal{1}));
    CHECK_FALSE(memory.read(2, value));
    CHECK((memory.read(31, value) && value == Decimal{32}));
    CHECK((memory.read("local", value) && value == Decimal{2}));
    CHECK((memory.read("_global", value) && value == Decimal{4}));
}
