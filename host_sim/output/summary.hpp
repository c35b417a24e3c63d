// SPDX-License-Identifier: MIT
// Summary: what a run amounts to, for people (text) and programs (JSON).
#pragma once

#include "host_sim/analysis/limit_share.hpp"
#include "host_sim/output/gpio_summary.hpp"
#include "host_sim/output/link_summary.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace splinefeed::host {

struct Summary {
    /// Largest use of an axis's limits on the emitted segments, 1 = at the limit.
    struct AxisUse {
        std::string axis;
        double velocity = 0.0;
        double acceleration = 0.0;
        std::optional<double> jerk; ///< none: the machine file has no jerk limit for the axis
    };
    /// Storage of the pipeline's stages.
    struct MemoryBytes {
        std::uint64_t curve = 0;
        std::uint64_t feed_plan = 0;
        std::uint64_t stream = 0;
    };

    double cycle_time_s = 0.0;
    double length_mm = 0.0;
    std::uint64_t waypoints = 0;
    std::uint64_t curve_segments = 0;
    std::uint64_t feed_segments = 0;
    std::string scalar;
    std::string curve;
    double max_speed_mm_s = 0.0;
    std::vector<AxisUse> limit_use;          ///< in the order of the machine file
    std::optional<double> waypoint_error_mm; ///< none: there are no waypoints, or the curve need not pass them
    std::optional<double> optimum_time_s;    ///< lower bound of the cycle time; none: stopped or steered
    double planning_time_s = 0.0;
    MemoryBytes memory_bytes;
    bool stopped = false;                 ///< the run ended before the program did
    std::uint64_t events = 0;             ///< of the operator
    std::uint64_t events_not_reached = 0; ///< the run was over before them
    std::uint64_t window_limited = 0; ///< how often the planning window was too short to tell the plan from the best
    std::uint64_t stops = 0;          ///< corners where the feed is zero, ends not counted
    double smoothing_bound_mm = 0.0;  ///< how far the emitted motion may be from the curve
    std::uint64_t peak_rss_bytes = 0; ///< memory of the process; 0: unknown
    std::optional<LimitShares> limit_share; ///< which limit bound; axes as in limit_use
    std::optional<LinkSummary> link;        ///< of a run on Modbus drives
    std::optional<GpioSummary> gpio;        ///< of a run on lines of GPIO chips
};

/// One JSON object with the keys of the contract in its order, then those added since, and a line end. Under
/// limit_use.jerk an axis without a jerk limit is omitted; waypoint_error_mm, optimum_time_s and limit_share are null
/// where there is none; so jerk under limit_share.
[[nodiscard]] std::string to_json(const Summary& summary);

/// A table with units, then a sentence for everything that is unusual. Ends with a line end.
[[nodiscard]] std::string to_text(const Summary& summary);

} // namespace splinefeed::host
