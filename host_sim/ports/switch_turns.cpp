// SPDX-License-Identifier: MIT
#include "host_sim/ports/switch_turns.hpp"

namespace splinefeed::host {

std::vector<SwitchTurn> switch_turns(const ProgramPins& lines, EventKind kind, std::int32_t number) {
    std::vector<SwitchTurn> turns;
    const bool on = kind == EventKind::mist_on || kind == EventKind::flood_on ||
                    kind == EventKind::output_on_with_motion || kind == EventKind::output_on;
    if (lines.mist && (kind == EventKind::mist_on || kind == EventKind::coolant_off)) {
        turns.push_back({&*lines.mist, on});
    }
    if (lines.flood && (kind == EventKind::flood_on || kind == EventKind::coolant_off)) {
        turns.push_back({&*lines.flood, on});
    }
    const DigitalOutput* const output = is_output(kind) ? lines.output(number) : nullptr;
    if (output != nullptr) {
        turns.push_back({&output->line, on});
    }
    return turns;
}

std::vector<SwitchTurn> safe_turns(const ProgramPins& lines) {
    std::vector<SwitchTurn> turns;
    for (const auto* const line : {&lines.mist, &lines.flood}) {
        if (*line) {
            turns.push_back({&**line, false});
        }
    }
    for (const DigitalOutput& output : lines.outputs) {
        turns.push_back({&output.line, output.safe_on});
    }
    return turns;
}

} // namespace splinefeed::host
