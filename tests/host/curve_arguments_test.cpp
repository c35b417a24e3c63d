// SPDX-License-Identifier: MIT
#include "host_sim/curve/curve_arguments.hpp"

#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

TEST_CASE("Curve options have defaults that depend on the method") {
    const CurveChoice usual = choose_curve({});
    CHECK(usual.method == "g2");
    CHECK(usual.parameterization == Parameterization::chordal);
    CHECK(usual.corner_angle_deg == 60.0);
    CurveArguments rom;
    rom.method = "catmull-rom";
    CHECK(choose_curve(rom).parameterization == Parameterization::centripetal);
    CHECK(choose_curve(rom).tension == 0.5);
    CHECK(choose_curve(rom).method == "catmull-rom");
}

TEST_CASE("Each method that --curve may name is chosen by its name") {
    const std::vector<std::string_view> names = curve_names();
    CHECK(names.size() >= 9);
    for (const std::string_view name : names) {
        CurveArguments arguments;
        arguments.method = name;
        CHECK(choose_curve(arguments).method == name);
    }
    CHECK(passes_waypoints("g2"));
    CHECK(passes_waypoints("bezier"));
    CHECK_FALSE(passes_waypoints("bspline"));
    CHECK_FALSE(passes_waypoints("beta-chain"));
}

TEST_CASE("Curve options are read") {
    CurveArguments arguments;
    arguments.parameterization = "uniform";
    arguments.corner_angle = "45";
    arguments.start_tangent = "1,-2.5";
    const CurveChoice choice = choose_curve(arguments);
    CHECK(choice.parameterization == Parameterization::uniform);
    CHECK(choice.corner_angle_deg == 45.0);
    REQUIRE(choice.start_tangent);
    CHECK(choice.start_tangent->components == 2);
    CHECK(choice.start_tangent->value[1] == -2.5);
    CHECK(first_option(arguments) == "--parameterization");
    CHECK(first_option(CurveArguments{}).empty());
}

TEST_CASE("A tolerance goes with polylines") {
    CurveArguments arguments;
    arguments.tolerance = "0.05";
    CHECK(first_option(arguments).empty()); // a file of elements takes it, too
    arguments.method = "polyline";
    CHECK(choose_curve(arguments).tolerance_mm == 0.05);
    arguments.closed = true;
    arguments.tolerance = "0";
    CHECK(choose_curve(arguments).tolerance_mm == 0.0);
}
