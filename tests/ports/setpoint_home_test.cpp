// SPDX-License-Identifier: MIT
// Drives that follow target positions find their references one after the other, and the others are heard meanwhile.
#include "ports/setpoint_plant.hpp"
#include "support/catch.hpp"

#include <algorithm>

namespace host = splinefeed::host;
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
    plant.open({.orders = {.home = true}});
    const std::uint64_t begun_us = plant.clock.now_us();
    CHECK_FALSE(plant.port->prepare(motion.segments.front()));
    CHECK(plant.clock.now_us() - begun_us > 3 * 200'000U); // each took longer than the watchdog's time
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(plant.port->report(i).reading.state != DriveState::fault);
    }
}

TEST_CASE("Set-point port, virtual: a drive whose profile has no home keeps only its own axis from homing", "[ports]") {
    DriveProfile without; // of a drive that the plant has
    SetpointPlant plant({});
    without = plant.profile;
    without.commands[static_cast<std::size_t>(DriveCommand::home)].clear();
    plant.wirings[1].profile = &without;
    const bool all = GENERATE(false, true);
    plant.make({.orders = {.home = true, .home_axes = all ? 7U : 5U}});
    REQUIRE_FALSE(plant.port->open());
    const PortFailure failure = plant.port->prepare(motion.segments.front());
    CHECK(failure.what == (all ? "its profile has no home command; home it by its own means" : ""));
    CHECK(failure.drive == (all ? 1U : 0U));
}

TEST_CASE(
    "Set-point port, virtual: homing of a drive that knows no stop ends by its power, or is said not to be confirmed",
    "[ports]") {
    const bool none = GENERATE(false, true);
    static bool asked_to_stop = false;
    asked_to_stop = false;
    SetpointPlantParameters parameters{.profile = "leadshine-pr", .start_counts = 60'000.0}; // 3 s
    parameters.change_drives = [none](DriveProfile& profile) {
        profile.commands[static_cast<std::size_t>(DriveCommand::quick_stop)].clear();
        profile.commands[static_cast<std::size_t>(DriveCommand::halt)].clear();
        none ? profile.commands[static_cast<std::size_t>(DriveCommand::disable)].clear() : void();
    };
    SetpointPlant plant(parameters);
    plant.open({.orders = {.home = true}, .interrupted = [] {
                    return asked_to_stop;
                }});
    plant.each_ms = [&] {
        asked_to_stop = asked_to_stop || std::fabs(plant.drives[1]->axis().reference().velocity_counts_s()) > 15'000.0;
    };
    CHECK(plant.port->prepare(motion.segments.front()).what.find("interrupted") == 0);
    const std::uint64_t ended_us = plant.clock.now_us();
    const StopReport stopped = plant.port->stop_report(1);
    CHECK(stopped.request == StopRequest::disable);
    CHECK((stopped.state == StopState::confirmed) != none);
    plant.port.reset();
    plant.clock.sleep_us(500'000);
    CHECK((plant.moved_us[1] <= ended_us) != none);
}

TEST_CASE("Set-point port, virtual: drives are switched off where a set-up fails, too", "[ports]") {
    SetpointPlant plant({});
    plant.open();
    plant.drives[2]->axis().trip(host::AxisFault::following_error);
    const PortFailure failure = plant.port->prepare(motion.segments.front());
    CHECK(failure.what.find("it is in fault, code 34321;") == 0);
    CHECK(failure.remedy == Remedy::reset);
    CHECK(failure.drive == 2);
    CHECK(plant.drives[0]->axis().power() == host::AxisPower::on);
    plant.port->power_off();
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(plant.port->stop_report(i).state == StopState::confirmed);
        CHECK(plant.drives[i]->axis().power() != host::AxisPower::on);
    }
}

TEST_CASE("Set-point port, virtual: silent for 0.15 s from any request of the set-up on, it is made ready or all stand",
          "[ports]") {
    for (const char* const profile : {"cia402-index", "leadshine-pr"}) {
        std::uint64_t requests = 1;
        bool begun = false;
        for (std::uint64_t at = 1; at <= requests; at += 1 + requests / 40) {
            INFO(profile << ", silent from request " << at << " of " << requests);
            SetpointPlant plant({.profile = profile, .one_wire = true, .start_counts = 8'000.0});
            plant.make({.orders = {.home = true}});
            plant.sample_positions();
            plant.wires[0]->silences.emplace_back(at, 150'000);
            const bool opened = !plant.port->open();
            const bool ready = opened && !plant.port->prepare(motion.segments.front());
            const std::uint64_t ended_us = plant.clock.now_us();
            requests = std::max(requests, plant.wires[0]->requests);
            if (!opened) {
                continue; // nothing was begun
            }
            begun = true;
            for (std::size_t i = 0; i < 3; ++i) {
                CHECK((ready || plant.port->stop_report(i).state == StopState::confirmed));
            }
            plant.port.reset();
            plant.clock.sleep_us(300'000);
            for (const std::uint64_t moved_us : plant.moved_us) {
                CHECK(moved_us <= ended_us);
            }
        }
        CHECK(begun);
    }
}
