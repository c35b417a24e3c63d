// SPDX-License-Identifier: MIT
// PathFeeder: the way of an input into its curve. CurveWatch: whoever looks at the curve before it is planned.
#pragma once

#include "host_sim/planning/path_sink.hpp"
#include "host_sim/program/path_input.hpp"
#include "splinefeed/s1_curve/curve_segment.hpp"

#include <memory>
#include <optional>
#include <string>

namespace splinefeed::host {

class PathFeeder;

class CurveWatch {
public:
    /// The next segment in the order of travel. If it throws, the segment is not passed on, and the curve ends.
    /// @param row  of its waypoint, element or move in the input
    virtual void segment(const CurveSegment<double>& segment, std::uint32_t row, const PathFeeder& feeder) = 0;

protected:
    CurveWatch() = default;
    CurveWatch(const CurveWatch&) = default;
    CurveWatch& operator=(const CurveWatch&) = default;
    ~CurveWatch() = default;
};

/// more() takes one waypoint or one step of a program at a time, so nothing is read before the curve needs it.
class PathFeeder {
public:
    using Patience = MoveSource::Patience;

    PathFeeder() = default;
    PathFeeder(const PathFeeder&) = delete;
    PathFeeder& operator=(const PathFeeder&) = delete;
    virtual ~PathFeeder() = default;

    /// What more() did.
    struct Pushed {
        std::uint32_t index = 0;      ///< of a waypoint, as CurveSegment::waypoint counts, modulo 2^32
        bool on_path = false;         ///< it pushed a waypoint that the path must pass
        bool start = false;           ///< it told where the first move begins
        PerAxis<Position> position{}; ///< of the waypoint, of the start, or the end of the last move
        const SourceStep* move{};     ///< it pushed this move; null: none; valid until the next call
        const SourceStep* step{};     ///< a dwell or an event behind the moves so far; null: none; valid as above
        std::optional<std::uint32_t>
            row{};                    ///< of the last move before the step that has a length; none: there was none
        std::uint32_t short_rows = 0; ///< rows behind that one: moves without a length, of which a chain may take some
    };
    /// Pushes what comes next, or finishes the curve; false if there is nothing. Throws InputError; the curve then ends
    /// with what came before. @pre the curve is starved
    virtual bool more(Pushed& pushed) = 0;
    /// The machine needs what there is, and the input pauses: a move that waits for the step behind it is pushed, with
    /// a stop at its end. false: none waits. @pre the curve is starved
    virtual bool release(Pushed& pushed);
    /// Whether more() would return without waiting; waits for that up to the given time.
    [[nodiscard]] virtual bool wait_for_row(Patience patience) = 0;
    /// Whether more() has nothing until an input has answered: MoveSource::answer(), of program().
    [[nodiscard]] virtual bool awaits_answer() const noexcept { return false; }
    /// What the path follows within a tolerance; null: it is none of that kind.
    [[nodiscard]] virtual MoveSource* program() const noexcept { return nullptr; }

    /// Number of waypoints, elements or lines of the input so far.
    [[nodiscard]] virtual std::uint64_t rows() const noexcept = 0;
    /// Index of the waypoint or element in the input, from 0, for an index of CurveSegment::waypoint.
    [[nodiscard]] virtual std::uint32_t row_of(std::uint32_t index) const noexcept { return index; }
    /// Line of the row in its file; 0: unknown.
    [[nodiscard]] virtual std::uint64_t line_of_row(std::uint32_t /*row*/) const noexcept { return 0; }
    /// "element 3 (line 12)" or "point 3", for messages where there is no line.
    [[nodiscard]] virtual std::string name_of_row(std::uint32_t row) const;
    /// The complete index of a row that was read recently.
    [[nodiscard]] std::uint64_t whole_row(std::uint32_t row) const noexcept;
    /// The motion has come to this row: nobody asks for those before it any more.
    virtual void passed(std::uint32_t /*row*/) {}
};

/// Both must outlive it. @param sink  of the curve that the input asks for
[[nodiscard]] std::unique_ptr<PathFeeder> make_feeder(PathInput& input, PathSink& sink);

} // namespace splinefeed::host
