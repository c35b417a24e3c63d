// SPDX-License-Identifier: MIT
// gpio_map_keys: the keys of a map file.
#pragma once

#include "host_sim/config/line_keys.hpp"

namespace splinefeed::host {

inline constexpr std::string_view input_roles[] = {"e-stop", "limit", "home", "drive-fault", "probe"};

inline constexpr FileKey map_axis_keys[] = {
    needed(line_key("step", "The line whose pulses are steps.")),
    needed(line_key("direction", "The line of the direction.")),
    line_key("step2", "Steps of the second motor; only with motors = 2 in the machine file."),
    line_key("direction2", "Direction of the second motor; only with motors = 2 in the machine file."),
};
inline constexpr FileTable map_axis_table{"[axis.x]", map_axis_keys, {}};

inline constexpr FileKey enable_keys[] = {
    needed(line_key("line", "The line that switches the drives on.")),
    level_key("active", "Level at which the drives are on; default high."),
    whole_key("settle_ms", 0, 60000, "From there to the first step; default 500.", "ms"),
};
inline constexpr FileTable enable_table{"[enable]", enable_keys, {}};

inline constexpr FileKey brake_keys[] = {
    needed(line_key("line", "The line of the brake.")),
    level_key("released", "Level at which the axis is free; default high."),
    whole_key("release_ms", 0, 5000, "From releasing it to the first step; default 100.", "ms"),
    whole_key("engage_ms", 0, 5000, "From engaging it to switching the drives off; default 100.", "ms"),
};
inline constexpr FileTable brake_table{"[brake]", brake_keys, {}};

inline constexpr FileKey map_input_keys[] = {
    needed(choice_key("role", input_roles, "What it says.")),
    text_key("axis", "The axis whose switch it is; of limit and home alone."),
    needed(line_key("line", "Its line. Inputs may share one.")),
    level_key("active", "Level at which it acts; default high."),
    bias_key,
    whole_key("debounce_us", 0, 100000, "A level counts after it has lasted so long; default 1000, of an e-stop 0.",
              "us"),
};
inline constexpr FileTable map_input_table{
    "[[input]]", map_input_keys,
    R"({"if": {"properties": {"role": {"enum": ["limit", "home"]}}}, "then": {"required": ["axis"]},
        "else": {"not": {"required": ["axis"]}}})"};

inline constexpr double farthest_home_mm = 1048576.0;
inline constexpr FileKey home_keys[] = {
    needed(level_key("towards", "The end of the axis where its switch is.")),
    needed(
        number_key("seek_mm_s", 0.001, 10000, "mm/s", "Speed of the search, at most max_velocity_mm_s of the axis.")),
    needed(number_key("latch_mm_s", 0.001, 10000, "mm/s", "Speed at which the edge is measured, at most seek_mm_s.")),
    needed(number_key("pull_off_mm", 0.001, 1000, "mm", "How far it goes off the switch.")),
    needed(number_key("position_mm", -farthest_home_mm, farthest_home_mm, "mm", "Position of the edge of the switch.")),
};
inline constexpr FileTable home_table{"[home.x]", home_keys, {}};

inline constexpr FileKey thread_keys[] = {
    whole_key("priority", 1, 98, "Its priority of SCHED_FIFO; default 80."),
    whole_key("cpu", 0, 1023, "The processor that it is bound to; default none."), // of cpu_set_t
    whole_key("spin_us", 0, 1000, "The part of each wait that it spends spinning; default 30.", "us"),
    whole_key("tolerated_late_us", 0, 10000, "An edge that is later delays the motion; default 100.", "us"),
    whole_key("stall_ms", 1, 10000, "An edge in motion that is later ends the run; default 40.", "ms"),
};
inline constexpr FileTable thread_table{"[thread]", thread_keys, {}};

inline constexpr FileKey map_keys[] = {
    of_a_line_name(text_key("consumer", "The name that gpioinfo shows for the lines; default splinefeed.")),
    needed(table_key("axis", map_axis_table, "The lines of each axis of the machine file.", KeyKind::by_axis)),
    table_key("enable", enable_table, "The line that switches the drives on."),
    table_key("brake", brake_table, "Holds an axis that would fall while the drives are off."),
    table_key("input", map_input_table, "Switches and other inputs.", KeyKind::tables),
    table_key("home", home_table, "How axes find their reference.", KeyKind::by_axis),
    table_key("thread", thread_table, "The thread that makes edges."),
};
inline constexpr FileTable map_table{"the map", map_keys, {}};

} // namespace splinefeed::host
