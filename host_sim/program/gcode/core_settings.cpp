// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/core_settings.hpp"

#include "host_sim/config/decimal_number.hpp"
#include "host_sim/program/left_out_list.hpp"

#include "splinefeed/s0_program/text/text_cursor.hpp"

#include <algorithm>

namespace splinefeed::host {

ProgramSettings core_settings(const GcodeSettings& from, const MachineTools* tools, FanucWords& fanuc) {
    ProgramSettings out;
    out.axes = static_cast<int>(from.axes.size());
    for (std::size_t k = 0; k < from.axes.size(); ++k) {
        out.letters[k] = upper_case(from.axes[k].front());
    }
    out.rotary_axes = from.rotary_axes;
    out.dialect = from.dialect;
    out.block_delete = from.block_delete;
    out.optional_pause = from.optional_stop;
    out.default_tolerance_mm = decimal_of(from.tolerance_mm);
    out.chain_quarters = from.chain_quarters;
    out.rapid_tolerance_mm = decimal_of(from.rapid_tolerance_mm);
    out.ignored = from.ignored.data();
    out.ignored_count = from.ignored.size();
    out.ignores_unknown = from.ignores_unknown;
    out.increments = from.increments;
    out.left_out = from.left_out;
    out.tools = tools;
    out.extension = from.dialect == Dialect::fanuc ? &fanuc : nullptr;
    out.most_speed = from.spindle != nullptr ? decimal_of(from.spindle->max_rpm) : out.most_speed;
    return out;
}

// Words that --ignore names lead nowhere: the interpreter refuses them.
FlowRules flow_rules(const GcodeSettings& settings, const CoolantState& coolant) {
    const auto ignores = [&](std::int16_t first, std::int16_t last, char letter = 'M') {
        return std::ranges::any_of(settings.ignored, [&](const IgnoredWord& word) {
            return word.letter == letter && word.tenths >= first && word.tenths <= last;
        });
    };
    const bool linuxcnc = settings.dialect == Dialect::linuxcnc;
    const NumberedPrograms of = linuxcnc                             ? NumberedPrograms::linuxcnc
                                : settings.dialect == Dialect::fanuc ? NumberedPrograms::fanuc
                                                                     : NumberedPrograms::none;
    const bool macros = settings.dialect == Dialect::fanuc && !ignores(970, 990) && !ignores(650, 650, 'G');
    return {ignores(980, 990) ? NumberedPrograms::none : of,
            settings.block_delete,
            linuxcnc && !ignores(700, 730),
            macros,
            settings.increments,
            settings.left_out,
            &coolant,
            settings.axes,
            settings.runs,
            settings.subprogram_folders};
}

} // namespace splinefeed::host
