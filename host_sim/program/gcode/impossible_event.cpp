// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/impossible_event.hpp"

#include "host_sim/program/program_action.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

// What the machine has no output for is refused, rather than left out.
std::string impossible(const ProgramEvent& event, const GcodeSettings& settings) {
    static const ProgramLines none;
    const ProgramLines& lines = settings.lines != nullptr ? *settings.lines : none;
    std::string missing;
    switch (event.kind) {
    case EventKind::message:
    case EventKind::print:
    case EventKind::debug:
    case EventKind::tool_select:
    case EventKind::tool_set:
    case EventKind::tool_change:
    case EventKind::pause:
    case EventKind::optional_pause:
    case EventKind::pallet_pause:
    case EventKind::program_end:
    case EventKind::overrides_on:
    case EventKind::feed_override:
    case EventKind::spindle_override:
    case EventKind::offsets_changed: return {};
    case EventKind::spindle_speed:
    case EventKind::spindle_clockwise:
    case EventKind::spindle_counterclockwise:
    case EventKind::spindle_stop:
        if (settings.spindle != nullptr && settings.spindle->is_controlled()) {
            return {};
        }
        missing = "spindle for this; name its frequency inverter, vfd = \"modbus-rtu://...\", or its line, "
                  "enable = { line = ... }, in [spindle]";
        break;
    case EventKind::surface_speed:
        return fmt::format(
            "{}: only the simulated machine changes the speed of its spindle along a move so far; use G97 "
            "and S in rpm in the place of G96",
            action_name(event.kind));
    case EventKind::mist_on:
        if (lines.mist) {
            return {};
        }
        missing = "line for this; name it in [coolant.mist]";
        break;
    case EventKind::flood_on:
        if (lines.flood) {
            return {};
        }
        missing = "line for this; name it in [coolant.flood]";
        break;
    case EventKind::coolant_off:
        if (lines.mist || lines.flood) {
            return {};
        }
        missing = "coolant; name its line in [coolant.mist] or [coolant.flood]";
        break;
    case EventKind::output_on_with_motion:
    case EventKind::output_off_with_motion:
    case EventKind::output_on:
    case EventKind::output_off:
        if (lines.output(event.number) != nullptr) {
            return {};
        }
        missing = fmt::format("output {}; name its line in [[output]] with number = {}", event.number, event.number);
        break;
    case EventKind::input_wait:
        if (event.analog) {
            return fmt::format(
                "{}: M66 E reads an analog input, and only digital ones are read, M66 P; take it out of the "
                "program, or add the word to --ignore",
                action_name(event.kind));
        }
        if (lines.input(event.number) != nullptr) {
            return {};
        }
        missing = fmt::format("input {}; name its line in [[input]] with number = {}", event.number, event.number);
        break;
    default:
        return fmt::format("{}: only the simulated machine does this so far; take it out of the program, or add its "
                           "word to --ignore",
                           action_name(event.kind));
    }
    return fmt::format("{}: the machine file has no {}, or add the word to --ignore", action_name(event.kind), missing);
}

} // namespace splinefeed::host
