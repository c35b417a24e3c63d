// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/words/plane_vector.hpp"

#include "splinefeed/number/wide_root.hpp"

#include <bit>

namespace splinefeed {

namespace {

constexpr Decimal least_miss{Decimal::one / 10'000'000};

std::uint64_t unsigned_raw(Decimal value) noexcept {
    return detail::magnitude(value.raw);
}

// sqrt(a^2 - b^2), by factors: no digit is lost where both are close. False: b is the larger one.
bool other_leg(Decimal a, Decimal b, Decimal& out) noexcept {
    const auto difference = static_cast<std::int64_t>(unsigned_raw(a)) - static_cast<std::int64_t>(unsigned_raw(b));
    if (difference < -least_miss.raw) {
        return false;
    }
    out = {};
    if (difference > 0) {
        out.raw = static_cast<std::int64_t>(
            square_root_rounded(multiply(static_cast<std::uint64_t>(difference), unsigned_raw(a) + unsigned_raw(b))));
    }
    return true;
}

} // namespace

PlaneDirection plane_direction(PlanePoint from, PlanePoint to) noexcept {
    const Decimal x = to.first - from.first;
    const Decimal y = to.second - from.second;
    const std::uint64_t larger = unsigned_raw(x) > unsigned_raw(y) ? unsigned_raw(x) : unsigned_raw(y);
    if (larger == 0) {
        return {sine_one, 0};
    }
    const int shift = std::countl_zero(larger) - 6; // to a length with as many digits as it can have
    const Decimal a{x.raw << shift};
    const Decimal b{y.raw << shift};
    const auto length = static_cast<std::uint64_t>(hypotenuse(a, b).raw);
    constexpr std::int64_t unit = sine_one;
    return {product_quotient(a.raw, unit, length).raw, product_quotient(b.raw, unit, length).raw};
}

Decimal plane_distance(PlanePoint a, PlanePoint b) noexcept {
    return hypotenuse(b.first - a.first, b.second - a.second);
}

PlanePoint moved(PlanePoint point, PlaneDirection u, Decimal by) noexcept {
    return {point.first + turned(by, u.first), point.second + turned(by, u.second)};
}

Decimal along(PlanePoint from, PlanePoint to, PlaneDirection u) noexcept {
    return turned(to.first - from.first, u.first) + turned(to.second - from.second, u.second);
}

SineCosine angle_between(PlaneDirection a, PlaneDirection b) noexcept {
    const auto product = [](std::int64_t x, std::int64_t y) {
        return turned(Decimal{x}, y).raw;
    };
    return {product(a.first, b.second) - product(a.second, b.first),
            product(a.first, b.first) + product(a.second, b.second)};
}

bool cross_line(PlanePoint point, PlaneDirection u, PlanePoint centre, Decimal radius, Crossing which,
                PlanePoint& out) noexcept {
    Decimal half{};
    if (!other_leg(radius, along(point, centre, quarter_turned(u, 1)), half)) {
        return false;
    }
    out = moved(point, u, along(point, centre, u) + (which == Crossing::leaves ? half : -half));
    return true;
}

bool cross_circle(PlanePoint centre, Decimal radius, int turn, PlanePoint other, Decimal other_radius, Crossing which,
                  PlanePoint& out) noexcept {
    const Decimal apart = plane_distance(centre, other);
    if (apart.raw == 0) {
        return false;
    }
    const detail::Checked share = product_quotient((radius - other_radius).raw, (radius + other_radius).raw,
                                                   static_cast<std::uint64_t>(apart.raw) * 2);
    if (!share.fits || detail::magnitude(share.raw) > static_cast<std::uint64_t>(Decimal::largest_raw)) {
        return false;
    }
    const Decimal foot{share.raw + apart.raw / 2};
    Decimal half{};
    if (!other_leg(radius, foot, half)) {
        return false;
    }
    const PlaneDirection u = plane_direction(centre, other);
    const bool to_left = (turn > 0) == (which == Crossing::leaves);
    out = moved(moved(centre, u, foot), quarter_turned(u, to_left ? 1 : -1), half);
    return true;
}

} // namespace splinefeed
