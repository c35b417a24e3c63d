// SPDX-License-Identifier: MIT
#include "host_sim/drive/pvt_axis.hpp"
#include "support/catch.hpp"

using namespace splinefeed::host;

TEST_CASE("PVT axis: the fastest of a reference, whatever its direction", "[drive][pvt_axis]") {
    PvtReference reference;
    reference.counts = {5.0, -7.0};
    CHECK(reference.rests());
    CHECK(reference.fastest() == 0);
    reference.counts_s = {3.0, -4.0};
    CHECK_FALSE(reference.rests());
    CHECK(reference.fastest() == 1);
    reference.counts_s = {-4.0, 4.0};
    CHECK(reference.fastest() == 0);
}
