// SPDX-License-Identifier: MIT
// BandedSystem: linear equations whose row i concerns the unknowns near i only, factored once and solved for many
// right-hand sides.
//
// Row and column i are numbered 0 ... size-1. In a cyclic system the unknowns near the last are those near the first;
// it is folded (0, size-1, 1, size-2, ...), which makes a plain band of twice the width of it.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"
#include "splinefeed/splines/weight.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace splinefeed {

/// How a system is eliminated.
enum class Elimination : std::uint8_t {
    in_order, ///< no row interchanges: for totally positive systems, where that is stable (de Boor & Pinkus 1977)
    pivoting, ///< partial pivoting, for all others
};

/// Shape of a system: entry (i, j) may differ from zero where |i - j| <= width, in a cyclic one modulo size.
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
    /// Entries stored of a row: interchanges fill in `band` more to the right.
    [[nodiscard]] constexpr std::size_t row_entries() const noexcept {
        return (elimination == Elimination::pivoting ? 3U : 2U) * band() + 1U;
    }
    /// Scalars of storage.
    [[nodiscard]] constexpr std::size_t entries() const noexcept { return size * row_entries(); }
    /// Bytes for the row interchanges.
    [[nodiscard]] constexpr std::size_t interchanges() const noexcept {
        return elimination == Elimination::pivoting ? size : 0U;
    }
};

/// The system. Entries are weights (weight.hpp), rows scaled so that their entries sum to about 1 in magnitude.
/// Cost: factor size * width^2 (in_order) to 8 size * width^2 (cyclic), solve size * width per axis.
template <Scalar S>
class BandedSystem {
public:
    BandedSystem() noexcept = default;
    /// All entries zero. The storage must outlive the system. width <= 127.
    /// @pre storage as the shape says, size >= 1
    BandedSystem(const BandShape& shape, std::span<S> entries, std::span<std::uint8_t> interchanges) noexcept;

    /// Adds to entry (row, column). @pre within the shape, not factored
    void add(std::size_t row, std::size_t column, S weight) noexcept;

    /// Eliminates. Errors: system_singular: a pivot is below 2^-44 (double), 2^-18 (float), 2^-32 (Fixed; there also if
    /// a multiplier would exceed 2^15), below which rounding cannot be told from zero.
    Status factor() noexcept;

    /// Solves in place: right-hand side i, then unknown i, is values[first + i * stride].
    /// Errors: result_out_of_range (not finite; in Fixed beyond 2^28, also for an intermediate result).
    /// @pre factored
    Status solve(std::span<Point<S>> values, int axes, std::size_t first = 0, std::size_t stride = 1) const noexcept;

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
    std::size_t reach_ = 0; ///< columns right of the diagonal that a row of the factors has
    std::span<S> entries_{};
    std::span<std::uint8_t> interchanges_{};
};

} // namespace splinefeed
