// SPDX-License-Identifier: MIT
// AccelerationBound: the values of v^2 at the two ends of a cell that keep every axis within its signed acceleration
// limits at every point of the cell. Derivation: acceleration_bound.cpp.
#pragma once

#include "splinefeed/number/division_by.hpp"
#include "splinefeed/s2_arc_length/cell.hpp"
#include "splinefeed/s2_arc_length/cell_interval.hpp"
#include "splinefeed/s3_feed_plan/acceleration/cap_line.hpp"
#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

namespace splinefeed {

/// The fastest entry that a cell allows, as v^2, with the exits that are possible from it.
template <Scalar S>
struct PeakSpeeds {
    S entry_sq{}; ///< below zero: still unknown
    S smallest_exit_sq{};
    S largest_exit_sq{};

    [[nodiscard]] static PeakSpeeds unknown() noexcept { return {.entry_sq = from_integer<S>(-1)}; }
    [[nodiscard]] bool known() const noexcept { return !(entry_sq < S{}); }
};

/// The convex polygon of the pairs (entry_sq, exit_sq) that a cell, or a part of it, allows: eight half-planes per
/// axis. It contains (0, 0). Half of the half-planes bound accelerations in the axis's own direction, the other half
/// those against it; each half has its own limit. Cost of a function: two products for each of four points and axis,
/// and a division for each half-plane that limits the result.
template <Scalar S>
class AccelerationBound {
public:
    /// `cell` and `limits` must outlive it.
    AccelerationBound(const Cell<S>& cell, const MotionLimits<S>& limits, const CellInterval<S>& stretch = {}) noexcept
        : cell_(cell), limits_(limits), stretch_(stretch) {}

    /// Largest exit_sq up to at_most. @pre an exit_sq up to at_most is allowed together with entry_sq
    [[nodiscard]] S largest_exit(S entry_sq, S at_most) const noexcept;
    /// Smallest exit_sq from at_least to at_most; at_most if none is allowed below it. A negative result is the slope
    /// of a line of v^2 that reaches zero before the end of the cell. @pre at_least <= at_most, at_least >= -entry_sq
    [[nodiscard]] S smallest_exit(S entry_sq, S at_least, S at_most) const noexcept;
    /// Largest entry_sq up to at_most. @pre exit_sq < peak().smallest_exit_sq
    [[nodiscard]] S largest_entry(S exit_sq, S at_most) const noexcept;
    /// By how much v^2 may grow along the whole cell if it is `faster`, else fall, up to at_most. A part of the cell
    /// allows its share of that, wherever it lies. At both ends v^2 is at most ends_sq. @pre not a stretch
    [[nodiscard]] S change(bool faster, S ends_sq, S at_most) const noexcept;
    /// Every exit_sq up to this value, at most at_most, can be reached from standstill.
    [[nodiscard]] S reach_from_standstill(S at_most) const noexcept;
    /// The largest possible entry_sq up to this cap, with its exits.
    [[nodiscard]] PeakSpeeds<S> peak(const CapLine<S>& cap) const noexcept;
    /// A part of the search for it, which begins with an unknown peak and goes on until it is known. Cost: at most
    /// three steps of Newton's method; most peaks take one.
    void approach_peak(const CapLine<S>& cap, PeakSpeeds<S>& peak) const noexcept;

private:
    using R = Ratio<S>;

    struct Row { // entry * entry_sq + exit * exit_sq <= limit, each side as a quarter_product
        R entry{};
        R exit{};
        S limit{};
    };

    /// The half-planes of an axis: point j bounds the accelerations > 0 with (e + entry[j], e + exit[j], limit[0]), and
    /// those < 0 with (e - entry[j], e - exit[j], limit[1]).
    struct AxisRows {
        std::array<R, 4> entry;
        std::array<R, 4> exit;
        R e; // of all of them
        std::array<S, 2> limit;

        [[nodiscard]] Row row(unsigned j, unsigned side) const noexcept {
            return side == 0 ? Row{e + entry[j], e + exit[j], limit[0]} : Row{e - entry[j], e - exit[j], limit[1]};
        }
    };

    struct Exits { // those from low to the smaller of high and steep, and the half-planes that bound them
        S low{};
        S high{};
        S steep{}; // by those that a slightly slower entry moves far away
        Row below{};
        Row above{};
        Row beside{}; // the one of `steep`
    };

    [[nodiscard]] Exits exits_from(S entry_sq, S cap_sq, const PerAxis<AxisRows>& rows) const noexcept;
    [[nodiscard]] static S crossing_of(const Row& first, const Row& second) noexcept;
    [[nodiscard]] AxisRows rows_of(unsigned k) const noexcept;
    template <auto Given, auto Asked> // members of AxisRows
    [[nodiscard]] S lowered(S given_sq, S at_most) const noexcept;
    [[nodiscard]] S lifted(S entry_sq, S exit_sq, S at_most) const noexcept;

    const Cell<S>& cell_;
    const MotionLimits<S>& limits_;
    CellInterval<S> stretch_;
};

} // namespace splinefeed
