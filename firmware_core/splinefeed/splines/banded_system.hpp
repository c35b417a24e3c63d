// SPDX-License-Identifier: MIT
// BandedSystem: linear equations in which row i contains only unknowns near i. Factored once and solved for many
// right-hand sides.
//
// Rows and columns are numbered 0 ... size-1. In a cyclic system the unknowns near the last one are next to those near
// the first one. It is folded (order 0, size-1, 1, size-2, ...) into a plain band of twice the width.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"
#include "splinefeed/splines/weight.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace splinefeed {

/// How a system is eliminated.
enum class Elimination : std::uint8_t {
    in_order, ///< no row interchanges: for totally positive systems, for which this is stable (de Boor & Pinkus 1977)
    pivoting, ///< partial pivoting, for all others
};

/// Shape of a system: entry (i, j) may be nonzero if |i - j| <= width; in a cyclic system modulo size.
struct BandShape {
    std::size_t size = 0;
    std::size_t width = 0;
    bool cyclic = false;
    Elimination elimination = Elimination::in_order;

    /// Width of the plain band.
    [[nodiscard]] constexpr std::size_t band() const noexcept {
        const std::size_t folded = cyclic ? 2U * width : width;
        return folded < size ? folded : size - 1U;
    }
    /// Stored entries per row: interchanges add up to `band` entries on the right.
    [[nodiscard]] constexpr std::size_t row_entries() const noexcept {
        return (elimination == Elimination::pivoting ? 3U : 2U) * band() + 1U;
    }
    /// Number of scalars of storage.
    [[nodiscard]] constexpr std::size_t entries() const noexcept { return size * row_entries(); }
    /// Bytes for the row interchanges.
    [[nodiscard]] constexpr std::size_t interchanges() const noexcept {
        return elimination == Elimination::pivoting ? size : 0U;
    }
};

/// The system. Entries are weights (weight.hpp); rows are scaled so that the sum of the magnitudes of their entries is
/// about 1. Cost: factor size * width^2 (in_order) to 8 size * width^2 (cyclic), solve size * width per axis.
template <Scalar S>
class BandedSystem {
public:
    BandedSystem() noexcept = default;
    /// Sets all entries to zero. The storage must outlive the system. width <= 127.
    /// @pre storage sizes as given by the shape, size >= 1
    BandedSystem(const BandShape& shape, std::span<S> entries, std::span<std::uint8_t> interchanges) noexcept;

    /// Adds to entry (row, column). @pre inside the shape, not factored
    void add(std::size_t row, std::size_t column, S weight) noexcept;

    /// Eliminates. Error: system_singular if a pivot is so small that rounding cannot be told from zero. That is below
    /// 2^-44 (double), 2^-18 (float), 2^-32 (Fixed; in Fixed also if a multiplier would exceed 2^15).
    Status factor() noexcept;

    /// Solves in place. values[first + i * stride] is the right-hand side i before, and the unknown i after. Error:
    /// result_out_of_range (not finite; in Fixed beyond 2^28, also for an intermediate result).
    /// @pre factor() succeeded
    [[nodiscard]] Status solve(std::span<Point<S>> values, int axes, std::size_t first = 0,
                               std::size_t stride = 1) const noexcept;

    [[nodiscard]] const BandShape& shape() const noexcept { return shape_; }

private:
    [[nodiscard]] std::size_t folded(std::size_t i) const noexcept;
    [[nodiscard]] std::size_t unfolded(std::size_t i) const noexcept;
    /// Entry of the folded system.
    [[nodiscard]] S& at(std::size_t row, std::size_t column) const noexcept {
        return entries_[row * row_entries_ + column + band_ - row];
    }

    BandShape shape_{};
    std::size_t band_ = 0;
    std::size_t row_entries_ = 0;
    std::size_t reach_ = 0; ///< columns to the right of the diagonal in a row of the factors
    std::span<S> entries_{};
    std::span<std::uint8_t> interchanges_{};
};

} // namespace splinefeed
