// SPDX-License-Identifier: MIT
// JerkWindow: the cells that a jerk-limited plan knows, and the nodes between them.
//
//        travelled      front                          back
//      nodes  o---o---o---o---o---o---o---o---o---o---o---o
//      cells              |___|___|___|___|___|___|___|___|
#pragma once

#include "splinefeed/base/ring_index.hpp"
#include "splinefeed/s2_arc_length/cell_interval.hpp"
#include "splinefeed/s3_feed_plan/jerk_optimal/jerk_leg.hpp"

namespace splinefeed {

/// Memory of a JerkPlan, the caller's: its window of cells, and nodes: twice one more than cells, since a change of the
/// steering is tried out beside the plan.
template <Scalar S>
struct JerkStorage {
    std::span<Cell<S>> cells;
    std::span<JerkNode> nodes;

    [[nodiscard]] static constexpr std::size_t nodes_for(std::size_t cells) noexcept { return 2 * (cells + 1); }
};

/// What a cell asks of the motion: its shape's derivatives at both ends.
template <Scalar S>
[[nodiscard]] JerkCell jerk_cell_of(const Cell<S>& cell, const MotionLimits<S>& limits, double cap_sq) noexcept;

/// A ring of cells; node i is where cell i starts, node size() the end of what is known.
template <Scalar S>
class JerkWindow {
public:
    static constexpr std::size_t most_spare = 40; ///< cells that are kept free, at most; at most a quarter of all
    static constexpr double shortest_mm = 2e-6;   ///< cells are cut no shorter, lest Fixed have no digits for them
    static constexpr double slowest_sq = 1e-6;    ///< v^2 below which a motion is not changed

    /// Whatever the storage holds is overwritten. Fewer nodes than nodes_for() the cells are a broken precondition of
    /// all that follows.
    JerkWindow(const MotionLimits<S>& limits, const JerkStorage<S>& storage) noexcept;

    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    /// Cells that may still be appended, or come in by splitting; some are kept free for that.
    [[nodiscard]] std::size_t room() const noexcept { return storage_.cells.size() - size_; }
    [[nodiscard]] bool full() const noexcept { return room() <= spare_; }

    [[nodiscard]] Cell<S>& cell(std::size_t i) noexcept {
        return storage_.cells[ring_index(head_ + i, storage_.cells.size())];
    }
    [[nodiscard]] const Cell<S>& cell(std::size_t i) const noexcept {
        return storage_.cells[ring_index(head_ + i, storage_.cells.size())];
    }
    [[nodiscard]] JerkNode& node(std::size_t i) noexcept { return storage_.nodes[travelled_ + i]; }
    [[nodiscard]] const JerkNode& node(std::size_t i) const noexcept { return storage_.nodes[travelled_ + i]; }
    [[nodiscard]] std::span<JerkNode> nodes(std::size_t first, std::size_t end) noexcept {
        return storage_.nodes.subspan(travelled_ + first, end - first + 1);
    }
    /// As many nodes again that the plan does not use.
    [[nodiscard]] std::span<JerkNode> scratch() noexcept { return storage_.nodes.subspan(storage_.cells.size() + 1); }

    /// Appends a cell, and a stop before it where q'' jumps. @param most_sq  largest v^2 in it, whatever is programmed
    /// @param wanted_sq  largest v^2 that is wanted in it  @param exit_at_most_sq  bound of v^2 at its end
    /// @pre room() > 0
    void append(const Cell<S>& added, double most_sq, double wanted_sq, double exit_at_most_sq) noexcept;
    void pop() noexcept;
    /// Moves what is not yet travelled to the front of the nodes. Cost: a visit to every node.
    void forget_travelled() noexcept;
    /// Makes room for more cells before number `first`: that one and all behind it get numbers that much larger, and so
    /// do the nodes before them; what takes their place is the caller's to fill. @pre forget_travelled(), more <=
    /// room()
    void open(std::size_t first, std::size_t more) noexcept;
    /// Makes two cells of one; the node between them stands still. @pre forget_travelled(), room() > 0
    void split(std::size_t i, double fraction) noexcept;
    /// Empty, and at rest.
    void clear() noexcept;

private:
    [[nodiscard]] bool bend_jumps(const JerkNode& before, const JerkNode& after) const noexcept;

    const MotionLimits<S>* limits_;
    JerkStorage<S> storage_;
    std::size_t spare_;
    std::size_t head_ = 0;      // of the ring of cells
    std::size_t size_ = 0;      // cells in it
    std::size_t travelled_ = 0; // nodes before the head's
};

} // namespace splinefeed
