// SPDX-License-Identifier: MIT
// LinkSummary: the state of the links of a run on drives. GpioSummary: timing of the edges of a run on GPIO lines, and
// the changes of its inputs.
#pragma once

#include "splinefeed/hal/modbus/link/link_counts.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
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
[[nodiscard]] nlohmann::ordered_json link_schema();

/// One line per drive; losses by name, if there were any.
[[nodiscard]] std::string to_text(const LinkSummary& link);

struct GpioSummary {
    /// An input became active or inactive.
    struct Change {
        std::string role; ///< as in the map file
        std::string axis; ///< for limit and home; otherwise empty
        bool active = false;
        double time_s = 0.0;                            ///< since the run began
        std::optional<std::vector<double>> position_mm; ///< of each axis at that time; nothing: not known
    };
    std::uint64_t edges = 0;    ///< instants at which lines changed
    double median_late_s = 0.0; ///< upper ends of octaves: half of the edges, or 99 of 100, came sooner
    double p99_late_s = 0.0;
    double most_late_s = 0.0;
    /// The number of edges that were later than the end of the previous octave and less late than this. [s]
    struct Octave {
        double below_s = 0.0;
        std::uint64_t edges = 0;
    };
    std::vector<Octave> late;     ///< the octaves that are not empty, in rising order
    double schedule_slip_s = 0.0; ///< the motion took longer than planned by this time, because edges came too late
    std::uint64_t buffer_underruns = 0; ///< the plan was not ready in time: all axes slowed down and then continued
    double began_monotonic_s = 0.0;     ///< time of the start, by CLOCK_MONOTONIC
    std::uint64_t missed = 0;           ///< edges of inputs that the system lost
    std::deque<Change> changes;         ///< the last ones
    std::uint64_t changes_left_out = 0; ///< older ones

    static constexpr std::size_t most_changes = 4096; ///< limits the memory if an input changes all the time
    /// Adds a change; the oldest one is dropped if there are too many.
    void add(Change change) {
        changes.push_back(std::move(change));
        if (changes.size() > most_changes) {
            changes.pop_front();
            ++changes_left_out;
        }
    }
};

/// The keys are the names of the members, with `_s` or `_mm` if they have it.
[[nodiscard]] nlohmann::ordered_json to_json(const GpioSummary& gpio);
[[nodiscard]] nlohmann::ordered_json gpio_schema();
/// One line about the edges, and one per change.
[[nodiscard]] std::string to_text(const GpioSummary& gpio);

} // namespace splinefeed::host
