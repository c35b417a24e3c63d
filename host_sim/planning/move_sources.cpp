// SPDX-License-Identifier: MIT
#include "host_sim/planning/move_sources.hpp"

#include "host_sim/program/element_moves.hpp"
#include "host_sim/program/gcode/gcode_moves.hpp"
#include "host_sim/program/row_moves.hpp"

namespace splinefeed::host {

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
