// SPDX-License-Identifier: MIT
// ProgramItems: the interpreter of a program in the scalar of its run, and what it makes of lines, in double.
#pragma once

#include "host_sim/base/scalar_kind.hpp"

#include "splinefeed/s0_program/block_interpreter.hpp"
#include "splinefeed/s0_program/expression.hpp"
#include "splinefeed/s0_program/words/program_item.hpp"

#include <memory>
#include <optional>

namespace splinefeed::host {

/// A host takes the items that a microcontroller computes: the feed of a move and the points of a spline depend on the
/// scalar.
class ProgramItems {
public:
    ProgramItems() = default;
    ProgramItems(const ProgramItems&) = delete;
    ProgramItems& operator=(const ProgramItems&) = delete;
    virtual ~ProgramItems() = default;

    [[nodiscard]] virtual BlockInterpreter& interpreter() noexcept = 0;
    /// Interpreter::next(). Every number is the one that was computed, but for points of Bezier segments.
    /// @param exact  gets these points, if double may have too few digits for them
    virtual Pull next(ProgramItem<double>& out, std::optional<BezierShape<Fixed>>& exact) = 0;
};

/// @param settings, expression  of the interpreter; what they refer to must outlive it
/// @param max_feed_mm_s  largest feed of a move that is no rapid; 0: none
[[nodiscard]] std::unique_ptr<ProgramItems> program_items(ScalarKind scalar, const ProgramSettings& settings,
                                                          Expression& expression, double max_feed_mm_s);

} // namespace splinefeed::host
