// SPDX-License-Identifier: MIT
//
// The arithmetic of Fixed as processors of 32 bits compute it, against exact 128 bit arithmetic.
#include "splinefeed/number/raw.hpp"

#include "random_operands.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

void check_short_product(std::int64_t a, std::int64_t b) {
    const std::int64_t limit = std::int64_t{1} << 47;
    const bool both = a >= -limit && a < limit && b >= -limit && b < limit;
    if (detail::both_short(a, b) != both) {
        FAIL_SAMPLE(a, b);
    }
    if (both) {
        const Int128 exact = rounded_quotient(static_cast<Int128>(a) * b, Uint128{1} << 32);
        if (detail::short_product(a, b) != exact || detail::short_product_of_halves(a, b) != exact) {
            FAIL_SAMPLE(a, b);
        }
    }
}

void check_quotient(std::int64_t a, std::int64_t b) {
    if (detail::quotient_overflows(detail::magnitude(a), detail::magnitude(b))) {
        return;
    }
    const detail::Checked wide = detail::checked_quotient(a, b);
    if (detail::quotient_vanishes(detail::magnitude(a), detail::magnitude(b)) && wide.raw != 0) {
        FAIL_SAMPLE(a, b);
    }
    const detail::Checked digits = detail::quotient_of_digits(a, b, detail::Divisor(detail::magnitude(b)));
    if (wide.raw != digits.raw || wide.fits != digits.fits) {
        FAIL_SAMPLE(a, b);
    }
}

void check_sum(std::int64_t a, std::int64_t b) {
    if (detail::sum(a, b) != clamped(static_cast<Int128>(a) + b) ||
        detail::difference(a, b) != clamped(static_cast<Int128>(a) - b)) {
        FAIL_SAMPLE(a, b);
    }
}

template <int exponent>
void check_shift(std::int64_t value) {
    const std::int64_t expected = detail::checked_shift(value, exponent).raw;
    if (detail::shifted(value, exponent) != expected || detail::any_shift(value, exponent) != expected) {
        FAIL_SAMPLE(value, exponent);
    }
    if constexpr (exponent < 0 && exponent >= -31) {
        if (detail::halved(value, -exponent) != expected) {
            FAIL_SAMPLE(value, exponent);
        }
    }
}

void check_shifts(std::int64_t value) {
    check_shift<-80>(value);
    check_shift<-32>(value);
    check_shift<-31>(value);
    check_shift<-30>(value);
    check_shift<-17>(value);
    check_shift<-12>(value);
    check_shift<-6>(value);
    check_shift<-5>(value);
    check_shift<-2>(value);
    check_shift<-1>(value);
    check_shift<0>(value);
    check_shift<1>(value);
    check_shift<4>(value);
    check_shift<6>(value);
    check_shift<12>(value);
    check_shift<29>(value);
    check_shift<30>(value);
    check_shift<31>(value);
    check_shift<32>(value);
    check_shift<80>(value);
}

} // namespace

TEST_CASE("short products", "[number][raw]") {
    each_pair(signed_edges(), check_short_product);
    for (std::int64_t a = -300; a <= 300; ++a) {
        for (std::int64_t b = -300; b <= 300; ++b) { // every tie
            check_short_product(a * (1 << 16), b * (1 << 15));
            check_short_product(a * (1 << 16), b * (1 << 14));
        }
    }
    Operands random;
    for (int i = 0; i < samples; ++i) {
        check_short_product(random.signed_below(47), random.signed_below(47));
        check_short_product(random.signed_below(34), random.signed_below(46));
        check_short_product(random.signed64(), random.signed64());
    }
}

TEST_CASE("quotients by digits", "[number][raw]") {
    each_pair(signed_edges(), check_quotient);
    for (std::int64_t a = -200; a <= 200; ++a) {
        for (std::int64_t b = -200; b <= 200; ++b) { // every tie
            check_quotient(a, b * (std::int64_t{1} << 33));
            check_quotient(a, b);
        }
    }
    Operands random;
    for (int i = 0; i < samples; ++i) {
        check_quotient(random.signed64(), random.signed64());
        check_quotient(random.signed_below(50), random.signed_below(48));
        check_quotient(random.signed_below(32), random.signed_below(63));
    }
}

TEST_CASE("sums saturate", "[number][raw]") {
    each_pair(signed_edges(), check_sum);
    Operands random;
    for (int i = 0; i < samples; ++i) {
        check_sum(random.signed64(), random.signed64());
    }
}

TEST_CASE("shifts by constants", "[number][raw]") {
    for (const std::int64_t value : signed_edges()) {
        check_shifts(value);
    }
    sampled(samples / 4, [&](Operands& random) { check_shifts(random.signed64()); });
}
