// SPDX-License-Identifier: MIT
#include "host_sim/drive/pvt_axis.hpp"
#include "support/catch.hpp"

using namespace splinefeed::host;
using splinefeed::hal::modbus::PvtFault;

TEST_CASE("PVT axis: its window, and on the path its limits, in both directions", "[drive][pvt_axis]") {
    PvtAxisParameters axis;
    axis.largest_counts_s = 1000.0;
    axis.largest_counts_s2 = 5000.0;
    for (const double sign : {1.0, -1.0}) {
        CAPTURE(sign);
        CHECK(fault_of(axis, {3.0 * sign, 1000.0 * sign, 5000.0 * sign, true}, 3.0) == PvtFault::none);
        CHECK(fault_of(axis, {3.1 * sign, 0.0, 0.0, true}, 3.0) == PvtFault::following_error);
        CHECK(fault_of(axis, {3.1 * sign, 0.0, 0.0, false}, 3.0) == PvtFault::following_error);
        CHECK(fault_of(axis, {0.0, 1000.1 * sign, 0.0, true}, 3.0) == PvtFault::limit);
        CHECK(fault_of(axis, {0.0, 0.0, 5000.1 * sign, true}, 3.0) == PvtFault::limit);
        CHECK(fault_of(axis, {0.0, 2000.0 * sign, 9000.0 * sign, false}, 3.0) == PvtFault::none);
        CHECK(fault_of(axis, {3.1 * sign, 2000.0 * sign, 0.0, true}, 3.0) == PvtFault::following_error);
    }
    // What positions rounded to the map's units do to a speed and an acceleration is none of the axis's doing.
    CHECK(fault_of(axis, {0.0, 1000.0005, 5000.002, true}, 0.0) == PvtFault::none);
}

TEST_CASE("PVT axis: no window and no limits are none", "[drive][pvt_axis]") {
    PvtAxisParameters axis;
    CHECK(fault_of(axis, {1e9, 1e9, 1e12, true}, 0.0) == PvtFault::none);
    axis.largest_counts_s = 1.0;
    CHECK(fault_of(axis, {0.0, 1.0, 1e12, true}, 0.0) == PvtFault::none);
    axis.largest_counts_s = 0.0;
    axis.largest_counts_s2 = 1.0;
    CHECK(fault_of(axis, {0.0, 1e12, 1.0, true}, 0.0) == PvtFault::none);
}

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
