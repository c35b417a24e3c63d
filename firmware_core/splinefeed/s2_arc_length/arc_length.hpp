// SPDX-License-Identifier: MIT
// ArcLength: cuts Bezier segments into cells and measures each: u(s), and bounds of dq/ds and d2q/ds2.
#pragma once

#include "splinefeed/s1_curve/curve_source.hpp"
#include "splinefeed/s2_arc_length/cell.hpp"
#include "splinefeed/s2_arc_length/checked_source.hpp"

namespace splinefeed {

/// Stage 2. A segment is halved until each piece is fine enough to be a cell: its metric is inverted well, its
/// direction and curvature hardly change, and near joints it is a fraction of the braking distance. Around a cusp the
/// pieces shrink until next to nothing is left, or until they bend more than any speed above that of crawling allows,
/// and the machine passes their chord from stop to stop. Memory: two segments and a stack of pieces. Cost per cell:
/// three evaluations with two derivatives.
template <Scalar S>
class ArcLength {
public:
    /// `source` and `refinement` must outlive it.
    ArcLength(CurveSource<S>& source, const Refinement<S>& refinement) noexcept
        : source_(source, refinement), refinement_(refinement) {}
    ArcLength(CurveSource<S>& source, const Refinement<S>&& refinement) = delete;

    /// Forgets the source before, and begins with this one. @param from  where it must begin, to 2^-26 mm (a closed
    /// curve meets its waypoints to rounding only); must outlive the call that writes the first cell. null: anywhere
    void start(CurveSource<S>& source, const PerAxis<Position>* from = nullptr) noexcept {
        source_.start(source, from);
        travelled_ = {};
        segments_ = 0;
        depth_ = 0;
        has_current_ = has_ahead_ = in_cusp_ = after_cusp_ = false;
        stop_before_ = stop_after_ = true;
    }
    /// Writes the next cell in travel order. Before a segment that does not fit the machine the path ends: see
    /// status().
    Pull next(Cell<S>& out) noexcept;
    /// Why the path ended before the end of its source: axes_differ, counts_out_of_range or start_elsewhere.
    [[nodiscard]] Status status() const noexcept { return source_.status(); }

    /// Length of all cells so far, in units of 2^-40 mm.
    [[nodiscard]] Wide travelled() const noexcept { return travelled_; }
    [[nodiscard]] std::uint64_t segments() const noexcept { return segments_; }

private:
    friend struct CounterSeam; // a test starts counters near their ends

    static constexpr int deepest = 18; ///< halvings of a segment; then a piece is taken as it is

    enum class Verdict : std::uint8_t { fine, coarse, cusp };

    Pull load() noexcept;
    [[nodiscard]] bool vanishes(const Piece<S>& piece) const noexcept;
    Verdict judge(const Piece<S>& piece) noexcept;
    [[nodiscard]] bool too_long(const Piece<S>& piece) const noexcept;
    [[nodiscard]] bool leaves_open_travel(const Piece<S>& piece) const noexcept;
    [[nodiscard]] bool bends_too_much() const noexcept;
    [[nodiscard]] bool near_stop(const Piece<S>& piece) const noexcept;
    void split() noexcept;
    void leave() noexcept;
    void fill(const Piece<S>& piece, Cell<S>& out) noexcept;
    [[nodiscard]] Position end_of(int piece, unsigned axis) const noexcept;
    void arrive(Cell<S>& cell) const noexcept;
    [[nodiscard]] AxisShape<S> largest_shape(unsigned axis, const Cell<S>& cell) const noexcept;
    [[nodiscard]] AxisShape<S> shape_of(unsigned axis, S rounding, const Cell<S>& cell) const noexcept;
    void extend_cusp(const Piece<S>& piece) noexcept;
    void fill_chord(bool at_end, Cell<S>& out) noexcept;
    void fill_common(bool at_end, Cell<S>& out) noexcept;
    [[nodiscard]] Piece<S>& top() noexcept { return stack_[static_cast<unsigned>(depth_ - 1)]; }
    [[nodiscard]] CurveSegment<S>& current() noexcept { return slots_[current_]; }
    [[nodiscard]] const CurveSegment<S>& current() const noexcept { return slots_[current_]; }

    CheckedSource<S> source_;
    const Refinement<S>& refinement_;
    std::array<CurveSegment<S>, 2> slots_{};
    std::array<Piece<S>, deepest + 1> stack_{}; // one of each level at the most
    PieceMeasure<S> m_{};                       // of the piece that is being judged
    Wide travelled_{};
    S grade_mm_{};
    PerAxis<Position> cusp_from_{};
    PerAxis<Position> cusp_to_{};
    S nothing_{}; // in units of the current segment
    std::uint64_t segments_ = 0;
    int depth_ = 0;            // pieces on the stack
    std::uint8_t current_ = 0; // of slots_
    bool has_current_ = false;
    bool has_ahead_ = false;
    bool in_cusp_ = false;    // pieces from cusp_from_ to cusp_to_ are to be passed as one chord
    bool after_cusp_ = false; // the cell before was such a chord
    bool stop_before_ = true;
    bool stop_after_ = true;
};

} // namespace splinefeed
