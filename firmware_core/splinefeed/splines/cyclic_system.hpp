// SPDX-License-Identifier: MIT
// CyclicRow: a row of a tridiagonal linear system, open or closed to a ring, solved by elimination with partial
// pivoting.
//
// Elimination without pivoting is not enough for the systems of splines/ferguson: with curvature signs of -1 a pivot
// can vanish in a perfectly regular system. In step k three rows can contain column k: the row that is carried along,
// the next row, and the last row, which closes the ring. Each of them contains at most two more columns and the last
// two columns.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"

#include <cstddef>

namespace splinefeed {

/// Row i of the system: below x_{i-1} + on x_i + above x_{i+1} = right, with indices modulo n. Afterwards it holds the
/// row of the eliminated system.
template <Scalar S>
struct CyclicRow {
    S below{};
    S on{};
    S above{};
    Point<S> right{};
    // ---- written by solve_cyclic
    std::array<S, 3> window{}; ///< columns k, k+1, k+2 below n-2
    std::array<S, 2> border{}; ///< columns n-2 and n-1
    std::array<S, 3> probe{};  ///< right sides of signs, to estimate the condition
};

template <Scalar S>
struct CyclicReport {
    S condition{};                 ///< lower estimate of the condition (infinity norm); the largest number: singular
    std::size_t weakest = 0;       ///< unknown with the smallest pivot
    bool without_pivoting = false; ///< plain elimination has no negligible pivot; in a ring not computed (false)
};

/// Smallest pivot that counts as regular, for rows scaled to a largest entry in [1, 2). The largest condition that
/// counts as regular is a quarter of its inverse.
template <Scalar S>
[[nodiscard]] constexpr S negligible_pivot() noexcept {
    return std::same_as<S, double>  ? literal<S>(0x1p-16) * literal<S>(0x1p-16) * literal<S>(0x1p-8)
           : std::same_as<S, float> ? literal<S>(0x1p-16)
                                    : literal<S>(0x1p-20);
}

/// Solves for all axes at once, in place; n = rows.size() >= 1 (a ring: 3). In an open system below = 0 in the first
/// row and above = 0 in the last row. In Fixed |right| < 2^28 after its row is scaled, and entries are below 2^11
/// except `on`: 2^18. Errors: system_singular (judged on the system itself: a negligible pivot, or a condition above
/// 1/4 of the inverse of a negligible pivot), result_out_of_range (the solution exceeds 2^24 in Fixed). `report` is
/// filled in either case. Cost: 4 divisions and about 12 + 10 axes products per row.
template <Scalar S>
[[nodiscard]] Status solve_cyclic(std::span<CyclicRow<S>> rows, bool ring, std::span<Point<S>> out,
                                  CyclicReport<S>& report) noexcept;

/// Whether |on| >= |below| + |above| and on != 0 in every row.
template <Scalar S>
[[nodiscard]] bool diagonally_dominant(std::span<const CyclicRow<S>> rows) noexcept;

} // namespace splinefeed
