// SPDX-License-Identifier: MIT
// StepPort on a virtual clock: disable(), and lines that cannot be set.
#include "port_rig.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

TEST_CASE_METHOD(PlainRig, "a port that was disabled enables nothing, before and after", "[stopping]") {
    SECTION("before the start") {
        port.disable();
        CHECK(port.start().empty());
        CHECK(lines.rows().empty());
    }
    SECTION("while the drives settle") {
        static_cast<void>(port.start());
        CHECK(lines.enabled());
        port.disable();
        clock.sleep_us(1000); // of the 5 ms that they take
    }
    SECTION("at rest, with the drives on, and started again") {
        static_cast<void>(port.start());
        CHECK(lines.enabled());
        port.complete();
        clock.sleep_us(10'000);
        CHECK(port.poll().phase == hal::PortPhase::idle);
        port.disable();
        clock.sleep_us(1000);
        CHECK_FALSE(lines.enabled());
        port.close();
        port.reset();
        const std::size_t rows = lines.rows().size();
        static_cast<void>(port.start());
        CHECK(lines.rows().size() == rows);
    }
    CHECK(port.poll().phase == hal::PortPhase::fault);
    CHECK_FALSE(port.submit({}));
    CHECK_FALSE(lines.enabled());
    port.close();
}

TEST_CASE_METHOD(PlainRig, "a line that cannot be set leaves no drive on, as soon as that can be", "[stopping]") {
    static_cast<void>(port.start());
    CHECK(lines.enabled());
    hal::StraightMotion motion(machine.settings, {}, {10.0, 0.0}, 50.0);
    FeedSegment segment;
    while (motion.next(segment) && port.room() > 0) {
        REQUIRE(port.submit(segment));
    }
    clock.sleep_us(40'000);
    lines.fail(true);
    clock.sleep_us(20'000);
    CHECK(port.poll().phase == hal::PortPhase::fault);
    CHECK(port.may_be_on());
    lines.fail(false);
    clock.sleep_us(2000);
    CHECK_FALSE(port.may_be_on());
    CHECK_FALSE(lines.enabled());
    port.close();
}
