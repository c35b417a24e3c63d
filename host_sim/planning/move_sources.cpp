// SPDX-License-Identifier: MIT
#include "host_sim/planning/move_sources.hpp"

#include "host_sim/program/element_program.hpp"
#include "host_sim/program/gcode/gcode_moves.hpp"
#include "host_sim/program/gcode/line_history.hpp"
#include "host_sim/program/move_source.hpp"
#include "host_sim/program/path_input.hpp"

#include <fmt/format.h>
#include <memory>
#include <vector>

namespace splinefeed::host {

namespace {

/// The lines between waypoints as moves.
class RowMoves final : public MoveSource {
public:
    /// Reads the rows of the input, which must outlive it.
    explicit RowMoves(PathInput& input) : input_(&input), rows_(input.rows()), lines_(remembered) {}

    bool start(PerAxis<Position>& position) override {
        WaypointRow row;
        return read(row, position);
    }

    bool next(SourceStep& out) override {
        WaypointRow row;
        out = {};
        PathElement<double>& move = out.move;
        if (!read(row, move.to)) {
            return false;
        }
        out.line = row.line;
        out.row = rows_read_ - 1;
        move.stop_at_end = row.corner == Corner::forced;
        move.tolerance_mm = row.tolerance_mm.value_or(input_->choice().tolerance_mm);
        move.feed_mm_s = row.feed_mm_s;
        move.max_feed_mm_s = row.max_feed_mm_s;
        return true;
    }

    [[nodiscard]] bool wait(Patience patience) override { return rows_->wait(patience); }

    [[nodiscard]] std::uint64_t rows() const noexcept override { return rows_read_; }
    void pushed(const SourceStep& step) override { ahead_.add(step.row - ahead_.moves()); }
    [[nodiscard]] std::uint32_t row_of(std::uint32_t move) const noexcept override {
        return move + static_cast<std::uint32_t>(ahead_.line_of(move));
    }

    [[nodiscard]] std::uint64_t line_of_row(std::uint64_t row) const noexcept override {
        const bool known = row < rows_read_ && row + remembered >= rows_read_;
        return known ? lines_[row % remembered] : 0;
    }

    [[nodiscard]] std::uint64_t number_of_move(std::uint64_t move) const noexcept override {
        return move + ahead_.line_of(move) + 1;
    }

    [[nodiscard]] std::string name_of_move(std::uint64_t move, std::uint64_t line) const override {
        return fmt::format("the move to point {} (line {})", number_of_move(move), line);
    }

    [[nodiscard]] std::string name_of_row(std::uint32_t row) const override { return fmt::format("point {}", row + 1); }

    [[nodiscard]] InputError refusal(const SourceStep& step, std::string_view text) const override {
        return {input_->name(), step.line, text};
    }

private:
    static constexpr std::size_t remembered = 1024; ///< number of lines that are remembered

    bool read(WaypointRow& row, PerAxis<Position>& position) {
        if (!rows_->next(row)) {
            return false;
        }
        lines_[rows_read_++ % remembered] = row.line;
        for (unsigned k = 0; k < input_->axes().size(); ++k) {
            position[k] = position_from_mm(row.position[k]);
        }
        return true;
    }

    const PathInput* input_;
    std::unique_ptr<WaypointRows> rows_;
    std::vector<std::uint64_t> lines_; // line of row i at index i % remembered
    LineHistory ahead_;                // of each move: how many rows its own is ahead of it
    std::uint64_t rows_read_ = 0;
};

/// A program of elements as steps.
class ElementMoves final : public MoveSource {
public:
    /// Both must outlive it.
    /// @param file  its name, for messages
    ElementMoves(const ElementProgram& program, const std::string& file) : program_(&program), file_(&file) {}

    bool start(PerAxis<Position>& position) override {
        position = program_->start();
        return true;
    }

    bool next(SourceStep& out) override {
        out = {};
        const bool all = moves_ == program_->moves();
        const std::uint32_t element =
            all ? static_cast<std::uint32_t>(program_->elements()) : program_->element_of(moves_);
        if (dwells_ < program_->dwells().size() && program_->dwells()[dwells_].before <= element) {
            out.kind = StepKind::dwell;
            out.stops = true;
            out.dwell_s = program_->dwells()[dwells_++].seconds;
            return true;
        }
        if (all) {
            return false;
        }
        out.line = program_->line_of(element);
        out.row = element;
        out.move = program_->element(moves_);
        rows_ = element + std::uint64_t{1};
        ++moves_;
        return true;
    }

    [[nodiscard]] std::uint64_t rows() const noexcept override { return rows_; }
    void pushed(const SourceStep& step) override { taken_.push_back(static_cast<std::uint32_t>(step.row)); }
    [[nodiscard]] std::uint32_t row_of(std::uint32_t move) const noexcept override {
        return move < taken_.size() ? taken_[move] : 0;
    }
    [[nodiscard]] std::uint64_t line_of_row(std::uint64_t /*row*/) const noexcept override { return 0; }

    [[nodiscard]] std::uint64_t number_of_move(std::uint64_t move) const noexcept override {
        return row_of(static_cast<std::uint32_t>(move)) + std::uint64_t{1};
    }

    [[nodiscard]] std::string name_of_move(std::uint64_t move, std::uint64_t line) const override {
        return element_name(number_of_move(move) - 1, static_cast<std::uint32_t>(line));
    }

    [[nodiscard]] std::string name_of_row(std::uint32_t row) const override {
        return element_name(row, program_->line_of(row));
    }

    [[nodiscard]] InputError refusal(const SourceStep& /*step*/, std::string_view text) const override {
        return {*file_, 0, fmt::format("{}: {}", name_of_row(static_cast<std::uint32_t>(rows_ - 1)), text)};
    }

    [[nodiscard]] std::string without_moves(Error /*error*/) const override {
        return "no element moves; a program needs a move";
    }

private:
    const ElementProgram* program_;
    const std::string* file_;
    std::vector<std::uint32_t> taken_; // elements of the moves in the path
    std::size_t moves_ = 0;            // delivered
    std::size_t dwells_ = 0;           // delivered
    std::uint64_t rows_ = 0;
};

} // namespace

std::unique_ptr<MoveSource> move_source(PathInput& input, ScalarKind scalar, ProblemList* problems) {
    if (const ElementProgram* const program = input.elements()) {
        return std::make_unique<ElementMoves>(*program, input.name());
    }
    if (const GcodeSettings* const settings = input.gcode()) {
        return gcode_moves(*settings, input.name(), input.lines(), scalar, problems);
    }
    return std::make_unique<RowMoves>(input);
}

} // namespace splinefeed::host
