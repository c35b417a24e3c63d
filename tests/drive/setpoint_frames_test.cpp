// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/setpoint_frames.hpp"

#include "host_sim/config/shipped_profiles.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::hal::modbus;

TEST_CASE("Target frames: one frame for a group, only what changed without, and a start once") {
    const DriveProfile kinco = host::find_profile("cia402-kinco");
    SetpointFrames frames(kinco);
    frames.set(FieldRole::profile_velocity, std::int64_t{125} << 16);
    frames.set(FieldRole::target_position, std::int64_t{0x12345} << 16);
    std::span<const RegisterWrite> writes = frames.build();
    REQUIRE(writes.size() == 6); // speed, both ramps, target, two steps of the start
    CHECK(writes[0].address == 0x4A00);
    CHECK(writes[0].values[0] == 2048);
    CHECK(writes[3].address == 0x4000);
    CHECK(writes[3].count == 2);
    CHECK(writes[3].values[0] == 0x2345);
    CHECK(writes[3].values[1] == 0x0001);
    CHECK(writes[4].values[0] == 0x002F);
    CHECK(writes[5].values[0] == 0x103F);
    CHECK(frames.build().size() == 1); // the target alone
    frames.forget();                   // some of them were lost, nobody knows which
    CHECK(frames.build().size() == 6);
    CHECK(frames.build().size() == 1);

    const DriveProfile lexium = host::find_profile("lexium32m");
    SetpointFrames group(lexium);
    CHECK(group.build().size() == 1);
    writes = group.build();
    CHECK(writes[0].count == 13);
    CHECK(writes[0].values[0] == 0x0200);
    CHECK(writes[0].values[4] == 0x0001);
    CHECK(group.build()[0].values[4] == 0x0081); // toggled
}
