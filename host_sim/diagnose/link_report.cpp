// SPDX-License-Identifier: MIT
#include "host_sim/diagnose/link_report.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/number_text.hpp"
#include "host_sim/config/machine_file.hpp"
#include "host_sim/diagnose/round_trips.hpp"
#include "host_sim/target/pvt_target.hpp"
#include "host_sim/target/setpoint_target.hpp"

#include "host_sim/config/shipped_profiles.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>
#ifdef SPLINEFEED_HAS_GPIO
#include "host_sim/diagnose/gpio_link.hpp"
#endif

namespace splinefeed::host {

namespace {

using namespace hal::modbus;

constexpr double usual = 0.5;
constexpr double nearly_all = 0.99;

/// What was measured on one drive.
struct Measured {
    RoundTrips round_trips;
    std::uint64_t lost = 0;
};

double measuring_time(const std::string& text) {
    constexpr double shortest_s = 0.1;
    constexpr double longest_s = 3600.0;
    double seconds = 0.0;
    if (read_number(text, seconds) != NumberText::number || seconds < shortest_s || seconds > longest_s) {
        throw UsageError(fmt::format("--seconds {}: it must be a number from 0.1 to 3600", in_quotes(text)));
    }
    return seconds;
}

template <class Port>
void measure(Port& port, double seconds, std::vector<Measured>& drives) {
    const std::uint64_t until = monotonic_us() + static_cast<std::uint64_t>(seconds * 1e6);
    while (monotonic_us() < until) {
        for (std::size_t i = 0; i < drives.size(); ++i) {
            const LinkAnswer answer = port.probe(i);
            if (answer.ok()) {
                drives[i].round_trips.add(answer.answered_us - answer.sent_us);
            } else {
                ++drives[i].lost;
            }
        }
    }
}

std::string trips(const Measured& measured, const LinkCounts& counts) {
    const RoundTrips& trips = measured.round_trips;
    std::string text =
        fmt::format("  round trip of a status read: half below {:.0f} us, 99 % below {:.0f} us, worst {} us\n",
                    trips.below_us(usual), trips.below_us(nearly_all), trips.worst_us());
    text += trips.picture();
    text += fmt::format("  lost: {} of {} ({} time-outs, {} broken connections, {} corrupt, {} that did not fit, {} "
                        "exceptions)\n",
                        measured.lost, measured.lost + trips.count(), counts.timeouts, counts.disconnects,
                        counts.corrupt, counts.misfits, counts.exceptions);
    return text;
}

std::string advice_on_losses(std::size_t drive, const Measured& measured, const LinkAddress& link) {
    if (measured.lost == 0) {
        return {};
    }
    const auto all = static_cast<double>(measured.lost + measured.round_trips.count());
    return fmt::format("  drive {}: {:.2f} % of the requests were lost; nothing is lost on the path, but look at {}\n",
                       drive + 1, 100.0 * static_cast<double>(measured.lost) / all,
                       link.wire == Wire::rtu ? "termination, shielding, and whether another master is on the line"
                                              : "the network's load and cables");
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

std::string advice(const ModbusPort& port, const std::vector<Measured>& drives, double least_us,
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

std::string pvt_report(const DriveTable& table, const MachineDescription& machine, double seconds) {
    ModbusPort port(pvt_wiring(table, machine), {});
    if (const auto failure = port.open()) {
        throw TargetError(drive_sentence(table, port, *failure));
    }
    std::vector<Measured> drives(port.drives());
    measure(port, seconds, drives);
    std::string text;
    for (std::size_t i = 0; i < drives.size(); ++i) {
        text += fmt::format("drive {}: {}\n", i + 1, table.drives[i].address.text) + about(port, i, drives[i]);
    }
    return text + "what that means:\n" + advice(port, drives, port.least_segment_us(), machine);
}

/// Of drives that are told where to be.
std::string target_report(const DriveTable& table, const MachineDescription& machine, double seconds) {
    TargetPort port(target_wiring(table, machine), {});
    if (const std::string what = port.open(); !what.empty()) {
        throw TargetError(fmt::format("{}: {}", table.drives[port.trouble_with()].address.text, what));
    }
    std::vector<Measured> drives(port.drives());
    measure(port, seconds, drives);
    std::string text;
    std::string advice;
    for (std::size_t i = 0; i < drives.size(); ++i) {
        const DriveProfile& profile = table.drives[i].profile;
        text += fmt::format("drive {}: {}\n  {}: {}; it says what its profile expects\n  it stands at {:.0f} counts\n",
                            i + 1, table.drives[i].address.text, profile.name, profile.drive, port.standing_counts(i));
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
    return text + "what that means:\n" + advice;
}

} // namespace

void add_link_options(CLI::App& app, LinkArguments& arguments) {
    app.add_option("--target", arguments.target, target_text);
    app.add_option("-m,--machine", arguments.machine,
                   "machine file (.toml), for modbus and gpio:// (default: three axes)");
    app.add_option("--seconds", arguments.seconds, "how long to measure, 0.1 to 3600 (default 3)");
}

int report_link(const LinkArguments& arguments) {
    if (arguments.target.empty() || arguments.target == "sim") {
        throw UsageError("there is nothing to test; name the drives with --target modbus-tcp://HOST:PORT, "
                         "modbus-rtu://DEVICE, gpio:///dev/gpiochip0?map=FILE.toml, or modbus and -m MACHINE.toml");
    }
    check_target(arguments.target);
    const double seconds = measuring_time(arguments.seconds);
    MachineDescription machine = arguments.machine.empty() ? default_machine() : read_machine_file(arguments.machine);
#ifdef SPLINEFEED_HAS_GPIO
    if (is_gpio_address(arguments.target)) {
        std::fputs(gpio_report(parse_gpio_address(arguments.target), machine, seconds).c_str(), stdout);
        return 0;
    }
#endif
    if (arguments.machine.empty() && arguments.target != "modbus") { // one drive, whatever axes it has
        const DriveProfile profile = find_profile(parse_target_address(arguments.target).profile);
        machine.settings.axes = std::min(machine.settings.axes, profile.axes);
    }
    const DriveTable table = drive_table(arguments.target, machine);
    const std::string text =
        table.interpolate ? pvt_report(table, machine, seconds) : target_report(table, machine, seconds);
    std::fputs(text.c_str(), stdout);
    return 0;
}

} // namespace splinefeed::host
