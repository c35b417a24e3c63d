// SPDX-License-Identifier: MIT
// MoveSource: a program as a sequence of steps: moves, dwells and events.
#pragma once

#include "host_sim/base/input_error.hpp"
#include "host_sim/program/program_action.hpp"

#include "splinefeed/base/status.hpp"
#include "splinefeed/s1_blended_path/path_element.hpp"

#include "splinefeed/s0_program/words/work_offsets.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <string>

namespace splinefeed::host {

enum class StepKind : std::uint8_t { move, dwell, event, nothing };

/// Only the members of its kind are meaningful.
struct SourceStep {
    StepKind kind = StepKind::move;
    std::uint64_t line = 0; ///< of its source; 0: unknown
    std::uint64_t row = 0;  ///< of a move: of its waypoint or element, from 0

    PathElement<double> move{};
    /// Of a Bezier segment from an interpreter in Fixed: its points, which may have more digits than double.
    std::optional<BezierShape<Fixed>> exact_points{};
    bool rapid = false;

    bool stops = false;   ///< the machine stands at the end of the moves before it
    double dwell_s = 0.0; ///< of a dwell, and how long the machine waits for an event
    ProgramAction action{};
    std::shared_ptr<const WorkOffsets> offsets{}; ///< of an event that changes them: what they are then
};

/// What a program has behind its end (M2, M30).
struct UnreadLines {
    std::uint64_t end = 0;   ///< the line where it ends
    std::uint64_t lines = 0; ///< with words, behind it
};

/// Every method that reads throws InputError.
class MoveSource {
public:
    using Patience = std::chrono::steady_clock::duration;

    MoveSource() = default;
    MoveSource(const MoveSource&) = delete;
    MoveSource& operator=(const MoveSource&) = delete;
    virtual ~MoveSource() = default;

    /// Where the first move begins. Call it once, before next(); false: there is nothing. May wait for the input.
    virtual bool start(PerAxis<Position>& position) = 0;
    /// The next step, which may be nothing; false: there are no more. May wait for the input.
    virtual bool next(SourceStep& out) = 0;
    /// Whether start() or next() would return without waiting; waits for that up to the given time.
    [[nodiscard]] virtual bool wait(Patience /*patience*/) { return true; }

    /// Whether the program waits for what an input says (M66): until answer() is called next() returns nothing, and
    /// wait() is false, since everything behind it may depend on that.
    [[nodiscard]] virtual bool awaits_answer() const noexcept { return false; }
    /// The answer: 0 or 1, -1 after the time-out. @pre awaits_answer()
    virtual void answer(int /*value*/) {}
    /// The answer that the program waits for. @pre as above
    [[nodiscard]] virtual int expected_answer() const noexcept { return 0; }

    /// The path has taken a move. Not all are: some have no length.
    virtual void pushed(const SourceStep& /*step*/) {}
    /// Number of waypoints, elements or lines so far.
    [[nodiscard]] virtual std::uint64_t rows() const noexcept = 0;
    /// Of a move, from 0, as the path has taken them: the index of its waypoint, element or move, modulo 2^32.
    [[nodiscard]] virtual std::uint32_t row_of(std::uint32_t move) const noexcept = 0;
    /// Line of a row in the file; 0: unknown.
    [[nodiscard]] virtual std::uint64_t line_of_row(std::uint64_t row) const noexcept = 0;
    /// What a move is counted as, from 1; and its name, e.g. "element 3 (line 12)".
    [[nodiscard]] virtual std::uint64_t number_of_move(std::uint64_t move) const noexcept = 0;
    [[nodiscard]] virtual std::string name_of_move(std::uint64_t move, std::uint64_t line) const = 0;
    /// For messages that do not begin with a line.
    [[nodiscard]] virtual std::string name_of_row(std::uint32_t row) const = 0;
    /// An error of the move that was delivered last.
    [[nodiscard]] virtual InputError refusal(const SourceStep& step, std::string_view text) const = 0;
    /// An error of a program that has no move; empty: it needs none.
    [[nodiscard]] virtual std::string without_moves(Error error) const { return std::string(describe(error)); }
    /// The motion has come to this row: nobody asks for those before it any more.
    virtual void passed(std::uint64_t /*row*/) noexcept {}
    /// Reads what is left of a file. @pre next() has returned false
    [[nodiscard]] virtual UnreadLines unread() { return {}; }
};

} // namespace splinefeed::host
