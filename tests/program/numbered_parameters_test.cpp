// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/text/numbered_parameters.hpp"

#include "support/catch.hpp"

#include <array>

using namespace splinefeed;

TEST_CASE("parameters have no value until one is written, and none again when it is forgotten", "[program]") {
    std::array<Decimal, 3> values{};
    NumberedParameters parameters(values);
    Decimal value{7};
    for (const std::int32_t number : {1, 2, 3}) {
        CHECK_FALSE(parameters.read(number, value));
    }
    CHECK(value == Decimal{7});
    for (const std::int64_t raw : {Decimal::largest_raw, -Decimal::largest_raw, std::int64_t{0}}) {
        CHECK(parameters.write(3, {raw}));
        CHECK((parameters.read(3, value) && value.raw == raw));
    }
    CHECK(parameters.write(1, {1}));
    CHECK_FALSE(parameters.read(2, value));
    parameters.forget(3);
    CHECK_FALSE(parameters.read(3, value));
    CHECK((parameters.read(1, value) && value.raw == 1));
}

TEST_CASE("there is no room for parameters beyond the memory, nor for names", "[program]") {
    std::array<Decimal, 5> memory{};
    NumberedParameters parameters(std::span<Decimal>(memory).subspan(1, 3));
    Decimal value;
    for (const std::int32_t number : {-1, 0, 4, 5602}) {
        CHECK_FALSE(parameters.write(number, {5}));
        CHECK_FALSE(parameters.read(number, value));
        parameters.forget(number);
    }
    CHECK_FALSE(parameters.write("depth", {5}));
    CHECK_FALSE(parameters.read("depth", value));
    parameters.forget("depth");
    CHECK((memory.front() == Decimal{} && memory.back() == Decimal{}));
}
