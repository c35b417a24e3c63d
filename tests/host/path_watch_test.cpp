// SPDX-License-Identifier: MIT
//
// What of a curve reaches the machine, and what those that look at it see.
#include "host_sim/run/path_watch.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/config/machine_file.hpp"
#include "host_sim/planning/path_curve.hpp"
#include "host_sim/planning/scalar_path.hpp"
#include "support/catch.hpp"
#include "temporary_folder.hpp"

#include <fstream>

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

/// A polyline from a file, and a machine whose x goes to 50 mm.
struct Teed {
    explicit Teed(const std::string& rows) {
        arguments.input = folder.file("p.csv");
        arguments.curve.method = "polyline";
        std::ofstream(arguments.input) << rows;
        machine.travel[0] = host::Travel{-10.0, 50.0};
    }
    /// The waypoints of the segments that were passed on, until there is none any more.
    std::vector<std::uint32_t> passed(const PathObservers& observers) {
        PathInput input(arguments, PathUse::executed, {.axes = {"x", "y", "z"}});
        PathWatch watch(arguments.input, observers);
        ScalarPath<double> path(input, nullptr, watch, {});
        PathTee<double>& tee = path.tee();
        std::vector<std::uint32_t> waypoints;
        CurveSegment<double> segment;
        for (;;) {
            const Pull pull = tee.next(segment);
            if (pull == Pull::item) {
                waypoints.push_back(segment.waypoint);
            } else if (pull == Pull::finished) {
                break;
            } else {
                PathFeeder::Pushed pushed;
                static_cast<void>(path.feeder().more(pushed));
            }
        }
        CHECK(tee.next(segment) == Pull::finished);
        CHECK(tee.segments() == waypoints.size());
        failure.clear();
        if (tee.failure()) {
            try {
                std::rethrow_exception(tee.failure());
            } catch (const InputError& error) {
                failure = error.what();
            }
        }
        return waypoints;
    }

    TemporaryFolder folder;
    PathArguments arguments;
    MachineDescription machine = default_machine();
    std::string failure;
};

} // namespace

TEST_CASE("a curve is passed on with the rows of its waypoints, whoever looks at it", "[path_watch]") {
    Teed teed("x,y,z,feed\n0,0,0,\n10,0,0,5\n20,10,0,\n30,10,0,8\n");
    const std::vector<std::uint32_t> rows{1, 2, 3};
    CHECK(teed.passed({}) == rows);
    const PathLimits limits(teed.machine);
    OptimumTime optimum(teed.machine.settings, 1e-3);
    LimitShare share(teed.machine.settings);
    CHECK(teed.passed({.limits = &limits, .optimum = &optimum, .share = &share}) == rows);
    optimum.finish();
    CHECK(optimum.seconds() > 10.0 / 5.0 + 10.0 / 8.0);
    CHECK(teed.failure.empty());
}

TEST_CASE("a curve ends before the segment that leaves the limits, with the line of its waypoint", "[path_watch]") {
    Teed teed("0,0,0\n40,0,0\n60,0,0\n20,0,0\n");
    const PathLimits limits(teed.machine);
    CHECK(teed.passed({.limits = &limits}) == std::vector<std::uint32_t>{1});
    CAPTURE(teed.failure);
    CHECK(teed.failure.find("p.csv:3: ") != std::string::npos);
    CHECK(teed.failure.find("axis x") != std::string::npos);
    CHECK(teed.passed({}) == std::vector<std::uint32_t>{1, 2, 3}); // without limits it is no matter
}
