// SPDX-License-Identifier: MIT
// JerkLeg: the jerk-limited motion from a state, or from standstill, to the next standstill. Derivation: jerk_leg.cpp.
#pragma once

#include "splinefeed/s3_feed_plan/jerk_optimal/controllable_set.hpp"
#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

#include <cstdint>

namespace splinefeed {

/// How a cell is travelled.
enum class Travel : std::uint8_t {
    curve,       ///< from JerkNode::state to the state of the next node
    line,        ///< together with the other cells of its leg, as one straight move
    rest_to_rest ///< from standstill to standstill, as a move of its own
};

/// A node of the window and the cell after it. Storage of the caller.
struct JerkNode {
    JerkCell cell{};          ///< from this node to the next
    double most_sq = 0.0;     ///< of the cell: at most its cap_sq, whatever the programmed feed
    double wanted_sq = 0.0;   ///< of the cell: its cap_sq with the present steering
    double at_most_sq = 0.0;  ///< upper bound of b, for instance that of the acceleration-limited plan
    double expected_sq = 0.0; ///< expected value of b; planning writes the value that it found
    SpeedState state{};       ///< the plan
    Travel travel = Travel::curve;

    // Used only during planning.
    std::array<SpeedState, StatePolygon::kept + 1> corner{};
    std::size_t corners = 0;
    SpeedState early{}; ///< state of the motion that is fast early, in the direction in which it is planned
    SpeedState late{};  ///< state of the motion that is fast late

    /// Copies everything except the members that are used only during planning.
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

    /// @param nodes  the leg's cells, and one more node: its end, at standstill
    /// @param start  the state at the first node, b > 0; null: standstill
    /// @param known  number of nodes from the start that have a state of an earlier plan
    /// @pre nodes.size() > fewest_cells
    JerkLeg(std::span<JerkNode> nodes, const SpeedState* start, std::size_t known) noexcept
        : nodes_(nodes), start_(start), known_(known) {}

    /// Leaves the motion in JerkNode::state. It plans one motion in the direction of travel and one against it, and
    /// takes a weighted mean. It does this a second time with the first result as expected speeds, and keeps the faster
    /// of the two results. false: no motion from the start exists with the expected speeds; only expected_sq was
    /// changed.
    bool plan() noexcept;
    /// Approximate duration of the motion in JerkNode::state; the state of the first node is that of the start.
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
