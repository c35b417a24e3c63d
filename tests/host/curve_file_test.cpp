// SPDX-License-Identifier: MIT
#include "host_sim/curve/curve_file.hpp"

#include "support/catch.hpp"

#include <nlohmann/json.hpp>

using namespace splinefeed;
using namespace splinefeed::host;

TEST_CASE("A curve file holds Bezier segments") {
    const CurveFile file = parse_curve(R"({"curve": "g2", "closed": true, "segments": [
        {"degree": 1, "control_points": [[0, 0], [10, 5]]},
        {"control_points": [[10, 5], [10, 0], [0, "-1.5e0"], [0, 0]], "note": 1}]})",
                                       "c.json");
    CHECK(file.method == "bezier");
    CHECK(file.closed);
    CHECK(file.axes == 2);
    REQUIRE(file.segments.size() == 2);
    CHECK(file.segments[1].degree == 3);
    CHECK(file.segments[1].first_point == 2);
    CHECK(file.at(4, 1) == -1.5);
    CHECK(parse_curve(R"({"method": "bezier", "input": {"segments": [{"control_points": [[0], [1]]}]}})", "c.json")
              .axes == 1);
}

TEST_CASE("A description names a method and its points") {
    const CurveFile file = parse_curve(
        R"({"id": "p1", "method": "catmull_rom", "input": {"closed": false, "tension": "0.25", "points": [[0, 0, 1], ["1e1", 2, 3]]}})",
        "c.json");
    CHECK(file.method == "catmull-rom");
    CHECK(file.described);
    REQUIRE(file.segments.size() == 1);
    CHECK(file.axes == 3);
    CHECK(file.at(1, 0) == Approx(10.0 / 12.0));
    CHECK(file.at(3, 0) == 10.0);
    CHECK(file.results->at("tangents")[0][0] == 2.5);
}
