// SPDX-License-Identifier: MIT
#include "host_sim/run/run_machine.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/number_text.hpp"
#include "host_sim/base/trimmed_text.hpp"
#include "host_sim/config/decimal_number.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
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

/// A number for each axis.
PerAxis<double> axis_places(const std::vector<std::string>& axes, std::string_view option, const std::string& text) {
    PerAxis<double> out{};
    const std::vector<std::string_view> parts = split(text, ',');
    for (std::size_t k = 0; k < axes.size(); ++k) {
        double mm = 0.0;
        if (read_number(parts[k], mm) != NumberText::number || (k + 1 == parts.size()) != (k + 1 == axes.size())) {
            throw UsageError("{} {}: it must be a number for each axis, {}", option, in_quotes(text),
                             fmt::join(axes, ","));
        }
        if (!position_representable(mm)) {
            throw UsageError("{} {}: {} is out of range; a position must lie within +-1048576 mm", option,
                             in_quotes(text), axes[k]);
        }
        out[k] = mm;
    }
    return out;
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

MachineState RunMachine::state(const std::string& state, const std::string& position, bool homed,
                               const std::string& zero) const {
    const std::optional<MachineState> kept = state.empty() ? std::nullopt : read_state_file(state, axes);
    MachineState out = kept.value_or(MachineState{});
    if (homed || !position.empty()) {
        out.position_mm.fill(0.0);
        out.unknown_why.clear();
    }
    if (!position.empty()) {
        const PerAxis<double> mm = axis_places(axes, "--position", position);
        std::copy_n(mm.begin(), axes.size(), out.position_mm.begin());
    }
    if (!zero.empty()) {
        const PerAxis<double> mm = axis_places(axes, "--zero", zero);
        out.offsets.active = 0;
        out.offsets.g92_applies = false;
        std::ranges::transform(mm, out.offsets.systems[0].origin.begin(), decimal_of);
    }
    return out;
}

std::vector<Summary::AxisPlace> RunMachine::places(const MachineState& begins, bool gcode) const {
    const WorkOffsets& offsets = begins.offsets;
    const WorkSystem& system = offsets.systems[static_cast<std::size_t>(offsets.active)];
    PerAxis<double> shift{}; // G92 lies in the rotated system
    for (std::size_t k = 0; offsets.g92_applies && k < axes.size(); ++k) {
        shift[k] = number_of(offsets.g92[k]);
    }
    const double turn = number_of(system.rotation_deg) * std::numbers::pi / 180.0;
    const auto [x, y] = std::pair(shift[0], shift[1]);
    shift[0] = x * std::cos(turn) - y * std::sin(turn);
    shift[1] = x * std::sin(turn) + y * std::cos(turn);
    std::vector<Summary::AxisPlace> out;
    for (std::size_t k = 0; k < axes.size(); ++k) {
        out.push_back({axes[k], machine.travel[k], std::nullopt});
        if (gcode) {
            out.back().zero_mm = number_of(system.origin[k]) + shift[k];
        }
    }
    return out;
}

} // namespace splinefeed::host
