// SPDX-License-Identifier: MIT
// LegPlan: the fastest motion that is found along a leg, from a state or from standstill to the next standstill, with
// every limit proved in every cell.
#pragma once

#include "splinefeed/s3_feed_plan/jerk/jerk_cell.hpp"
#include "splinefeed/s3_feed_plan/jerk/leg_solver.hpp"

namespace splinefeed {

/// It computes in R. Works in nodes of the caller. Build a leg by begin() and add(), then plan it: at once, or in
/// steps.
template <Floating R>
class LegPlan {
public:
    static constexpr std::size_t fewest_cells = LegSolver<R>::fewest_cells;
    static constexpr double above_braking = 1.02;  ///< caps are so much above a motion that brakes
    static constexpr std::size_t most_proved = 12; ///< cells in a step, which takes as long as LegSolver's
    static constexpr unsigned most_work = LegSolver<R>::most_nodes / 2; ///< of a step, in nodes that are solved for

    /// @param nodes  scratch, one more than the cells of a leg
    explicit LegPlan(std::span<LegNode<R>> nodes) noexcept : nodes_(nodes) {}

    /// @param start  b > 0, or standstill
    void begin(const SpeedState& start) noexcept;
    /// Appends a cell. @pre fewer cells than nodes
    /// @param at_most_sq  an upper bound of b at its end, about: that of an acceleration-limited plan; 0: not known
    void add(const JerkCell<R>& cell, R at_most_sq) noexcept;
    /// The middle of the last cell in a plan that is possible. @pre all cells before it are known
    void know(R middle_sq) noexcept;
    [[nodiscard]] std::size_t cells() const noexcept { return cells_; }
    /// Caps the middles of all cells, but not below what is known.
    void limit(R most_sq) noexcept;

    /// Begins the search for the fastest motion. @pre fewest_cells or more
    void search() noexcept;
    /// A step of it. `none`: the nodes are not changed for the caller. Cost in all: ten to twenty steps of LegSolver,
    /// and as many again for each attempt that fails.
    Search step() noexcept;
    /// Of a step, in nodes.
    [[nodiscard]] unsigned step_work() const noexcept {
        return cells_ < most_work ? static_cast<unsigned>(cells_) : most_work;
    }
    /// Begins the search for the motion that brakes as hard as it can, from the plan that is known: the same step(). It
    /// is not proved, and not for each_cell(). @pre it begins in motion, and something is known
    void brake() noexcept;
    /// Of the motion that brakes: b at the start of a cell, and its middle.
    [[nodiscard]] R b(std::size_t i) const noexcept { return nodes_[i].b; }
    [[nodiscard]] R middle_sq(std::size_t i) const noexcept { return nodes_[i].middle_sq; }
    [[nodiscard]] R length_mm(std::size_t i) const noexcept { return nodes_[i].length_mm; }
    /// Another cap for the middle of a cell, or a higher one that allows the motion that brakes, which becomes the
    /// known one.
    void cap(std::size_t i, R cap_sq) noexcept;
    /// All of it. Whether one was found.
    bool fastest() noexcept;
    /// From standstill: a motion that is possible and not fast. false: none within the range of numbers.
    bool slow() noexcept;

    /// The result: calls visit(i, b, middle_sq) for every cell, with v^2 at its start, and at its middle as a Bezier
    /// point, to the last digit of double. @pre fastest() or slow() found one
    template <class Visit>
    void each_cell(Visit&& visit) const noexcept {
        if (rests_) {
            visit(std::size_t{0}, 0.0, 0.0);
        }
        SpeedState state = motion_.first(start_);
        for (std::size_t i = rests_ ? 1 : 0; i < cells_; ++i) {
            visit(i, state.b, state.b + 0.5 * state.slope * static_cast<double>(nodes_[i].length_mm));
            state = i + 1 < cells_ ? motion_.behind(i, state) : state;
        }
    }

private:
    enum class Stage : std::uint8_t {
        guess, ///< a first motion
        first, ///< solved as it is
        prove_first,
        again, ///< solved with smaller shares of the limits, from where it is
        anew,  ///< the same with new multipliers
        prove,
        slow_down, ///< caps that a motion which exceeds limits between the nodes would keep
        brake
    };
    struct Proof {
        bool kept = true; ///< every limit in every cell
        R most{};
    };

    void limit_middles(const JerkCell<R>& cell) noexcept;
    [[nodiscard]] std::span<LegNode<R>> leg() const noexcept { return nodes_.first(cells_ + 1); }
    void join() noexcept;
    void guess(double lead) noexcept;
    void begin_visit(Stage stage) noexcept;
    [[nodiscard]] std::size_t visit_some() noexcept;
    [[nodiscard]] bool visited() const noexcept { return at_ + 1 >= cells_; }
    bool slow_down() noexcept;
    Search fail() noexcept;
    bool prove(R from, bool tighten) noexcept;

    std::span<LegNode<R>> nodes_;
    LegMotion<R> motion_;
    LegSolver<R> solver_;
    std::size_t cells_ = 0;
    std::size_t known_ = 0;
    bool rests_ = true;
    SpeedState start_{};
    AxisLimits<R> limits_{};
    R exit_most_sq_{}; // of the last cell: JerkCell::most_sq, and its slope
    R most_slope_{};
    R first_most_sq_{};
    R last_most_sq_{};
    Stage stage_ = Stage::guess;
    std::size_t lead_ = 0; // number of the attempt
    int passes_ = 0;       // of solving again
    std::size_t at_ = 0;   // cell that is proved or slowed down next
    Proof proof_{};        // of the cells before it
};

} // namespace splinefeed
