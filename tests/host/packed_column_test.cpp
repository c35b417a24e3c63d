// SPDX-License-Identifier: MIT
#include "host_sim/report/packed_column.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;

TEST_CASE("a column is packed as differences in base64") {
    CHECK(packed_column({}).empty());
    CHECK(packed_column({0}) == "AA==");         // 0
    CHECK(packed_column({1, 0}) == "AgE=");      // +1: 2, -1: 1
    CHECK(packed_column({5, 5, 5}) == "CgAA");   // 10, 0, 0
    CHECK(packed_column({64}) == "gAE=");        // 128: two groups of seven bits
    CHECK(packed_column({-64, -128}) == "f38="); // 127 twice
    // All bits: the difference of the ends of the range of half the size.
    CHECK(packed_column({std::int64_t{1} << 40}).size() == 8);
}
