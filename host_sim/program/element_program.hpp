// SPDX-License-Identifier: MIT
// ElementProgram: a program of lines, arcs and Bezier segments, as moves of the core.
#pragma once

#include "splinefeed/s1_blended_path/path_element.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace splinefeed::host {

/// Moves in order, in the axes of the machine. An element of the file is one move or, if it is a rational or a long
/// curve, several. Memory: about 100 bytes per line, 200 per arc, 600 per Bezier segment.
class ElementProgram {
public:
    /// What every move has.
    struct Move {
        MoveShape shape = MoveShape::line;
        PathMode mode = PathMode::continuous;
        bool stop_at_end = false;
        std::uint32_t element = 0; ///< in the file, from 0
        std::uint32_t detail = 0;  ///< index of its arc or its Bezier points
        PerAxis<Position> to{};
        double tolerance_mm = 0.0;
        double chain_tolerance_mm = 0.0;
        double feed_mm_s = 0.0; ///< 0: the machine's
    };
    struct Dwell {
        std::uint32_t before = 0; ///< element
        double seconds = 0.0;
    };

    void set_start(const PerAxis<Position>& start) noexcept { start_ = start; }
    void add_line(const Move& move) { add(move, MoveShape::line, 0); }
    void add_arc(const Move& move, const ArcShape<double>& arc);
    void add_bezier(const Move& move, const BezierShape<double>& bezier);
    /// The element's own line, e.g. in the G-code that it came from; 0: unknown.
    void add_element_line(std::uint32_t line) { lines_.push_back(line); }
    /// The machine stops at the end of the moves before this element. @pre element is at most elements()
    void stop_before(std::uint32_t element) noexcept;
    /// In any order. @pre before is at most elements()
    void add_dwell(std::uint32_t before, double seconds);

    [[nodiscard]] const PerAxis<Position>& start() const noexcept { return start_; }
    /// Where the last move so far ends.
    [[nodiscard]] const PerAxis<Position>& end() const noexcept { return moves_.empty() ? start_ : moves_.back().to; }
    [[nodiscard]] std::size_t moves() const noexcept { return moves_.size(); }
    [[nodiscard]] std::size_t elements() const noexcept { return lines_.size(); }
    [[nodiscard]] std::uint32_t element_of(std::size_t move) const noexcept { return moves_[move].element; }
    [[nodiscard]] std::uint32_t line_of(std::uint32_t element) const noexcept { return lines_[element]; }
    /// A move in the form of the core.
    [[nodiscard]] PathElement<double> element(std::size_t move) const noexcept;
    /// In the order of their places.
    [[nodiscard]] const std::vector<Dwell>& dwells() const noexcept { return dwells_; }

private:
    void add(const Move& move, MoveShape shape, std::size_t detail);

    PerAxis<Position> start_{};
    std::vector<Move> moves_;
    std::vector<ArcShape<double>> arcs_;
    std::vector<BezierShape<double>> beziers_;
    std::vector<std::uint32_t> lines_; // of each element
    std::vector<Dwell> dwells_;
};

/// "element 3", or "element 3 (line 12)" where the line of its own program is known. @param element from 0
[[nodiscard]] std::string element_name(std::uint64_t element, std::uint32_t line);

} // namespace splinefeed::host
