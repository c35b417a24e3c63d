// SPDX-License-Identifier: MIT
#include "host_sim/planning/path_limits.hpp"

#include "host_sim/config/machine_file.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

// A parabola in x from 0 over `middle` to 0: it reaches half of that. y stays at `y`.
CurveSegment<double> parabola(double middle, double y) {
    CurveSegment<double> segment;
    segment.axes = 3;
    segment.degree = 2;
    segment.origin[1] = position_from_mm(y);
    PerAxis<PerDegree<double>> offsets{};
    offsets[0][1] = middle * 4096.0;
    segment.assign(offsets);
    return segment;
}

} // namespace

TEST_CASE("What counts is how far the curve goes, not its control points") {
    MachineDescription machine = default_machine();
    machine.travel[0] = host::Travel{-10.0, 50.0};
    const PathLimits limits(machine);
    CHECK_FALSE(limits.violation(parabola(20.0, 0.0)));
    CHECK_FALSE(limits.violation(parabola(99.999, 0.0)));
    CHECK_FALSE(limits.violation(parabola(100.0, 0.0))); // on the limit
    const auto above = limits.violation(parabola(100.001, 0.0));
    REQUIRE(above);
    CHECK(above->find("axis x goes to 50.0005") != std::string::npos);
    CHECK(above->find("[-10, 50]") != std::string::npos);
    CHECK(limits.violation(parabola(-20.001, 0.0)));
    CHECK_FALSE(limits.violation(parabola(1.0, 1000.0)));
}

TEST_CASE("A box is within with its margin, or not") {
    MachineDescription machine = default_machine();
    machine.travel[0] = host::Travel{-10.0, 50.0};
    const PathLimits limits(machine);
    CHECK(limits.contain({-10.0, -900.0, 0.0}, {50.0, 900.0, 0.0}, 0.0));
    CHECK(limits.contain({-9.9, 0.0, 0.0}, {49.9, 0.0, 0.0}, 0.1));
    CHECK_FALSE(limits.contain({-9.9, 0.0, 0.0}, {40.0, 0.0, 0.0}, 0.11));
    CHECK_FALSE(limits.contain({0.0, 0.0, 0.0}, {50.001, 0.0, 0.0}, 0.0));
}

TEST_CASE("Without travel the counts are the limit") {
    MachineDescription machine = default_machine();
    machine.settings.axis[1].steps_per_mm = 1e6;
    const PathLimits limits(machine);
    CHECK_FALSE(limits.violation(parabola(1.0, 2147.0)));
    const auto violation = limits.violation(parabola(1.0, 2148.0));
    REQUIRE(violation);
    CHECK(violation->find("2147483647 counts") != std::string::npos);
}
