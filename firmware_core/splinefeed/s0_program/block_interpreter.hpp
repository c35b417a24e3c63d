// SPDX-License-Identifier: MIT
// BlockInterpreter: the part of the interpreter that does not depend on the scalar: modes, offsets, what a block means.
#pragma once

#include "splinefeed/s0_program/block_status.hpp"
#include "splinefeed/s0_program/program_settings.hpp"
#include "splinefeed/s0_program/word_evaluator.hpp"
#include "splinefeed/s0_program/work_offsets.hpp"

namespace splinefeed {

/// Use it as Interpreter<S>.
class BlockInterpreter : public SystemParameters {
public:
    /// Longest line, without its end.
    static constexpr std::size_t longest_line = 256;

    /// @param evaluator  for # and [: an Expression; none: they are refused. What it refers to must outlive this.
    explicit BlockInterpreter(const ProgramSettings& settings, WordEvaluator* evaluator = nullptr) noexcept;

    /// Where the machine stands, in machine coordinates. Before the first push(), and after an abort.
    void start(const PerAxis<Position>& position) noexcept;
    /// For the next program: modes as at the start, offsets and position as they are.
    void restart() noexcept;
    /// The offsets of a state file.
    void restore(const WorkOffsets& offsets) noexcept;
    [[nodiscard]] const WorkOffsets& offsets() const noexcept;

    /// Executes a line. After an error nothing of the line has happened, and the next line may follow. The text must
    /// live until the next push(): messages and splines refer to it. @pre next() has returned starved
    /// @param line_number  of the source, for the items
    /// Cost: about 100 ns on x86-64, 10,000 instructions on a Cortex-M4F.
    BlockStatus push(std::string_view text, std::uint32_t line_number) noexcept;

    /// After the machine has executed a probe move: where the contact was, and where the machine stands now. Without
    /// it the contact counts as found at the end of the move.
    void report_probe(bool contact, const PerAxis<Position>& contact_at, const PerAxis<Position>& stands_at) noexcept;
    /// After the machine has executed M66: the input's value, -1 after the time-out.
    void report_input(Decimal value) noexcept;
    /// Where the last move ends, in machine coordinates.
    [[nodiscard]] PerAxis<Position> position() const noexcept;
};

} // namespace splinefeed
