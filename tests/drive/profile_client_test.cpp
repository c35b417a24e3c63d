// SPDX-License-Identifier: MIT
// The frames of commands and readings, as a profile has them.
#include "host_sim/config/shipped_profiles.hpp"
#include "splinefeed/hal/modbus/setpoint/command_sequence.hpp"
#include "splinefeed/hal/modbus/setpoint/status_frames.hpp"
#include "support/catch.hpp"

using namespace splinefeed::hal::modbus;
using namespace splinefeed::host;

TEST_CASE("Command sequence: pulses last, edges have two frames, a quick stop goes ahead") {
    const DriveProfile oriental = find_profile("oriental-az");
    SetpointFrames frames(oriental);
    CommandSequence sequence(oriental, frames);
    CHECK(sequence.finished());
    CHECK_FALSE(sequence.begin(DriveCommand::resume));
    CHECK(sequence.finished());
    REQUIRE(sequence.begin(DriveCommand::fault_reset));
    CHECK(sequence.due_us() == 0);
    CHECK(sequence.next().address == 0x007C);
    CHECK(sequence.next().count == 2);
    CHECK(sequence.next().values[1] == 0x0080);
    sequence.on_sent(5000);
    CHECK_FALSE(sequence.finished());
    CHECK(sequence.due_us() == 25000);
    CHECK(sequence.next().values[1] == 0);
    REQUIRE(sequence.begin(DriveCommand::quick_stop)); // now
    CHECK(sequence.due_us() == 0);
    CHECK(sequence.next().values[1] == 0x0020);
    sequence.on_sent(6000);
    sequence.on_sent(30000);
    CHECK(sequence.finished());

    const DriveProfile lexium = find_profile("lexium32m");
    SetpointFrames group(lexium);
    CommandSequence edges(lexium, group);
    REQUIRE(edges.begin(DriveCommand::enable));
    CHECK(edges.next().count == 13);
    CHECK(edges.next().values[4] == 0x0001);
    edges.on_sent(1000);
    CHECK(edges.due_us() == 1000);
    CHECK(edges.next().values[4] == 0x0201);
    edges.on_sent(2000);
    CHECK(edges.due_us() == 12000);
    CHECK(edges.next().values[4] == 0x0001);
    edges.on_sent(12000);
    CHECK(edges.finished());
}

TEST_CASE("Status frames: one frame for a group, and one for each number beside it") {
    const auto reads = [](const char* name) {
        const DriveProfile profile = find_profile(name);
        const StatusFrames status(profile);
        std::vector<std::pair<int, std::size_t>> out;
        for (const RegisterRead& read : status.reads()) {
            out.emplace_back(read.address, read.count);
        }
        return out;
    };
    using Reads = std::vector<std::pair<int, std::size_t>>;
    CHECK(reads("lexium32m") == Reads{{0, 13}});
    CHECK(reads("oriental-az") == Reads{{0x007E, 4}, {0x0120, 2}});
    CHECK(reads("leadshine-pr") == Reads{{0x1003, 1}, {0x602C, 2}, {0x2203, 1}});
    CHECK(reads("cia402-kinco") == Reads{{0x3200, 1}, {0x3700, 2}});
}
