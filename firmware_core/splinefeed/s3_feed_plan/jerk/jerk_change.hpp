// SPDX-License-Identifier: MIT
// JerkChange: plans the jerk-limited motion that answers a change of the steering, from where the machine is.
//
//      v |----.                          v |----.            .----  wanted before
//        |     '.                          |     '.
//        |       '.                        |       '.________       wanted now
//        |_________'.____                  |_________________
//        now        nearest standstill     now      nearest possible change
#pragma once

#include "splinefeed/s3_feed_plan/jerk/jerk_window.hpp"

namespace splinefeed {

/// Tries motions without changing the plan. Only when a motion is found, the window changes: its first cells are split
/// at the places that the motion was planned for. Derivation: jerk_change.cpp.
template <Scalar S, Floating R>
class JerkChange {
public:
    /// @param from  fraction of the front cell where the machine is, with motion `state`, b > 0
    /// @param planned  number of cells from the front on that have a plan
    /// @pre window.forget_travelled()
    JerkChange(JerkWindow<S, R>& window, double from, const SpeedState& state, std::size_t planned) noexcept;

    /// The nearest standstill; it is where cell planned() - 1 ends. false: there is none in the window. Cost: about
    /// twenty LegPlan::fastest of the cells within the braking distance, of twenty cells at least.
    bool to_rest() noexcept;
    /// Makes JerkNode::wanted_sq the cap of the cells, from the nearest possible place on. The motion ends at a
    /// standstill beyond that place; beyond changed() the plan may be made anew. false: not possible in the window.
    bool to_wanted() noexcept;

    /// Cells from the front on that have a motion which ends at standstill.
    [[nodiscard]] std::size_t planned() const noexcept { return planned_; }
    /// Those of them that belong to the change; at least one.
    [[nodiscard]] std::size_t changed() const noexcept { return changed_; }

private:
    /// Where the cells are split: distances from the machine.
    struct Cuts {
        double end_mm = 0.0;      ///< place of standstill
        double change_mm = 0.0;   ///< from here on the caps are those that are wanted
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
    bool fit(Cuts& cuts) noexcept;
    bool attempt(const Cuts& cuts) noexcept;
    void adopt(const Cuts& cuts) noexcept;
    bool possible(Cuts& cuts) noexcept { return fit(cuts) && attempt(cuts); }
    template <class CutsAt>
    [[nodiscard]] double nearest(double guess_mm, CutsAt&& cuts_at) noexcept;
    bool take(Cuts cuts) noexcept;
    [[nodiscard]] bool knows(std::size_t cell) const noexcept;
    [[nodiscard]] SpeedState known_state(std::size_t cell, double fraction) const noexcept;
    [[nodiscard]] double ramp_mm(double from_mm_s, double to_mm_s) const noexcept;

    JerkWindow<S, R>* window_;
    LegPlan<R> leg_; // the last attempt
    double from_;
    SpeedState state_;
    std::size_t old_planned_;
    MoveLimits along_;        // of the front cell
    double start_mm_ = 1e9;   // distance since a start with constant jerk
    double known_mm_ = 0.0;   // distance to the next stop, or to the end of the window
    double seconds_ = 0.0;    // duration of the last attempt that succeeded
    std::size_t pieces_ = 0;  // pieces of the cuts that fit
    std::size_t cells_ = 0;   // cells that these pieces belong to
    std::size_t planned_ = 0; // pieces of the last attempt that succeeded
    std::size_t changed_ = 0;
};

} // namespace splinefeed
