// SPDX-License-Identifier: MIT
// PathFeeder: the way of an input into its curve. CurveWatch: whoever looks at the curve before it is planned.
#pragma once

#include "host_sim/program/move_source.hpp"
#include "host_sim/program/path_input.hpp"
#include "splinefeed/move_stream/move_stream.hpp"
#include "splinefeed/s1_curve/waypoint.hpp"

#include <functional>
#include <memory>
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
        std::uint32_t moves = 0;      ///< so many moves are before the step
        bool stops = false;           ///< the machine stands at the end of the moves before
    };
    /// Pushes what comes next, or finishes the curve; false if there is nothing. Throws InputError; the curve then ends
    /// with what came before. @pre the curve is starved
    virtual bool more(Pushed& pushed) = 0;
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

/// Where waypoints go: the curve that is made of them, whatever its scalar is.
struct WaypointSink {
    std::function<Status(const Waypoint<double>&, Role)> push; ///< errors: those of WaypointCurve::push()
    std::function<Status()> finish;
};

/// Of moves. Both must outlive it. @pre input.within_tolerance()
[[nodiscard]] std::unique_ptr<PathFeeder> make_feeder(PathInput& input, MoveStream& stream);
/// Of any other curve.
[[nodiscard]] std::unique_ptr<PathFeeder> make_feeder(PathInput& input, WaypointSink sink);

} // namespace splinefeed::host
