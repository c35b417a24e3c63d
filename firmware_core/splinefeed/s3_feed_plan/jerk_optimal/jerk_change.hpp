// SPDX-License-Identifier: MIT
// JerkChange: the jerk-limited motion from where the machine is that answers a change of the steering.
//
//      v |----.                          v |----.            .----  wanted before
//        |     '.                          |     '.
//        |       '.                        |       '.________       wanted now
//        |_________'.____                  |_________________
//        now        rest, as near as can   now      change, as near as can be
#pragma once

#include "splinefeed/s3_feed_plan/jerk_optimal/jerk_window.hpp"

namespace splinefeed {

/// Tries motions out beside the plan; the window is changed only by one that was found: its first cells are cut at the
/// places that it was planned for, from where the machine is. Derivation: jerk_change.cpp.
template <Scalar S>
class JerkChange {
public:
    /// @param from  fraction of the front cell where the machine is, in `state`, b > 0
    /// @param planned  cells that have a plan, from the front on
    /// @pre window.forget_travelled()
    JerkChange(JerkWindow<S>& window, const MotionLimits<S>& limits, double from, const SpeedState& state,
               std::size_t planned) noexcept;

    /// The nearest rest; its end is where cell planned() - 1 ends. false: there is none in the window.
    /// Cost: about twenty JerkLeg::plan of the cells within the braking distance, some twenty at least.
    bool to_rest() noexcept;
    /// JerkNode::wanted_sq becomes the cap of the cells, from as near as can be. To a rest beyond; beyond changed() the
    /// plan may be made anew. false: nowhere in the window.
    bool to_wanted() noexcept;

    /// Cells from the front on that have a motion, to rest.
    [[nodiscard]] std::size_t planned() const noexcept { return planned_; }
    /// Those of them that belong to the change; at least one.
    [[nodiscard]] std::size_t changed() const noexcept { return changed_; }

private:
    /// Where the cells are cut: distances from the machine.
    struct Cuts {
        double end_mm = 0.0;      ///< rest
        double change_mm = 0.0;   ///< the caps are those that are wanted from here on
        double fine_mm = 0.0;     ///< up to here no piece is longer than
        double coarsest_mm = 0.0; ///< this
        double finest_mm = 0.0;   ///< and next to the rest than this; coarsest_mm: they are not graded
        double part_behind = 0.0; ///< of the distance from the rest: the longest piece behind it

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
    [[nodiscard]] double braking_sq(double distance_mm) const noexcept;
    [[nodiscard]] double ramp_mm(double from_mm_s, double to_mm_s) const noexcept;

    JerkWindow<S>* window_;
    const MotionLimits<S>* limits_;
    double from_;
    SpeedState state_;
    std::size_t old_planned_;
    MoveLimits along_;        // of the front cell
    double start_mm_ = 1e9;   // since a start with constant jerk
    double peak_sq_ = 0.0;    // of the way to rest
    double known_mm_ = 0.0;   // to the next stop, or to the end of the window
    double seconds_ = 0.0;    // of the last attempt that succeeded
    std::size_t pieces_ = 0;  // of the cuts that fit
    std::size_t cells_ = 0;   // that they are pieces of
    std::size_t planned_ = 0; // pieces of the last attempt that succeeded
    std::size_t changed_ = 0;
};

} // namespace splinefeed
