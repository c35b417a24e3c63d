// SPDX-License-Identifier: MIT
// CurveFeeder: the curve that the user chose, and the way of the waypoints into it.
#pragma once

#include "host_sim/curve/bezier_source.hpp"
#include "host_sim/curve/streamed_curve.hpp"
#include "host_sim/planning/element_feeder.hpp"
#include "host_sim/program/path_input.hpp"

#include "splinefeed/s1_curve/smoothed_curve.hpp"

#include <optional>

namespace splinefeed {
struct CounterSeam; // of tests
} // namespace splinefeed

namespace splinefeed::host {

/// Owns the curve. more() pushes one waypoint at a time, so nothing is read before the curve needs it. A closed curve
/// has to be read completely first. It is pushed as the 16 points before the seam, the path with its first point at
/// both ends, and the 16 points after the seam. Lines and arcs within a tolerance are an ElementFeeder's.
template <Scalar S>
class CurveFeeder {
public:
    /// Throws UsageError if an end tangent does not fit the axes. `input` must outlive it.
    explicit CurveFeeder(PathInput& input);
    CurveFeeder(const CurveFeeder&) = delete;
    CurveFeeder& operator=(const CurveFeeder&) = delete;

    [[nodiscard]] CurveSource<S>& source() noexcept { return *source_; }

    /// The result of a push.
    struct Pushed {
        std::uint32_t index = 0; ///< as CurveSegment::waypoint counts, modulo 2^32
        PerAxis<Position> position{};
        bool on_path = false; ///< false: lead-in or lead-out, or no waypoint that the path must pass
        /// Within a tolerance: what the program's step did. Pointers are valid until the next call.
        typename ElementFeeder<S>::Pushed program{};
    };
    /// Pushes the next waypoint, or finishes the curve; false if there is none. Throws InputError; the curve then ends
    /// with the waypoints before. @pre the curve is starved
    bool more(Pushed& pushed);
    /// ElementFeeder::release().
    bool release(Pushed& pushed) {
        pushed = {};
        return elements_ && elements_->release(pushed.program);
    }
    /// Whether more() has nothing until the program's input has answered: MoveSource::answer(), of program().
    [[nodiscard]] bool awaits_answer() const noexcept { return elements_ && elements_->awaits_answer(); }
    /// The program. @pre the path is one within a tolerance
    [[nodiscard]] MoveSource<S>& program() noexcept { return elements_->program(); }
    /// Whether more() would return without waiting; waits for that up to the given time. A closed curve is read
    /// completely before.
    [[nodiscard]] bool wait_for_row(WaypointRows::Patience patience) {
        return elements_ ? elements_->wait_for_row(patience)
                         : finished_ || input_->choice().closed || input_rows_->wait(patience);
    }
    /// The path within a tolerance; null: the curve is another one.
    [[nodiscard]] const TolerancePath<S>* tolerance_path() const noexcept {
        return elements_ ? &elements_->path() : nullptr;
    }

    /// Number of waypoints of the input so far.
    [[nodiscard]] std::uint64_t rows() const noexcept { return elements_ ? elements_->program().rows() : rows_read_; }
    /// Index of the waypoint in the input, from 0, for an index of CurveSegment::waypoint.
    [[nodiscard]] std::uint32_t row_of(std::uint32_t index) const noexcept;
    /// Line of the waypoint in its file; 0: unknown.
    [[nodiscard]] std::uint64_t line_of_row(std::uint32_t row) const noexcept;
    /// Of a move within a tolerance, from 0: its element or the waypoint at its end, counted from 1; and as a text.
    [[nodiscard]] std::uint64_t number_of_move(std::uint64_t move) const noexcept;
    [[nodiscard]] std::string name_of_move(std::uint64_t move, std::uint64_t line) const;
    /// "element 3 (line 12)" or "point 3", for messages where there is no line.
    [[nodiscard]] std::string name_of_row(std::uint32_t row) const;
    /// The complete index of a row that was read recently.
    [[nodiscard]] std::uint64_t whole_row(std::uint32_t row) const noexcept;
    /// The motion has come to this row: nobody asks for those before it any more.
    void passed(std::uint32_t row) {
        if (elements_) {
            elements_->program().passed(whole_row(row));
        }
    }
    /// Memory of the curve stage.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return segments_ ? sizeof *segments_ : elements_ ? sizeof *elements_ : streamed_.bytes;
    }

private:
    friend struct splinefeed::CounterSeam;

    static constexpr std::size_t lead = 16;               ///< waypoints on each side of the seam that shape a closed
                                                          ///< curve
    static constexpr std::size_t remembered = 1024;       ///< number of lines that are remembered
    static constexpr std::size_t most_closed = 4'000'000; ///< waypoints of a closed curve, 400 MB

    void read_all();
    bool next_row(WaypointRow& row, Role& role);
    void finish();

    std::optional<BezierSource<S>> segments_; // one of the three
    std::optional<ElementFeeder<S>> elements_;
    StreamedCurve<S> streamed_;
    std::optional<SmoothedCurve<S>> smoothed_; // --smooth
    CurveSource<S>* source_ = nullptr;
    WaypointCurve<S>* waypoints_ = nullptr; // streamed_'s; null: one of the others
    PathInput* input_;
    std::unique_ptr<WaypointRows> input_rows_;
    std::vector<WaypointRow> all_;     // closed curves: the whole input
    std::vector<std::uint64_t> lines_; // line of row i at index i % remembered
    std::uint64_t rows_read_ = 0;
    std::uint64_t pushed_ = 0;
    bool finished_ = false;
};

} // namespace splinefeed::host
