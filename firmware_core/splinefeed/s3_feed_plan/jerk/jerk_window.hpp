// SPDX-License-Identifier: MIT
// JerkWindow: the cells that a JerkPlan knows, and the nodes between them.
//
//        travelled      front                          back
//      nodes  o---o---o---o---o---o---o---o---o---o---o---o
//      cells              |___|___|___|___|___|___|___|___|
#pragma once

#include "splinefeed/base/ring_index.hpp"
#include "splinefeed/s2_arc_length/cell_interval.hpp"
#include "splinefeed/s3_feed_plan/jerk/leg_lease.hpp"
#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

#include <cstdint>

namespace splinefeed {

template <Scalar S>
inline constexpr int last_digit_log2 = std::same_as<S, Fixed> ? -32 : -52; ///< of fractions of a cell

/// How a cell is travelled.
enum class Travel : std::uint8_t {
    curve,       ///< with b as a parabola, or next to standstill with constant jerk
    line,        ///< together with the other cells of its leg, as one straight move
    rest_to_rest ///< from standstill to standstill, as a move of its own
};

/// A node of the window, and the plan of the cell after it. The plan is continuous to the last digit of double.
template <Floating R>
struct JerkNode {
    R length_mm{};  ///< of the cell
    R cap_sq{};     ///< largest v^2 anywhere in it, but for the velocities of the axes where it bends (JerkCell)
    R most_sq{};    ///< at most its cap_sq, whatever the programmed feed
    R wanted_sq{};  ///< its cap_sq with the present steering
    R at_most_sq{}; ///< upper bound of b at the node: that of the acceleration-limited plan
    double b = 0.0; ///< the plan: v^2 at the node
    double middle_sq = 0.0; ///< and the middle Bezier point of v^2 in the cell
    Travel travel = Travel::curve;
    float kept = 0.0F; ///< of the limits in the cell, for kinks beside it
};

/// Memory of a JerkPlan, owned by the caller: as many nodes and as much scratch as cells, and one more of each.
template <Scalar S, Floating R>
struct JerkStorage {
    std::span<Cell<S>> cells;
    std::span<JerkNode<R>> nodes;
    std::span<LegNode<R>> scratch;

    [[nodiscard]] bool enough() const noexcept { return nodes.size() > cells.size() && scratch.size() > cells.size(); }
};

/// The limits of the axes in jerk-limited motion.
template <Floating R, Scalar S>
[[nodiscard]] AxisLimits<R> axis_limits_of(const MotionLimits<S>& limits) noexcept;

/// The limits of a cell: the derivatives of its shape at both ends.
template <Floating R, Scalar S>
[[nodiscard]] JerkCell<R> jerk_cell_of(const Cell<S>& cell, const AxisLimits<R>& limits, R cap_sq,
                                       float kept = 0.0F) noexcept;

/// A ring of cells; node i is where cell i starts, and node size() is the end of the known path.
template <Scalar S, Floating R>
class JerkWindow {
public:
    static constexpr std::size_t most_spare = 40; ///< largest number of cells that are kept free; at most a quarter of
                                                  ///< all
    static constexpr double shortest_mm = 2e-6;   ///< cells are not split into shorter ones, because Fixed would have
                                                  ///< no digits for them
    static constexpr double slowest_sq = 4e-7;    ///< v^2 below which a motion is not changed: half of SpeedCaps'

    /// Overwrites the storage. @pre storage.enough(); this also holds for all other functions
    JerkWindow(const MotionLimits<S>& limits, const JerkStorage<S, R>& storage) noexcept;

    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    /// Cells that may still be appended, or created by splitting; some are kept free for splitting.
    [[nodiscard]] std::size_t room() const noexcept { return storage_.cells.size() - size_; }
    [[nodiscard]] bool full() const noexcept { return room() <= spare_; }

    [[nodiscard]] Cell<S>& cell(std::size_t i) noexcept {
        return storage_.cells[ring_index(head_ + i, storage_.cells.size())];
    }
    [[nodiscard]] const Cell<S>& cell(std::size_t i) const noexcept {
        return storage_.cells[ring_index(head_ + i, storage_.cells.size())];
    }
    [[nodiscard]] JerkNode<R>& node(std::size_t i) noexcept { return storage_.nodes[travelled_ + i]; }
    [[nodiscard]] const JerkNode<R>& node(std::size_t i) const noexcept { return storage_.nodes[travelled_ + i]; }
    /// The motion at a node.
    [[nodiscard]] SpeedState state(std::size_t i) const noexcept;
    /// The limits of a cell of the window.
    [[nodiscard]] JerkCell<R> limits_of(std::size_t i) const noexcept {
        return limits_of(cell(i), node(i).cap_sq, node(i).kept);
    }
    /// Those of a part of a cell.
    [[nodiscard]] JerkCell<R> limits_of(const Cell<S>& cell, R cap_sq, float kept) const noexcept {
        return jerk_cell_of<R>(cell, limits_, cap_sq, kept);
    }
    [[nodiscard]] LegScratch<R>& scratch() noexcept { return scratch_; }
    /// Cells that a leg can have.
    [[nodiscard]] std::size_t longest_leg() const noexcept { return storage_.scratch.size() - 1; }

    /// Appends a cell. Where the direction or q'' jumps before it, something of the limits is kept for that, or the
    /// cells beside it get a cap, or there is a stop.
    /// @param most_sq  largest v^2 in it, whatever the programmed feed
    /// @param wanted_sq  largest v^2 that is wanted in it
    /// @param exit_at_most_sq  upper bound of v^2 at its end
    /// @pre room() > 0
    void append(const Cell<S>& added, R most_sq, R wanted_sq, R exit_at_most_sq) noexcept;
    void pop() noexcept;
    /// Moves the nodes that are not yet travelled to the front of the storage. Cost: a visit to every node.
    void forget_travelled() noexcept;
    /// Inserts `more` cells before cell `first`, with their nodes. They are not initialised: the caller fills them.
    /// @pre forget_travelled(), more <= room()
    void open(std::size_t first, std::size_t more) noexcept;
    /// Splits a cell in two; at the new node the state is standstill. @pre forget_travelled(), room() > 0
    void split(std::size_t i, double fraction) noexcept;
    /// Makes it empty, at standstill.
    void clear() noexcept;

private:
    /// What a kink takes of the limits: for its jumps of the direction and of q''.
    struct Kink {
        R turn{};
        R bend{};
    };
    [[nodiscard]] Kink kink_at(std::size_t i, R speed_mm_s) const noexcept;
    [[nodiscard]] bool pass_kink(std::size_t i) noexcept;

    AxisLimits<R> limits_;
    R segments_per_s_;
    JerkStorage<S, R> storage_;
    LegScratch<R> scratch_;
    std::size_t spare_;
    std::size_t head_ = 0;      // first place of the ring of cells
    std::size_t size_ = 0;      // cells in it
    std::size_t travelled_ = 0; // nodes before the head's node
    R keeping_mm_{};            // so far behind the last cell something is kept for a kink before it:
    float keeping_ = 0.0F;      // this part
};

} // namespace splinefeed
