// SPDX-License-Identifier: MIT
#include "host_sim/ports/modbus/pvt_target.hpp"

#include "host_sim/base/input_error.hpp"

#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/modbus/profile/drive_timing.hpp"
#include "splinefeed/hal/rt/clock.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

using namespace hal::modbus;

namespace {

constexpr std::uint64_t stale_us = 100'000; // a drive's place, where it has not been heard for this long

} // namespace

std::vector<DriveWiring> pvt_wiring(const DriveTable& table, const MachineDescription& machine) {
    std::vector<DriveWiring> wiring;
    for (const DriveTable::Drive& drive : table.drives) {
        DriveWiring& out = wiring.emplace_back();
        out.link = drive.address.link;
        out.axis_names = drive.axis_names;
        for (const int axis : drive.machine_axis) {
            const auto k = static_cast<unsigned>(axis);
            out.axes.emplace_back(axis, axis >= 0 && machine.inverted[k]);
            if (axis >= 0) {
                out.axes.back().window_counts = std::llround(standstill_window_counts(machine, k));
            }
        }
        out.timing = timing_of(drive.profile.link);
        out.both_in_one = drive.profile.link.has(23);
        const std::uint32_t watchdog_ms = drive.profile.watchdog_timeout_ms;
        out.watchdog_ms = watchdog_ms > 0 ? std::optional(static_cast<std::uint16_t>(watchdog_ms)) : std::nullopt;
        if (const auto window = drive.profile.following_error_window_counts) {
            out.following_window = static_cast<std::uint32_t>(*window);
        }
    }
    return wiring;
}

void check_pvt_range(const MachineDescription& machine, double segment_us) {
    constexpr double margin = 1.001; // of what a plan's arithmetic may be above its limits
    for (const unsigned k : indices(machine.settings.axes)) {
        const AxisSettings& axis = machine.settings.axis[k];
        const double counts = axis.max_velocity_mm_s * axis.steps_per_mm * segment_us / us_per_s;
        if (counts * margin >= pvt_velocity_range) {
            throw UsageError(
                "axis {}: {} mm/s at {} counts/mm are {:.0f} counts in a segment of {:.2f} ms, and splinefeed-pvt "
                "carries {:.0f}; lower max_velocity_mm_s or steps_per_mm, or take a faster line or a shorter "
                "sample_period_us",
                machine.axis_name[k], axis.max_velocity_mm_s, axis.steps_per_mm, counts, segment_us * 1e-3,
                pvt_velocity_range / margin);
        }
    }
}

PvtTarget::PvtTarget(DriveTable table, const MachineDescription& machine, const RunOptions& options,
                     const DriveWires& wires)
    : ModbusTarget(std::move(table), machine, options, wires, pvt_wiring), clock_(wires.clock) {
    least_segment_us_ = port_.least_segment_us();
}

TargetFacts PvtTarget::facts() const {
    TargetFacts out = drive_facts();
    out.least_segment_us = least_segment_us_;
    out.resamples =
        std::ranges::all_of(table_.drives, [](const DriveTable::Drive& drive) { return drive.address.resample; });
    for (std::size_t i = 0; i < port_.drives(); ++i) {
        std::uint32_t of_drive = 0;
        for (const PvtAxis& axis : port_.wiring(i).axes) {
            of_drive |= axis.machine_axis >= 0 ? 1U << static_cast<unsigned>(axis.machine_axis) : 0U;
        }
        for (const unsigned k : indices(machine_->settings.axes)) {
            out.homes_with[k] = (of_drive >> k & 1U) != 0 ? of_drive : out.homes_with[k];
        }
    }
    return out;
}

std::vector<RunTarget::AxisPlace> PvtTarget::standing() {
    require(port_.await_standstill());
    std::vector<AxisPlace> out;
    for (std::size_t i = 0; i < port_.drives(); ++i) {
        const DriveWiring& wiring = port_.wiring(i);
        for (std::size_t k = 0; k < wiring.axes.size(); ++k) {
            if (wiring.axes[k].machine_axis >= 0) {
                const auto axis = static_cast<unsigned>(wiring.axes[k].machine_axis);
                out.push_back(standing_place(axis, counts_of(i, k), port_.placed(i)));
            }
        }
    }
    return out;
}

// As its drive reports it, in the axis's direction.
int PvtTarget::counts_of(std::size_t drive, std::size_t drive_axis) const {
    const int counts = port_.report(drive).status.position[drive_axis];
    return port_.wiring(drive).axes[drive_axis].inverted ? -counts : counts;
}

std::vector<RunTarget::AxisPlace> PvtTarget::places() const {
    std::vector<AxisPlace> out;
    for (std::size_t i = 0; may_have_moved() && i < port_.drives(); ++i) {
        const DriveReport report = port_.report(i);
        const DriveWiring& wiring = port_.wiring(i);
        for (std::size_t k = 0; k < wiring.axes.size(); ++k) {
            if (wiring.axes[k].machine_axis >= 0) {
                const auto axis = static_cast<unsigned>(wiring.axes[k].machine_axis);
                // One that is away went on to where all were to stop.
                const bool online = clock_->now_us() - report.answered_us < stale_us;
                AxisPlace& at = out.emplace_back(place(i, axis, counts_of(i, k), online));
                at.mm = port_.known_position(i, k) ? at.mm : std::nullopt;
            }
        }
    }
    return out;
}

void PvtTarget::describe(Summary& summary) const {
    LinkSummary& link = summary.link.emplace();
    double worst_us = 0.0;
    for (std::size_t i = 0; i < port_.drives(); ++i) {
        link.drives.push_back({table_.drives[i].address.text, port_.report(i).counts});
        link.clocks_s = std::max(link.clocks_s, (worst_us + port_.clock_uncertainty_us(i)) * 1e-6);
        worst_us = std::max(worst_us, port_.clock_uncertainty_us(i));
    }
    link.resumes = port_.resumes();
    link.bus_s = static_cast<double>(port_.busy_us()) * 1e-6;
}

} // namespace splinefeed::host
