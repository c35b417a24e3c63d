// SPDX-License-Identifier: MIT
// PendingSteps: dwells and events of a program that the motion has not reached yet, each with its place on the path.
#pragma once

#include "host_sim/program/move_source.hpp"

#include <deque>
#include <optional>

namespace splinefeed::host {

/// A dwell or an event, behind the move of `row`.
struct PendingStep {
    StepKind kind = StepKind::event;
    bool stops = false; ///< the machine stands at the end of the move
    double dwell_s = 0.0;
    std::uint64_t line = 0;
    ProgramAction action{};
    std::shared_ptr<const WorkOffsets> offsets{}; ///< what the event makes of them; null: nothing
    std::optional<std::uint32_t> row{}; ///< of the last move before it, as segments name it; none: before every move
    PerAxis<Position> place{};          ///< where that move ends
    std::uint32_t short_rows = 0; ///< rows behind it with moves too short to be one: the path may have one of them
};

/// First in, first out. Memory: the steps between what the path has read and what has been travelled.
class PendingSteps {
public:
    /// 0.1 um: shorter moves are none.
    static constexpr double same_place_mm = 1e-4;

    void add(PendingStep step) { steps_.push_back(std::move(step)); }
    [[nodiscard]] bool empty() const noexcept { return steps_.empty(); }

    /// The first step if the machine is past it when a segment of `row` begins; null: it is not.
    [[nodiscard]] const PendingStep* passed(std::uint32_t row) const noexcept;
    /// The first step if the machine has come to a standstill where it is due.
    /// @param row  of the last segment; none: nothing has moved yet
    /// @param position_mm  of the axes
    [[nodiscard]] const PendingStep* reached(std::optional<std::uint32_t> row, const PerAxis<double>& position_mm,
                                             int axes) const noexcept;
    /// @pre not empty
    [[nodiscard]] const PendingStep& first() const noexcept { return steps_.front(); }
    /// Removes the first step. @pre not empty
    PendingStep take();

private:
    std::deque<PendingStep> steps_;
};

} // namespace splinefeed::host
