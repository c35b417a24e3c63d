// SPDX-License-Identifier: MIT
// machine_keys: the keys of a machine file. Ranges that the core knows are the core's.
#pragma once

#include "host_sim/config/line_keys.hpp"
#include "host_sim/config/path_tolerances.hpp"
#include "host_sim/config/program_pins.hpp"

#include "splinefeed/s3_feed_plan/limits/machine_numbers.hpp"
#include "splinefeed/s5_pulse_train/step_timing.hpp"

namespace splinefeed::host {

/// The row of a number that `rows` of the core have; a compile error if they do not.
template <class Rows>
consteval FileKey core_key(const Rows& rows, std::string_view key, std::string_view sentence) {
    for (const auto& row : rows) {
        if (row.key == key) {
            FileKey out = number_key(key, row.low, row.high, row.unit, sentence);
            out.required = row.without == WithoutKey::refused;
            return out;
        }
    }
    throw "there is no such number";
}
consteval FileKey step_time_key(std::string_view key, std::string_view sentence) {
    for (const StepTime& time : step_times) {
        if (time.key == key) {
            return number_key(key, time.least_us, longest_step_time_us, "us", sentence);
        }
    }
    throw "there is no such time";
}
consteval FileKey tolerance_key(std::string_view key, std::string_view sentence) {
    for (const PathToleranceKey& tolerance : path_tolerance_keys) {
        if (tolerance.key == key) {
            return number_key(key, 0.0, tolerance.high, tolerance.unit, sentence);
        }
    }
    throw "there is no such tolerance";
}

inline constexpr std::string_view engine_names[] = {"intervals", "fixed-rate", "interpolated"};
inline constexpr std::string_view axis_kinds[] = {"linear", "rotary"};
inline constexpr std::string_view axis_name_letters[] = {"x", "y", "z", "a", "b", "c"};
inline constexpr std::string_view on_or_off[] = {"on", "off"};
inline constexpr std::string_view output_states[] = {"off", "on"};

inline constexpr FileKey path_keys[] = {
    core_key(path_numbers, "max_feed_mm_s", "The largest feed."),
    core_key(path_numbers, "centripetal_mm_s2", "Limit of the acceleration across the path; default none."),
    tolerance_key("joint_tolerance_mm", "How far an exact path may be from its joints; default 0.001."),
    tolerance_key("default_tolerance_mm", "Of elements and lines that state none; default 0.01."),
    tolerance_key("rapid_tolerance_mm", "Of rapids; default 0.1."),
    tolerance_key("rotary_tolerance_deg", "Of moves that turn a rotary axis, where their own number is larger."),
    core_key(path_numbers, "chord_error_mm", "A chord per sample period stays this close; default no such limit."),
};
inline constexpr FileTable path_table{"[path]", path_keys, {}};

inline constexpr FileKey step_line_keys[] = {
    choice_key("engine", engine_names, "What makes the pulses; default intervals."),
    number_key("tick_us", 0.25, 1000, "us", "Of fixed-rate and interpolated: a multiple of 0.25; default 10 and 40."),
    step_time_key("step_length_us", "Least length of a pulse; default 2."),
    step_time_key("step_space_us", "Least time between two pulses; default 2."),
    step_time_key("direction_setup_us", "From a change of direction to the step that needs it; default 5."),
    step_time_key("direction_hold_us", "From the end of a pulse to a change of direction; default 5."),
    flag_key("step_on_edge", "Each edge is a step; default false."),
};
inline constexpr FileTable step_line_table{
    "[step]", step_line_keys,
    R"({"dependencies": {"tick_us": {"properties": {"engine": {"enum": ["fixed-rate", "interpolated"]}, "tick_us": {"multipleOf": 0.25}},
                                     "required": ["engine"]}}})"};

inline constexpr FileKey switched_keys[] = {
    needed(line_key("line", "The line.")),
    level_key("active", "Level at which it is on; default high."),
};
inline constexpr FileTable switched_table{"[spindle.enable]", switched_keys, {}};
inline constexpr FileKey sensed_keys[] = {
    needed(line_key("line", "The line.")),
    level_key("active", "Level at which it acts; default high."),
    bias_key,
};
inline constexpr FileTable sensed_table{"[spindle.at_speed]", sensed_keys, {}};

inline constexpr FileKey spindle_keys[] = {
    needed(
        number_key("max_rpm", 0.001, 1e6, "1/min", "run refuses a program that asks for more; serve turns no faster.")),
    number_key("min_rpm", 0, 1e6, "1/min",
               "run refuses a program that asks for less; serve turns no slower. At most max_rpm."),
    number_key("ramp_s", 0, 600, "s", "From standstill to max_rpm, in the simulated machine; default 0."),
    text_key("vfd", "Address of its frequency inverter, with &profile=; for real targets."),
    number_key("rpm_per_hz", 0.001, 1e4, "1/min per Hz", "Speed of the spindle per Hz of the inverter; default 60."),
    number_key("at_speed_timeout_s", 0.1, 600, "s", "Within this time it has its speed, or stands; default 10."),
    table_key("enable", switched_table, "Of a spindle on lines: it turns."),
    table_key("reverse", switched_table, "It turns counterclockwise; without it M4 is refused."),
    table_key("at_speed", sensed_table, "An input that acts at its speed."),
    number_key("spin_up_s", 0, 600, "s", "Of a spindle on lines: from standstill to its speed."),
    number_key("spin_down_s", 0, 600, "s", "From its speed to standstill; default spin_up_s."),
};
inline constexpr FileTable spindle_table{
    "[spindle]", spindle_keys,
    R"({"dependencies": {"enable": ["spin_up_s"], "reverse": ["enable"], "at_speed": ["enable"],
        "spin_up_s": ["enable"], "spin_down_s": ["enable"], "vfd": {"not": {"required": ["enable"]}}}})"};

inline constexpr FileKey chip_keys[] = {
    needed(form_key("chip", line_keys[0].form, "The chip of lines that name none, like /dev/gpiochip0.")),
};
inline constexpr FileTable chip_table{"[lines]", chip_keys, {}};

inline constexpr FileKey module_keys[] = {
    needed(text_key("name", "For the tables that name it.")),
    needed(text_key("address", "Like modbus-tcp://HOST:PORT?unit=1.")),
    whole_key("response_timeout_ms", 10, 500, "It answers within this time; default 100.", "ms"),
};
inline constexpr FileTable module_table{"[[module]]", module_keys, {}};

inline constexpr FileKey module_key = text_key("module", "The [[module]] that has it, instead of a line.");
inline constexpr double most_bit = 65535;
inline constexpr FileKey coil_key = whole_key("coil", 0, most_bit, "Its coil in the module, from 0.");
inline constexpr std::string_view line_or_coil =
    R"({"oneOf": [{"required": ["line"], "not": {"anyOf": [{"required": ["module"]}, {"required": ["coil"]}]}},
        {"required": ["module", "coil"], "not": {"required": ["line"]}}]})";

inline constexpr FileKey coolant_line_keys[] = {
    line_key("line", "The line, or module and coil."),
    module_key,
    coil_key,
    level_key("active", "Level at which it is on; default high."),
};
inline constexpr FileTable coolant_line_table{"[coolant.mist]", coolant_line_keys, line_or_coil};
inline constexpr FileKey coolant_keys[] = {
    table_key("mist", coolant_line_table, "M7."),
    table_key("flood", coolant_line_table, "M8."),
};
inline constexpr FileTable coolant_table{"[coolant]", coolant_keys, {}};

inline constexpr FileKey output_keys[] = {
    needed(whole_key("number", 0, DigitalOutput::most, "P of M62 to M65.")),
    line_key("line", "The line, or module and coil."),
    module_key,
    coil_key,
    level_key("active", "Level at which it is on; default high."),
    choice_key("safe", output_states, "As it is before and after a run, and after an e-stop; default off."),
};
inline constexpr FileTable output_table{"[[output]]", output_keys, line_or_coil};

inline constexpr FileKey input_keys[] = {
    needed(whole_key("number", 0, DigitalInput::most, "P of M66.")),
    line_key("line", "The line, or module and input or coil."),
    bias_key,
    module_key,
    whole_key("input", 0, most_bit, "Its discrete input in the module, from 0."),
    coil_key,
    level_key("active", "Level at which it is on; default high."),
};
inline constexpr FileTable input_table{
    "[[input]]", input_keys,
    R"({"oneOf": [{"required": ["line"], "not": {"anyOf": [{"required": ["module"]}, {"required": ["coil"]}, {"required": ["input"]}]}},
        {"required": ["module", "coil"], "not": {"anyOf": [{"required": ["line"]}, {"required": ["bias"]}]}},
        {"required": ["module", "input"], "not": {"anyOf": [{"required": ["line"]}, {"required": ["bias"]}]}}]})"};

inline constexpr FileKey axis_keys[] = {
    needed(form_key("name", R"({"enum": ["x", "y", "z", "a", "b", "c", "X", "Y", "Z", "A", "B", "C"]})",
                    "x, y, z, a, b or c.")),
    choice_key("kind", axis_kinds, "linear (default) or rotary: degrees where the keys say mm."),
    form_key(
        "travel_mm",
        R"({"type": "array", "items": {"type": "number", "minimum": -1048576, "maximum": 1048576}, "minItems": 2, "maxItems": 2})",
        "Soft limits, checked before anything moves: [lowest, highest]."),
    core_key(axis_numbers, "travel_end_zone_mm", "This near to its soft limits the axis has the next limit."),
    core_key(axis_numbers, "travel_end_velocity_mm_s", "Limit of the velocity near the soft limits."),
    core_key(axis_numbers, "max_velocity_mm_s", "Limit of the velocity."),
    core_key(axis_numbers, "max_acceleration_mm_s2", "Limit of the acceleration."),
    core_key(axis_numbers, "max_jerk_mm_s3", "Limit of the jerk; default none."),
    core_key(axis_numbers, "max_braking_mm_s2", "Limit while the axis brakes; default max_acceleration_mm_s2."),
    core_key(axis_numbers, "steps_per_mm", "Counts per mm; default 1000."),
    flag_key("invert", "The drive counts down where the axis goes up; default false."),
    whole_key("motors", 1, 2, "Motors on the step and direction lines; default 1."),
    flag_key("invert_step", "The step line is low in a pulse; default false."),
    form_key(
        "invert_direction",
        R"({"anyOf": [{"type": "boolean"}, {"type": "array", "items": {"type": "boolean"}, "minItems": 1, "maxItems": 2}]})",
        "The direction line is low where the axis goes up; of two motors [false, true]."),
    number_key("standstill_window_mm", 1e-4, 10, "mm", "How far apart positions at standstill may lie."),
    text_key("drive", "Address of its drive: modbus-tcp://HOST:PORT?unit=1."),
};
inline constexpr FileTable axis_table{
    "[[axis]]", axis_keys,
    R"({"dependencies": {"travel_end_zone_mm": ["travel_end_velocity_mm_s", "travel_mm"],
        "travel_end_velocity_mm_s": ["travel_end_zone_mm"]},
        "if": {"properties": {"motors": {"const": 2}}, "required": ["motors"]},
        "then": {"properties": {"invert_direction": {"minItems": 2}}}, "else": {"properties": {"invert_direction": {"maxItems": 1}}}})"};

inline constexpr FileKey machine_keys[] = {
    text_key("name", "Of the machine."),
    whole_key(sample_period.key, sample_period.low, sample_period.high, "Period of the output; default 1000.",
              sample_period.unit),
    choice_key("drives_at_end", on_or_off, "Whether the drives stay on after a run."),
    needed(table_key("path", path_table, "Limits of the path.")),
    table_key("step", step_line_table, "Step and direction lines."),
    table_key("spindle", spindle_table, "The spindle."),
    table_key("lines", chip_table, "Lines that programs switch and read."),
    table_key("module", module_table, "Modbus I/O modules.", KeyKind::tables),
    table_key("coolant", coolant_table, "What M7 and M8 switch."),
    table_key("output", output_table, "Digital outputs, M62 to M65.", KeyKind::tables),
    table_key("input", input_table, "Digital inputs, M66.", KeyKind::tables),
    needed({.key = "axis",
            .kind = KeyKind::tables,
            .sentence = "The axes, one to six.",
            .low = 1,
            .high = max_axes,
            .inside = &axis_table}),
};
inline constexpr FileTable machine_table{"the machine file", machine_keys, {}};

/// Whether each number of the core has its row: a new limit needs one.
template <class Rows>
consteval bool has_all(const FileTable& table, const Rows& rows) {
    for (const auto& row : rows) {
        bool found = false;
        for (const FileKey& key : table.keys) {
            found = found || key.key == row.key;
        }
        if (!found) {
            return false;
        }
    }
    return true;
}
static_assert(has_all(path_table, path_numbers) && has_all(path_table, path_tolerance_keys) &&
              has_all(axis_table, axis_numbers) && has_all(step_line_table, step_times));

} // namespace splinefeed::host
