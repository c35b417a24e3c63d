// SPDX-License-Identifier: MIT
// RowMoves: the lines between waypoints as moves.
#pragma once

#include "host_sim/program/move_source.hpp"
#include "host_sim/program/path_input.hpp"

#include <memory>
#include <vector>

namespace splinefeed::host {

class RowMoves final : public MoveSource {
public:
    /// Reads the rows of the input, which must outlive it.
    explicit RowMoves(PathInput& input);

    bool start(PerAxis<Position>& position) override;
    bool next(SourceStep& out) override;
    [[nodiscard]] bool wait(Patience patience) override { return rows_->wait(patience); }

    [[nodiscard]] std::uint64_t rows() const noexcept override { return rows_read_; }
    [[nodiscard]] std::uint32_t row_of(std::uint32_t move) const noexcept override { return move + 1U; }
    [[nodiscard]] std::uint64_t line_of_row(std::uint64_t row) const noexcept override;
    [[nodiscard]] std::uint64_t number_of_move(std::uint64_t move) const noexcept override { return move + 2; }
    [[nodiscard]] std::string name_of_move(std::uint64_t move, std::uint64_t line) const override;
    [[nodiscard]] std::string name_of_row(std::uint32_t row) const override;
    [[nodiscard]] InputError refusal(const SourceStep& step, std::string_view text) const override;

private:
    static constexpr std::size_t remembered = 1024; ///< number of lines that are remembered

    bool read(WaypointRow& row, PerAxis<Position>& position);

    const PathInput* input_;
    std::unique_ptr<WaypointRows> rows_;
    std::vector<std::uint64_t> lines_; // line of row i at index i % remembered
    std::uint64_t rows_read_ = 0;
};

} // namespace splinefeed::host
