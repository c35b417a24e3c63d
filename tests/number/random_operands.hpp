// SPDX-License-Identifier: MIT
//
// Operands for the tests of the number layer: reproducible random integers of mixed magnitudes, the values next to
// powers of two, and 128 bit arithmetic of the compiler as the reference.
#pragma once

#include "support/catch.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace splinefeed_test {

__extension__ using Int128 = __int128;
__extension__ using Uint128 = unsigned __int128;

/// Printed by every failing test that draws operands.
inline constexpr std::uint64_t seed = 20240611;

/// Reports the operands of a sampled comparison that failed. Only called on failure: a REQUIRE for each of millions of
/// samples would take longer than what it tests.
#define FAIL_SAMPLE(...)                                                                                               \
    do {                                                                                                               \
        CAPTURE(splinefeed_test::seed);                                                                                \
        CAPTURE(__VA_ARGS__);                                                                                          \
        FAIL("sampled comparison");                                                                                    \
    } while (false)

class Operands {
public:
    /// All 64 bits random, then shortened by a random number of bits; now and then with a long run of equal bits.
    std::uint64_t unsigned64() {
        const std::uint64_t control = generator_();
        std::uint64_t value = generator_() >> (control & 63U);
        switch ((control >> 8) & 15U) {
        case 0: value |= (std::uint64_t{1} << ((control >> 16) & 63U)) - 1U; break;
        case 1: value &= ~((std::uint64_t{1} << ((control >> 16) & 63U)) - 1U); break;
        case 2: value = ~value; break;
        case 3: value = (std::uint64_t{1} << ((control >> 16) & 63U)) + ((control >> 24) & 3U) - 2U; break;
        default: break;
        }
        return value;
    }

    std::int64_t signed64() { return static_cast<std::int64_t>(unsigned64()) >> (generator_() & 1U); }

    /// Both signs, at most `bits` bits.
    std::int64_t signed_below(int bits) {
        const auto size = static_cast<std::int64_t>(unsigned64() & ((std::uint64_t{1} << bits) - 1U));
        return (generator_() & 1U) != 0 ? -size : size;
    }

    int between(int lowest, int highest) {
        return lowest + static_cast<int>(generator_() % static_cast<std::uint64_t>(highest - lowest + 1));
    }

    /// Significand random, exponent (of two) in the given range, both signs; short significands now and then.
    double real(int lowest_exponent, int highest_exponent) {
        const std::uint64_t keep = ~std::uint64_t{0} << ((generator_() & 3U) == 0 ? between(11, 63) : 11);
        const auto significand = static_cast<double>(((generator_() | (std::uint64_t{1} << 63)) & keep) >> 11);
        const double size = std::ldexp(significand, between(lowest_exponent, highest_exponent) - 52);
        return (generator_() & 1U) != 0 ? -size : size;
    }

    std::uint64_t bits() { return generator_(); }

private:
    std::mt19937_64 generator_{seed};
};

inline constexpr int samples = 1'000'000;

/// What is checked draws its own operands, the same in each run.
template <class Check>
void sampled(int count, Check check) {
    Operands random;
    for (int i = 0; i < count; ++i) {
        check(random);
    }
}

template <class Values, class Check>
void each_pair(const Values& values, Check check) {
    for (const auto a : values) {
        for (const auto b : values) {
            check(a, b);
        }
    }
}

/// 0, and 2^k - 1, 2^k, 2^k + 1 for all k: every place where a carry or a shift can go wrong.
inline std::vector<std::uint64_t> edges() {
    std::vector<std::uint64_t> values{0U, ~std::uint64_t{0}};
    for (int k = 0; k < 64; ++k) {
        const std::uint64_t power = std::uint64_t{1} << k;
        values.insert(values.end(), {power - 1U, power, power + 1U});
    }
    return values;
}

inline std::vector<std::int64_t> signed_edges() {
    std::vector<std::int64_t> values;
    for (const std::uint64_t value : edges()) {
        values.push_back(static_cast<std::int64_t>(value));
        values.push_back(static_cast<std::int64_t>(0U - value));
    }
    return values;
}

inline Uint128 size_of(Int128 value) {
    return value < 0 ? Uint128{0} - static_cast<Uint128>(value) : static_cast<Uint128>(value);
}

/// The nearest std::int64_t.
inline std::int64_t clamped(Int128 value) {
    constexpr std::int64_t low = std::numeric_limits<std::int64_t>::min();
    constexpr std::int64_t high = std::numeric_limits<std::int64_t>::max();
    return value < low ? low : value > high ? high : static_cast<std::int64_t>(value);
}

/// numerator / denominator rounded to nearest, ties away from zero; denominator > 0.
inline Int128 rounded_quotient(Int128 numerator, Uint128 denominator) {
    const Uint128 size = size_of(numerator);
    const Uint128 rest = size % denominator;
    const Uint128 quotient = size / denominator + (rest >= denominator - rest ? 1U : 0U);
    return numerator < 0 ? -static_cast<Int128>(quotient) : static_cast<Int128>(quotient);
}

/// |actual - exact| in units of the last place of S at the exact value (which must be in the normal range of S).
template <class S>
double error_in_ulp(S actual, long double exact) {
    int exponent = 0;
    static_cast<void>(std::frexp(exact, &exponent));
    const long double ulp = std::ldexp(1.0L, exponent - std::numeric_limits<S>::digits);
    return static_cast<double>(std::fabs(static_cast<long double>(actual) - exact) / ulp);
}

} // namespace splinefeed_test
