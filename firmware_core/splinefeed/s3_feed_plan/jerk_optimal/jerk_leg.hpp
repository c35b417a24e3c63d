// SPDX-License-Identifier: MIT
// JerkLeg: the jerk-limited motion from a state or from rest to the next rest. Derivation: jerk_leg.cpp.
#pragma once

#include "splinefeed/s3_feed_plan/jerk_optimal/controllable_set.hpp"
#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

#include <cstdint>

namespace splinefeed {

/// How a cell is travelled.
enum class Travel : std::uint8_t {
    curve,       ///< from JerkNode::state to the next node's
    line,        ///< with the other cells of its leg as one straight move
    rest_to_rest ///< from rest to rest as a move of its own
};

/// A node of the window and the cell behind it. The caller's storage.
struct JerkNode {
    JerkCell cell{};          ///< from this node to the next
    double most_sq = 0.0;     ///< of the cell: its cap_sq at most, whatever feed is programmed
    double wanted_sq = 0.0;   ///< of the cell: its cap_sq as it is steered
    double at_most_sq = 0.0;  ///< bound of b, for instance that of the acceleration-limited plan
    double expected_sq = 0.0; ///< what b is expected to be; the plan writes what it came to
    SpeedState state{};       ///< the plan
    Travel travel = Travel::curve;

    // Of the planning itself
    std::array<SpeedState, StatePolygon::kept + 1> corner{};
    std::size_t corners = 0;
    SpeedState early{}; ///< of the motion that is fast early, in the sense in which it is planned
    SpeedState late{};  ///< of the one that is fast late

    /// All but what belongs to the planning itself.
    void take(const JerkNode& from) noexcept {
        cell = from.cell;
        most_sq = from.most_sq;
        wanted_sq = from.wanted_sq;
        at_most_sq = from.at_most_sq;
        expected_sq = from.expected_sq;
        state = from.state;
        travel = from.travel;
    }
};

class JerkLeg {
public:
    static constexpr std::size_t fewest_cells = 4;

    /// @param nodes  the leg's cells and one more node, its end, at rest
    /// @param start  the state at the first node, b > 0; nothing: at rest
    /// @param known  that many nodes have a state of an earlier plan, from the start
    /// @pre nodes.size() > fewest_cells
    JerkLeg(std::span<JerkNode> nodes, const SpeedState* start, std::size_t known) noexcept
        : nodes_(nodes), start_(start), known_(known) {}

    /// Leaves the motion in JerkNode::state: the mean of one that is planned with the direction of travel and one
    /// against it, once more, from what the first came to, and the faster of both.
    /// false: there is no motion from the start with what is expected; nothing was changed but expected_sq.
    bool plan() noexcept;
    /// About what the motion in JerkNode::state takes; that of the first node is the start's.
    [[nodiscard]] double seconds() const noexcept;

private:
    [[nodiscard]] std::size_t cells() const noexcept { return nodes_.size() - 1; }
    bool sweep(bool backward) noexcept;
    template <class StateAt>
    [[nodiscard]] double time(StateAt&& state_at) const noexcept;
    [[nodiscard]] double mean_time(double share) const noexcept;

    std::span<JerkNode> nodes_;
    const SpeedState* start_;
    std::size_t known_;
};

} // namespace splinefeed
