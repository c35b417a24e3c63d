// SPDX-License-Identifier: MIT
// Checks of points that the whole-curve methods make before any arithmetic.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"

#include <cstddef>

namespace splinefeed {

/// Largest coordinate that the whole-curve methods accept, in the unit of the points. It is 2^18 in Fixed, which leaves
/// 2^13 for the factors of a method, and 2^40 in floating point, where squares of chords still fit in a float.
template <Scalar S>
[[nodiscard]] constexpr S farthest_coordinate() noexcept {
    return std::same_as<S, Fixed> ? literal<S>(0x1p18) : literal<S>(0x1p30) * literal<S>(0x1p10);
}

/// Whether |x| <= limit. NaN is not.
template <Scalar S>
[[nodiscard]] constexpr bool within(S x, S limit) noexcept {
    return x >= -limit && x <= limit;
}

/// Index of the first point that is out of range or NaN; points.size() if there is none.
template <Scalar S>
[[nodiscard]] std::size_t first_bad_point(std::span<const Point<S>> points) noexcept;

/// Number of different points of a closed curve: one less if the last point repeats the first.
template <Scalar S>
[[nodiscard]] std::size_t closed_count(std::span<const Point<S>> points) noexcept;

/// to - from, per axis.
template <Scalar S>
[[nodiscard]] Point<S> chord_between(const Point<S>& from, const Point<S>& to) noexcept;

} // namespace splinefeed
