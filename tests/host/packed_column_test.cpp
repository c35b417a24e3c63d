// SPDX-License-Identifier: MIT
#include "host_sim/report/packed_column.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;

TEST_CASE("a column is packed as differences in base64") {
    CHECK(packed_column({}).empty());
    CHECK(packed_column({0}) == "AAA=");                                    // 0, and no more of them
    CHECK(packed_column({1, 0}) == "AgE=");                                 // +1: 2, -1: 1
    CHECK(packed_column({5, 5, 5}) == "CgAB");                              // 10, 0, one more
    CHECK(packed_column(std::vector<std::int64_t>(1000, 7)) == "DgDmBw=="); // 14, 0, 998 more
    CHECK(packed_column({64}) == "gAE=");                                   // 128: two groups of seven bits
    CHECK(packed_column({-64, -128}) == "f38=");                            // 127 twice
    // All bits: the difference of the ends of the range of half the size.
    CHECK(packed_column({std::int64_t{1} << 40}).size() == 8);
}
