// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/setpoint_watch.hpp"
#include "support/catch.hpp"

using namespace splinefeed::hal::modbus;

TEST_CASE("Setpoint watch: a state that the profile does not know is trouble when it stays") {
    constexpr std::uint64_t away_us = 10'000'000;
    constexpr std::uint64_t start_us = 5'000'000;
    SetpointWatch watch;
    SetpointReport seen;
    const auto trouble_at = [&](std::uint64_t us, DriveState state) {
        seen.reading.state = state;
        seen.answered_us = seen.status_us = start_us + us;
        return !watch.trouble(seen, start_us + us, away_us, start_us).empty();
    };
    CHECK_FALSE(trouble_at(0, DriveState::moving));
    CHECK_FALSE(trouble_at(1'000, DriveState::unknown)); // on its way to another one
    CHECK_FALSE(trouble_at(200'000, DriveState::unknown));
    CHECK_FALSE(trouble_at(210'000, DriveState::enabled));
    CHECK_FALSE(trouble_at(220'000, DriveState::unknown)); // counted anew
    CHECK_FALSE(trouble_at(419'000, DriveState::unknown));
    CHECK(trouble_at(421'000, DriveState::unknown));
}

TEST_CASE("Setpoint watch: states in which a drive does not follow, and one that does not answer") {
    for (const DriveState state : {DriveState::fault, DriveState::disabled, DriveState::not_ready,
                                   DriveState::quick_stop, DriveState::halted, DriveState::homing}) {
        SetpointWatch watch;
        SetpointReport seen;
        seen.reading.state = state;
        seen.answered_us = seen.status_us = 1'000;
        CHECK(watch.trouble(seen, 1'000, 500, 0).empty()); // perhaps an answer to another request
        CHECK(watch.trouble(seen, 1'100, 500, 0).empty()); // the same reading
        seen.answered_us = seen.status_us = 1'200;
        CHECK_FALSE(watch.trouble(seen, 1'200, 500, 0).empty());
        seen.reading.state = DriveState::moving;
        CHECK(watch.trouble(seen, 1'200, 500, 0).empty());
    }
    SetpointWatch watch;
    SetpointReport seen;
    seen.reading.state = DriveState::moving;
    seen.answered_us = seen.status_us = 1'000;
    CHECK(watch.trouble(seen, 1'500, 500, 0).empty());
    CHECK_FALSE(watch.trouble(seen, 1'501, 500, 0).empty());
    CHECK(watch.trouble(seen, 2'000, 500, 1'600).empty()); // it is to follow since then
    seen.clamped = true;
    CHECK_FALSE(watch.trouble(seen, 1'500, 500, 0).empty());
}
