// SPDX-License-Identifier: MIT
#include "pvt_target.hpp"

#include "signal_watch.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace splinefeed::host {

using namespace hal::modbus;

namespace {

constexpr std::uint64_t stale_us = 100'000; // a drive's place, where it has not been heard for this long

} // namespace

std::vector<DriveWiring> pvt_wiring(const DriveTable& table) {
    std::vector<DriveWiring> wiring;
    for (const DriveTable::Drive& drive : table.drives) {
        wiring.push_back({drive.address.link, drive.machine_axis});
    }
    return wiring;
}

PvtTarget::PvtTarget(DriveTable table, const MachineDescription& machine, bool home)
    : machine_(&machine), table_(std::move(table)),
      port_(pvt_wiring(table_), {.home = home, .interrupted = &SignalWatch::interrupted}) {
    if (const auto failure = port_.open()) {
        throw TargetError(drive_sentence(table_, port_, *failure));
    }
    least_segment_us_ = port_.least_segment_us();
}

bool PvtTarget::resamples() const noexcept {
    return std::all_of(table_.drives.begin(), table_.drives.end(),
                       [](const DriveTable::Drive& drive) { return drive.address.resample; });
}

std::string drive_sentence(const DriveTable& table, const ModbusPort& port, const DriveFailure& failure) {
    const DriveReport report = port.report(failure.drive);
    std::string text = fmt::format("{}: {}", table.drives[failure.drive].address.text, describe(failure.problem));
    if (failure.problem == DriveProblem::fault) {
        text += fmt::format(", code {} on its axis {}: {}", report.status.fault, report.status.fault_axis,
                            fault_name(report.status.fault));
    } else if (failure.problem == DriveProblem::silent && report.last_fault != LinkFault::none) {
        text += fmt::format(" (last: {})", describe(report.last_fault));
    }
    return text;
}

std::string PvtTarget::halted(bool quick) const {
    return stop_sentence(stopped(), quick);
}

std::string PvtTarget::fault() const {
    return drive_sentence(table_, port_, *port_.failure()) + unconfirmed_drives(stopped());
}

std::vector<StoppedDrive> PvtTarget::stopped() const {
    std::vector<StoppedDrive> drives;
    for (std::size_t i = 0; i < port_.drives(); ++i) {
        drives.push_back({table_.drives[i].address.text, port_.stop_report(i)});
    }
    return drives;
}

std::string PvtTarget::where() const {
    std::string text = "; the machine stands at";
    for (std::size_t i = 0; i < port_.drives(); ++i) {
        const DriveReport report = port_.report(i);
        const DriveWiring& wiring = port_.wiring(i);
        for (std::size_t k = 0; k < wiring.machine_axis.size(); ++k) {
            if (wiring.machine_axis[k] >= 0) {
                const auto axis = static_cast<unsigned>(wiring.machine_axis[k]);
                // One that is away went on to where all were to stop.
                const bool heard = monotonic_us() - report.answered_us < stale_us;
                text += fmt::format(" {}={:.4f}{}", machine_->axis_name[axis],
                                    report.status.position[k] / machine_->settings.axis[axis].steps_per_mm,
                                    heard ? "" : " (when it was last heard)");
            }
        }
    }
    return text + " mm";
}

std::string PvtTarget::prepare(const FeedSegment& first) {
    const auto failure = port_.prepare(first);
    return failure ? drive_sentence(table_, port_, *failure) : std::string();
}

void PvtTarget::describe(Summary& summary) const {
    LinkSummary& link = summary.link.emplace();
    double worst_us = 0.0;
    for (std::size_t i = 0; i < port_.drives(); ++i) {
        link.drives.push_back({table_.drives[i].address.text, port_.report(i).counts});
        link.clocks_s = std::max(link.clocks_s, (worst_us + port_.unsure_us(i)) * 1e-6);
        worst_us = std::max(worst_us, port_.unsure_us(i));
    }
    link.resumes = port_.resumes();
    link.bus_s = static_cast<double>(port_.busy_us()) * 1e-6;
}

} // namespace splinefeed::host
