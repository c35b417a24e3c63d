// SPDX-License-Identifier: MIT
// Interpreter: lines of G-code to moves, dwells and events.
#pragma once

#include "splinefeed/s0_program/block_interpreter.hpp"
#include "splinefeed/s0_program/cycles/point_curve.hpp"
#include "splinefeed/s0_program/cycles/rational_pieces.hpp"
#include "splinefeed/s0_program/words/program_item.hpp"

namespace splinefeed {

/// Push a line, pull its items until `starved`, push the next line. What a line does is decided, and every error of it
/// is found, by push(): next() cannot fail. Cycles and splines expand one item at a time, so memory is constant.
///
///     Interpreter<double> interpreter(settings, &expression);
///     interpreter.start(machine_position);
///     while (read_line(text)) {
///         if (const BlockStatus status = interpreter.push(text, ++line); !status.ok()) { ... describe(status.error) }
///         while (interpreter.next(item) == Pull::item) { ... }
///     }
///
/// Moves that the program states as rapids have feed_mm_s 0. Items with stops_before need the machine at rest: whoever
/// passes moves on sets stop_at_end of the move before them. Moves without length occur; TolerancePath drops them.
/// All decisions are made by integers, so they are the same for every S and on every target.
/// Memory: 3.5 KB with three axes, 4 KB with six.
template <Scalar S>
class Interpreter : public BlockInterpreter {
public:
    /// @param points  for G5.5; none: it is refused. Both that it refers to must outlive this.
    explicit Interpreter(const ProgramSettings& settings, WordEvaluator* evaluator = nullptr,
                         PointCurve<S>* points = nullptr) noexcept
        : BlockInterpreter(settings, evaluator), points_(points) {
        takes_points_ = points != nullptr;
    }

    /// The next item of the block. `starved`: push the next line; `finished`: the program has ended (M2, M30, the
    /// closing %), and push() does nothing more until restart(). Cost: about that of a few square roots for a move.
    Pull next(ProgramItem<S>& out) noexcept;

private:
    void begin_chain(PathElement<S>& element) noexcept;
    void fill_manner(const MoveManner& how, MoveKind move, ProgramItem<S>& out) const noexcept;
    void fill_move(const ProgramStep& step, ProgramItem<S>& out) const noexcept;
    void fill_arc(const ProgramStep& step, ProgramItem<S>& out) const noexcept;
    void fill_bezier(const ProgramStep& step, ProgramItem<S>& out) const noexcept;
    void fill_piece(ProgramItem<S>& out) noexcept;
    void add_point(const ProgramStep& step) noexcept;
    [[nodiscard]] bool give_curve(ProgramItem<S>& out) noexcept;
    [[nodiscard]] S path_feed(const ProgramStep& step) const noexcept;
    [[nodiscard]] S space_length(const ProgramStep& step) const noexcept;

    PointCurve<S>* points_;
    RationalPieces<S> pieces_{};
    bool pieces_begun_ = false; // the next piece is not the first
    S pieces_feed_{};
    AxisPoint pieces_to_{};
    PerAxis<Position> piece_end_{};
};

// The core is compiled without run-time type information: its virtual tables stay there.
extern template class Interpreter<double>;
extern template class Interpreter<float>;
extern template class Interpreter<Fixed>;

} // namespace splinefeed
