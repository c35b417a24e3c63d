// SPDX-License-Identifier: MIT
// DriveArguments: the options of `splinefeed drive` as typed, and the command.
#pragma once

#include <optional>
#include <string>

namespace splinefeed::host {

/// No value: not given.
struct DriveArguments {
    std::string listen = "tcp://127.0.0.1:1502";
    std::string profile = "splinefeed-pvt";
    std::optional<std::string> axes;
    std::optional<std::string> position;
    std::optional<std::string> ring;
    std::optional<std::string> ramp;
    std::optional<std::string> bandwidth;
    std::optional<std::string> damping;
    std::optional<std::string> feed_forward;
    std::optional<std::string> max_velocity;
    std::optional<std::string> max_acceleration;
    std::optional<std::string> stop_deceleration;
    std::optional<std::string> faults;
    std::optional<std::string> record;
    std::optional<std::string> record_segments;
    bool allow_remote = false;
    bool list_profiles = false;
};

/// Serves until SIGTERM or SIGINT; then the records are complete. Returns the exit status. Throws UsageError,
/// OutputError.
[[nodiscard]] int run_drive(const DriveArguments& arguments);

} // namespace splinefeed::host
