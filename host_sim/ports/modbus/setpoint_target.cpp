// SPDX-License-Identifier: MIT
#include "host_sim/ports/modbus/setpoint_target.hpp"

#include "splinefeed/base/units.hpp"

#include "host_sim/base/input_error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

using namespace hal::modbus;

namespace {

constexpr double um_per_mm = 1e3;
constexpr double ramp_of_path = 4.0; // BlockSettings::acceleration
constexpr double most_q16 = 9.2e18;  // of 64 bits

// What the drive's ramps are, or are set to: never harder than the machine file says, unless the address says so.
double ramp_mm_s2(const DriveTable::Drive& drive, const AxisSettings& axis) {
    const double smaller = axis.max_braking_mm_s2 > 0.0 ? std::min(axis.max_acceleration_mm_s2, axis.max_braking_mm_s2)
                                                        : axis.max_acceleration_mm_s2;
    return drive.address.ramp_counts_s2 ? *drive.address.ramp_counts_s2 / axis.steps_per_mm : smaller;
}

double most_planned_mm_s2(const DriveTable::Drive& drive, const AxisSettings& axis) {
    return ramp_mm_s2(drive, axis) / ramp_of_path;
}

} // namespace

std::vector<SetpointWiring> target_wiring(const DriveTable& table, const MachineDescription& machine) {
    std::vector<SetpointWiring> wiring;
    for (const DriveTable::Drive& drive : table.drives) {
        const int axis = drive.machine_axis.front(); // they have one
        const AxisSettings& settings = machine.settings.axis[static_cast<unsigned>(axis)];
        const double planned = drive.profile.stream == StreamWay::blocks
                                   ? std::min(settings.larger_acceleration_mm_s2(), most_planned_mm_s2(drive, settings))
                                   : settings.larger_acceleration_mm_s2();
        wiring.push_back({.link = drive.address.link,
                          .profile = &drive.profile,
                          .axis = axis,
                          .acceleration_counts_s2 = planned * settings.steps_per_mm,
                          .ramp_counts_s2 = ramp_mm_s2(drive, settings) * settings.steps_per_mm,
                          .fastest_counts_s = settings.max_velocity_mm_s * settings.steps_per_mm,
                          .inverted = machine.inverted[static_cast<unsigned>(axis)],
                          .standstill_counts = standstill_window_counts(machine, static_cast<unsigned>(axis))});
    }
    return wiring;
}

std::string fit_to_ramps(const DriveTable& table, MachineDescription& machine) {
    std::string lowered;
    for (const DriveTable::Drive& drive : table.drives) {
        if (drive.profile.stream != StreamWay::blocks) {
            continue;
        }
        const auto k = static_cast<unsigned>(drive.machine_axis.front());
        AxisSettings& axis = machine.settings.axis[k];
        const double most = most_planned_mm_s2(drive, axis);
        if (axis.larger_acceleration_mm_s2() <= most) {
            continue;
        }
        lowered += fmt::format("{}{} {:g} mm/s^2", lowered.empty() ? "" : ", ", machine.axis_name[k], most);
        axis.max_acceleration_mm_s2 = std::min(axis.max_acceleration_mm_s2, most);
        axis.max_braking_mm_s2 = std::min(axis.max_braking_mm_s2, most); // 0 stays: as max_acceleration
    }
    return lowered.empty()
               ? lowered
               : "drives with positioning blocks ramp four times as hard as the path, so it is planned with " +
                     lowered + "; state with &ramp= the acceleration that a drive may ramp with, where it is more";
}

void check_register_ranges(const DriveTable& table, const MachineDescription& machine, std::uint32_t period_us) {
    for (const DriveTable::Drive& drive : table.drives) {
        const auto k = static_cast<unsigned>(drive.machine_axis.front());
        const AxisSettings& axis = machine.settings.axis[k];
        const auto check = [&](FieldRole role, double counts, const char* what) {
            const RegisterField* const field = drive.profile.field_of(role);
            const double q16 = counts * (1 << physical_bits);
            if (field == nullptr || (q16 < most_q16 && !raw_of(*field, std::llround(q16)).clamped)) {
                return;
            }
            throw UsageError(
                "axis {}: {} is {:.0f} counts, and the register {} of the profile {} holds {} to {} (scale {} / {}{}); "
                "lower it or steps_per_mm, or look at width, scale and clamp in the profile",
                machine.axis_name[k], what, counts, field->name, drive.profile.name, field->lowest, field->highest,
                field->scale_numerator, field->scale_denominator, field->inverse ? ", inverse" : "");
        };
        if (drive.profile.stream == StreamWay::blocks) {
            const double ramp = ramp_mm_s2(drive, axis) * axis.steps_per_mm;
            // A block catches up what the one before left: by the ramp, within a period.
            check(FieldRole::profile_velocity, axis.max_velocity_mm_s * axis.steps_per_mm + ramp * period_us / us_per_s,
                  "max_velocity_mm_s with what a block catches up, in a second,");
            check(FieldRole::profile_acceleration, ramp, "the ramp, in a second^2,");
            check(FieldRole::profile_deceleration, ramp, "the ramp, in a second^2,");
        }
        if (machine.travel[k]) { // wherever in it the drive's own zero is
            check(FieldRole::target_position,
                  (machine.travel[k]->high - machine.travel[k]->low) * axis.steps_per_mm / 2.0, "half of travel_mm");
        }
    }
}

SetpointTarget::SetpointTarget(DriveTable table, const MachineDescription& machine, const RunOptions& options,
                               const DriveWires& wires)
    : ModbusTarget(std::move(table), machine, options, wires, target_wiring) {
    const std::uint32_t period_us = port_.period_us();
    for (const DriveTable::Drive& drive : table_.drives) {
        if (!machine.drives_on_at_end.value_or(true) && drive.profile.steps_of(DriveCommand::disable).empty()) {
            throw UsageError("{}: drives_at_end is \"off\", and the profile {} has no command `disable`; "
                             "leave drives_at_end out",
                             drive.address.text, drive.profile.name);
        }
        if (drive.profile.stream == StreamWay::cyclic && period_us > drive.profile.period_us) {
            throw UsageError("{}: the wire carries a target every {:.2f} ms at most often, and the drive "
                             "takes {:.2f} ms to get to one "
                             "(period_ms of {}): it would stand between them; set a longer interpolation "
                             "period in the drive, and as "
                             "period_ms in a copy of its profile",
                             drive.address.text, period_us * um_per_mm / us_per_s,
                             drive.profile.period_us * um_per_mm / us_per_s, drive.profile.name);
        }
        if (!drive.address.resample && period_us > static_cast<unsigned>(machine.settings.sample_period_us)) {
            throw UsageError(
                "{}: the wires carry a target every {:.2f} ms at most often, and the machine file asks for one "
                "every {:.2f} ms; raise sample_period_us, take a faster line, or leave resample=no out",
                drive.address.text, period_us * um_per_mm / us_per_s,
                machine.settings.sample_period_us * um_per_mm / us_per_s);
        }
    }
}

std::size_t SetpointTarget::axis_of(std::size_t drive) const noexcept {
    return static_cast<std::size_t>(table_.drives[drive].machine_axis.front());
}

// Targets are computed from the path at any instant, so segments may be as short as wanted.
TargetFacts SetpointTarget::facts() const {
    TargetFacts out = drive_facts();
    out.resamples = true;
    out.switches = {.homes = 0, .no_home = "the profile of its drive has no command home; home it by its own means"};
    double sum_sq = 0.0;
    for (std::size_t i = 0; i < table_.drives.size(); ++i) {
        const auto axis = static_cast<unsigned>(axis_of(i));
        const double most = port_.deviation_bound_counts(i) / machine_->settings.axis[axis].steps_per_mm;
        sum_sq += most * most;
        const bool homes = !table_.drives[i].profile.steps_of(hal::modbus::DriveCommand::home).empty();
        out.switches.homes |= homes ? 1U << axis : 0U;
    }
    out.note =
        fmt::format("the drives get a target position every {:.2f} ms; between two targets the machine may be up "
                    "to {:.1f} um off the path",
                    port_.period_us() * um_per_mm / us_per_s, um_per_mm * std::sqrt(sum_sq));
    return out;
}

std::vector<RunTarget::AxisPlace> SetpointTarget::standing() {
    require(port_.await_standstill());
    std::vector<AxisPlace> out;
    for (std::size_t i = 0; i < table_.drives.size(); ++i) {
        const auto axis = static_cast<unsigned>(axis_of(i));
        const double counts = machine_->inverted[axis] ? -port_.standing_counts(i) : port_.standing_counts(i);
        const std::optional<double> kept = port_.kept_counts(i);
        out.push_back(standing_place(axis, port_.placed(i) ? counts : kept.value_or(counts),
                                     port_.placed(i) || kept.has_value()));
    }
    return out;
}

std::vector<RunTarget::AxisPlace> SetpointTarget::places() const {
    std::vector<AxisPlace> out;
    for (std::size_t i = 0; may_have_moved() && i < table_.drives.size(); ++i) {
        const auto axis = static_cast<unsigned>(axis_of(i));
        const std::optional<double> counts = port_.position_counts(i);
        const bool online = port_.online(i);
        out.push_back(counts ? place(i, axis, *counts, online) : AxisPlace{axis, std::nullopt, online});
    }
    return out;
}

void SetpointTarget::describe(Summary& summary) const {
    LinkSummary& link = summary.link.emplace();
    double sum_sq = 0.0;
    for (std::size_t i = 0; i < table_.drives.size(); ++i) {
        const SetpointReport report = port_.report(i);
        link.drives.push_back({table_.drives[i].address.text, report.counts});
        link.late_us = std::max(link.late_us, report.late_us);
        const double off = port_.deviation_counts(i) / machine_->settings.axis[axis_of(i)].steps_per_mm;
        sum_sq += off * off;
    }
    link.resumes = port_.resumes();
    link.bus_s = static_cast<double>(port_.busy_us()) * 1e-6;
    link.target_period_us = port_.period_us();
    link.between_targets_mm = std::sqrt(sum_sq);
}

} // namespace splinefeed::host
