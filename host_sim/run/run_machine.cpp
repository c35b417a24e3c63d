// SPDX-License-Identifier: MIT
#include "host_sim/run/run_machine.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/number_text.hpp"
#include "host_sim/base/trimmed_text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace splinefeed::host {

namespace {

// Rapids are limited by their axes alone: a diagonal of all that count is faster than any of them.
void limit_rapids_by_axes(MachineSettings& machine) {
    constexpr double most = 10000.0; // as a machine file may state
    double linear_sq = 0.0;
    double rotary_sq = 0.0;
    for (const unsigned k : indices(machine.axes)) {
        const double v = machine.axis[k].max_velocity_mm_s;
        (machine.axis[k].rotary ? rotary_sq : linear_sq) += v * v;
    }
    const double stated = machine.max_feed_mm_s;
    machine.max_feed_mm_s = std::clamp(std::sqrt(linear_sq > 0.0 ? linear_sq : rotary_sq), stated, most);
    machine.max_turning_deg_s = std::clamp(std::sqrt(linear_sq + rotary_sq), stated, most);
}

} // namespace

RunMachine::RunMachine(const MachineChoice& choice, const InputFormat& format)
    : RunMachine(choose_machine(choice), format.is_gcode()) {}

RunMachine::RunMachine(MachineDescription stated, bool gcode)
    : machine(std::move(stated)), max_feed_mm_s(machine.settings.max_feed_mm_s),
      axes(machine.axis_name.begin(), machine.axis_name.begin() + machine.settings.axes) {
    if (gcode) {
        limit_rapids_by_axes(machine.settings);
    }
}

PathMachine RunMachine::path() const {
    PathMachine out{.axes = axes,
                    .tolerances = machine.tolerances,
                    .max_feed_mm_s = max_feed_mm_s,
                    .spindle = machine.spindle ? &*machine.spindle : nullptr,
                    .lines = &machine.lines};
    for (unsigned k = 0; k < axes.size(); ++k) {
        out.rotary_axes |= machine.settings.axis[k].rotary ? std::uint32_t{1} << k : 0U;
    }
    return out;
}

MachineDescription RunMachine::as_stated() const {
    MachineDescription stated = machine;
    stated.settings.max_feed_mm_s = max_feed_mm_s;
    stated.settings.max_turning_deg_s = 0.0;
    return stated;
}

void RunMachine::settle_places(MachineState& state, const std::string& file) const {
    std::vector<std::string> unknown;
    for (std::size_t k = 0; k < axes.size(); ++k) {
        if (!state.position_mm[k]) {
            unknown.push_back(axes[k]);
            state.position_mm[k] = 0.0;
        }
    }
    if (!unknown.empty() && !state.unknown_why.empty()) {
        throw InputError(file, 0,
                         "where {} {} is not known: {}; let the machine find its references with --home, or "
                         "say with --position where it stands",
                         fmt::join(unknown, ", "), unknown.size() == 1 ? "stands" : "stand", state.unknown_why);
    }
}

MachineState RunMachine::state(const std::string& state, const std::string& position, bool homed) const {
    const std::optional<MachineState> kept = state.empty() ? std::nullopt : read_state_file(state, axes);
    MachineState out = kept.value_or(MachineState{});
    if (homed || !position.empty()) {
        out.position_mm.fill(0.0);
        out.unknown_why.clear();
    }
    if (position.empty()) {
        return out;
    }
    const std::vector<std::string_view> parts = split(position, ',');
    for (std::size_t k = 0; k < axes.size(); ++k) {
        double mm = 0.0;
        if (read_number(parts[k], mm) != NumberText::number || (k + 1 == parts.size()) != (k + 1 == axes.size())) {
            throw UsageError("--position {}: it must be a number for each axis, {}", in_quotes(position),
                             fmt::join(axes, ","));
        }
        if (!position_representable(mm)) {
            throw UsageError("--position {}: {} is out of range; a position must lie within +-1048576 mm",
                             in_quotes(position), axes[k]);
        }
        out.position_mm[k] = mm;
    }
    return out;
}

} // namespace splinefeed::host
