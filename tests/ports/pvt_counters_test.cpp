// SPDX-License-Identifier: MIT
// Counters of the map splinefeed-pvt that wrap on the way: sequence numbers of 32 bits, command counters and nonces
// of 16.
#include "ports/pvt_plant.hpp"
#include "ports/run_plant.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::hal;
using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;

namespace {

const SmoothMotion motion = smooth_motion(20000.0, 2, 150, 2000);

/// As if somebody had spoken with the drive for long: its next nonce and command counter are near their end.
void age(host::PvtDrive& drive, std::uint16_t nonce, std::uint16_t counter) {
    PvtBlockRegisters registers{};
    const PvtBlock block{.nonce = nonce, .session = 7, .command = PvtCommand::disable, .command_counter = counter};
    const std::size_t size = encode(block, {}, drive.axes(), registers);
    REQUIRE(drive.write(pvt::block_address, std::span(registers).first(size)) == host::ModbusException::none);
    std::array<std::uint16_t, pvt::status_registers(max_axes)> raw{};
    const std::span<std::uint16_t> status(raw.data(), pvt::status_registers(drive.axes()));
    REQUIRE(drive.read(pvt::status_address, status) == host::ModbusException::none);
    REQUIRE(decode_status(status, drive.axes()).last_command == counter);
}

} // namespace

TEST_CASE("PVT port, virtual: sequence numbers wrap on the way, and nothing is lost or repeated", "[ports]") {
    for (const std::uint32_t before : {1U, 60U, 150U, 299U}) {
        for (const bool away : {false, true}) {
            INFO(before << " segments before the wrap" << (away ? ", one drive away on the way" : ""));
            PvtPlant plant({.clock_ppm = {150.0, -150.0, 0.0}});
            if (away) { // longer than what the others have
                plant.wires[1]->unplugged.push_back({plant.clock.now_us() + 250'000, plant.clock.now_us() + 1'100'000});
            }
            ModbusPortSettings settings;
            settings.first_sequence = 0U - before;
            plant.begin(motion, settings);
            CHECK(run(plant, motion, {}) == PortPhase::idle);
            CHECK(plant.port->poll().executed == motion.segments.size());
            CHECK((plant.port->resumes() > 0) == away);
            for (std::size_t i = 0; i < 3; ++i) {
                CHECK(plant.executed_once(i) == motion.segments.size());
                CHECK(plant.port->report(i).counts.segments == motion.segments.size());
            }
            CHECK(plant.off_path_counts < motion.fastest_counts_s * 0.0004);
            plant.port->close();
        }
    }
}

TEST_CASE("PVT port, virtual: command counters and nonces wrap on the way", "[ports]") {
    for (const unsigned left : {0U, 1U, 2U, 3U, 4U}) {
        INFO(left << " commands before the wrap");
        PvtPlant plant({});
        for (host::PvtDrive* drive : plant.drives) {
            age(*drive, static_cast<std::uint16_t>(0xFFFFU - left), static_cast<std::uint16_t>(0xFFFFU - left));
        }
        plant.begin(motion);
        CHECK(run(plant, motion, {}) == PortPhase::idle);
        CHECK(plant.port->resumes() == 0);
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(plant.executed_once(i) == motion.segments.size());
        }
        plant.port->close();
    }
}

TEST_CASE("PVT port, virtual: what a segment cannot carry stops all on the path before it", "[ports]") {
    PvtPlant plant({});
    plant.begin(motion);
    ModbusPort& port = *plant.port;
    std::size_t next = 0;
    PortPhase phase = PortPhase::running;
    bool refused = false;
    while (phase == PortPhase::running && plant.clock.now_us() < 20'000'000 + plant.began_us) {
        while (!refused && port.room() > 0) {
            FeedSegment segment = motion.segments[next];
            segment.end_velocity[1] = next == 250 ? units_per_count * (1 << 23) : segment.end_velocity[1];
            refused = !port.submit(segment);
            next += refused ? 0 : 1;
        }
        phase = port.poll().phase;
        plant.clock.sleep_us(1000);
    }
    CHECK(next == 250);
    CHECK(phase == PortPhase::fault);
    REQUIRE(port.failure());
    CHECK(names(port.failure(), DriveProblem::range));
    CHECK(port.failure().drive == 1);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(port.stop_report(i).held());
    }
    CHECK(plant.off_path_counts < motion.fastest_counts_s * 0.0004);
    port.close();
}
