// SPDX-License-Identifier: MIT
// ElementFeeder: moves of a program, or lines between waypoints, into a path within their tolerance.
#pragma once

#include "host_sim/program/path_input.hpp"

#include "splinefeed/s1_blended_path/tolerance_path.hpp"

#include <memory>
#include <vector>

namespace splinefeed::host {

/// Owns the path. more() pushes one move at a time, so waypoints are not read before the path needs them.
template <Scalar S>
class ElementFeeder {
public:
    /// `input` must outlive it. @pre input.within_tolerance()
    /// @param rows  null for a program
    ElementFeeder(PathInput& input, std::unique_ptr<WaypointRows> rows);

    [[nodiscard]] CurveSource<S>& source() noexcept { return path_; }
    [[nodiscard]] const TolerancePath<S>& path() const noexcept { return path_; }

    /// What more() did.
    struct Pushed {
        bool start = false;                ///< it told where the first move begins
        PerAxis<Position> position{};      ///< there, or at the end of the move
        const PathElement<double>* move{}; ///< null: none; valid until the next call
        std::uint64_t line = 0;            ///< of the move, in the CSV or in the program that the elements came from
    };
    /// Pushes the start, the next move, or finishes the path; false if there is none. Throws InputError; the path then
    /// ends with the moves before. @pre the path is starved
    bool more(Pushed& pushed);
    [[nodiscard]] bool wait_for_row(WaypointRows::Patience patience) {
        return finished_ || rows_ == nullptr || rows_->wait(patience);
    }

    /// Waypoints, or elements, so far.
    [[nodiscard]] std::uint64_t rows() const noexcept { return rows_read_; }
    /// Index of the waypoint or the element for an index of CurveSegment::waypoint, modulo 2^32.
    [[nodiscard]] std::uint32_t row_of(std::uint32_t index) const noexcept {
        return program_ == nullptr ? index + 1U : program_->element_of(index);
    }
    /// Line of a waypoint in its file; 0: unknown.
    [[nodiscard]] std::uint64_t line_of_row(std::uint64_t row) const noexcept;

private:
    static constexpr std::size_t remembered = 1024; ///< number of lines that are remembered

    bool next(Pushed& pushed);
    void finish();
    [[noreturn]] void refuse(Error error, std::uint64_t line) const;

    PathInput* input_;
    const ElementProgram* program_; // null: rows
    std::unique_ptr<WaypointRows> rows_;
    TolerancePath<S> path_;
    PathElement<double> move_;         // the last one
    PerAxis<Position> at_{};           // its end
    std::vector<std::uint64_t> lines_; // line of row i at index i % remembered
    std::uint64_t rows_read_ = 0;
    std::uint64_t moves_ = 0;
    bool started_ = false;
    bool finished_ = false;
};

} // namespace splinefeed::host
