// SPDX-License-Identifier: MIT
// How ProgramFlow saves modes and puts them back: M70 to M73.
#include "host_sim/program/gcode/program_flow.hpp"

#include "splinefeed/s0_program/block_interpreter.hpp"

#include <algorithm>

namespace splinefeed::host {

SavedModes ProgramFlow::modes() const {
    return {system_->modal(), system_->offsets(), rules_.coolant != nullptr ? *rules_.coolant : CoolantState{}};
}

// Each call has its own place for them, and the main program has one.
void ProgramFlow::execute_modes(const FlowWord& word, const SourceLine& line) {
    if (!word.others.empty()) {
        fail(line, word.label_at, "M70 to M73 stand alone in their line");
    }
    const auto called =
        std::find_if(frames_.rbegin(), frames_.rend(), [](const Frame& frame) { return frame.call != Call::none; });
    std::optional<SavedModes>& place = called == frames_.rend() ? modes_ : called->modes;
    switch (word.kind) {
    case FlowKind::forget_modes: place.reset(); break;
    case FlowKind::restore_modes:
        if (!place) {
            fail(line, word.label_at, "M72 needs an M70 or M73 before, in the same subprogram");
        }
        if (place->modal.cutter.side != 0 && system_->modal().cutter.side == 0) {
            fail(line, word.label_at,
                 "M72 cannot begin cutter compensation again; write G40 before M70, and G41 behind M72");
        }
        put_back(*place, line);
        break;
    default:
        place = modes();
        if (called != frames_.rend()) {
            called->lends = called->lends || word.kind == FlowKind::lend_modes;
        }
    }
}

void ProgramFlow::put_back(const SavedModes& saved, const SourceLine& line) {
    for (std::string& text : restoring_lines(saved, modes(), rules_.axes)) {
        restoring_.push_back({std::move(text), line.number, true, line.file});
    }
}

} // namespace splinefeed::host
