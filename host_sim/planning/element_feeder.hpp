// SPDX-License-Identifier: MIT
// ElementFeeder: the moves of a program into a path within their tolerance.
#pragma once

#include "host_sim/planning/path_feeder.hpp"

#include <deque>
#include <exception>

namespace splinefeed::host {

/// If a program does not say in advance where the machine has to stand, a move waits here until the next step that says
/// so is known, and with it up to most_behind steps that happen behind it and do not say it: a message before a dwell,
/// for example.
class ElementFeeder final : public PathFeeder {
public:
    static constexpr std::size_t most_behind = 64;

    /// Both must outlive it. @pre input.within_tolerance()
    ElementFeeder(PathInput& input, PathSink& sink);

    bool more(Pushed& pushed) override;
    bool release(Pushed& pushed) override;
    /// MoveSource::awaits_answer(), once everything before is delivered.
    [[nodiscard]] bool awaits_answer() const noexcept override {
        return !finished_ && failure_ == nullptr && due_ == 0 && program_->awaits_answer();
    }
    [[nodiscard]] bool wait_for_row(Patience patience) override {
        return finished_ || failure_ != nullptr || due_ > 0 || program_->wait(patience);
    }
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
    void take_due(Pushed& pushed);
    void push_held(Pushed& pushed);
    void push(SourceStep& step, Pushed& pushed);
    void limit_tolerance(SourceStep& step) const;
    [[nodiscard]] bool has_length(const SourceStep& step) const;
    void finish();

    const PathInput* input_;
    PathSink* sink_;
    std::unique_ptr<MoveSource> program_;
    SourceStep step_; // read last
    SourceStep held_; // a move that waits for what comes behind it
    struct Behind {
        SourceStep step;
        std::optional<std::uint32_t> row;
    };
    std::deque<Behind> behind_;        // dwells and events behind the move that waits, or one that was pushed
    std::size_t due_ = 0;              // so many of them are behind moves that were pushed
    SourceStep pushed_;                // the move that was pushed last
    PerAxis<Position> here_{};         // where the last move so far ends, held or not
    std::optional<std::uint32_t> row_; // of the last move with a length
    std::uint32_t short_rows_ = 0;     // behind it
    std::exception_ptr failure_;       // thrown behind the moves before it
    std::uint32_t moves_ = 0;          // pushed
    bool holds_ = false;
    bool started_ = false;
    bool finished_ = false;
};

} // namespace splinefeed::host
