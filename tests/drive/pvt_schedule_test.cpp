// SPDX-License-Identifier: MIT
#include "host_sim/drive/pvt_schedule.hpp"
#include "support/catch.hpp"

using namespace splinefeed::host;

TEST_CASE("PVT schedule: what is due is taken once, at its time or behind it", "[drive][pvt_schedule]") {
    PvtSchedule schedule;
    CHECK_FALSE(schedule.start_waits());
    CHECK_FALSE(schedule.take_start(0));
    CHECK_FALSE(schedule.take_hold(0));
    schedule.start_at(100);
    schedule.hold_at(200);
    CHECK(schedule.start_waits());
    CHECK_FALSE(schedule.take_start(99));
    CHECK(schedule.start_waits());
    CHECK(schedule.take_start(100));
    CHECK_FALSE(schedule.start_waits());
    CHECK_FALSE(schedule.take_start(1000));
    CHECK_FALSE(schedule.take_hold(199));
    CHECK(schedule.take_hold(250));
    CHECK_FALSE(schedule.take_hold(251));
}

TEST_CASE("PVT schedule: called off or replaced, it does not come", "[drive][pvt_schedule]") {
    PvtSchedule schedule;
    schedule.start_at(100);
    schedule.hold_at(100);
    schedule.start_at(300);
    CHECK_FALSE(schedule.take_start(299));
    schedule.call_off_hold();
    CHECK_FALSE(schedule.take_hold(1000));
    CHECK(schedule.start_waits());
    schedule.call_off_start();
    CHECK_FALSE(schedule.start_waits());
    CHECK_FALSE(schedule.take_start(1000));
}

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

TEST_CASE("PVT schedule: the watchdog waits anew with everything that comes", "[drive][pvt_schedule]") {
    PvtSchedule schedule;
    CHECK_FALSE(schedule.starves(1'000'000, 0));
    CHECK_FALSE(schedule.starves(49'999, 50));
    CHECK(schedule.starves(50'000, 50));
    schedule.feed(50'000);
    CHECK_FALSE(schedule.starves(50'000, 50));
    CHECK_FALSE(schedule.starves(99'999, 50));
    CHECK(schedule.starves(100'000, 50));
    CHECK(schedule.starves(100'000 + 65'535'000, 65535));
}
