// SPDX-License-Identifier: MIT
// GcodeMoves: a program in G-code as steps.
#pragma once

#include "host_sim/program/gcode/line_history.hpp"
#include "host_sim/program/gcode/parameter_memory.hpp"
#include "host_sim/program/gcode_settings.hpp"
#include "host_sim/program/move_source.hpp"
#include "host_sim/program/source_line.hpp"

#include "splinefeed/s0_program/expression.hpp"
#include "splinefeed/s0_program/interpreter.hpp"

#include <memory>

namespace splinefeed::host {

/// Reads a line when the step before it has been taken, so motion can begin before the program ends. Errors have the
/// line and the column.
template <Scalar S>
class GcodeMoves final : public MoveSource<S> {
public:
    /// @param file  for messages
    /// `settings` must outlive it.
    GcodeMoves(const GcodeSettings& settings, std::string file, std::unique_ptr<SourceLines> lines);

    bool start(PerAxis<Position>& position) override;
    bool next(SourceStep<S>& out) override;
    [[nodiscard]] bool wait(typename MoveSource<S>::Patience patience) override;
    [[nodiscard]] bool knows_stops() const noexcept override { return false; }
    void pushed(const SourceStep<S>& step) override { history_.add(step.line); }

    [[nodiscard]] std::uint64_t rows() const noexcept override { return history_.moves(); }
    [[nodiscard]] std::uint32_t row_of(std::uint32_t move) const noexcept override { return move; }
    [[nodiscard]] std::uint64_t line_of_row(std::uint64_t row) const noexcept override { return history_.line_of(row); }
    [[nodiscard]] std::uint64_t number_of_move(std::uint64_t move) const noexcept override { return move + 1; }
    [[nodiscard]] std::string name_of_move(std::uint64_t move, std::uint64_t line) const override;
    [[nodiscard]] std::string name_of_row(std::uint32_t row) const override;
    [[nodiscard]] InputError refusal(const SourceStep<S>& step, std::string_view text) const override;
    [[nodiscard]] std::string without_moves(Error /*error*/) const override { return {}; }
    void passed(std::uint64_t row) noexcept override { history_.forget_before(row); }

private:
    void read_line();
    void take(SourceStep<S>& out);
    void take_move(SourceStep<S>& out) const;
    void take_event(SourceStep<S>& out);
    void require_possible(EventKind kind) const;
    [[nodiscard]] std::string in_the_line(const BlockStatus& status) const;

    const GcodeSettings* settings_;
    std::string file_;
    std::unique_ptr<SourceLines> lines_;
    ParameterMemory parameters_;
    Expression expression_{parameters_};
    Interpreter<S> interpreter_;
    SourceLine line_;
    ProgramItem<S> item_;
    PerAxis<Position> here_{}; // where the last move so far ends
    LineHistory history_;
    bool pending_ = false; // the block has more items
};

} // namespace splinefeed::host
