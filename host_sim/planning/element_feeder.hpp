// SPDX-License-Identifier: MIT
// ElementFeeder: the steps of a program into the stream of its moves.
#pragma once

#include "host_sim/planning/path_feeder.hpp"

namespace splinefeed::host {

/// Behind most_behind steps without a move between them the machine stands, so that they happen: what waits for the end
/// of the move that is kept back is bounded.
class ElementFeeder final : public PathFeeder {
public:
    static constexpr std::size_t most_behind = 64;

    /// Both must outlive it. @pre input.within_tolerance()
    ElementFeeder(PathInput& input, MoveStream& stream);

    bool more(Pushed& pushed) override;
    [[nodiscard]] bool awaits_answer() const noexcept override { return !finished_ && program_->awaits_answer(); }
    [[nodiscard]] bool wait_for_row(Patience patience) override { return finished_ || program_->wait(patience); }
    [[nodiscard]] MoveSource* program() const noexcept override { return program_.get(); }

    [[nodiscard]] std::uint64_t rows() const noexcept override { return program_->rows(); }
    [[nodiscard]] std::uint32_t row_of(std::uint32_t index) const noexcept override { return program_->row_of(index); }
    [[nodiscard]] std::uint64_t line_of_row(std::uint32_t row) const noexcept override {
        return program_->line_of_row(whole_row(row));
    }
    [[nodiscard]] std::string name_of_row(std::uint32_t row) const override { return program_->name_of_row(row); }
    void passed(std::uint32_t row) override { program_->passed(whole_row(row)); }

private:
    bool take(Pushed& pushed);
    void take_move(Pushed& pushed);
    void limit_tolerance(SourceStep& step) const;
    void finish();

    const PathInput* input_;
    MoveStream* stream_;
    std::unique_ptr<MoveSource> program_;
    SourceStep step_;        // read last
    std::size_t behind_ = 0; // steps since the last move or stop
    bool started_ = false;
    bool finished_ = false;
};

} // namespace splinefeed::host
