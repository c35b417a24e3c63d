// SPDX-License-Identifier: MIT
// Turning: finds where an axis may reverse, for axes whose braking limit differs from their acceleration limit.
// Derivation: turning.cpp.
#pragma once

#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

namespace splinefeed {

/// Takes cells in the order of travel. As soon as enough of the path after a cell is known, it writes into the cell
/// which way each such axis moves in it and near it (Cell::heading). Cost: nothing if no axis has two limits; otherwise
/// a few products per cell, and as much again for every cell within two or three segment durations.
template <Scalar S>
class Turning {
public:
    explicit Turning(const MotionLimits<S>& limits) noexcept : limits_(&limits) { clear(); }

    /// Which way an axis moves all along a cell: 1, -1, or 0 if it may turn round in it.
    [[nodiscard]] static int way_in(const Cell<S>& cell, unsigned axis) noexcept;

    /// Looks at the newest of `count` cells and at those before it.
    /// @param cell_at  returns the cell of an index; `settled` is called with the index of every cell whose heading
    ///                 changed
    template <class CellAt, class Settled>
    void take(std::size_t count, const CellAt& cell_at, const Settled& settled) noexcept {
        for (const unsigned k : indices(limits_->axes)) {
            if (const S near_mm = near_mm_of(k); near_mm > S{}) {
                take(k, near_mm, count, cell_at, settled);
            }
        }
    }
    /// Call it if the path ends at standstill with the newest of `count` cells.
    template <class CellAt, class Settled>
    void end(std::size_t count, const CellAt& cell_at, const Settled& settled) noexcept {
        for (const unsigned k : indices(limits_->axes)) {
            if (const S near_mm = near_mm_of(k); near_mm > S{}) {
                settle(k, near_mm, count, near_mm, cell_at, settled);
            }
        }
    }
    /// Call it if the next cell begins a path at standstill.
    void clear() noexcept;

private:
    static constexpr std::int8_t unsettled = 2; // factor of the heading: the axis may still turn round beyond the known
                                                // path

    /// The distance near a turn within which an axis has no heading; 0: the axis has only one limit.
    [[nodiscard]] S near_mm_of(unsigned axis) const noexcept;
    [[nodiscard]] static S travel_in(const Cell<S>& cell, unsigned axis) noexcept;

    template <class CellAt, class Settled>
    void take(unsigned k, S near_mm, std::size_t count, const CellAt& cell_at, const Settled& settled) noexcept {
        Cell<S>& cell = cell_at(count - 1);
        const int way = way_in(cell, k);
        if (way == 0 || way == -way_[k]) {
            travelled_mm_[k] = S{};
        }
        way_[k] = static_cast<std::int8_t>(way);
        cell.heading[k] = static_cast<std::int8_t>(travelled_mm_[k] < near_mm ? 0 : way * unsettled);
        if (way != 0) {
            travelled_mm_[k] = smaller(travelled_mm_[k] + travel_in(cell, k), near_mm);
            settle(k, near_mm, count, S{}, cell_at, settled);
        }
    }

    // Sets the heading of those cells that are far enough before the newest, or before the place of the turn.
    template <class CellAt, class Settled>
    void settle(unsigned k, S near_mm, std::size_t count, S ahead_mm, const CellAt& cell_at,
                const Settled& settled) noexcept {
        for (std::size_t i = count; i-- > 0;) {
            Cell<S>& cell = cell_at(i);
            if (way_in(cell, k) != way_[k] || cell.heading[k] == 0 || cell.heading[k] == way_[k]) {
                break;
            }
            if (!(ahead_mm < near_mm)) {
                cell.heading[k] = way_[k];
                settled(i);
            }
            ahead_mm = smaller(ahead_mm + travel_in(cell, k), near_mm);
        }
    }

    const MotionLimits<S>* limits_;
    PerAxis<S> travelled_mm_{};  // since the axis may have turned round
    PerAxis<std::int8_t> way_{}; // direction in the newest cell
};

} // namespace splinefeed
