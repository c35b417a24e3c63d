// SPDX-License-Identifier: MIT
#include "host_sim/drive/pvt_schedule.hpp"
#include "support/catch.hpp"

using namespace splinefeed::host;

TEST_CASE("PVT schedule: time goes on to the next that is due, never behind the limit", "[drive][pvt_schedule]") {
    PvtSchedule schedule;
    CHECK(schedule.next_us(0, 0, 5000) == 5000);
    schedule.start_at(3000);
    schedule.hold_at(2000);
    CHECK(schedule.next_us(0, 0, 5000) == 2000);
    CHECK(schedule.next_us(0, 0, 1000) == 1000);
    CHECK(schedule.next_us(2000, 0, 5000) == 3000); // what is due now is not ahead
    CHECK(schedule.next_us(3000, 0, 5000) == 5000);
    CHECK(schedule.next_us(0, 1, 5000) == 1000);
    schedule.feed(500);
    CHECK(schedule.next_us(500, 1, 5000) == 1500);
    CHECK(schedule.next_us(1500, 1, 5000) == 2000);
}
