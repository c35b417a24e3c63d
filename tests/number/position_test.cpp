// SPDX-License-Identifier: MIT
//
// Positions: differences and displacements rounded once, independent of the place on the axis.
#include "splinefeed/number/position.hpp"

#include "random_operands.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr std::int64_t highest = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min();

/// offset * 2^exponent rounded half away, saturated; long double holds every float and double, and scaling is exact.
std::int64_t rounded_offset(long double offset, int exponent) {
    const long double whole = std::round(std::ldexp(offset, exponent));
    return whole >= 0x1p63L ? highest : whole < -0x1p63L ? lowest : static_cast<std::int64_t>(whole);
}

template <class S>
void check_displaced(std::int64_t origin, S offset, int unit_log2) {
    std::int64_t step = 0;
    if constexpr (std::same_as<S, Fixed>) {
        step = rounded_offset(static_cast<long double>(offset.raw()), unit_log2 + 40 - 32);
    } else {
        step = rounded_offset(static_cast<long double>(offset), unit_log2 + 40);
    }
    if (displaced(Position{origin}, offset, unit_log2).raw != clamped(static_cast<Int128>(origin) + step)) {
        FAIL_SAMPLE(origin, to_double(offset), unit_log2, step);
    }
}

} // namespace

TEST_CASE("positions compare like numbers", "[number][position]") {
    static_assert(Position{} == Position{0} && Position{-1} < Position{0} && Position{5} > Position{4});
}

TEST_CASE("Fixed distances are rounded shifts", "[number][position]") {
    sampled(samples / 2, [&](Operands& random) {
        const std::int64_t from = random.signed_below(62);
        const std::int64_t to = random.signed_below(62);
        const int unit = random.between(-60, 60);
        const Int128 difference = static_cast<Int128>(to) - from;
        const int right = unit + 40 - 32;
        const std::int64_t expected = right > 0 ? clamped(rounded_quotient(difference, Uint128{1} << right))
                                                : clamped(difference * (Int128{1} << std::min(-right, 60)));
        if (distance<Fixed>(Position{from}, Position{to}, unit).raw() != expected) {
            FAIL_SAMPLE(from, to, unit);
        }
    });
    REQUIRE(distance<Fixed>(Position{1}, Position{4}, -7) == Fixed::from_raw(2));
    REQUIRE(distance<Fixed>(Position{4}, Position{1}, -7) == Fixed::from_raw(-2));
}

TEMPLATE_TEST_CASE("float and double distances are the nearest numbers", "[number][position]", float, double) {
    const auto check = [](std::int64_t from, std::int64_t to, int unit) {
        // A long double has 64 bits: the difference is exact, and the cast is the only rounding.
        const auto exact = std::ldexp(static_cast<long double>(to - from), -40 - unit);
        if (distance<TestType>(Position{from}, Position{to}, unit) != static_cast<TestType>(exact)) {
            FAIL_SAMPLE(from, to, unit, distance<TestType>(Position{from}, Position{to}, unit));
        }
    };
    sampled(samples / 2, [&](Operands& random) {
        check(random.signed_below(62), random.signed_below(62), random.between(-60, 60));
        check(random.signed_below(52), random.signed_below(52), 0);
    });
    // Next to the middle between two floats: ties to even, and a distant last bit breaks the tie
    for (int shift = 0; shift < 38; ++shift) {
        for (std::int64_t significand = (1 << 24) + 1; significand < (1 << 24) + 64; ++significand) {
            const std::int64_t value = significand * (std::int64_t{1} << shift);
            for (const std::int64_t offset : {-1, 0, 1}) {
                check(0, value + offset, 0);
                check(value + offset, 0, 0);
            }
        }
    }
    check(0, highest, 0);
    check(0, lowest, 0);
}

TEMPLATE_TEST_CASE("a distance does not depend on where it is", "[number][position]", float, double, Fixed) {
    Operands random;
    for (int i = 0; i < samples / 4; ++i) {
        const Position from{random.signed_below(40)};
        const Position to{random.signed_below(40)};
        const std::int64_t moved = random.signed_below(52);
        const int unit = random.between(-4, 4);
        if (distance<TestType>(from, to, unit) !=
                distance<TestType>(Position{from.raw + moved}, Position{to.raw + moved}, unit) ||
            distance<TestType>(from, to, unit) != -distance<TestType>(to, from, unit)) {
            FAIL_SAMPLE(from.raw, to.raw, moved, unit);
        }
    }
}

TEMPLATE_TEST_CASE("displacements by float and double are rounded once", "[number][position]", float, double) {
    using Limits = std::numeric_limits<TestType>;
    sampled(samples / 2, [&](Operands& random) {
        check_displaced(random.signed_below(53), static_cast<TestType>(random.real(-40, 22)), 0);
        check_displaced(random.signed64(), static_cast<TestType>(random.real(-90, 90)), random.between(-60, 60));
    });
    for (int k = -2000; k <= 2000; ++k) {
        check_displaced(k, static_cast<TestType>(k) * TestType{0x1p-42}, 0); // quarters: every second one a tie
        check_displaced(k, static_cast<TestType>(k) * TestType{0x1p-28}, -14);
    }
    for (const TestType sign : {TestType{-1}, TestType{1}}) {
        for (const TestType size : {TestType{0}, Limits::denorm_min(), Limits::min(), Limits::max(), TestType{0x1p31},
                                    TestType{0x1p30}, std::nextafter(TestType{0x1p31}, TestType{0})}) {
            for (const int unit : {-60, -1, 0, 1, 60}) {
                check_displaced(7, sign * size, unit);
            }
        }
    }
    for (const int unit : {-60, 0, 60}) {
        REQUIRE(displaced(Position{-1}, Limits::infinity(), unit).raw == highest - 1);
        REQUIRE(displaced(Position{}, -Limits::infinity(), unit).raw == lowest);
        REQUIRE(displaced(Position{}, Limits::quiet_NaN(), unit).raw == highest);
    }
}

TEST_CASE("displacements by Fixed are rounded shifts", "[number][position]") {
    Operands random;
    for (int i = 0; i < samples / 2; ++i) {
        check_displaced(random.signed_below(60), Fixed::from_raw(random.signed64()), random.between(-60, 60));
    }
}

TEMPLATE_TEST_CASE("a displacement undoes a distance", "[number][position]", float, double, Fixed) {
    // Exact as long as the distance has no more digits than the scalar: 24 bits for float
    Operands random;
    for (int i = 0; i < samples / 4; ++i) {
        const Position from{random.signed_below(52)};
        const Position to{from.raw + random.signed_below(24)};
        const int unit = random.between(-15, -8);
        if (displaced(from, distance<TestType>(from, to, unit), unit) != to) {
            FAIL_SAMPLE(from.raw, to.raw, unit);
        }
    }
}

TEST_CASE("scaled positions are rounded to nearest or saturate", "[number][position]") {
    Operands random;
    const auto check = [](std::int64_t raw, std::uint64_t factor, int shift) {
        const Uint128 product = size_of(raw) * factor;
        const Uint128 half = shift > 0 ? Uint128{1} << (shift - 1) : 0U;
        const Uint128 size = (product + half) >> shift;
        const Uint128 limit = (Uint128{1} << 63) - (raw < 0 ? 0U : 1U);
        const auto kept = static_cast<Int128>(size > limit ? limit : size);
        const auto expected = static_cast<std::int64_t>(raw < 0 ? -kept : kept);
        if (scaled(Position{raw}, factor, shift) != expected) {
            FAIL_SAMPLE(raw, factor, shift, expected);
        }
    };
    for (int i = 0; i < samples / 2; ++i) {
        check(random.signed64(), random.unsigned64(), random.between(0, 127));
        check(random.signed_below(53), random.unsigned64() >> 20, 64);
    }
    for (int shift = 0; shift <= 127; ++shift) {
        for (const std::int64_t raw : {lowest, highest, std::int64_t{0}, std::int64_t{1}, std::int64_t{-1}}) {
            for (const std::uint64_t factor : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}}) {
                check(raw, factor, shift);
            }
        }
    }
    // 80 steps per mm: 1.5 steps are 2, in both directions
    const Position p = position_from_mm(1.5 / 80.0);
    REQUIRE(scaled(position_from_mm(0.25), std::uint64_t{80} << 32, 72) == 20);
    REQUIRE(scaled(Position{std::int64_t{3} << 39}, std::uint64_t{1} << 32, 72) == 2);
    REQUIRE(scaled(Position{-(std::int64_t{3} << 39)}, std::uint64_t{1} << 32, 72) == -2);
    REQUIRE(scaled(p, std::uint64_t{80} << 32, 72) == 2);
}

TEST_CASE("positions and micrometres", "[number][position]") {
    STATIC_REQUIRE(position_from_um(1000).raw == std::int64_t{1} << 40);
    STATIC_REQUIRE(position_from_um(-2500).raw == -(std::int64_t{5} << 39));
    sampled(1000, [&](Operands& random) {
        const std::int64_t um = random.signed_below(29);
        const long double wanted = static_cast<long double>(um) * 0x1p40L / 1000.0L;
        REQUIRE(std::fabs(static_cast<long double>(position_from_um(um).raw) - wanted) < 1.01L);
        REQUIRE(position_from_um(-um).raw == -position_from_um(um).raw);
    });
    REQUIRE(position_from_um(8'388'607'999).raw > position_from_um(8'388'607'998).raw);
}

TEST_CASE("positions and millimetres", "[number][position]") {
    REQUIRE(position_from_mm(1.0).raw == std::int64_t{1} << 40);
    REQUIRE(to_mm(Position{-(std::int64_t{5} << 38)}) == -1.25);
    REQUIRE(position_from_mm(0x1p-41).raw == 1);
    REQUIRE(position_from_mm(-0x1p-41).raw == -1);
    sampled(samples / 2, [&](Operands& random) {
        const Position position{random.signed_below(52)};
        if (position_from_mm(to_mm(position)) != position) {
            FAIL_SAMPLE(position.raw);
        }
        const double mm = random.real(-48, 19);
        if (std::fabs(to_mm(position_from_mm(mm)) - mm) > 0x1p-41) {
            FAIL_SAMPLE(mm);
        }
    });
    REQUIRE(position_representable(1048576.0));
    REQUIRE(position_representable(-1048576.0));
    REQUIRE_FALSE(position_representable(std::nextafter(1048576.0, 2e6)));
    REQUIRE_FALSE(position_representable(std::nextafter(-1048576.0, -2e6)));
    REQUIRE_FALSE(position_representable(std::numeric_limits<double>::quiet_NaN()));
}
