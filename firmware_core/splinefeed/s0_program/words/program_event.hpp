// SPDX-License-Identifier: MIT
// ProgramEvent: what a program asks for besides motion.
#pragma once

#include "splinefeed/s0_program/text/decimal.hpp"
#include "splinefeed/s0_program/text/text_part.hpp"

namespace splinefeed {

/// Events happen at their place in the program: after the moves before them, before the moves after them.
enum class EventKind : std::uint8_t {
    message,           ///< (MSG,text): show `text` to the operator
    print,             ///< (PRINT,text): write `text` to the standard output; #1 and `#<name>` are left to the host
    debug,             ///< (DEBUG,text): the same, to the operator
    spindle_speed,     ///< S: `value` in revolutions per minute; behind M5, if that is in the block
    spindle_clockwise, ///< M3; `value`: the speed [1/min]. Motion waits until it is reached
    spindle_counterclockwise,  ///< M4
    spindle_stop,              ///< M5
    tool_select,               ///< T: `number`
    tool_change,               ///< M6: `number` is the tool that T selected
    tool_set,                  ///< M61 Q: tool `number` is in the spindle; nothing moves
    mist_on,                   ///< M7
    flood_on,                  ///< M8
    coolant_off,               ///< M9
    output_on_with_motion,     ///< M62 P: output `number`, with the start of the next move, without a stop
    output_off_with_motion,    ///< M63 P
    output_on,                 ///< M64 P: at once
    output_off,                ///< M65 P
    input_wait,                ///< M66: see InputWait; call Interpreter::report_input with the result
    overrides_on,              ///< M48: feed and spindle override
    overrides_off,             ///< M49
    feed_override,             ///< M50: `number` 1 on, 0 off
    spindle_override,          ///< M51
    adaptive_feed,             ///< M52
    feed_hold,                 ///< M53: the input for a feed hold
    pause,                     ///< M0
    optional_pause,            ///< M1, only where settings say so
    pallet_pause,              ///< M60
    program_end,               ///< M2 (`number` 2), M30 (30) or the closing % (0)
    printer,                   ///< a heater or a fan: M104 M106 M107 M109 M140 M190 ...: `number`, its S as `value`
    offsets_changed,           ///< G10, G28.1, G55, G92, M2 ...: Interpreter::offsets() is to be stored
    analog_output_with_motion, ///< M67: output `number` (E) becomes `value` (Q) with the start of the next move
    analog_output,             ///< M68: the same at once
    spindle_orient,            ///< M19: the spindle stops at `value` degrees, by way `number` (P)
    surface_speed,             ///< G96: `value` is the speed that the spindle follows to [1/min]; nobody waits for it
};

/// M62 to M65: a digital output.
[[nodiscard]] constexpr bool is_output(EventKind kind) noexcept {
    return kind >= EventKind::output_on_with_motion && kind <= EventKind::output_off;
}
/// M7 to M9.
[[nodiscard]] constexpr bool is_coolant(EventKind kind) noexcept {
    return kind >= EventKind::mist_on && kind <= EventKind::coolant_off;
}

/// How M66 waits.
enum class InputWait : std::uint8_t { now, rise, fall, high, low };

struct ProgramEvent {
    EventKind kind = EventKind::message;
    bool stops = false;  ///< the machine must stand at the end of the moves before it
    bool analog = false; ///< input_wait: E instead of P
    InputWait wait = InputWait::now;
    std::int32_t number = 0;
    Decimal value{}; ///< input_wait: the time-out [s]
    TextPart text{}; ///< of messages and of M117: `text.of(line)`, with the line that was pushed
};

} // namespace splinefeed
