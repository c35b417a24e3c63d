// SPDX-License-Identifier: MIT
// LegSolver: the speeds along a leg that keep the limits at its nodes and take the least time, by an interior-point
// method. Derivation: leg_solver.cpp.
#pragma once

#include "splinefeed/s3_feed_plan/jerk/leg_motion.hpp"
#include "splinefeed/s3_feed_plan/jerk/leg_rows.hpp"

#include <span>

namespace splinefeed {

/// How a search stands.
enum class Search : std::uint8_t { running, found, none };

/// How far the solver goes. `accuracy` is a share of the time by which a motion exceeds the least time, about.
template <Floating R>
struct LegEffort {
    int steps = 0;
    R start_accuracy{};
    R accuracy{};
    R margin{};         ///< of the limits, that the first motion leaves free at least
    bool again = false; ///< the multipliers of the last solution serve
    R brakes_from_sq{}; ///< b at the start of a motion that is to be as slow as possible, instead of as fast; 0: it is
                        ///< not
};

/// The nodes are the caller's, as those of LegMotion.
template <Floating R>
class LegSolver {
public:
    static constexpr std::size_t fewest_cells = 3;
    static constexpr std::size_t most_nodes = 48; ///< that a call visits

    LegSolver() noexcept = default;
    /// @param nodes  one more than cells; their geometry, guess and shares are set
    /// @param rests  the leg begins at standstill; otherwise b, slope and middle_sq of the first node are its start
    /// @pre fewest_cells or more
    LegSolver(std::span<LegNode<R>> nodes, const AxisLimits<R>& limits, bool rests) noexcept
        : node_(nodes), cells_(nodes.size() - 1), first_(rests ? 1U : 0U), limits_(limits) {}

    /// From the motion of the nodes on, which may exceed limits.
    void begin(const LegEffort<R>& effort) noexcept;
    /// A part of a step. `found`: the limits are kept at every node, which have their b, slope and curvature. A step
    /// visits every node twice, most_nodes in a call. Cost: about 500 operations a node of three axes in all. @pre
    /// begin()
    Search step() noexcept;

private:
    using Row = detail::LegRow<R>;
    using Terms = detail::LegTerms<R>;
    /// A step: of b and db/ds at a node, and of d2b/ds2 in the cell behind it.
    struct Change {
        R b{}, slope{}, curvature{};
    };
    /// Cost of the rest of the way: second and first derivatives by the state at a node, and by u of the cell before
    /// it.
    struct Value {
        R bb{}, bs{}, ss{}, b{}, s{};
        R ub{}, us{}, uu{}, u{};
    };
    /// The step so far, and the inverse of the part of it that stays within all limits.
    struct Reach {
        R most{1};
        Pair<R> most_jerk{R(1), R(1)};
        R before{}; // curvature of the cell before
        Change change{};
    };

    void begin_step() noexcept;
    Search finish() noexcept;
    [[nodiscard]] Row row_at(std::size_t i) const noexcept;
    R measure_excess(R margin) noexcept;
    void forget_multipliers() noexcept;
    [[nodiscard]] Change first_change() const noexcept;
    [[nodiscard]] Change next_change(std::size_t i, const Change& change) const noexcept;
    void move(R part) noexcept;
    void add_cap(LegNode<R>& node, const Row& row, Value& value) noexcept;
    void pass_cell(std::size_t i, const Terms& terms, Value& value) noexcept;
    void backward() noexcept;
    bool forward() noexcept;

    std::span<LegNode<R>> node_;
    std::size_t cells_ = 0;
    std::size_t first_ = 0; // node that the start is told by
    AxisLimits<R> limits_{};
    R barrier_{};       // mu: weight of the barrier
    R infeasibility_{}; // phi: share of the first excess that is left
    R gap_{};           // duality gap
    R nominal_gap_{};   // what it would be on the central path
    R first_step_{};    // of b at the first node, from standstill
    Value value_{};     // of the way behind node at_, on the way back
    Reach reach_{};     // before it, on the way forward
    std::size_t at_ = 0;
    LegEffort<R> effort_{};
    R brake_root_{}; // b^(-1/2) at the start of braking; 0: the motion is to be fast
    int steps_ = 0;
    int stuck_ = 0;
    bool ahead_ = false; // on the way forward
};

} // namespace splinefeed
