// SPDX-License-Identifier: MIT
// ArcLength: divides Bezier segments into cells and measures each cell: u(s), and bounds of dq/ds and d2q/ds2.
#pragma once

#include "splinefeed/base/work_budget.hpp"
#include "splinefeed/s1_curve/curve_source.hpp"
#include "splinefeed/s2_arc_length/cell.hpp"
#include "splinefeed/s2_arc_length/checked_source.hpp"

namespace splinefeed {

/// Stage 2. It halves a segment until every piece is fine enough to be a cell. Then its metric can be inverted
/// accurately, and its direction and curvature hardly change. Near joints it is a fraction of the braking distance.
/// Around a cusp the pieces shrink until almost nothing is left, or until they bend more than any speed above crawling
/// allows. The machine then passes the chord of these pieces from stop to stop. Memory: two segments and a stack of
/// pieces. Cost per cell: three evaluations with two derivatives.
template <Scalar S>
class ArcLength {
public:
    /// `source` and `refinement` must outlive it.
    ArcLength(CurveSource<S>& source, const Refinement<S>& refinement) noexcept
        : source_(source, refinement), refinement_(refinement) {}
    ArcLength(CurveSource<S>& source, const Refinement<S>&& refinement) = delete;

    /// Forgets the previous source and begins with this one.
    /// @param from  where it must begin, to 2^-26 mm (a closed curve meets its waypoints only to rounding); must
    ///              outlive the call that writes the first cell. null: anywhere
    void start(CurveSource<S>& source, const PerAxis<Position>* from = nullptr) noexcept {
        source_.start(source, from);
        travelled_ = {};
        segments_ = 0;
        depth_ = 0;
        has_current_ = has_ahead_ = false;
        cusp_ = Cusp::none;
        stop_before_ = stop_after_ = true;
        slow_before_ = slow_ = slow_after_ = false;
    }
    /// Writes the next cell in the order of travel. The path ends before a segment that does not fit the machine: see
    /// status(). `busy`: the budget is spent; call again. A piece that is judged is three steps, a segment
    /// of the source four.
    Pull next(Cell<S>& out, WorkBudget& work) noexcept;
    /// The same without a bound.
    Pull next(Cell<S>& out) noexcept {
        WorkBudget unlimited;
        return next(out, unlimited);
    }
    /// Why the path ended before the end of its source: axes_differ, counts_out_of_range or start_elsewhere.
    [[nodiscard]] Status status() const noexcept { return source_.status(); }

    /// Length of all cells so far, in units of 2^-40 mm.
    [[nodiscard]] Wide travelled() const noexcept { return travelled_; }
    [[nodiscard]] std::uint64_t segments() const noexcept { return segments_; }

private:
    friend struct CounterSeam; // a test starts counters near their ends

    static constexpr int deepest = 18;           ///< halvings of a segment; after that a piece is accepted as it is
    static constexpr unsigned segment_steps = 4; ///< of the budget, for a segment of the source
    static constexpr unsigned piece_steps = 3;   ///< for a piece that is judged, and filled in where it is a cell

    enum class Verdict : std::uint8_t { fine, coarse, cusp };

    Pull load() noexcept;
    Verdict judge(const Piece<S>& piece) noexcept;
    [[nodiscard]] bool too_long(const Piece<S>& piece) const noexcept;
    [[nodiscard]] bool leaves_open_travel(const Piece<S>& piece) const noexcept;
    [[nodiscard]] bool bends_too_much() const noexcept;
    [[nodiscard]] S largest_sq_in_turn() const noexcept;
    [[nodiscard]] bool errs_too_much() const noexcept;
    [[nodiscard]] bool coarse_near(const Piece<S>& piece, bool start, bool end) const noexcept;
    void split() noexcept;
    void leave() noexcept;
    void fill(const Piece<S>& piece, Cell<S>& out) noexcept;
    [[nodiscard]] Position end_of(int piece, unsigned axis) const noexcept;
    void arrive(Cell<S>& cell) const noexcept;
    [[nodiscard]] AxisShape<S> largest_shape(unsigned axis, const Cell<S>& cell) const noexcept;
    [[nodiscard]] AxisShape<S> shape_of(unsigned axis, Ratio<S> bend, Ratio<S> rounding,
                                        const Cell<S>& cell) const noexcept;
    void extend_cusp(const Piece<S>& piece) noexcept;
    void fill_chord(bool at_end, Cell<S>& out) noexcept;
    void fill_common(bool at_end, Cell<S>& out) noexcept;
    [[nodiscard]] Piece<S>& top() noexcept { return stack_[static_cast<unsigned>(depth_ - 1)]; }
    [[nodiscard]] CurveSegment<S>& current() noexcept { return slots_[current_]; }
    [[nodiscard]] const CurveSegment<S>& current() const noexcept { return slots_[current_]; }

    CheckedSource<S> source_;
    const Refinement<S>& refinement_;
    std::array<CurveSegment<S>, 2> slots_{};
    std::array<Piece<S>, deepest + 1> stack_{}; // at most one of each level
    PieceMeasure<S> m_{};                       // of the piece that is being judged
    Wide travelled_{};
    S grade_mm_{};
    S feed_mm_s_{}; // of the segment
    PerAxis<Position> cusp_from_{};
    PerAxis<Position> cusp_to_{};
    S nothing_{}; // lengths below count as zero, in units of the current segment
    std::uint64_t segments_ = 0;
    int depth_ = 0;            // pieces on the stack
    std::uint8_t current_ = 0; // index in slots_
    bool has_current_ = false;
    bool has_ahead_ = false;
    /// `in`: pieces from cusp_from_ to cusp_to_ will be passed as one chord. `behind`: the previous cell was such one.
    enum class Cusp : std::uint8_t { none, in, behind } cusp_ = Cusp::none;
    bool stop_before_ = true;
    bool stop_after_ = true;
    bool slow_before_ = false; // the segment before this one is passed slowly, this one, the one after it
    bool slow_ = false;
    bool slow_after_ = false;
};

} // namespace splinefeed
