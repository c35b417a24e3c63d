// SPDX-License-Identifier: MIT
#include "host_sim/curve/bezier_source.hpp"

#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

TEMPLATE_TEST_CASE("Bezier segments go out as they stand", "", double, float, Fixed) {
    using S = TestType;
    const CurveFile file = parse_curve(R"({"segments": [
        {"control_points": [[100, 1], [101, 3], [103, 2.5]]},
        {"control_points": [[103, 2.5], [103, 2.5]]},
        {"control_points": [[103.0000005, 2.5], [110, 2.5]]}]})",
                                       "c.json");
    BezierSource<S> source(file, 3);
    CurveSegment<S> segment;
    REQUIRE(source.next(segment) == Pull::item);
    CHECK(segment.axes == 3);
    CHECK(segment.degree == 2);
    CHECK(segment.control_mm(0, 1) == Approx(101.0).epsilon(1e-9));
    CHECK(segment.control_mm(1, 2) == Approx(2.5).epsilon(1e-9));
    CHECK(segment.control_mm(2, 1) == 0.0);
    CHECK(to_mm(segment.end[0]) == 103.0);
    const Position joint = segment.end[0];
    REQUIRE(source.next(segment) == Pull::item); // the one without a move is left out
    CHECK(segment.waypoint == 2);
    CHECK(segment.degree == 1);
    CHECK(segment.origin[0] == joint); // the gap is closed
    CHECK(segment.control_mm(0, 1) == Approx(110.0).epsilon(1e-7));
    CHECK(to_mm(segment.end[0]) == 110.0);
    CHECK(source.next(segment) == Pull::finished);
    CHECK(source.next(segment) == Pull::finished);
}
