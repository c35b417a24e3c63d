// SPDX-License-Identifier: MIT
#include "host_sim/planning/move_sources.hpp"

#include "host_sim/program/element_moves.hpp"
#include "host_sim/program/gcode/gcode_moves.hpp"
#include "host_sim/program/row_moves.hpp"

namespace splinefeed::host {

template <Scalar S>
std::unique_ptr<MoveSource<S>> move_source(PathInput& input) {
    if (const ElementProgram* const program = input.elements()) {
        return std::make_unique<ElementMoves<S>>(*program, input.name());
    }
    if (const GcodeSettings* const settings = input.gcode()) {
        return gcode_moves<S>(*settings, input.name(), input.lines());
    }
    return std::make_unique<RowMoves<S>>(input);
}

template std::unique_ptr<MoveSource<double>> move_source(PathInput& input);
template std::unique_ptr<MoveSource<float>> move_source(PathInput& input);
template std::unique_ptr<MoveSource<Fixed>> move_source(PathInput& input);

} // namespace splinefeed::host
