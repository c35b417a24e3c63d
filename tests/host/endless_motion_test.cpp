// SPDX-License-Identifier: MIT
//
// What a run of 10^9 mm, 10^10 segments and 2^32 waypoints says of itself: its counters start shortly before.
#include "host_sim/run/runner.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/config/machine_file.hpp"
#include "host_sim/planning/scalar_path.hpp"
#include "host_sim/planning/waypoint_feeder.hpp"
#include "support/catch.hpp"
#include "support/counter_seam.hpp"
#include "temporary_folder.hpp"

#include "splinefeed/number/path_position.hpp"

#include <fmt/format.h>
#include <fstream>

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

constexpr std::uint64_t far_segments = 10'000'000'000;
constexpr std::uint64_t far_ticks = far_segments * 2000;
constexpr std::uint64_t far_rows = (std::uint64_t{1} << 32U) - 40;
constexpr Wide far_length{59, 0};

struct Outcome {
    Summary summary;
    std::string stopped;
    std::vector<std::string> trace;
};

Outcome run(const std::string& program, bool old, const MachineDescription& machine = default_machine()) {
    const TemporaryFolder folder;
    RunArguments arguments;
    arguments.path.input = folder.file("p.csv");
    arguments.outputs.trace = folder.file("t.csv");
    arguments.motion.quiet = true;
    std::ofstream(arguments.path.input) << program;
    const PlanFigures figures = plan_figures(ScalarKind::fixed, machine);
    const auto axes = static_cast<std::size_t>(machine.settings.axes);
    PathInput input(arguments.path, PathUse::executed,
                    {.axes = {machine.axis_name.begin(), machine.axis_name.begin() + axes}});
    const PathLimits path_limits(machine);
    Outputs outputs(arguments.outputs, input.curve_name(), false, machine);
    LiveMachine none;
    Motion motion(arguments.motion, machine, figures, input, path_limits, outputs, none);
    if (old) {
        auto& path = CounterSeam::path<ScalarPath<Fixed>>(motion);
        CounterSeam::travelled(path.stream().trajectory(), far_length, far_segments, far_segments);
        CounterSeam::ran(motion, far_ticks, far_segments);
        CounterSeam::read(dynamic_cast<WaypointFeeder&>(path.feeder()), far_rows);
        CounterSeam::pushed(path.curve().waypoints(), static_cast<std::uint32_t>(far_rows));
    }
    Outcome result;
    result.stopped = motion.run({});
    result.summary = motion.summary();
    outputs.commit();
    result.trace = lines_of(arguments.outputs.trace);
    return result;
}

std::string zigzag(int rows) {
    std::string text;
    for (int i = 0; i < rows; ++i) {
        text += fmt::format("{},{},0\n", 0.5 * i, i % 3 * 0.4);
    }
    return text;
}

} // namespace

TEST_CASE("a run that has lasted for a month says how long, how far and how many", "[endless]") {
    const Outcome fresh = run(zigzag(100), false);
    const Outcome old = run(zigzag(100), true);
    REQUIRE(fresh.stopped.empty());
    REQUIRE(old.stopped.empty());
    CHECK(old.summary.feed_segments == far_segments + fresh.summary.feed_segments);
    CHECK(old.summary.waypoints == far_rows + 100);
    CHECK(old.summary.cycle_time_s - static_cast<double>(far_ticks) / 8e6 ==
          Approx(fresh.summary.cycle_time_s).epsilon(1e-9));
    CHECK(old.summary.length_mm - length_to_mm(far_length) == Approx(fresh.summary.length_mm).epsilon(1e-8));
    CHECK(old.summary.waypoint_error_mm == fresh.summary.waypoint_error_mm);
    CHECK(old.summary.optimum_time_s == fresh.summary.optimum_time_s);
    CHECK(old.summary.stops == fresh.summary.stops);
    REQUIRE(old.trace.size() == fresh.trace.size());
    for (std::size_t i = 1; i < fresh.trace.size(); ++i) {
        const std::string& late = old.trace[i];
        const std::string& early = fresh.trace[i];
        REQUIRE(late.substr(late.find(',')) == early.substr(early.find(','))); // at the same places
        const std::string_view decimals = std::string_view(early).substr(early.find('.'), 7);
        REQUIRE(late.substr(late.find('.'), 7) == decimals); // and 2,500,000 s later
        REQUIRE(late.substr(0, late.find('.')) ==
                fmt::format("{}", 2'500'000 + std::stoll(early.substr(0, early.find('.')))));
    }
}

TEST_CASE("a position out of the travel is told with its line after 2^32 waypoints", "[endless]") {
    MachineDescription machine = default_machine();
    machine.travel[0] = splinefeed::host::Travel{-1.0, 40.0};
    for (const bool old : {false, true}) {
        std::string refusal; // thrown before the first move; after it, why the machine stopped
        try {
            refusal = run(zigzag(100), old, machine).stopped;
        } catch (const InputError& error) {
            refusal = error.what();
        }
        CAPTURE(old, refusal);
        CHECK(refusal.find("p.csv:82: axis x goes to 40.5") != std::string::npos);
    }
}
