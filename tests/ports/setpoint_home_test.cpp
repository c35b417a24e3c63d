// SPDX-License-Identifier: MIT
// Drives that follow target positions find their references one after the other, and the others are heard meanwhile.
#include "ports/setpoint_plant.hpp"
#include "splinefeed/hal/modbus/profile/field_codec.hpp"
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

TEST_CASE("Set-point port, virtual: drives that were homed are in the mode again in which they are streamed to",
          "[ports]") {
    SetpointPlant plant({});
    REQUIRE(plant.profile.stream_mode.has_value());
    REQUIRE(plant.profile.homing_mode.has_value());
    REQUIRE(*plant.profile.stream_mode != *plant.profile.homing_mode);
    const RegisterField* const mode = plant.profile.field_of(FieldRole::mode);
    REQUIRE(mode != nullptr);
    plant.open({.orders = {.home = true}});
    REQUIRE_FALSE(plant.port->prepare(motion.segments.front()));
    for (host::ProfileDrive* const drive : plant.drives) {
        std::array<std::uint16_t, 4> registers{};
        const std::span<std::uint16_t> words = std::span(registers).first(mode->registers());
        REQUIRE(drive->read(mode->address, words) == host::ModbusException::none);
        CHECK(take_raw(*mode, words) == *plant.profile.stream_mode);
    }
}

namespace {

bool asked_to_stop = false;

struct HomingFault {
    const char* name;
    std::function<void(SetpointPlant&)> spoil; ///< drive 1 is on its way to its reference
    std::string trouble;                       ///< how it begins; empty: the set-up succeeds
    std::size_t with = 1;
    StopRequest request = StopRequest::quick_stop; ///< that drive 1 gets in the end
    bool confirmed = true;
    SetpointPlantParameters parameters{};
};

void mute(SetpointPlant& plant, std::size_t drive, std::uint64_t duration_us) {
    plant.stations[drive]->mute.push_back({plant.clock.now_us(), plant.clock.now_us() + duration_us});
}

void ask(SetpointPlant& /*plant*/) {
    asked_to_stop = true;
}

/// The drive does not know this command: it answers, and goes on.
void deafen(DriveProfile& profile, DriveCommand command) {
    profile.commands[static_cast<std::size_t>(command)].clear();
}

std::vector<HomingFault> homing_faults() {
    constexpr std::uint64_t for_ever_us = 1'000'000'000;
    const auto unknown_commands = [](std::initializer_list<DriveCommand> commands) {
        SetpointPlantParameters parameters{.profile = "leadshine-pr"};
        parameters.change_drives = [commands = std::vector(commands)](DriveProfile& profile) {
            std::for_each(commands.begin(), commands.end(), [&](DriveCommand command) { deafen(profile, command); });
        };
        return parameters;
    };
    return {
        {"silent for 0.15 s", [](auto& plant) { mute(plant, 1, 150'000); }, ""},
        {"Ctrl-C", ask, "interrupted during homing"},
        {"Ctrl-C while it is silent", [](auto& plant) { mute(plant, 1, 150'000), ask(plant); }, "interrupted"},
        {"silent for 0.7 s, Ctrl-C", [](auto& plant) { mute(plant, 1, 700'000), ask(plant); }, "interrupted"},
        {"silent for ever",
         [](auto& plant) { mute(plant, 1, for_ever_us); },
         "it does not answer",
         1,
         StopRequest::disable,
         false,
         {.start_counts = 300'000.0}},
        {"another drive fails", [](auto& plant) { plant.drives[2]->axis().trip(host::AxisFault::following_error); },
         "it is in fault", 2},
        {"another drive is silent",
         [](auto& plant) { mute(plant, 0, for_ever_us); },
         "it does not answer",
         0,
         StopRequest::quick_stop,
         true,
         {.start_counts = 300'000.0}},
        {"a slow quick stop", ask, "interrupted", 1, StopRequest::quick_stop, true, {.quick_stop_counts_s2 = 60'000.0}},
        {"a quick stop that takes too long",
         ask,
         "interrupted",
         1,
         StopRequest::disable,
         true,
         {.quick_stop_counts_s2 = 1'000.0}},
        {"a quick stop that is not known", ask, "interrupted", 1, StopRequest::disable, true,
         unknown_commands({DriveCommand::quick_stop, DriveCommand::halt})},
        {"no stop is known", ask, "interrupted", 1, StopRequest::disable, false,
         unknown_commands({DriveCommand::quick_stop, DriveCommand::halt, DriveCommand::disable})},
    };
}

} // namespace

TEST_CASE("Set-point port, virtual: whatever ends homing stops all drives, or says which did not confirm it",
          "[ports]") {
    for (const HomingFault& fault : homing_faults()) {
        INFO(fault.name);
        asked_to_stop = false;
        bool spoilt = false;
        SetpointPlantParameters parameters = fault.parameters;
        parameters.start_counts = parameters.start_counts == 0.0 ? 60'000.0 : parameters.start_counts; // 3 s
        SetpointPlant plant(parameters);
        plant.open({.orders = {.home = true}, .interrupted = [] {
                        return asked_to_stop;
                    }});
        plant.each_ms = [&] {
            if (!spoilt && plant.drives[1]->axis().homing()) {
                spoilt = std::fabs(plant.drives[1]->axis().reference().velocity_counts_s()) > 15'000.0;
                spoilt ? fault.spoil(plant) : void();
            }
        };
        const std::string trouble = plant.port->prepare(motion.segments.front()).what;
        const std::uint64_t ended_us = plant.clock.now_us();
        REQUIRE(spoilt);
        CHECK(trouble.substr(0, fault.trouble.size()) == fault.trouble);
        if (fault.trouble.empty()) {
            CHECK(trouble.empty());
            continue;
        }
        CHECK(plant.port->failure().drive == fault.with);
        CHECK(plant.port->poll().phase == PortPhase::fault);
        const StopReport stopped = plant.port->stop_report(1);
        CHECK(stopped.request == fault.request);
        CHECK((stopped.state == StopState::confirmed) == fault.confirmed);
        CHECK_FALSE(plant.port->position_counts(1).has_value()); // its reference is not known
        plant.port.reset();
        plant.clock.sleep_us(500'000);
        CHECK((plant.moved_us[1] <= ended_us) == fault.confirmed);
        CHECK(plant.moved_us[2] <= ended_us);
    }
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
