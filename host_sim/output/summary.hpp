// SPDX-License-Identifier: MIT
// Summary: the results of a run, for people (text) and programs (JSON).
#pragma once

#include "host_sim/analysis/limit_share.hpp"
#include "host_sim/config/machine_description.hpp"
#include "host_sim/output/link_summary.hpp"
#include "host_sim/output/program_summary.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace splinefeed::host {

/// A path within a tolerance of what was programmed.
struct ToleranceSummary {
    struct Place {
        double distance = 0.0;    ///< [mm, degrees]
        std::uint64_t number = 0; ///< of the element or the waypoint, from 1; 0: the distance is 0 everywhere
        std::uint64_t line = 0;   ///< 0: unknown
        std::string name;         ///< for people; empty: the distance is 0 everywhere
    };
    Place deviation;                       ///< largest distance between the path and the elements, both ways
    std::optional<Place> rotary_deviation; ///< nothing: the machine has no rotary axis
    std::string excess;                    ///< the worst place where a tolerance was not kept; empty: all were
    std::uint64_t blended = 0;             ///< joints that were rounded
    std::uint64_t stopped = 0;             ///< joints where the machine stops, with the end
    std::uint64_t through = 0;             ///< joints without a corner
    std::uint64_t chains = 0;              ///< runs of short elements that became one spline
    std::uint64_t elements = 0;
    std::uint64_t pieces = 0; ///< Bezier segments
    double exact_stop_s = 0.0;
};

/// A limit that was raised by a tenth, alone, or a window that is longer.
struct RaisedLimit {
    std::string limit;         ///< for people
    std::string setting;       ///< of --set, to try it; empty: it is no number of the machine
    std::uint64_t window = 0;  ///< of --window; 0: it is a limit
    double cycle_time_s = 0.0; ///< then
    double gain = 0.0;         ///< part of the cycle time that is saved
};

struct LimitAdvice {
    std::vector<RaisedLimit> limits; ///< the largest gain first
    std::uint64_t moves = 0; ///< the first ones of the program, which stand for all of them; 0: all were planned
};

struct Summary {
    /// Largest use of an axis's limits on the emitted segments, 1 = at the limit.
    struct AxisUse {
        std::string axis;
        double velocity = 0.0;
        double acceleration = 0.0;
        std::optional<double> jerk;            ///< nothing: the machine file has no jerk limit for the axis
        std::optional<double> jerk_reserved{}; ///< part of that limit that the plan keeps for rounding
    };
    /// In the machine's coordinates. [mm, degrees]
    struct AxisPlace {
        std::string axis;
        std::optional<Travel> travel_mm; ///< nothing: no limit
        std::optional<double> zero_mm;   ///< of the program as it begins, without a tool's length; nothing: it has none
    };
    /// Storage of the stages of the pipeline.
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
    std::string jerk_scalar; ///< empty: the jerk is not limited
    std::string curve;
    double max_speed_mm_s = 0.0;
    std::vector<AxisUse> limit_use;          ///< in the order of the machine file
    std::vector<AxisPlace> places;           ///< in the same order
    std::optional<double> waypoint_error_mm; ///< nothing: there are no waypoints, or the curve need not pass through
                                             ///< them
    std::optional<double> optimum_time_s;    ///< lower bound of the cycle time; nothing: the run was stopped or steered
    double planning_time_s = 0.0; ///< from the start to this summary; on a real machine: how long it computed
    MemoryBytes memory_bytes;
    bool stopped = false;                 ///< the run ended before the program
    std::uint64_t events = 0;             ///< of the operator
    std::uint64_t events_not_reached = 0; ///< events after the end of the run
    /// How often the planning window was too short to know that the plan is the best; with a jerk limit how often the
    /// speed was what the machine can stop from within it.
    std::uint64_t window_limited = 0;
    std::optional<std::uint64_t> searched_legs; ///< that a plan with a jerk limit was searched for, again and again
    std::optional<std::uint64_t> slow_legs;     ///< of these, those without a new plan
    std::uint64_t stops = 0;                    ///< corners where the feed is zero, without the ends
    double smoothing_bound_mm = 0.0;            ///< largest distance of the emitted motion from the curve
    std::uint64_t peak_rss_bytes = 0;           ///< memory of the process; 0: unknown
    std::optional<LimitShares> limit_share;     ///< which limit bound; axes as in limit_use
    std::optional<ToleranceSummary> tolerance;  ///< for elements, and lines within a tolerance
    std::optional<LimitAdvice> what_would_help; ///< nothing: the program was not planned again
    ProgramSummary program;                     ///< dwells and events
    std::optional<LinkSummary> link;            ///< for a run on Modbus drives
    std::optional<GpioSummary> gpio;            ///< for a run on lines of GPIO chips
};

/// One JSON object, with a line end. An axis without a jerk limit is omitted under limit_use.jerk and limit_share.jerk.
/// waypoint_error_mm, optimum_time_s and limit_share are null if there is no value.
[[nodiscard]] std::string to_json(const Summary& summary);

/// The JSON schema of that object.
[[nodiscard]] nlohmann::ordered_json summary_schema();

/// A table with units, then a sentence for everything unusual. Ends with a line end.
[[nodiscard]] std::string to_text(const Summary& summary);

} // namespace splinefeed::host
