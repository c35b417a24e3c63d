// SPDX-License-Identifier: MIT
// plane_vector: points and directions of a plane, by integers.
#pragma once

#include "splinefeed/s0_program/text/elementary.hpp"

namespace splinefeed {

/// By its normal: x (G19), y (G18), z (G17).
enum class Plane : std::uint8_t { yz, zx, xy };

/// A point of a plane: its first and its second axis, by the right-hand rule (X Y, Z X, Y Z).
struct PlanePoint {
    Decimal first{};
    Decimal second{};

    friend constexpr bool operator==(const PlanePoint&, const PlanePoint&) noexcept = default;
};

/// A unit vector, in units of 2^-62; error below 2^-56.
struct PlaneDirection {
    std::int64_t first = 0;
    std::int64_t second = 0;

    [[nodiscard]] constexpr PlaneDirection operator-() const noexcept { return {-first, -second}; }
};

/// Turned by a quarter to the left (1) or to the right (-1).
[[nodiscard]] constexpr PlaneDirection quarter_turned(PlaneDirection u, int side) noexcept {
    return side > 0 ? PlaneDirection{-u.second, u.first} : PlaneDirection{u.second, -u.first};
}

/// From one point to another; (1, 0) where they are the same. @pre both are positions
[[nodiscard]] PlaneDirection plane_direction(PlanePoint from, PlanePoint to) noexcept;

[[nodiscard]] Decimal plane_distance(PlanePoint a, PlanePoint b) noexcept;

/// `point` moved along `u`.
[[nodiscard]] PlanePoint moved(PlanePoint point, PlaneDirection u, Decimal by) noexcept;

/// How far `to` lies from `from` along `u`; negative: behind it.
[[nodiscard]] Decimal along(PlanePoint from, PlanePoint to, PlaneDirection u) noexcept;

/// Cosine and sine of the angle from `a` to `b`, in units of 2^-62.
[[nodiscard]] SineCosine angle_between(PlaneDirection a, PlaneDirection b) noexcept;

/// Which of the two points where a way crosses a circle.
enum class Crossing : std::uint8_t { enters, leaves };

/// Where the line through `point` along `u` crosses a circle. A line that misses it by less than 1e-7 mm touches it.
/// False: it misses it.
[[nodiscard]] bool cross_line(PlanePoint point, PlaneDirection u, PlanePoint centre, Decimal radius, Crossing which,
                              PlanePoint& out) noexcept;

/// The same for a circle that is travelled to the left (1) or to the right (-1).
[[nodiscard]] bool cross_circle(PlanePoint centre, Decimal radius, int turn, PlanePoint other, Decimal other_radius,
                                Crossing which, PlanePoint& out) noexcept;

} // namespace splinefeed
