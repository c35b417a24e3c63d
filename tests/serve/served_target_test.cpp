// SPDX-License-Identifier: MIT
//
// A ServedTarget on a target that says what it was told: which motions it gets, what stops them, and what follows.
#include "host_sim/serve/served_target.hpp"

#include "support/catch.hpp"
#include "talking_drives.hpp"

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

TEST_CASE_METHOD(ServedDrives, "lines that come at a motion's end are the next motion, and nothing is lost",
                 "[serve]") {
    drives->frozen = true;
    move(0, 1);
    REQUIRE(is_told("complete"));
    move(1, 2);
    move(2, 3);
    wait_a_bit();
    drives->frozen = false;
    REQUIRE(stands());
    CHECK(drives->told() ==
          Told{"prepare at 0", "0 to 1", "complete", "renew at 1", "1 to 2", "2 to 3", "complete", "renew at 3"});
    CHECK(x_mm() == 3.0);
}

TEST_CASE_METHOD(ServedDrives, "a stop at a motion's end stops the next one, too", "[serve]") {
    const bool before = GENERATE(true, false);
    drives->obeys = !before; // nothing is left to be stopped
    drives->renewed = [&] {
        static_cast<void>(before || machine->halt());
    };
    drives->frozen = true;
    move(0, 1);
    REQUIRE(is_told("complete"));
    move(1, 2);
    if (before) {
        CHECK(machine->halt());
        REQUIRE(is_told("halt"));
    }
    drives->frozen = false;
    REQUIRE(stands());
    CHECK_FALSE(drives->was_told("1 to 2"));
    CHECK(x_mm() == 1.0);
    drives->renewed = [] {
    };
    move(1, 2);
    REQUIRE(stands());
    CHECK(x_mm() == 2.0);
}

TEST_CASE_METHOD(ServedDrives, "a motion begins only where the drives stand", "[serve]") {
    move(5, 6);
    REQUIRE(alarms(Alarm::drive_fault));
    CHECK(alarm_sentence() == "axis x stands elsewhere than where the motion begins: reset");
    CHECK_FALSE(drives->was_told("prepare at 5"));
}

TEST_CASE_METHOD(ServedDrives, "the drives become at the end what the machine file says", "[serve]") {
    move(0, 1);
    REQUIRE(stands());
    drives->unfinished = "a drive did not confirm that it is off";
    CHECK(machine->finish() == "a drive did not confirm that it is off");
    CHECK(drives->was_told("finish"));
}

TEST_CASE_METHOD(ServedDrives, "outputs behind segments that were dropped stay as they are, and the coolant ends",
                 "[serve]") {
    obey(EventKind::output_on_with_motion);
    move(0, 1);
    obey(EventKind::flood_on);
    REQUIRE(stands());
    REQUIRE(comes([this] { return machine->read().spindle_ready; }));
    CHECK(switched() == Kinds{EventKind::output_on_with_motion, EventKind::flood_on});
    drives->frozen = true;
    move(1, 2);
    for (const EventKind kind : {EventKind::output_off_with_motion, EventKind::output_on, EventKind::coolant_off}) {
        obey(kind);
    }
    REQUIRE(is_told("1 to 2"));
    CHECK(machine->halt());
    REQUIRE(stands());
    REQUIRE(comes([this] { return machine->read().spindle_ready; }));
    CHECK(switched() == Kinds{EventKind::output_on_with_motion, EventKind::flood_on, EventKind::coolant_off});
}

TEST_CASE_METHOD(ServedDrives, "behind a quick stop the spindle takes orders again", "[serve]") {
    drives->frozen = true;
    move(0, 1);
    REQUIRE(is_told("0 to 1"));
    machine->quick_stop();
    REQUIRE(stands());
    CHECK(outputs_made() == 2);
    obey(EventKind::spindle_clockwise, 100);
    CHECK(comes([this] { return machine->read().spindle_ready; }));
    CHECK(spindle().rpm == 100.0);
}

TEST_CASE_METHOD(ServedDrives, "a spindle that does not answer is an alarm, whether anything has moved or not",
                 "[serve]") {
    const bool moved = GENERATE(false, true);
    if (moved) {
        move(0, 1);
        REQUIRE(stands());
    }
    spindle().fails = true;
    obey(EventKind::spindle_clockwise, 100);
    REQUIRE(alarms(Alarm::spindle_speed));
    CHECK(alarm_sentence() == "it is silent");
    SECTION("a reset connects to it anew, as often as it takes") {
        refuses_outputs(true);
        machine->reset_faults();
        REQUIRE(alarms(Alarm::drive_fault));
        CHECK(alarm_sentence() == "no answer");
        refuses_outputs(false);
        machine->reset_faults();
        REQUIRE(stands());
        CHECK(machine->read().alarm == Alarm::none);
        obey(EventKind::spindle_clockwise, 100);
        CHECK(comes([this] { return machine->read().spindle_ready; }));
        CHECK(spindle().rpm == 100.0);
    }
}

TEST_CASE_METHOD(ServedDrives, "homing is given up, whenever that comes, and the machine may move behind it",
                 "[serve]") {
    drives->searches = true;
    const bool begun = GENERATE(false, true);
    machine->home(7);
    if (begun) {
        REQUIRE(is_told("prepare at 0, homes 7"));
    }
    machine->quick_stop();
    REQUIRE(comes([this] { return machine->read().homing == HomingPhase::failed; }));
    REQUIRE(stands());
    CHECK(machine->read().alarm == Alarm::none);
    CHECK(machine->read().known != begun);
    move(0, 1);
    REQUIRE(stands());
    CHECK(machine->read().alarm == Alarm::none);
    CHECK(x_mm() == 1.0);
}

TEST_CASE_METHOD(ServedDrives, "drives that are made ready for a motion are given up, and it is forgotten", "[serve]") {
    drives->searches = true; // for ever
    drives->waits = true;
    move(0, 1);
    REQUIRE(is_told("prepare at 0"));
    machine->quick_stop();
    REQUIRE(stands());
    CHECK(machine->read().alarm == Alarm::none);
    CHECK_FALSE(drives->was_told("0 to 1"));
}

TEST_CASE_METHOD(UnknownDrives, "an axis that was homed is known, and no other one", "[serve]") {
    CHECK_FALSE(machine->read().known);
    machine->home(1);
    REQUIRE(comes([this] { return machine->read().homing == HomingPhase::done; }));
    CHECK_FALSE(machine->read().known);
    CHECK(machine->places()[0].mm == 0.0);
    CHECK_FALSE(machine->places()[1].mm.has_value());
    machine->home(6);
    REQUIRE(comes([this] { return machine->read().homing == HomingPhase::done; }));
    CHECK(machine->read().known);
}

TEST_CASE_METHOD(UnknownDrives, "what moves when the operator has unlocked it stands where the path says", "[serve]") {
    move(0, 1);
    REQUIRE(stands());
    CHECK(machine->read().known);
    CHECK(machine->places()[1].mm == 0.0);
}

TEST_CASE_METHOD(ServedDrives, "a reset wakes drives up that sleep, and ends their fault", "[serve]") {
    drives->faulted = true;
    drives->frozen = true;
    move(0, 1);
    REQUIRE(alarms(Alarm::drive_fault));
    machine->enable(false);
    REQUIRE(stands());
    CHECK(machine->read().alarm == Alarm::drive_fault);
    machine->enable(true);
    machine->reset_faults();
    REQUIRE(stands());
    CHECK(machine->read().alarm == Alarm::none);
    CHECK(drives->was_told("prepare at 0, resets"));
}

TEST_CASE_METHOD(TalkingFeed, "a hold that does not end becomes a quick stop, and then nobody waits any more",
                 "[serve]") {
    CHECK(ends_by(1).why == "interrupted, but not every drive has confirmed that it stands");
    CHECK(drives.told() == Told{"0 to 1", "halt", "quick stop"});
    CHECK(feed.outputs_ended());
}
