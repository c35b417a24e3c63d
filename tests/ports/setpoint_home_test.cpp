// SPDX-License-Identifier: MIT
// Drives that follow target positions find their references one after the other, and the others are heard meanwhile.
#include "ports/setpoint_plant.hpp"
#include "splinefeed/hal/modbus/profile/field_codec.hpp"
#include "support/catch.hpp"

using namespace splinefeed::hal;
using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;

namespace {

const SmoothMotion motion = smooth_motion(8000.0, 2, 100, 4000);

/// With a communication watchdog of 150 ms that is a fault: shorter than any drive takes to find its reference.
void watch(DriveProfile& profile) {
    RegisterField field;
    field.name = "watchdog";
    field.role = FieldRole::watchdog;
    field.address = 0x7000;
    field.unit = PhysicalUnit::ms;
    profile.fields.push_back(field);
    profile.watchdog_timeout_ms = 150;
    profile.watchdog_reaction = WatchdogReaction::fault;
}

} // namespace

TEST_CASE("Set-point port, virtual: no watchdog runs out while other drives are enabled and homed", "[ports]") {
    SetpointPlant plant({.change = watch});
    plant.make({.home = true});
    plant.sample_positions();
    REQUIRE(plant.port->open() == "");
    const std::uint64_t begun_us = plant.clock.now_us();
    CHECK(plant.port->prepare(motion.segments.front()) == "");
    CHECK(plant.clock.now_us() - begun_us > 3 * 200'000U); // each took longer than the watchdog's time
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(plant.port->report(i).reading.state != DriveState::fault);
    }
}

TEST_CASE("Set-point port, virtual: drives that were homed are in the mode again in which they are streamed to",
          "[ports]") {
    SetpointPlant plant({});
    REQUIRE(plant.profile.stream_mode.has_value());
    REQUIRE(plant.profile.homing_mode.has_value());
    REQUIRE(*plant.profile.stream_mode != *plant.profile.homing_mode);
    const RegisterField* const mode = plant.profile.field_of(FieldRole::mode);
    REQUIRE(mode != nullptr);
    plant.make({.home = true});
    plant.sample_positions();
    REQUIRE(plant.port->open() == "");
    REQUIRE(plant.port->prepare(motion.segments.front()) == "");
    for (splinefeed::host::ProfileDrive* const drive : plant.drives) {
        std::array<std::uint16_t, 4> registers{};
        const std::span<std::uint16_t> words = std::span(registers).first(mode->registers());
        REQUIRE(drive->read(mode->address, words) == splinefeed::host::ModbusException::none);
        CHECK(take_raw(*mode, words) == *plant.profile.stream_mode);
    }
}
