// SPDX-License-Identifier: MIT
// PlannedPath: an input as a motion within a machine's limits, segment by segment, whatever scalar and planner make it.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/planning/path_feeder.hpp"
#include "host_sim/program/path_input.hpp"

#include "splinefeed/s1_blended_path/tolerance_path.hpp"
#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

namespace splinefeed {
struct CounterSeam; // of tests
} // namespace splinefeed

namespace splinefeed::host {

/// How a path is planned.
struct PlannerChoice {
    std::size_t window_cells = 1024;              ///< look-ahead of the feed plan
    ScalarKind jerk_scalar = ScalarKind::float64; ///< number type of a JerkPlanner; not fixed

    [[nodiscard]] SampledIn sampled() const noexcept {
        return jerk_scalar == ScalarKind::float64 ? SampledIn::float64 : SampledIn::scalar;
    }
};

inline constexpr std::size_t longest_window = 1'000'000; ///< cells

/// The look-ahead of --window, 10 to longest_window cells. Throws UsageError.
[[nodiscard]] std::size_t read_window(std::string_view text);

/// What has the scalar of the plan is behind stream().
class PlannedPath {
public:
    struct Statistics {
        const char* scalar = "";
        const char* jerk_scalar = "";               ///< of a JerkPlanner; empty: the jerk is not limited
        double length_mm = 0.0;                     ///< that was travelled
        std::uint64_t curve_segments = 0;           ///< that were passed to the plan
        PathCounts counts;                          ///< of a path within a tolerance
        std::uint64_t window_limited = 0;           ///< FeedPlan::window_limited() or JerkPlan::window_limited()
        std::optional<std::uint64_t> searched_legs; ///< JerkPlan::searched_legs(); none: the jerk is not limited
        std::optional<std::uint64_t> slow_legs;     ///< JerkPlan::slow_legs()
        PerAxis<double> jerk_mm_s3{};               ///< limits of the plan, which leave out what is kept for rounding
        std::size_t curve_bytes = 0;                ///< memory of the stages
        std::size_t plan_bytes = 0;
        std::size_t stream_bytes = 0;
    };

    /// @param path  of a machine
    template <class ScalarPath>
    explicit PlannedPath(std::shared_ptr<ScalarPath> path)
        : stream_(&path->stream()), feeder_(&path->feeder()), failure_(&path->tee().failure()),
          statistics_([&path = *path] { return path.statistics(); }), memory_(std::move(path)) {}

    /// What has to be fed when next() says `starved`, unless the machine stands for something.
    [[nodiscard]] PathFeeder& feeder() noexcept { return *feeder_; }
    [[nodiscard]] MoveStream& stream() noexcept { return *stream_; }
    /// MoveStream::next(); the segment names the row of its waypoint in the input.
    Pull next(FeedSegment& out, Supply supply);
    /// Why the curve ended before its end: what the watch has thrown; null: nothing.
    [[nodiscard]] const std::exception_ptr& failure() const noexcept { return *failure_; }
    [[nodiscard]] Statistics statistics() const { return statistics_(); }

private:
    friend struct splinefeed::CounterSeam;

    MoveStream* stream_;
    PathFeeder* feeder_;
    const std::exception_ptr* failure_;
    std::function<Statistics()> statistics_;
    std::shared_ptr<void> memory_;
};

/// The input in its scalar, with the planner that the machine's limits need. Throws InputError where the limits do not
/// go together, and UsageError where the curve cannot be what was chosen. The arguments must outlive it, but for
/// `machine`.
[[nodiscard]] std::unique_ptr<PlannedPath> plan_path(PathInput& input, const MachineDescription& machine,
                                                     CurveWatch& watch, const PlannerChoice& choice);

/// The whole curve, to the watch; nothing is planned. Inputs of a real machine answer as the program expects: a loop
/// may wait for another answer, so the look ends at the M66 behind a hundred of them. Throws what the watch throws.
/// Returns the number of waypoints; nothing: it depends on inputs.
std::optional<std::uint64_t> look_through(PathInput& input, CurveWatch& watch);

} // namespace splinefeed::host
