// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/impossible_event.hpp"

#include "host_sim/program/program_action.hpp"

#include "splinefeed/s0_program/dialects/dialect_rules.hpp"

#include <fmt/format.h>
#include <optional>
#include <string_view>

namespace splinefeed::host {

namespace {

/// What the machine file lacks for an event; empty: nothing. No text: only the simulated machine knows the event.
std::optional<std::string> missing_for(const ProgramEvent& event, const GcodeSettings& settings) {
    static const ProgramPins none;
    const ProgramPins& lines = settings.lines != nullptr ? *settings.lines : none;
    const auto unless = [&](std::string_view text) {
        return std::string(lines.has(event.kind, event.number) ? std::string_view() : text);
    };
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
    case EventKind::offsets_changed: return std::string();
    case EventKind::spindle_speed:
    case EventKind::spindle_clockwise:
    case EventKind::spindle_counterclockwise:
    case EventKind::spindle_stop:
        return settings.spindle != nullptr && settings.spindle->is_controlled()
                   ? std::string()
                   : "spindle for this; name its frequency inverter, vfd = \"modbus-rtu://...\", or its line, "
                     "enable = { line = ... }, in [spindle]";
    case EventKind::mist_on: return unless("line for this; name it in [coolant.mist]");
    case EventKind::flood_on: return unless("line for this; name it in [coolant.flood]");
    case EventKind::coolant_off: return unless("coolant; name its line in [coolant.mist] or [coolant.flood]");
    case EventKind::output_on_with_motion:
    case EventKind::output_off_with_motion:
    case EventKind::output_on:
    case EventKind::output_off:
        return unless(fmt::format("output {0}; name its line in [[output]] with number = {0}", event.number));
    case EventKind::input_wait:
        return unless(fmt::format("input {0}; name its line in [[input]] with number = {0}", event.number));
    default: return std::nullopt;
    }
}

} // namespace

// What the machine has no output for is refused, rather than left out.
std::string impossible(const ProgramEvent& event, const GcodeSettings& settings) {
    const auto refused = [&](std::string_view why) {
        return fmt::format("{}: {}", action_name(event.kind), why);
    };
    if (event.kind == EventKind::surface_speed) {
        return refused("only the simulated machine changes the speed of its spindle along a move so far; use G97 "
                       "and S in rpm in the place of G96");
    }
    if (event.kind == EventKind::input_wait && event.analog) {
        return refused("M66 E reads an analog input, and only digital ones are read, M66 P; take it out of the "
                       "program, or add the word to --ignore");
    }
    const std::optional<std::string> missing = missing_for(event, settings);
    if (!missing) {
        return refused("only the simulated machine does this so far; take it out of the program, or add its word to "
                       "--ignore");
    }
    return missing->empty() ? std::string()
                            : refused(fmt::format("the machine file has no {}, or add the word to --ignore", *missing));
}

std::string impossible_move(const ProgramItem<double>& item, Dialect dialect) {
    const bool dollar = rules_of(dialect).dollar_lines;
    switch (item.move) {
    case MoveKind::probe:
        return fmt::format("G38.{}: only the simulated machine probes within a program so far; take it out, "
                           "and let --probe end a run of its own at the contact (GPIO lines)",
                           2 + (item.probe.away ? 2 : 0) + (item.probe.required ? 0 : 1));
    case MoveKind::turning:
        return "tapping and threads (G33, G33.1, G74, G76, G84): only the simulated machine does this so far, as no "
               "target measures the turns of its spindle; take them out of the program";
    case MoveKind::home:
        return fmt::format("{}: only the simulated machine homes within a program so far; begin the run with "
                           "--home, and {}",
                           dollar ? "$H" : "G28", dollar ? "take it out" : "--ignore G28");
    default: return {};
    }
}

} // namespace splinefeed::host
