// SPDX-License-Identifier: MIT
// LinkSummary: the state of the links of a run on drives.
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
    double clocks_s = 0.0;     ///< largest difference of the start times of two drives, by the uncertainty of their
                               ///< clocks
    std::uint32_t resumes = 0; ///< how often all drives stopped together and continued
    double bus_s = 0.0;        ///< processor time of the buses' threads
    /// For drives that do not interpolate: the time between two targets, and the largest path error between them.
    std::uint32_t target_period_us = 0; ///< 0: they interpolate
    double between_targets_mm = 0.0;
    std::uint64_t late_us = 0; ///< largest lateness of a target
};

/// `{"drives": [{"address":, "exchanges":, "segments":, "timeouts":, ...}], "resumes":, "clocks_known_to_s":,
/// "bus_time_s":}`; with targets it has "targets" instead of "segments", and also "target_period_s",
/// "between_targets_mm" and "latest_target_s".
[[nodiscard]] nlohmann::ordered_json to_json(const LinkSummary& link);
/// Its JSON schema.
[[nodiscard]] nlohmann::ordered_json link_schema();

/// One line per drive; losses by name, if there were any.
[[nodiscard]] std::string to_text(const LinkSummary& link);

} // namespace splinefeed::host
