// SPDX-License-Identifier: MIT
// profile_keys: the keys of a drive profile.
#pragma once

#include "host_sim/base/file_key.hpp"

#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

#include <array>

namespace splinefeed::host {

// Names in the order of their enumerators.
inline constexpr std::array<std::string_view, 4> stream_names{"pvt", "cyclic", "blocks", "speed"};
inline constexpr std::array<std::string_view, 2> state_machine_names{"cia402", "masks"};
inline constexpr std::array<std::string_view, 2> wire_names{"rtu", "tcp"};
inline constexpr std::array<std::string_view, 3> parity_names{"N", "E", "O"};
inline constexpr std::array<std::string_view, 5> unit_names{"number", "counts", "counts/s", "counts/s^2", "ms"};
inline constexpr std::array<std::string_view, 4> table_names{"holding_registers", "input_registers", "coils",
                                                             "discrete_inputs"};
inline constexpr std::array<std::string_view, 2> order_names{"high_first", "low_first"};
inline constexpr std::array<std::string_view, 3> access_names{"read_write", "read", "write"};
inline constexpr std::array<std::string_view, 2> use_names{"target", "status"};
inline constexpr std::array<std::string_view, 4> step_kind_names{"level", "edge", "pulse", "toggle"};
inline constexpr std::array<std::string_view, 5> reaction_names{"none", "stop", "quick_stop", "disable", "fault"};
/// Behind FieldRole::none.
inline constexpr std::array<std::string_view, hal::modbus::field_roles - 1> field_role_names{"control",
                                                                                             "status",
                                                                                             "mode",
                                                                                             "mode_display",
                                                                                             "target_position",
                                                                                             "target_velocity",
                                                                                             "profile_velocity",
                                                                                             "profile_acceleration",
                                                                                             "profile_deceleration",
                                                                                             "actual_position",
                                                                                             "actual_velocity",
                                                                                             "following_error",
                                                                                             "following_error_window",
                                                                                             "fault_code",
                                                                                             "watchdog"};
/// Behind DriveState::unknown.
inline constexpr std::array<std::string_view, hal::modbus::drive_states - 1> state_names{
    "not_ready", "disabled", "enabled", "moving", "homing", "halted", "quick_stop", "fault"};
inline constexpr std::array<std::string_view, hal::modbus::drive_commands> command_names{
    "enable",     "disable", "fault_reset", "start_move", "halt", "resume",
    "quick_stop", "home",    "forward",     "reverse",    "stop"};

inline constexpr double any_low = -9223372036854775808.0; // 64 bits; the reader knows the field's own
inline constexpr double any_high = 9223372036854775808.0;
inline constexpr double highest_mask = 0xFFFFFFFF; // masks are of the low 32 bits at most

inline constexpr FileKey link_keys[] = {
    needed({.key = "wires",
            .kind = KeyKind::choices,
            .sentence = "The lines that the drive has.",
            .low = 1,
            .names = wire_names}),
    needed(form_key("functions",
                    R"({"type": "array", "items": {"enum": [1, 2, 3, 4, 5, 6, 16, 23]},
                        "allOf": [{"contains": {"const": 3}}, {"contains": {"enum": [6, 16]}}]})",
                    "Function codes that the drive has: 3 reads, 6 writes one register, 16 several, 23 both; "
                    "1, 2 and 4 read coils, discrete inputs and input registers, 5 writes a coil.")),
    form_key("unit", R"({"anyOf": [{"type": "integer", "minimum": 1, "maximum": 247}, {"const": 255}]})",
             "Factory setting of the unit number; 255 with tcp alone; default 1."),
    whole_key("baud", 1200, 4000000, "Factory setting of the baud rate; default 19200."),
    choice_key("parity", parity_names, "Factory setting; default E."),
    whole_key("stop_bits", 1, 2, "Factory setting; default 1."),
    number_key("silence_before_ms", 0, 1000, "ms", "Silence before a frame, besides the 3.5 characters of RTU."),
    number_key("silence_after_ms", 0, 1000, "ms", "Silence after a frame, likewise."),
    number_key("turnaround_ms", 0, 1000, "ms", "From a request to the drive's answer."),
    number_key("response_timeout_ms", 0.001, 60000, "ms", "An exchange without an answer is lost then; default 100."),
    whole_key("retries", 0, 100, "How often a lost exchange is repeated; default 2."),
    whole_key("most_read_registers", 1, 125, "Most registers that are read in a frame; default 125."),
    whole_key("most_write_registers", 1, 123, "Most registers that are written in a frame; default 123."),
    whole_key("address_base", 0, 1, "1 where the manual counts registers from 1; default 0."),
    flag_key("reads_zero_until_written", "Values are valid only after the target group was written once."),
    form_key("exchange_ms",
             R"({"type": "array", "items": {"type": "array", "minItems": 2, "maxItems": 2,
            "items": [{"type": "integer", "minimum": 1200, "maximum": 4000000},
                      {"type": "number", "minimum": 0, "maximum": 60000}]}})",
             "Time of an exchange for each baud rate: [[9600, 24.9], ...]."),
};
inline constexpr FileTable link_table{"[link]", link_keys,
                                      R"({"if": {"properties": {"unit": {"const": 255}}, "required": ["unit"]},
                                          "then": {"properties": {"wires": {"contains": {"const": "tcp"}}}}})"};

inline constexpr FileKey field_keys[] = {
    choice_key("role", field_role_names, "What the program knows it as; or a name of your own."),
    text_key("name", "A name of your own, where no role fits."),
    needed(whole_key("address", 0, 65536, "First register, counted from address_base.")),
    choice_key("table", table_names, "Where the address is; default holding_registers. Others with speed alone."),
    form_key("width", R"({"enum": [16, 32, 64]})", "Bits; default 16."),
    flag_key("signed", "Two's complement; default false."),
    choice_key("word_order", order_names, "Which register of several comes first; default high_first."),
    choice_key("byte_order", order_names, "Likewise within a register; Modbus is high_first, the default."),
    form_key("scale",
             R"({"type": "array", "minItems": 2, "maxItems": 2,
                 "items": [{"type": "integer", "minimum": -1000000000000000, "maximum": 1000000000000000, "not": {"const": 0}},
                           {"type": "integer", "minimum": 1, "maximum": 1000000000000000}]})",
             "[n, d]: register = physical * n / d."),
    flag_key("inverse", "register = n / (d * physical) instead."),
    choice_key("unit", unit_names, "Of the physical value; a role has its own."),
    form_key("clamp", R"({"type": "array", "items": {"type": "integer"}, "minItems": 2, "maxItems": 2})",
             "Lowest and highest value that may be written to the register."),
    choice_key("access", access_names, "Whether it is read, written or both; default read_write."),
    flag_key("flash", "Every write wears the memory: it is written only by [[init]], if it differs."),
    whole_key("value", any_low, any_high, "Of the register if nothing else sets it; default 0."),
};
inline constexpr FileTable field_table{"[[field]]", field_keys,
                                       R"({"oneOf": [{"required": ["role"]}, {"required": ["name"]}],
        "allOf": [{"if": {"properties": {"table": {"enum": ["input_registers", "discrete_inputs"]}}, "required": ["table"]},
                   "then": {"properties": {"access": {"const": "read"}}}},
                  {"if": {"properties": {"table": {"enum": ["coils", "discrete_inputs"]}}, "required": ["table"]},
                   "then": {"properties": {"width": false, "signed": false, "word_order": false, "byte_order": false,
                                           "scale": false, "inverse": false, "unit": false, "clamp": false,
                                           "flash": false}}}]})"};

inline constexpr FileKey group_keys[] = {
    needed(choice_key("use", use_names, "target: written in one frame; status: read in one frame.")),
    needed({.key = "fields",
            .kind = KeyKind::texts,
            .sentence = "Their names, in order of addresses, without gaps.",
            .low = 1}),
};
inline constexpr FileTable group_table{"[[group]]", group_keys, {}};

constexpr FileKey mask_key = whole_key("mask", 1, highest_mask, "The bits that count; default all.");
constexpr FileKey field_name_key = needed(text_key("field", "Name or role of a field."));

inline constexpr FileKey state_keys[] = {
    needed(choice_key("name", state_names, "The state that the drive is in.")),
    field_name_key,
    mask_key,
    needed(whole_key("value", 0, highest_mask, "What the bits of the mask are then.")),
};
inline constexpr FileTable state_table{"[[state]]", state_keys, {}};

inline constexpr FileKey step_keys[] = {
    field_name_key,
    whole_key("mask", 1, highest_mask, "The bits that change; default all."),
    whole_key("value", 0, highest_mask, "What they become; not of a toggle."),
    choice_key("kind", step_kind_names, "How they change; default level."),
    whole_key("duration_ms", 0, 60000, "Of a pulse; else the wait before the next step.", "ms"),
};
inline constexpr FileTable step_table{"a step", step_keys,
                                      R"({"if": {"properties": {"kind": {"const": "toggle"}}, "required": ["kind"]},
        "then": {"not": {"required": ["value"]}}, "else": {"required": ["value"]},
        "allOf": [{"if": {"properties": {"kind": {"const": "pulse"}}, "required": ["kind"]},
                   "then": {"properties": {"duration_ms": {"minimum": 1}}, "required": ["duration_ms"]}}]})"};

inline constexpr FileKey command_keys[] = {
    needed(choice_key("name", command_names, "What it does.")),
    needed({.key = "steps",
            .kind = KeyKind::tables,
            .sentence = "What is written, in order.",
            .low = 1,
            .inside = &step_table}),
};
inline constexpr FileTable command_table{"[[command]]", command_keys, {}};

inline constexpr FileKey test_keys[] = {
    field_name_key,
    mask_key,
    needed(whole_key("value", 0, highest_mask, "What the bits of the mask must be.")),
};
inline constexpr FileTable test_table{"a test", test_keys, {}};

inline constexpr FileKey motion_keys[] = {
    whole_key("stream_mode", any_low, any_high, "Value of the mode field for streaming."),
    whole_key("homing_mode", any_low, any_high, "Value of the mode field for homing."),
    flag_key("change_on_the_fly", "A block replaces the current one without a stop; required with blocks."),
    number_key("period_ms", 0, 1000, "ms",
               "Time between two blocks, or in which a drive moves to a target; 0: what the link allows."),
    table_key("done", test_table, "The last move has arrived."),
    table_key("homed", test_table, "The reference is known."),
    whole_key("following_error_window_counts", 1, 0x7FFFFFFF, "Written before the drive is enabled.", "counts"),
};
inline constexpr FileTable motion_table{"[motion]", motion_keys, {}};

inline constexpr FileKey watchdog_keys[] = {
    whole_key("timeout_ms", 1, 60000, "Written to the field of role watchdog.", "ms"),
    choice_key("reaction", reaction_names, "Reaction of the simulated drive; default none."),
};
inline constexpr FileTable watchdog_table{"[watchdog]", watchdog_keys, {}};

inline constexpr FileKey init_keys[] = {
    field_name_key,
    needed(whole_key("value", any_low, any_high, "What the register gets.")),
};
inline constexpr FileTable init_table{"[[init]]", init_keys, {}};

inline constexpr FileKey identity_keys[] = {
    field_name_key,
    mask_key,
    needed(whole_key("value", 0, highest_mask, "What the bits of the mask must be.")),
    needed(text_key("sentence", "What to tell where it does not hold.")),
};
inline constexpr FileTable identity_table{"[[identity]]", identity_keys, {}};

inline constexpr FileKey stays_on_keys[] = {
    field_name_key,
    mask_key,
    needed(whole_key("value", 0, highest_mask, "What the bits of the mask are then.")),
    needed(text_key("sentence", "What keeps the motor on, and what to set in the drive.")),
};
inline constexpr FileTable stays_on_table{"[[stays_on]]", stays_on_keys, {}};

inline constexpr FileKey profile_keys[] = {
    needed(form_key("name", R"({"type": "string", "pattern": "^[a-z0-9-]+$"})", "Of the profile.")),
    needed(text_key("drive", "Makes and models.")),
    needed(
        {.key = "sources", .kind = KeyKind::texts, .sentence = "Where its registers and values come from.", .low = 1}),
    needed({.key = "not_verified", .kind = KeyKind::texts, .sentence = "What was not tried on hardware."}),
    needed(choice_key("stream", stream_names, "How the drive gets its motion.")),
    whole_key("axes", 1, 6, "Most axes in one drive; beyond 1 with pvt alone."),
    choice_key("states", state_machine_names, "cia402: status word of CiA 402; masks (default): the [[state]] tables."),
    needed(table_key("link", link_table, "How the drive is reached.")),
    needed({.key = "field",
            .kind = KeyKind::tables,
            .sentence = "Numbers that are read or written.",
            .low = 1,
            .inside = &field_table}),
    table_key("group", group_table, "Fields of one frame.", KeyKind::tables),
    table_key("state", state_table, "How the drive tells its state.", KeyKind::tables),
    table_key("command", command_table, "How the drive is commanded.", KeyKind::tables),
    table_key("motion", motion_table, "How it moves."),
    table_key("watchdog", watchdog_table, "What watches the link."),
    table_key("init", init_table, "Written once, in order, before the drive is enabled.", KeyKind::tables),
    table_key("identity", identity_table, "Checked before anything is written.", KeyKind::tables),
    table_key("stays_on", stays_on_table, "Where it holds, disable does not take the motor's power off: refused.",
              KeyKind::tables),
};
inline constexpr FileTable profile_table{"the profile", profile_keys,
                                         R"({"allOf": [
        {"if": {"properties": {"states": {"const": "cia402"}}, "required": ["states"]}, "then": {"properties": {"state": {"maxItems": 0}}}},
        {"if": {"properties": {"stream": {"enum": ["pvt", "cyclic", "blocks"]}}},
         "then": {"properties": {"field": {"items": {"properties": {"table": {"const": "holding_registers"}}}}}},
         "else": {"properties": {"group": false, "watchdog": false, "init": false, "identity": false, "stays_on": false}}},
        {"if": {"properties": {"axes": {"minimum": 2}}, "required": ["axes"]}, "then": {"properties": {"stream": {"const": "pvt"}}}},
        {"if": {"properties": {"stream": {"const": "blocks"}}},
         "then": {"properties": {"motion": {"properties": {"change_on_the_fly": {"const": true}}, "required": ["change_on_the_fly"]}},
                  "required": ["motion"]}}]})"};

} // namespace splinefeed::host
