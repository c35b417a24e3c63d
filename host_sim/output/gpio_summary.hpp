// SPDX-License-Identifier: MIT
// GpioSummary: how the lines of a run did, and what its switches told.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace splinefeed::host {

struct GpioSummary {
    /// An input began to act, or ended to.
    struct Change {
        std::string role; ///< as in the map file
        std::string axis; ///< of limit and home; else empty
        bool active = false;
        double time_s = 0.0;                            ///< since the run began
        std::optional<std::vector<double>> position_mm; ///< of each axis then; nothing: not known
    };
    std::uint64_t edges = 0;    ///< instants at which lines changed
    double median_late_s = 0.0; ///< ends of octaves: half of them, 99 of 100 came sooner
    double p99_late_s = 0.0;
    double most_late_s = 0.0;
    /// So many edges came later than the one before says, and less than this late. [s]
    struct Octave {
        double below_s = 0.0;
        std::uint64_t edges = 0;
    };
    std::vector<Octave> late;     ///< where there were any, in rising order
    double schedule_slip_s = 0.0; ///< by so much the motion took longer than planned, for edges that came too late
    std::uint64_t buffer_underruns = 0; ///< the plan was not ready in time: all axes slowed down, and went on
    double began_monotonic_s = 0.0;     ///< when the run began, by CLOCK_MONOTONIC
    std::uint64_t missed = 0;           ///< edges of inputs that the system lost
    std::deque<Change> changes;         ///< the last ones
    std::uint64_t changes_left_out = 0; ///< older ones

    static constexpr std::size_t most_changes = 4096; ///< an input that never rests must not fill the memory
    /// Takes one more; the oldest gives way.
    void add(Change change) {
        changes.push_back(std::move(change));
        if (changes.size() > most_changes) {
            changes.pop_front();
            ++changes_left_out;
        }
    }
};

/// Keys as the members, and `_s` or `_mm` where they have one.
[[nodiscard]] nlohmann::ordered_json to_json(const GpioSummary& gpio);
/// A line on the edges, and one a change.
[[nodiscard]] std::string to_text(const GpioSummary& gpio);

} // namespace splinefeed::host
