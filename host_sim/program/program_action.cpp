// SPDX-License-Identifier: MIT
#include "host_sim/program/program_action.hpp"

namespace splinefeed::host {

const char* action_name(EventKind kind) noexcept {
    switch (kind) {
    case EventKind::message: return "message";
    case EventKind::print: return "print";
    case EventKind::debug: return "debug";
    case EventKind::spindle_speed: return "spindle_speed";
    case EventKind::spindle_clockwise: return "spindle_clockwise";
    case EventKind::spindle_counterclockwise: return "spindle_counterclockwise";
    case EventKind::spindle_stop: return "spindle_stop";
    case EventKind::tool_select: return "select_tool";
    case EventKind::tool_change: return "change_tool";
    case EventKind::tool_set: return "set_tool";
    case EventKind::mist_on: return "mist_on";
    case EventKind::flood_on: return "flood_on";
    case EventKind::coolant_off: return "coolant_off";
    case EventKind::output_on_with_motion: return "output_on_with_motion";
    case EventKind::output_off_with_motion: return "output_off_with_motion";
    case EventKind::output_on: return "output_on";
    case EventKind::output_off: return "output_off";
    case EventKind::input_wait: return "input_wait";
    case EventKind::overrides_on: return "overrides_on";
    case EventKind::overrides_off: return "overrides_off";
    case EventKind::feed_override: return "feed_override";
    case EventKind::spindle_override: return "spindle_override";
    case EventKind::adaptive_feed: return "adaptive_feed";
    case EventKind::feed_hold: return "feed_hold";
    case EventKind::pause: return "stop";
    case EventKind::optional_pause: return "optional_stop";
    case EventKind::pallet_pause: return "pallet_stop";
    case EventKind::program_end: return "end";
    case EventKind::printer: return "printer";
    case EventKind::analog_output_with_motion: return "analog_output_with_motion";
    case EventKind::analog_output: return "analog_output";
    case EventKind::surface_speed: return "surface_speed";
    case EventKind::spindle_orient: return "spindle_orient";
    case EventKind::offsets_changed: return "offsets_changed";
    }
    return "unknown";
}

} // namespace splinefeed::host
