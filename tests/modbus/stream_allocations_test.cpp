// SPDX-License-Identifier: MIT
#include "drive/smooth_track.hpp"
#include "host_sim/config/shipped_profiles.hpp"
#include "splinefeed/hal/modbus/setpoint/block_stream.hpp"
#include "splinefeed/hal/modbus/setpoint/cyclic_stream.hpp"
#include "support/allocations.hpp"
#include "support/catch.hpp"

using namespace splinefeed::hal::modbus;
using splinefeed::host::find_profile;

TEST_CASE("Streams allocate when they are made, and never again") {
    TrajectoryBuffer track = splinefeed::test::Circle().track();
    const DriveProfile kinco = find_profile("cia402-kinco");
    const DriveProfile lexium = find_profile("lexium32m");
    const DriveProfile index = find_profile("cia402-index");
    BlockStream frames(kinco, {});
    BlockStream group(lexium, {});
    CyclicStream cyclic(index, {});
    const std::size_t before = splinefeed_test::allocations();
    frames.begin(0.0);
    group.begin(0.0);
    std::size_t writes = 0;
    for (std::uint64_t now_us = 0; now_us < 1'000'000; now_us += 10'000) {
        writes += frames.block(track, now_us).size() + group.block(track, now_us).size();
        writes += cyclic.frame(track, now_us).size();
        track.release(now_us);
    }
    const std::size_t after = splinefeed_test::allocations();
    CHECK(writes > 300);
    CHECK(after == before); // trivially under a sanitizer, which is not counted
}
