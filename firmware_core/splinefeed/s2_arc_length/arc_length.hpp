// SPDX-License-Identifier: MIT
// ArcLength: cuts Bezier segments into cells and measures each: u(s), and bounds of dq/ds and d2q/ds2.
#pragma once

#include "splinefeed/s1_curve/curve_source.hpp"
#include "splinefeed/s2_arc_length/cell.hpp"

namespace splinefeed {

/// How fine the cells are. Thresholds are odd numbers on purpose: no exact input sits on one, so that all scalars
/// decide alike and their traces stay comparable.
template <Scalar S>
struct Refinement {
    S longest_mm{};          ///< longest cell (the resolution of the parameter w in Fixed and float)
    S max_feed_mm_s{};       ///< feed of segments that program none
    S grade_per_feed_sq{};   ///< cells next to a joint are at most feed^2 times this: a fraction of the braking distance
    S direction_jump{};      ///< a larger change of dq/ds at a joint is a corner, and a stop
    S turn = literal<S>(0.0613);            ///< largest change of direction within a cell [rad]
    S curvature_change = literal<S>(0.0127); ///< largest change of curvature times length within a cell [rad]
    S curvature_bend = literal<S>(0.0037);  ///< the same for the second difference of curvature
    S metric_ratio = literal<S>(1.487);      ///< largest ratio of two |dr/dw| within a cell
    /// largest relative difference of a 4th and a 6th order length; float cannot tell less
    S metric_error = literal<S>(std::same_as<S, float> ? 1.13e-5 : 1.13e-6);
};

/// Stage 2. Memory: two segments and a stack of pieces. Cost per cell: three evaluations with two derivatives, no loop
/// over anything that grows with the program.
template <Scalar S>
class ArcLength {
public:
    ArcLength(CurveSource<S>& source, const Refinement<S>& refinement) noexcept
        : source_(&source), refinement_(refinement) {}

    /// Writes the next cell in travel order.
    Pull next(Cell<S>& out) noexcept;

    /// Length of all cells so far, in units of 2^-40 mm.
    [[nodiscard]] std::int64_t travelled_raw() const noexcept { return travelled_.raw; }
    [[nodiscard]] std::uint32_t segments() const noexcept { return segments_; }

private:
    static constexpr int deepest = 22; ///< halvings of a segment; below, a piece is its own chord

    struct Piece {
        PerAxis<PerDegree<S>> control{};
        int level = 0;
        bool at_start = false; ///< touches the start of its segment
        bool at_end = false;
    };
    enum class Verdict : std::uint8_t { fine, coarse, cusp };
    struct Measure; // derivatives and lengths of a piece at w = 0, 1/2, 1

    Pull load() noexcept;
    [[nodiscard]] bool jumps(const CurveSegment<S>& before, const CurveSegment<S>& after) const noexcept;
    void measure(const Piece& piece, Measure& m) noexcept;
    [[nodiscard]] Verdict judge(const Piece& piece, Measure& m) const noexcept;
    void fill(const Piece& piece, const Measure& m, Cell<S>& out) noexcept;
    void fill_chord(const Piece& piece, Cell<S>& out) noexcept;
    void fill_common(const Piece& piece, int degree, Cell<S>& out) noexcept;
    [[nodiscard]] CurveSegment<S>& current() noexcept { return slots_[current_]; }
    [[nodiscard]] const CurveSegment<S>& current() const noexcept { return slots_[current_]; }

    CurveSource<S>* source_;
    Refinement<S> refinement_;
    std::array<CurveSegment<S>, 2> slots_{};
    std::array<Piece, deepest + 2> stack_{};
    PerAxis<PerDegree<S>> left_{};  // the halves of the piece that is being measured
    PerAxis<PerDegree<S>> right_{};
    Position travelled_{};
    S grade_mm_{};
    std::uint32_t segments_ = 0;
    unsigned current_ = 0;
    int depth_ = 0; // pieces on the stack
    bool has_current_ = false;
    bool has_ahead_ = false;
    bool stop_before_ = true;
    bool stop_after_ = true;
};

} // namespace splinefeed
