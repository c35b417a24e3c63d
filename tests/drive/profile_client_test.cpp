// SPDX-License-Identifier: MIT
// Commands and readings by the profile, against the models: what a client on a bus does, without the bus.
#include "host_sim/config/shipped_profiles.hpp"
#include "host_sim/drive/profile_drive.hpp"
#include "splinefeed/hal/modbus/setpoint/command_sequence.hpp"
#include "splinefeed/hal/modbus/setpoint/status_frames.hpp"
#include "support/catch.hpp"

using namespace splinefeed::hal::modbus;
using namespace splinefeed::host;

namespace {

/// A drive and its client: it writes frames and reads what the profile says must be read.
class Client {
public:
    explicit Client(const std::string& name)
        : profile(find_profile(name)), frames(profile), sequence(profile, frames), status(profile), drive(profile, {}) {
    }

    void command(DriveCommand wanted) {
        REQUIRE(sequence.begin(wanted));
        while (!sequence.finished()) {
            now_us = std::max(now_us + 1000, sequence.due_us());
            drive.advance(now_us);
            const RegisterWrite& write = sequence.next();
            REQUIRE(drive.write(write.address, write.registers()) == ModbusException::none);
            sequence.on_sent(now_us);
        }
    }
    void wait_ms(std::uint64_t duration_ms) { drive.advance(now_us += 1000 * duration_ms); }
    void move(double target, double velocity) {
        frames.set(FieldRole::target_position, std::llround(target * 65536.0));
        frames.set(FieldRole::profile_velocity, std::llround(velocity * 65536.0));
        frames.set(FieldRole::profile_acceleration, std::int64_t{1000000} << 16);
        frames.set(FieldRole::profile_deceleration, std::int64_t{1000000} << 16);
        for (const RegisterWrite& write : frames.build()) {
            REQUIRE(drive.write(write.address, write.registers()) == ModbusException::none);
        }
    }
    DriveReading read() {
        for (std::size_t i = 0; i < status.reads().size(); ++i) {
            std::vector<std::uint16_t> registers(status.reads()[i].count);
            REQUIRE(drive.read(status.reads()[i].address, registers) == ModbusException::none);
            status.take(i, registers);
        }
        return status.reading();
    }

    DriveProfile profile;
    SetpointFrames frames;
    CommandSequence sequence;
    StatusFrames status;
    ProfileDrive drive;
    std::uint64_t now_us = 0;
};

} // namespace

TEST_CASE("A client by the profile: enable, move, stop, fault, reset; each drive says the same in its own way") {
    for (const std::string name : {"cia402-kinco", "leadshine-pr", "oriental-az", "lexium32m"}) {
        CAPTURE(name);
        Client client(name);
        if (client.profile.stream_mode) {
            const FieldIndex mode = client.profile.index_of("mode");
            const RegisterWrite write = client.frames.single(mode, *client.profile.stream_mode);
            REQUIRE(client.drive.write(write.address, write.registers()) == ModbusException::none);
        }
        client.command(DriveCommand::enable);
        CHECK(client.read().state == DriveState::enabled);
        CHECK(client.read().done);
        client.move(3000.0, 30000.0);
        client.wait_ms(50);
        CHECK(client.read().state == DriveState::moving);
        CHECK_FALSE(client.read().done);
        client.wait_ms(500);
        CHECK(client.read().state == DriveState::enabled);
        CHECK(client.read().done);
        CHECK(client.read().position_q16 == std::int64_t{3000} << 16);
        client.move(-1e6, 30000.0);
        client.wait_ms(100);
        client.command(DriveCommand::quick_stop);
        client.wait_ms(100);
        CHECK_FALSE(client.drive.axis().moving());
        client.drive.axis().trip(AxisFault::following_error);
        CHECK(client.read().state == DriveState::fault);
        CHECK((client.read().fault_code != 0) == (client.profile.field_of(FieldRole::fault_code) != nullptr));
        client.command(DriveCommand::fault_reset);
        client.command(DriveCommand::enable);
        CHECK(client.read().state == DriveState::enabled);
        client.move(500.0, 30000.0);
        client.wait_ms(1000);
        CHECK(client.read().position_q16 == std::int64_t{500} << 16);
    }
}

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
