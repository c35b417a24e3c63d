// SPDX-License-Identifier: MIT
// ElementMoves: a program of elements as steps.
#pragma once

#include "host_sim/program/element_program.hpp"
#include "host_sim/program/move_source.hpp"

namespace splinefeed::host {

class ElementMoves final : public MoveSource {
public:
    /// Both must outlive it.
    /// @param file  its name, for messages
    ElementMoves(const ElementProgram& program, const std::string& file) : program_(&program), file_(&file) {}

    bool start(PerAxis<Position>& position) override;
    bool next(SourceStep& out) override;

    [[nodiscard]] std::uint64_t rows() const noexcept override { return rows_; }
    [[nodiscard]] std::uint32_t row_of(std::uint32_t move) const noexcept override {
        return program_->element_of(move);
    }
    [[nodiscard]] std::uint64_t line_of_row(std::uint64_t /*row*/) const noexcept override { return 0; }
    [[nodiscard]] std::uint64_t number_of_move(std::uint64_t move) const noexcept override;
    [[nodiscard]] std::string name_of_move(std::uint64_t move, std::uint64_t line) const override;
    [[nodiscard]] std::string name_of_row(std::uint32_t row) const override;
    [[nodiscard]] InputError refusal(const SourceStep& step, std::string_view text) const override;
    [[nodiscard]] std::string without_moves(Error error) const override;

private:
    const ElementProgram* program_;
    const std::string* file_;
    std::size_t moves_ = 0;  // delivered
    std::size_t dwells_ = 0; // delivered
    std::uint64_t rows_ = 0;
};

} // namespace splinefeed::host
