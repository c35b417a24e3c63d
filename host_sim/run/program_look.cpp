// SPDX-License-Identifier: MIT
#include "host_sim/run/program_look.hpp"

#include "host_sim/analysis/move_extent.hpp"
#include "host_sim/base/interruption.hpp"
#include "host_sim/planning/move_sources.hpp"

#include <algorithm>

namespace splinefeed::host {

std::optional<std::uint64_t> look_at_moves(PathInput& input, const PathLimits& limits, int axes) {
    const auto program = move_source(input, input.scalar());
    PerAxis<Position> here{};
    static_cast<void>(program->start(here));
    AxisBox box;
    double tolerance = 0.0; // the path leaves the box of its moves by no more
    std::uint64_t moves = 0;
    for (SourceStep step; program->next(step);) {
        Interruption::point();
        if (program->awaits_answer()) {
            return std::nullopt;
        }
        if (step.kind != StepKind::move) {
            continue;
        }
        add_extent(here, step.move, axes, box);
        tolerance = std::max({tolerance, step.move.tolerance_mm, step.move.chain_tolerance_mm});
        here = step.move.to;
        ++moves;
        program->pushed(step);
        program->passed(moves); // nobody asks for its line
    }
    return moves > 0 && limits.contain(box.low, box.high, tolerance) ? std::optional(moves) : std::nullopt;
}

} // namespace splinefeed::host
