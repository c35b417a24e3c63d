// SPDX-License-Identifier: MIT
#include "setpoint_target.hpp"

#include "input_error.hpp"
#include "signal_watch.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

using namespace hal::modbus;

namespace {

constexpr double us_per_s = 1e6;
constexpr double um_per_mm = 1e3;

} // namespace

std::vector<TargetWiring> target_wiring(const DriveTable& table, const MachineDescription& machine) {
    std::vector<TargetWiring> wiring;
    for (const DriveTable::Drive& drive : table.drives) {
        const int axis = drive.machine_axis.front(); // they have one
        const AxisSettings& settings = machine.settings.axis[static_cast<unsigned>(axis)];
        wiring.push_back({.link = drive.address.link,
                          .profile = &drive.profile,
                          .axis = axis,
                          .acceleration_counts_s2 = settings.larger_acceleration_mm_s2() * settings.steps_per_mm,
                          .ramp_counts_s2 = drive.address.ramp_counts_s2.value_or(0.0)});
    }
    return wiring;
}

SetpointTarget::SetpointTarget(DriveTable table, const MachineDescription& machine, bool home)
    : machine_(&machine), table_(std::move(table)),
      port_(target_wiring(table_, machine), {.home = home, .interrupted = &SignalWatch::interrupted}) {
    if (const std::string what = port_.open(); !what.empty()) {
        throw TargetError(sentence(what));
    }
    const std::uint32_t period_us = port_.period_us();
    for (const DriveTable::Drive& drive : table_.drives) {
        if (drive.profile.stream == StreamWay::cyclic && period_us > drive.profile.period_us) {
            throw UsageError(fmt::format("{}: the wire carries a target every {:.2f} ms at most often, and the drive "
                                         "takes {:.2f} ms to get to one "
                                         "(period_ms of {}): it would stand between them; set a longer interpolation "
                                         "period in the drive, and as "
                                         "period_ms in a copy of its profile",
                                         drive.address.text, period_us * um_per_mm / us_per_s,
                                         drive.profile.period_us * um_per_mm / us_per_s, drive.profile.name));
        }
        if (!drive.address.resample && period_us > static_cast<unsigned>(machine.settings.sample_period_us)) {
            throw UsageError(fmt::format(
                "{}: the wires carry a target every {:.2f} ms at most often, and the machine file asks for one "
                "every {:.2f} ms; raise sample_period_us, take a faster line, or leave resample=no out",
                drive.address.text, period_us * um_per_mm / us_per_s,
                machine.settings.sample_period_us * um_per_mm / us_per_s));
        }
    }
}

std::size_t SetpointTarget::axis_of(std::size_t drive) const noexcept {
    return static_cast<std::size_t>(table_.drives[drive].machine_axis.front());
}

std::string SetpointTarget::sentence(const std::string& trouble) const {
    return fmt::format("{}: {}", table_.drives[port_.trouble_with()].address.text, trouble);
}

std::string SetpointTarget::note() const {
    double sum_sq = 0.0;
    for (std::size_t i = 0; i < table_.drives.size(); ++i) {
        const AxisSettings& axis = machine_->settings.axis[axis_of(i)];
        const double most = port_.deviation_bound_counts(i) / axis.steps_per_mm;
        sum_sq += most * most;
    }
    return fmt::format("the drives are told where to be every {:.2f} ms; between two targets the machine may be up to "
                       "{:.1f} um off the path",
                       port_.period_us() * um_per_mm / us_per_s, um_per_mm * std::sqrt(sum_sq));
}

std::string SetpointTarget::halted(bool quick) const {
    return stop_sentence(stopped(), quick);
}

std::string SetpointTarget::fault() const {
    return sentence(port_.trouble()) + unconfirmed_drives(stopped());
}

std::vector<StoppedDrive> SetpointTarget::stopped() const {
    std::vector<StoppedDrive> drives;
    for (std::size_t i = 0; i < port_.drives(); ++i) {
        drives.push_back({table_.drives[i].address.text, port_.stop_report(i)});
    }
    return drives;
}

std::string SetpointTarget::where() const {
    std::string text = "; the machine stands at";
    for (std::size_t i = 0; i < table_.drives.size(); ++i) {
        const std::size_t axis = axis_of(i);
        text += fmt::format(" {}={:.4f}{}", machine_->axis_name[axis],
                            port_.position_counts(i) / machine_->settings.axis[axis].steps_per_mm,
                            port_.heard(i) ? "" : " (when it was last heard)");
    }
    return text + " mm";
}

std::string SetpointTarget::prepare(const FeedSegment& first) {
    const std::string what = port_.prepare(first);
    return what.empty() ? what : sentence(what);
}

void SetpointTarget::describe(Summary& summary) const {
    LinkSummary& link = summary.link.emplace();
    double sum_sq = 0.0;
    for (std::size_t i = 0; i < table_.drives.size(); ++i) {
        const TargetReport report = port_.report(i);
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
