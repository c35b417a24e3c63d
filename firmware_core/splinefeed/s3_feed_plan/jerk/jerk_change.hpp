// SPDX-License-Identifier: MIT
// JerkChange: plans the jerk-limited motion that answers a change of the steering, from where the machine is.
//
//      v |----.                          v |----.            .----  wanted before
//        |     '.                          |     '.
//        |       '.                        |       '.________       wanted now
//        |_________'.____                  |_________________
//        now        nearest standstill     now
#pragma once

#include "splinefeed/base/work_budget.hpp"
#include "splinefeed/s3_feed_plan/jerk/jerk_window.hpp"

namespace splinefeed {

/// It searches without changing the plan. Only when a motion is found, the window changes: its first cells are split at
/// the places that the motion was planned for. Derivation: jerk_change.cpp.
template <Scalar S, Floating R>
class JerkChange {
public:
    explicit JerkChange(JerkWindow<S, R>& window) noexcept : window_(&window), leg_(window.scratch()) {}

    /// @param from  fraction of the front cell where the machine is, with motion `state`, b > 0
    /// @param planned  number of cells from the front on that have a plan
    /// @pre window.forget_travelled(); nothing else changes the window until the search ends
    void begin(double from, const SpeedState& state, std::size_t planned) noexcept;
    /// Begins the search for the nearest standstill; it is where cell planned() - 1 ends. `none`: there is none in the
    /// window.
    void to_rest(WorkBudget& work) noexcept;
    /// Begins the search for a motion with JerkNode::wanted_sq as the caps of the cells, from the nearest possible
    /// place on. It ends at a standstill beyond that place; beyond changed() the plan may be made anew. `none`: not
    /// possible in the window.
    void to_wanted(WorkBudget& work) noexcept;
    /// Goes on. `running`: the budget is spent. `found`: the window has changed. Cost in all: two or three searches of
    /// LegPlan over the cells within the braking distance, in steps.
    Search search(WorkBudget& work) noexcept;
    [[nodiscard]] bool running() const noexcept { return leg_.held(); }
    /// Ends the search; the window stays as it is.
    void cancel() noexcept { leg_.give_back(); }

    /// Cells from the front on that have a motion which ends at standstill.
    [[nodiscard]] std::size_t planned() const noexcept { return planned_; }
    /// Those of them that belong to the change; at least one.
    [[nodiscard]] std::size_t changed() const noexcept { return changed_; }

private:
    enum class Stage : std::uint8_t {
        brake,  ///< the motion that brakes as hard as it can, which tells where a standstill or a speed is possible
        attempt ///< the one that is adopted
    };
    /// Where the cells are split: distances from the machine.
    struct Cuts {
        double end_mm = 0.0;      ///< place of standstill
        double fine_mm = 0.0;     ///< up to here no piece is longer than coarsest_mm
        double coarsest_mm = 0.0; ///< longest piece up to fine_mm
        double finest_mm = 0.0;   ///< longest piece next to the standstill; equal to coarsest_mm: pieces are not graded
        double part_behind = 0.0; ///< longest piece after the standstill, as a part of the distance from it

        [[nodiscard]] bool graded() const noexcept { return finest_mm < coarsest_mm; }
    };

    template <class Visit>
    void each_piece(const Cuts& cuts, std::size_t first, Visit&& visit) const noexcept;
    [[nodiscard]] static double least_mm(const Cuts& cuts) noexcept;
    [[nodiscard]] static double longest_piece(const Cuts& cuts, double at_mm) noexcept;
    [[nodiscard]] static bool concerns(const Cuts& cuts, double at_mm, double length_mm) noexcept;
    bool fit(WorkBudget& work) noexcept;
    bool lay(WorkBudget& work, bool wanted) noexcept;
    void brake(WorkBudget& work) noexcept;
    void attempt_rest(WorkBudget& work) noexcept;
    void attempt_wanted(WorkBudget& work) noexcept;
    void follow_braking() noexcept;
    [[nodiscard]] double nearest_rest_mm() const noexcept;
    void adopt() noexcept;
    [[nodiscard]] bool knows(std::size_t cell) const noexcept;
    [[nodiscard]] SpeedState known_state(std::size_t cell, double fraction) const noexcept;
    [[nodiscard]] double ramp_mm(double from_mm_s, double to_mm_s) const noexcept;

    JerkWindow<S, R>* window_;
    LegLease<R> leg_;
    Cuts cuts_;
    double from_ = 0.0;
    SpeedState state_{};
    std::size_t old_planned_ = 0;
    MoveLimits along_;       // of the front cell
    double start_mm_ = 0.0;  // distance since a start with constant jerk
    double known_mm_ = 0.0;  // distance to the next stop, or to the end of the window
    double guess_mm_ = 0.0;  // distance that a hold takes with constant limits
    double rest_mm_ = 0.0;   // and as braking tells it
    std::size_t pieces_ = 0; // pieces of the cuts that fit
    std::size_t cells_ = 0;  // cells that these pieces belong to
    std::size_t planned_ = 0;
    std::size_t changed_ = 1;
    std::size_t attempts_ = 0; // that were begun
    Stage stage_ = Stage::brake;
    bool rests_ = false; // else a speed is wanted
    bool fits_ = false;  // with the pieces that were asked for
};

} // namespace splinefeed
