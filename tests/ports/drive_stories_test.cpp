// SPDX-License-Identifier: MIT
//
// The stories of tests/live/shaft_stories.txt on simulated Modbus drives.
#include "live/shaft_teller.hpp"
#include "ports/drive_world.hpp"
#include "support/catch.hpp"

using namespace splinefeed_test;

TEST_CASE("stories of a machine on drives that interpolate", "[live]") {
    const bool serial = GENERATE(false, true);
    INFO("serial " << serial);
    tell_stories_of<PvtWorld>({"pvt", "homes"}, 2, serial);
}

TEST_CASE("stories of a machine on drives that follow target positions", "[live]") {
    const std::string profile = GENERATE(from_range(SetpointWorld::profiles));
    INFO(profile);
    const bool homes = !host::find_profile(profile).steps_of(hal::modbus::DriveCommand::home).empty();
    tell_stories_of<SetpointWorld>({"setpoint", homes ? "homes" : "homeless"}, 4, profile);
}
