// SPDX-License-Identifier: MIT
// Algebra on arrays with a value for each axis, of which the first `count` are meaningful. The count is chosen at run
// time: operators over the whole capacity would cost a machine with three axes twice the arithmetic.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/base/indices.hpp"
#include "splinefeed/number/position.hpp"

#include <array>
#include <cstddef>
#include <type_traits>

namespace splinefeed {

/// |v|, as norm of the scalar computes it.
template <Numeric N, std::size_t capacity>
[[nodiscard]] constexpr N norm(const std::array<N, capacity>& v, int count) noexcept {
    return norm(v.data(), count);
}

/// a . b, summed in the order of the axes.
template <Numeric N, std::size_t capacity>
[[nodiscard]] constexpr N dot(const std::array<N, capacity>& a, const std::array<N, capacity>& b, int count) noexcept {
    N sum{};
    for (const unsigned k : indices(count)) {
        sum += a[k] * b[k];
    }
    return sum;
}

/// a - b; 0 behind the count.
template <Numeric N, std::size_t capacity>
[[nodiscard]] constexpr std::array<N, capacity> difference(const std::array<N, capacity>& a,
                                                           const std::array<N, capacity>& b, int count) noexcept {
    std::array<N, capacity> out{};
    for (const unsigned k : indices(count)) {
        out[k] = a[k] - b[k];
    }
    return out;
}

/// a + b; 0 behind the count.
template <Numeric N, std::size_t capacity>
[[nodiscard]] constexpr std::array<N, capacity> plus(const std::array<N, capacity>& a, const std::array<N, capacity>& b,
                                                     int count) noexcept {
    std::array<N, capacity> out{};
    for (const unsigned k : indices(count)) {
        out[k] = a[k] + b[k];
    }
    return out;
}

/// v / by, in place.
template <Numeric N, std::size_t capacity>
constexpr void divide(std::array<N, capacity>& v, N by, int count) noexcept {
    for (const unsigned k : indices(count)) {
        v[k] = v[k] / by;
    }
}

/// by v, in place.
template <Numeric N, std::size_t capacity>
constexpr void scale(std::array<N, capacity>& v, N by, int count) noexcept {
    for (const unsigned k : indices(count)) {
        v[k] = by * v[k];
    }
}

/// v + by u, in place.
template <Numeric N, std::size_t capacity>
constexpr void add(std::array<N, capacity>& v, N by, const std::array<N, capacity>& u, int count) noexcept {
    for (const unsigned k : indices(count)) {
        v[k] = v[k] + by * u[k];
    }
}

/// v - by u, in place: with by = v . u of a unit vector u, what of v is across it.
template <Numeric N, std::size_t capacity>
constexpr void subtract(std::array<N, capacity>& v, N by, const std::array<N, capacity>& u, int count) noexcept {
    for (const unsigned k : indices(count)) {
        v[k] = v[k] - by * u[k];
    }
}

/// f(k) for each axis; 0 behind the count.
template <class F>
[[nodiscard]] constexpr auto each(int count, F&& f) noexcept {
    PerAxis<std::remove_cvref_t<decltype(f(0U))>> out{};
    for (const unsigned k : indices(count)) {
        out[k] = f(k);
    }
    return out;
}

/// f(0) + f(1) + ..., in the order of the axes.
template <class F>
[[nodiscard]] constexpr auto sum_of(int count, F&& f) noexcept {
    std::remove_cvref_t<decltype(f(0U))> sum{};
    for (const unsigned k : indices(count)) {
        sum += f(k);
    }
    return sum;
}

/// The largest |v[k]|.
template <Numeric N, std::size_t capacity>
[[nodiscard]] constexpr N largest_size(const std::array<N, capacity>& v, int count) noexcept {
    N most{};
    for (const unsigned k : indices(count)) {
        most = larger(most, absolute(v[k]));
    }
    return most;
}

/// Whether f(k) holds for each axis; it is not asked behind the first for which it does not.
template <class F>
[[nodiscard]] constexpr bool for_all(int count, F&& f) noexcept {
    for (const unsigned k : indices(count)) {
        if (!f(k)) {
            return false;
        }
    }
    return true;
}

/// The same for any axis.
template <class F>
[[nodiscard]] constexpr bool for_any(int count, F&& f) noexcept {
    return !for_all(count, [&f](unsigned k) { return !f(k); });
}

/// distance() of each axis; 0 behind the count.
template <Scalar S>
[[nodiscard]] constexpr PerAxis<S> distances(const PerAxis<Position>& from, const PerAxis<Position>& to, int unit_log2,
                                             int count) noexcept {
    return each(count, [&](unsigned k) { return distance<S>(from[k], to[k], unit_log2); });
}

/// The coordinates in mm, for the host.
[[nodiscard]] constexpr PerAxis<double> to_mm(const PerAxis<Position>& place, int count) noexcept {
    return each(count, [&](unsigned k) { return to_mm(place[k]); });
}

/// The nearest positions, for the host. @pre position_representable() of each
[[nodiscard]] constexpr PerAxis<Position> position_from_mm(const PerAxis<double>& mm, int count) noexcept {
    return each(count, [&](unsigned k) { return position_from_mm(mm[k]); });
}

/// The i-th control point.
template <class Row>
[[nodiscard]] constexpr auto control_at(const PerAxis<Row>& control, unsigned i, int count) noexcept {
    return each(count, [&](unsigned k) { return control[k][i]; });
}

/// From the i-th control point to the j-th one.
template <class Row>
[[nodiscard]] constexpr auto leg(const PerAxis<Row>& control, unsigned i, unsigned j, int count) noexcept {
    return each(count, [&](unsigned k) { return control[k][j] - control[k][i]; });
}

} // namespace splinefeed
