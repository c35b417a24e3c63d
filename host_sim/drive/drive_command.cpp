// SPDX-License-Identifier: MIT
#include "host_sim/drive/drive_command.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/option_number.hpp"
#include "host_sim/base/standard_streams.hpp"
#include "host_sim/base/trimmed_text.hpp"
#include "host_sim/config/shipped_profiles.hpp"
#include "host_sim/drive/drive_server.hpp"
#include "host_sim/drive/faulty_drive.hpp"
#include "host_sim/drive/profile_drive.hpp"
#include "host_sim/drive/pvt_drive.hpp"
#include "host_sim/drive/vfd_drive.hpp"

#include <fmt/format.h>
#include <random>

namespace splinefeed::host {

namespace {

constexpr double farthest_counts = 2147483647.0;

volatile std::sig_atomic_t stop_requested = 0;

extern "C" void request_stop(int /*signal*/) {
    stop_requested = 1;
}

std::vector<double> numbers(std::string_view option, std::string_view text, double low, double high) {
    std::vector<double> out;
    for (const std::string_view part : split(text, ',')) {
        out.push_back(read_option_number(option, part, low, high));
    }
    return out;
}

/// One value for all axes, or one for each.
void take_each(std::vector<PvtAxisParameters>& axes, std::string_view option, const std::optional<std::string>& text,
               double low, double high, double PvtAxisParameters::*member) {
    if (!text) {
        return;
    }
    const std::vector<double> values = numbers(option, *text, low, high);
    if (values.size() != 1 && values.size() != axes.size()) {
        throw UsageError("{} {} has {} numbers; there must be one, or one for each of the {} axes", option,
                         in_quotes(*text), values.size(), axes.size());
    }
    for (std::size_t k = 0; k < axes.size(); ++k) {
        axes[k].*member = values[values.size() == 1 ? 0 : k];
    }
}

std::size_t choose_axes(const DriveArguments& arguments, const hal::modbus::DriveProfile& profile) {
    constexpr std::size_t usual = 3;
    if (profile.axes == 1) {
        if (arguments.axes && read_option_integer("--axes", *arguments.axes, 1, max_axes) != 1) {
            throw UsageError("--axes {}: a drive with the profile {} has one axis; start one for each",
                             in_quotes(*arguments.axes), profile.name);
        }
        return 1;
    }
    if (arguments.axes) {
        return static_cast<std::size_t>(read_option_integer("--axes", *arguments.axes, 1, max_axes));
    }
    const std::size_t named =
        arguments.position ? numbers("--position", *arguments.position, -farthest_counts, farthest_counts).size() : 1;
    return named == 1 ? std::min<std::size_t>(usual, max_axes) : std::min<std::size_t>(named, max_axes);
}

/// Unless it is not given.
void take(std::string_view option, const std::optional<std::string>& text, double low, double high, double& out) {
    out = text ? read_option_number(option, *text, low, high) : out;
}

MotorAxisParameters shaft_parameters(const DriveArguments& arguments) {
    MotorAxisParameters shaft;
    take("--bandwidth", arguments.bandwidth, 0.1, 10000.0, shaft.bandwidth_hz);
    take("--damping", arguments.damping, 0.0, 0.999, shaft.damping);
    take("--feed-forward", arguments.feed_forward, 0.0, 2.0, shaft.feed_forward);
    return shaft;
}

/// An option of drives of axes.
struct AxisOption {
    const char* name;
    std::optional<std::string> DriveArguments::*text;
    bool of_segments = false; ///< only where the drive takes segments
};
constexpr AxisOption axis_options[] = {
    {"--position", &DriveArguments::position},
    {"--ring", &DriveArguments::ring, true},
    {"--max-velocity", &DriveArguments::max_velocity, true},
    {"--max-acceleration", &DriveArguments::max_acceleration, true},
    {"--stop-deceleration", &DriveArguments::stop_deceleration},
    {"--bandwidth", &DriveArguments::bandwidth},
    {"--damping", &DriveArguments::damping},
    {"--feed-forward", &DriveArguments::feed_forward},
    {"--record-segments", &DriveArguments::record_segments, true},
};

PvtDriveParameters pvt_parameters(const DriveArguments& arguments, std::size_t axes) {
    constexpr double fastest = 1e12;
    PvtDriveParameters out;
    out.axes.assign(axes, {});
    const MotorAxisParameters shaft = shaft_parameters(arguments);
    for (PvtAxisParameters& axis : out.axes) {
        axis.shaft = shaft;
    }
    take_each(out.axes, "--position", arguments.position, -farthest_counts, farthest_counts,
              &PvtAxisParameters::start_counts);
    take_each(out.axes, "--max-velocity", arguments.max_velocity, 0.0, fastest, &PvtAxisParameters::largest_counts_s);
    take_each(out.axes, "--max-acceleration", arguments.max_acceleration, 0.0, fastest,
              &PvtAxisParameters::largest_counts_s2);
    take_each(out.axes, "--stop-deceleration", arguments.stop_deceleration, 1.0, fastest,
              &PvtAxisParameters::stop_counts_s2);
    if (arguments.ring) {
        out.ring = static_cast<std::uint16_t>(read_option_integer("--ring", *arguments.ring, 16, 65535));
    }
    // As in a real one: nobody knows what it will be.
    std::random_device any;
    out.boot = any();
    out.clock_start_us = any();
    return out;
}

ProfileDriveParameters profile_parameters(const DriveArguments& arguments, const std::string& profile) {
    for (const AxisOption& option : axis_options) {
        if (option.of_segments && arguments.*option.text) {
            throw UsageError("{} is for drives that take segments, not for the profile {}; leave it out", option.name,
                             profile);
        }
    }
    ProfileDriveParameters out;
    out.axis.shaft = shaft_parameters(arguments);
    if (arguments.position && arguments.position->find(',') != std::string::npos) {
        throw UsageError("--position {}: a drive with the profile {} has one axis; give one number",
                         in_quotes(*arguments.position), profile);
    }
    take("--position", arguments.position, -farthest_counts, farthest_counts, out.axis.start_counts);
    take("--stop-deceleration", arguments.stop_deceleration, 1.0, 1e12, out.axis.stop_counts_s2);
    return out;
}

VfdDriveParameters vfd_parameters(const DriveArguments& arguments, const std::string& profile) {
    for (const AxisOption& option : axis_options) {
        if (arguments.*option.text) {
            throw UsageError("{} is for drives of axes, not for the spindle of the profile {}; leave it out",
                             option.name, profile);
        }
    }
    VfdDriveParameters out;
    take("--ramp", arguments.ramp, 0.1, 1e6, out.ramp_hz_s);
    return out;
}

/// The one place where a profile becomes a model.
std::unique_ptr<DriveModel> make_drive_model(const DriveArguments& arguments, const hal::modbus::DriveProfile& profile,
                                             std::size_t axes, SegmentRecord* segments) {
    if (profile.stream == hal::modbus::StreamWay::speed) {
        return std::make_unique<FaultyDrive>(
            std::make_unique<VfdDrive>(profile, vfd_parameters(arguments, profile.name)), profile);
    }
    if (arguments.ramp) {
        throw UsageError("--ramp is for spindles, not for the profile {}; leave it out", profile.name);
    }
    if (profile.stream == hal::modbus::StreamWay::pvt) {
        auto drive = std::make_unique<PvtDrive>(pvt_parameters(arguments, axes));
        if (segments != nullptr) {
            drive->machine().observe([segments](const ExecutedSegment& executed) { segments->row(executed); });
        }
        return drive;
    }
    return std::make_unique<FaultyDrive>(
        std::make_unique<ProfileDrive>(profile, profile_parameters(arguments, profile.name)), profile);
}

void check_records(const DriveArguments& arguments) {
    if (arguments.record && arguments.record == arguments.record_segments) {
        throw UsageError("--record and --record-segments both go to one file; give each its own");
    }
    for (const auto& [option, path] :
         {std::pair{"--record", &arguments.record}, std::pair{"--record-segments", &arguments.record_segments}}) {
        if (!*path) {
            continue;
        }
        if (*path == "-") {
            throw UsageError("{} -: standard output tells where the drive listens; record to a file", option);
        }
        if ((*path)->empty()) {
            throw UsageError("{} needs the name of a file", option);
        }
    }
}

} // namespace

int run_drive(const DriveArguments& arguments) {
    if (arguments.list_profiles) {
        print_whole(list_profiles(), "the list of profiles");
        return 0;
    }
    check_records(arguments);
    const ListenAddress address = parse_listen_address(arguments.listen, arguments.allow_remote);
    const DriveFaults faults = parse_drive_faults(arguments.faults.value_or(""));
    const std::uint64_t seed = faults.seed.value_or(std::random_device{}());
    std::optional<SegmentRecord> segments;
    const hal::modbus::DriveProfile profile = find_profile(arguments.profile);
    const std::size_t axes = choose_axes(arguments, profile);
    if (arguments.record_segments) {
        segments.emplace(*arguments.record_segments, static_cast<int>(axes));
    }
    const std::unique_ptr<DriveModel> drive =
        make_drive_model(arguments, profile, axes, segments ? &*segments : nullptr);
    // Before anybody can know that it runs: who has read the line below may stop it.
    stop_requested = 0;
    static_cast<void>(std::signal(SIGTERM, request_stop));
    static_cast<void>(std::signal(SIGINT, request_stop));
    DriveServer server(*drive, address, faults, seed);
    std::optional<DriveRecord> record;
    if (arguments.record) {
        record.emplace(*arguments.record, arguments.profile, drive->axes(), server.start_s());
    }
    if (faults.random() && !faults.seed) {
        tell("splinefeed: --faults seed={}\n", seed);
    }
    print_whole(fmt::format("listening on {}, profile {}, {} {}\n", server.address().text(), arguments.profile,
                            drive->axes(), drive->axes() == 1 ? "axis" : "axes"),
                "the address");
    server.run(stop_requested, record ? &*record : nullptr);
    if (record) {
        record->commit();
    }
    if (segments) {
        segments->commit();
    }
    return 0;
}

} // namespace splinefeed::host
