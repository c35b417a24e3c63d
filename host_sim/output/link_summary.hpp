// SPDX-License-Identifier: MIT
// LinkSummary: how the wires of a run on drives did.
#pragma once

#include "splinefeed/hal/modbus/link/link_counts.hpp"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace splinefeed::host {

struct LinkSummary {
    struct Drive {
        std::string address;
        hal::modbus::LinkCounts counts;
    };
    std::vector<Drive> drives;
    double clocks_s = 0.0;     ///< two drives may have been started so far apart, by what is known of their clocks
    std::uint32_t resumes = 0; ///< all drives stopped together and went on
    double bus_s = 0.0;        ///< processor time of the buses' threads
    /// Of drives that do not interpolate: between two targets, and how far off the path the machine may have been
    /// there.
    std::uint32_t target_period_us = 0; ///< 0: they interpolate
    double between_targets_mm = 0.0;
    std::uint64_t late_us = 0; ///< most that a target came behind its instant
};

/// `{"drives": [{"address":, "exchanges":, "segments":, "timeouts":, ...}], "resumes":, "clocks_known_to_s":,
/// "bus_time_s":}`; with targets "targets" for "segments", and "target_period_s", "between_targets_mm" and
/// "latest_target_s" besides.
[[nodiscard]] nlohmann::ordered_json to_json(const LinkSummary& link);

/// A line a drive; what was lost by name, where anything was.
[[nodiscard]] std::string to_text(const LinkSummary& link);

} // namespace splinefeed::host
