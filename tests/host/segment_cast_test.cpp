// SPDX-License-Identifier: MIT
#include "host_sim/curve/segment_cast.hpp"

#include "support/catch.hpp"

using namespace splinefeed;
using splinefeed::host::in_double;

TEST_CASE("A segment in Fixed loses no digit in double") {
    CurveSegment<Fixed> segment;
    segment.axes = 2;
    segment.degree = 3;
    segment.unit_log2 = -7;
    segment.origin[1] = position_from_mm(-123.4);
    segment.end[0] = position_from_mm(5.6);
    segment.feed_mm_s = from_double<Fixed>(12.345);
    segment.max_feed_mm_s = from_double<Fixed>(9999.9);
    segment.stop_at_end = true;
    segment.waypoint = 0xfffffffe;
    for (unsigned i = 0; i <= 3; ++i) {
        segment.control[0][i] = Fixed::from_raw((std::int64_t{1} << 48) - 1 - i); // the largest ones
        segment.control[1][i] = Fixed::from_raw(-1 - static_cast<std::int64_t>(i));
    }
    const CurveSegment<double> seen = in_double(segment);
    CHECK(seen.axes == 2);
    CHECK(seen.degree == 3);
    CHECK(seen.origin == segment.origin);
    CHECK(seen.end == segment.end);
    CHECK(seen.stop_at_end);
    CHECK(seen.waypoint == 0xfffffffe);
    CHECK(from_double<Fixed>(seen.block_feed_mm_s()) == segment.block_feed_mm_s());
    for (int i = 0; i <= 3; ++i) {
        CHECK(from_double<Fixed>(seen.control[0][static_cast<unsigned>(i)]) ==
              segment.control[0][static_cast<unsigned>(i)]);
        CHECK(from_double<Fixed>(seen.control[1][static_cast<unsigned>(i)]) ==
              segment.control[1][static_cast<unsigned>(i)]);
        CHECK(seen.control_mm(0, i) == segment.control_mm(0, i));
        CHECK(seen.control_mm(1, i) == segment.control_mm(1, i));
    }
}
