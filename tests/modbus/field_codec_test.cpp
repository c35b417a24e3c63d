// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/profile/field_codec.hpp"

#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <array>
#include <random>

using namespace splinefeed::hal::modbus;

namespace {

__extension__ using Exact = __int128;

constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();

RegisterField field_with(std::int64_t numerator, std::int64_t denominator, bool inverse = false) {
    RegisterField field;
    field.width_bits = 64;
    field.is_signed = true;
    field.scale_numerator = numerator;
    field.scale_denominator = denominator;
    field.inverse = inverse;
    field.lowest = least;
    field.highest = most;
    return field;
}

// floor(numerator / denominator + 1/2), saturated.
std::int64_t nearest(Exact numerator, Exact denominator) {
    if (denominator < 0) {
        numerator = -numerator;
        denominator = -denominator;
    }
    const Exact whole = numerator / denominator;
    Exact floor = whole - (numerator % denominator < 0 ? 1 : 0);
    const Exact rest = numerator - floor * denominator;
    floor += rest >= denominator - rest ? 1 : 0;
    return floor < least ? least : floor > most ? most : static_cast<std::int64_t>(floor);
}

std::int64_t q16(double physical) {
    return static_cast<std::int64_t>(physical * 65536.0);
}

} // namespace

TEST_CASE("Field codec: scales of real drives") {
    CHECK(raw_of(field_with(1, 1), q16(-12345.0)).raw == -12345);
    CHECK(raw_of(field_with(1, 1), q16(2.5)).raw == 3);
    CHECK(raw_of(field_with(1, 1), q16(-2.5)).raw == -2);
    CHECK(raw_of(field_with(2048, 125), q16(125.0)).raw == 2048);
    const RegisterField ramp = field_with(10'000'000'000, 60, true); // ms per 1000 rpm at 10000 counts a turn
    CHECK(raw_of(ramp, q16(1e6)).raw == 167);                        // 100 turns/s^2
    CHECK(physical_of(ramp, 1000) == nearest(Exact{10'000'000'000} * 65536, 60000));
    CHECK(raw_of(ramp, 0).raw == most);
    CHECK(physical_of(ramp, 0) == most);
}

TEST_CASE("Field codec: values are clamped, and it says so") {
    RegisterField field = field_with(60, 10000);
    field.lowest = 0;
    field.highest = 3000;
    CHECK(raw_of(field, q16(100000.0)).raw == 600);
    CHECK_FALSE(raw_of(field, q16(500000.0)).clamped);
    CHECK(raw_of(field, q16(500000.0)).raw == 3000);
    CHECK(raw_of(field, q16(500100.0)).clamped);
    CHECK(raw_of(field, q16(500100.0)).raw == 3000);
    CHECK(raw_of(field, q16(-100.0)).raw == 0);
    CHECK(raw_of(field, q16(-100.0)).clamped);
    CHECK(raw_of(field_with(most, 1), most).clamped == false); // saturated at the field's own end
    CHECK(raw_of(field_with(most, 1), most).raw == most);
    CHECK(raw_of(field_with(most, 1), least).raw == least);
}

TEST_CASE("Field codec: exact for random scales and values, against 128 bits") {
    const unsigned seed = splinefeed_test::random_seed();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    const auto number = [&random](unsigned bits) { // of any size up to so many bits, with its sign
        const auto value = static_cast<std::int64_t>(random() >> (64U - 1U - random() % bits));
        return random() % 2 == 0 ? value : -value;
    };
    for (int round = 0; round < 20000; ++round) {
        const std::int64_t numerator = number(46) | 1;
        const std::int64_t denominator = std::abs(number(46)) | 1;
        const std::int64_t value = number(62);
        CAPTURE(numerator, denominator, value);
        const RegisterField direct = field_with(numerator, denominator);
        REQUIRE(raw_of(direct, value).raw == nearest(Exact{value} * numerator, Exact{denominator} * 65536));
        REQUIRE(physical_of(direct, value >> 16) ==
                nearest(Exact{value >> 16} * denominator * 65536, Exact{numerator}));
        const RegisterField inverse = field_with(numerator, denominator, true);
        if (value != 0) {
            REQUIRE(raw_of(inverse, value).raw == nearest(Exact{numerator} * 65536, Exact{denominator} * value));
            REQUIRE(physical_of(inverse, value) == nearest(Exact{numerator} * 65536, Exact{denominator} * value));
        }
    }
}

TEST_CASE("Field codec: divisors beyond 2^48 and numbers at the ends") {
    for (const std::int64_t value : {least, least + 1, std::int64_t{-1}, std::int64_t{0}, std::int64_t{1}, most}) {
        for (const std::int64_t denominator : {std::int64_t{1}, std::int64_t{1} << 47, (std::int64_t{1} << 48) - 1,
                                               std::int64_t{1} << 48, (std::int64_t{1} << 50) + 3, most}) {
            CAPTURE(value, denominator);
            const RegisterField field = field_with(3, denominator);
            // By halves: the reference's divisor would not fit 128 bits times the value otherwise.
            CHECK(raw_of(field, value).raw == nearest(Exact{value} * 3, Exact{denominator} * 65536));
        }
    }
}

TEST_CASE("Field codec: word and byte order of every width") {
    RegisterField field = field_with(1, 1);
    std::array<std::uint16_t, 4> registers{};
    const auto put = [&](std::uint8_t width, Significance words, Significance bytes) {
        field.width_bits = width;
        field.word_order = words;
        field.byte_order = bytes;
        registers = {};
        put_raw(field, 0x0123456789ABCDEF, registers);
        return registers;
    };
    using Registers = std::array<std::uint16_t, 4>;
    constexpr Significance high = Significance::high_first;
    constexpr Significance low = Significance::low_first;
    CHECK(put(64, high, high) == Registers{0x0123, 0x4567, 0x89AB, 0xCDEF});
    CHECK(put(64, low, high) == Registers{0xCDEF, 0x89AB, 0x4567, 0x0123});
    CHECK(put(64, high, low) == Registers{0x2301, 0x6745, 0xAB89, 0xEFCD});
    CHECK(put(32, low, low) == Registers{0xEFCD, 0xAB89, 0, 0});
    CHECK(put(32, high, high) == Registers{0x89AB, 0xCDEF, 0, 0});
    CHECK(put(16, low, high) == Registers{0xCDEF, 0, 0, 0});
    for (const std::uint8_t width : {std::uint8_t{16}, std::uint8_t{32}, std::uint8_t{64}}) {
        for (const Significance words : {high, low}) {
            for (const Significance bytes : {high, low}) {
                put(width, words, bytes);
                field.is_signed = true;
                const auto bits = static_cast<unsigned>(64 - width);
                const auto top = static_cast<std::int64_t>(0x0123456789ABCDEFULL << bits);
                CHECK(take_raw(field, registers) == top >> bits);
                field.is_signed = false;
                if (width < 64) {
                    CHECK(take_raw(field, registers) ==
                          static_cast<std::int64_t>((0x0123456789ABCDEFULL << bits) >> bits));
                }
            }
        }
    }
}
