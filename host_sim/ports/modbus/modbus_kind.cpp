// SPDX-License-Identifier: MIT
#include "host_sim/base/input_error.hpp"
#include "host_sim/config/drive_address.hpp"
#include "host_sim/config/drive_table.hpp"
#include "host_sim/config/machine_description.hpp"
#include "host_sim/config/shipped_profiles.hpp"
#include "host_sim/ports/histogram_picture.hpp"
#include "host_sim/ports/modbus/pvt_target.hpp"
#include "host_sim/ports/modbus/setpoint_target.hpp"
#include "host_sim/ports/target_table.hpp"
#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/rt/clock.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string>

namespace splinefeed::host {

namespace {

using namespace hal::modbus;

/// What was measured on one drive.
struct Measured {
    hal::TimeHistogram round_trips;
    std::uint64_t lost = 0;
};

constexpr std::array<std::string_view, 7> pvt_states{"disabled", "enabled, it stands", "running", "stopping",
                                                     "held",     "in fault",           "homing"};
constexpr std::array<std::string_view, drive_states> profile_states{"unknown: it matches none of its profile's states",
                                                                    "not ready",
                                                                    "disabled",
                                                                    "enabled, it stands",
                                                                    "moving",
                                                                    "homing",
                                                                    "halted",
                                                                    "in a quick stop",
                                                                    "in fault"};

/// A drive in fault, and the way out.
std::string fault_trouble(const DriveTable& table, std::size_t drive, const std::string& fault) {
    return drive_sentence(table, {"it is in fault, " + fault, drive, hal::Remedy::reset});
}

/// Where an axis of a drive stands. @param in_mm  the user named the machine
std::string standing(const DriveTable::Drive& drive, std::size_t axis, double counts, const MachineDescription& machine,
                     bool in_mm) {
    const int machine_axis = axis < drive.machine_axis.size() ? drive.machine_axis[axis] : -1;
    const auto k = static_cast<unsigned>(std::max(machine_axis, 0));
    const std::string name = axis < drive.axis_names.size() ? drive.axis_names[axis] : fmt::format("its axis {}", axis);
    const double mm = (machine.inverted[k] ? -counts : counts) / machine.settings.axis[k].steps_per_mm;
    return machine_axis < 0 || !in_mm ? fmt::format("  {}: at {:.0f} counts\n", name, counts)
                                      : fmt::format("  {}: at {:.4f} mm, {:.0f} counts\n", name, mm, counts);
}

template <class Port>
void measure(Port& port, double seconds, std::vector<Measured>& drives) {
    const std::uint64_t until = hal::system_clock().now_us() + static_cast<std::uint64_t>(seconds * 1e6);
    while (hal::system_clock().now_us() < until) {
        for (std::size_t i = 0; i < drives.size(); ++i) {
            const LinkAnswer answer = port.probe(i);
            if (answer.ok()) {
                drives[i].round_trips.add((answer.answered_us - answer.sent_us) * ns_per_us);
            } else {
                ++drives[i].lost;
            }
        }
    }
}

std::string trips(const Measured& measured, const LinkCounts& counts) {
    const hal::TimeHistogram& trips = measured.round_trips;
    std::string text =
        fmt::format("  round trip of a status read: half below {:.0f} us, 99 % below {:.0f} us, worst {} us\n",
                    trips.below_us(median_share), trips.below_us(nearly_all), trips.most_ns() / ns_per_us);
    text += histogram_picture(trips);
    text += fmt::format("  lost: {} of {} ({} time-outs, {} broken connections, {} corrupt, {} that did not fit, {} "
                        "exceptions)\n",
                        measured.lost, measured.lost + trips.total(), counts.timeouts, counts.disconnects,
                        counts.corrupt, counts.misfits, counts.exceptions);
    return text;
}

std::string advice_on_losses(std::size_t drive, const Measured& measured, const LinkAddress& link) {
    if (measured.lost == 0) {
        return {};
    }
    const auto all = static_cast<double>(measured.lost + measured.round_trips.total());
    return fmt::format("  drive {}: {:.2f} % of the requests were lost; nothing is lost on the path, but look at {}\n",
                       drive + 1, 100.0 * static_cast<double>(measured.lost) / all,
                       link.wire == Wire::rtu ? "termination, shielding, and whether another master is on the line"
                                              : "the network's load and cables");
}

std::string state_of(const DriveReport& report, const DriveTable::Drive& drive, const MachineDescription& machine,
                     bool in_mm) {
    const auto state = static_cast<std::size_t>(report.status.state);
    std::string text = state < pvt_states.size() ? fmt::format("  state: {}", pvt_states[state])
                                                 : fmt::format("  state: {}, which the map does not have", state);
    text += report.status.fault != 0 ? ", " + fault_text(report.status, drive.axis_names) + "\n" : ", no fault\n";
    for (const unsigned k : indices(report.identity.axes)) {
        text += standing(drive, k, report.status.position[k], machine, in_mm);
    }
    return text;
}

std::string about(const ModbusPort& port, std::size_t drive, const Measured& measured) {
    const DriveReport report = port.report(drive);
    const PvtIdentity& identity = report.identity;
    std::string text =
        fmt::format("  splinefeed-pvt version {}, {} ax{}, ring of {} segments, boot number {}\n"
                    "  word order: high word first, as it must be\n",
                    identity.version, identity.axes, identity.axes == 1 ? "is" : "es", identity.ring, identity.boot);
    text += trips(measured, report.counts);
    if (report.clock.known()) {
        text += fmt::format("  clock against ours: {:+.1f} ppm, known to {:.0f} us\n", report.clock.skew_ppm(),
                            report.clock.uncertainty_us());
    }
    return text;
}

std::string advice_on_ring(const ModbusPort& port, const std::vector<Measured>& drives, double least_us,
                           const MachineDescription& machine) {
    std::string text;
    for (std::size_t i = 0; i < drives.size(); ++i) {
        const DriveReport report = port.report(i);
        text += advice_on_losses(i, drives[i], port.wiring(i).link);
        constexpr double noticeable_ppm = 50.0;
        if (std::abs(report.clock.skew_ppm()) > noticeable_ppm) {
            text += fmt::format(
                "  drive {}: its clock is {:+.0f} ppm off ours; segments are made longer or shorter by that "
                "much, so that drives stay together\n",
                i + 1, report.clock.skew_ppm());
        }
    }
    const double asked_us = machine.settings.sample_period_us;
    text += fmt::format("  segments of {:.2f} ms or more: {:.0f} a second for all drives\n", 1e-3 * least_us,
                        1e6 / least_us);
    text += least_us > asked_us
                ? fmt::format("  the machine file asks for {:.2f} ms: a run will take {:.2f} ms instead, and say so\n",
                              1e-3 * asked_us, 1e-3 * least_us)
                : fmt::format("  the machine file asks for {:.2f} ms: that is carried\n", 1e-3 * asked_us);
    return text;
}

LinkReport pvt_report(const DriveTable& table, const MachineDescription& machine, bool in_mm, double seconds) {
    ModbusPort port(pvt_wiring(table, machine), {});
    if (const auto failure = port.open()) {
        throw TargetError(drive_sentence(table, failure));
    }
    std::vector<Measured> drives(port.drives());
    measure(port, seconds, drives);
    LinkReport out;
    for (std::size_t i = 0; i < drives.size(); ++i) {
        const DriveTable::Drive& drive = table.drives[i];
        const DriveReport report = port.report(i);
        out.text += fmt::format("drive {}: {}\n", i + 1, drive.address.text) + state_of(report, drive, machine, in_mm) +
                    about(port, i, drives[i]);
        if (report.status.state == PvtState::fault && out.trouble.empty()) {
            out.trouble = fault_trouble(table, i, fault_text(report.status, drive.axis_names));
        }
    }
    out.text += "what that means:\n" + advice_on_ring(port, drives, port.least_segment_us(), machine);
    return out;
}

/// Of drives that follow target positions.
LinkReport target_report(const DriveTable& table, const MachineDescription& machine, bool in_mm, double seconds) {
    SetpointPort port(target_wiring(table, machine), {});
    if (const auto failure = port.open()) {
        throw TargetError(drive_sentence(table, failure));
    }
    std::vector<Measured> drives(port.drives());
    measure(port, seconds, drives);
    LinkReport out;
    std::string& text = out.text;
    std::string advice;
    for (std::size_t i = 0; i < drives.size(); ++i) {
        const DriveTable::Drive& drive = table.drives[i];
        const DriveProfile& profile = drive.profile;
        const DriveReading& reading = port.reading(i);
        const bool faulty = reading.state == DriveState::fault;
        const std::string fault = fmt::format("code {}; see its manual", reading.fault_code);
        text += fmt::format("drive {}: {}\n  {}: {}; it says what its profile expects\n  state: {}{}\n", i + 1,
                            drive.address.text, profile.name, profile.drive,
                            profile_states[static_cast<std::size_t>(reading.state)], faulty ? ", " + fault : "");
        text += standing(drive, 0, port.standing_counts(i), machine, in_mm);
        if (faulty && out.trouble.empty()) {
            out.trouble = fault_trouble(table, i, fault);
        }
        text += trips(drives[i], port.counts(i));
        advice += advice_on_losses(i, drives[i], table.drives[i].address.link);
    }
    advice += fmt::format("  a target every {:.2f} ms: between two, each axis may be off the path by\n",
                          port.period_us() * 1e-3);
    for (std::size_t i = 0; i < drives.size(); ++i) {
        const auto axis = static_cast<unsigned>(table.drives[i].machine_axis.front());
        advice += fmt::format("    {}: {:.1f} um, by its acceleration and what its registers round\n",
                              machine.axis_name[axis],
                              1e3 * port.deviation_bound_counts(i) / machine.settings.axis[axis].steps_per_mm);
    }
    text += "what that means:\n" + advice;
    return out;
}

/// Measures every drive of a target for the given time; nothing moves. Returns the state of each drive, the
/// measurements and advice; the trouble is a drive in fault. Throws UsageError, InputError, and TargetError if a drive
/// cannot be used.
/// @param target  "modbus", or the address of a drive
/// @param any_axes  the user named no machine: the machine of an address has as many axes as the drive
LinkReport modbus_report(const std::string& target, const MachineDescription& stated, bool any_axes, double seconds) {
    MachineDescription machine = stated;
    if (any_axes && target != "modbus") {
        const DriveProfile profile = find_profile(parse_drive_address(target).profile);
        machine.settings.axes = std::min(machine.settings.axes, profile.axes);
    }
    const DriveTable table = drive_table(target, machine);
    const WireClaims claims(table);
    return table.interpolate ? pvt_report(table, machine, !any_axes, seconds)
                             : target_report(table, machine, !any_axes, seconds);
}

bool is_modbus(const std::string& target) {
    return target == "modbus" || target.rfind("modbus-", 0) == 0;
}

void check_modbus(const std::string& target) {
    if (target != "modbus") {
        static_cast<void>(parse_drive_address(target));
    }
}

std::unique_ptr<RunTarget> make_modbus_target(const std::string& target, const MachineDescription& machine,
                                              const RunOptions& options) {
    if (options.probe) {
        throw UsageError("--probe needs a probe: an input of a target gpio://");
    }
    DriveTable table = drive_table(target, machine);
    if (table.interpolate) {
        return std::make_unique<PvtTarget>(std::move(table), machine, options);
    }
    return std::make_unique<SetpointTarget>(std::move(table), machine, options);
}

} // namespace

extern const TargetKind modbus_kind{
    .names = "modbus, modbus-tcp://, modbus-rtu:// (docs/reference/modbus.md)",
    .help = "modbus: each axis's drive as the machine file names it; modbus-tcp://HOST:PORT?unit=1 or "
            "modbus-rtu:///dev/ttyUSB0?baud=115200: one drive with all axes",
    .is = is_modbus,
    .check = check_modbus,
    .make = make_modbus_target,
    .report = modbus_report,
};

} // namespace splinefeed::host
