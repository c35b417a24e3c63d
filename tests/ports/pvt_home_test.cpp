// SPDX-License-Identifier: MIT
// Before a motion of drives that interpolate: homing that ends early, faults that are reset, another program's drives,
// and when a position is known.
#include "ports/pvt_plant.hpp"
#include "ports/run_plant.hpp"
#include "support/catch.hpp"

using namespace splinefeed::hal;
using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;

namespace {

const SmoothMotion motion = smooth_motion(20000.0, 1, 150, 2000);

VirtualClock* user_clock = nullptr;
std::uint64_t interrupts_us = UINT64_MAX; // when the user presses Ctrl-C

bool interrupted() {
    return user_clock->now_us() >= interrupts_us;
}

/// Three drives that home for ten seconds.
struct Homing {
    explicit Homing(double stop_counts_s2) : plant(parameters(stop_counts_s2)) {
        user_clock = &plant.clock;
        interrupts_us = UINT64_MAX;
        plant.open({.orders = {.home = true}, .interrupted = &interrupted});
        began_us = plant.clock.now_us();
    }
    static PvtPlantParameters parameters(double stop_counts_s2) {
        PvtPlantParameters out;
        out.drive.axes.resize(1);
        out.drive.axes[0].start_counts = 500'000.0;
        out.drive.axes[0].stop_counts_s2 = stop_counts_s2;
        return out;
    }
    PortFailure prepare() {
        const auto failure = plant.port->prepare(motion.segments.front());
        ended_us = plant.clock.now_us();
        return failure;
    }
    void check_all_stand() {
        CHECK_FALSE(plant.port->known_position(0, 0));
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(plant.port->stop_report(i).state == StopState::confirmed);
        }
        check_stands_since(plant, ended_us);
    }

    PvtPlant plant;
    std::uint64_t began_us = 0;
    std::uint64_t ended_us = 0;
};

} // namespace

TEST_CASE("PVT port, virtual: homing that the user ends stops every drive, with ramps of any length", "[ports]") {
    for (const double stop_counts_s2 : {2e6, 5e4, 5e3}) { // 25 ms, 1 s and 10 s
        INFO(stop_counts_s2);
        Homing homing(stop_counts_s2);
        interrupts_us = homing.began_us + 3'000'000;
        const auto failure = homing.prepare();
        REQUIRE(failure);
        CHECK(names(failure, DriveProblem::interrupted));
        homing.check_all_stand();
    }
}

TEST_CASE("PVT port, virtual: homing that the user ends stops every drive behind an earlier end, too", "[ports]") {
    Homing homing(2e6);
    for (int search = 0; search < 3; ++search) { // the second one begins in phase fault
        interrupts_us = homing.plant.clock.now_us() + 1'000'000;
        REQUIRE(homing.prepare());
        homing.plant.clock.sleep_us(1'000'000);
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(homing.plant.port->stop_report(i).state == StopState::confirmed);
            CHECK(homing.plant.moved_us[i] > interrupts_us - 10'000);
            CHECK(homing.plant.moved_us[i] <= homing.ended_us);
        }
        homing.plant.port->close();
        REQUIRE_FALSE(homing.plant.port->open());
    }
}

TEST_CASE("PVT port, virtual: a stop of homing is repeated while a drive is silent", "[ports]") {
    Homing homing(2e6);
    interrupts_us = homing.began_us + 3'000'000;
    homing.plant.stations[1]->mute.push_back({interrupts_us - 20'000, interrupts_us + 400'000});
    REQUIRE(homing.prepare());
    homing.check_all_stand();
}

TEST_CASE("PVT port, virtual: a drive that dies while it homes stops the others, and is said to be unconfirmed",
          "[ports]") {
    Homing homing(2e6);
    const std::uint64_t dies_us = homing.began_us + 3'000'000;
    homing.plant.stations[1]->mute.push_back({dies_us, UINT64_MAX});
    const auto failure = homing.prepare();
    REQUIRE(failure);
    CHECK(failure.drive == 1);
    CHECK(names(failure, DriveProblem::silent));
    CHECK(homing.ended_us < dies_us + 5'000'000);
    CHECK(homing.plant.port->stop_report(1).state == StopState::unconfirmed);
    CHECK(homing.plant.port->stop_report(0).state == StopState::confirmed);
    CHECK(homing.plant.port->stop_report(2).state == StopState::confirmed);
    CHECK(homing.plant.moved_us[0] < dies_us + 1'500'000);
    homing.plant.port.reset();
}

TEST_CASE("PVT port, virtual: a fault is reset where that is asked for, and told where it is not", "[ports]") {
    for (const bool reset : {false, true}) {
        for (const bool stays : {false, true}) {
            INFO("reset " << reset << ", its cause stays " << stays);
            PvtPlant plant({});
            ModbusPortSettings settings;
            settings.orders.reset = reset;
            plant.open(settings);
            auto& machine = plant.drives[1]->machine();
            REQUIRE(machine.execute(PvtCommand::enable, 0) == PvtRefusal::none);
            machine.configure({.following_window = 1});
            machine.shaft(0).disturb(1e7);
            plant.clock.sleep_us(20'000);
            REQUIRE(machine.state() == PvtState::fault);
            machine.shaft(0).disturb(stays ? 1e7 : 0.0);
            const auto failure = plant.port->prepare(motion.segments.front());
            CHECK(bool(failure) == (!reset || stays));
            if (failure) {
                CHECK(failure.drive == 1);
                CHECK(names(failure, DriveProblem::fault));
            }
            plant.events.clear();
            plant.port.reset();
        }
    }
}

TEST_CASE("PVT port, virtual: a drive that another program uses is refused at once, and its motion goes on",
          "[ports]") {
    PvtPlant plant({});
    plant.open();
    CHECK_FALSE(plant.port->known_position(0, 0));
    REQUIRE_FALSE(plant.port->prepare(motion.segments.front()));
    CHECK(plant.port->known_position(0, 0) == 0);
    plant.began_us = plant.clock.now_us();
    ModbusPortSettings settings;
    settings.make_line = plant.make_line();
    settings.clock = &plant.clock;
    PortFailure second;
    std::uint64_t took_us = 0;
    const auto other = plant.clock.start([&] {
        plant.clock.sleep_us(150'000);
        const std::uint64_t began_us = plant.clock.now_us();
        ModbusPort port(plant.wirings, settings);
        second = port.open();
        took_us = plant.clock.now_us() - began_us;
    });
    CHECK(run(plant, motion, {}) == PortPhase::idle);
    other->join();
    REQUIRE(second);
    CHECK(names(second, DriveProblem::busy));
    CHECK(took_us < 500'000);
    CHECK(plant.port->resumes() == 0);
    CHECK(plant.executed_once(0) == motion.segments.size());
    plant.port.reset();
}

TEST_CASE("PVT port, virtual: a position is not known behind a power cycle", "[ports]") {
    PvtPlant plant({});
    plant.begin(motion);
    plant.events.emplace_back(plant.began_us + 300'000, [&] { plant.drives[1]->power_cycle(); });
    CHECK(run(plant, motion, {}) == PortPhase::fault);
    CHECK(names(plant.port->failure(), DriveProblem::power_cycled));
    CHECK(plant.port->known_position(0, 0));
    CHECK_FALSE(plant.port->known_position(1, 0));
    plant.events.clear();
    plant.port.reset();
}

TEST_CASE("PVT port, virtual: a shaft that dithers beyond its window stands by its drive's word", "[ports]") {
    PvtPlant plant({});
    plant.begin(motion);
    plant.liars[1]->lie = [](PvtStatus& status) {
        status.position[0] += status.nonce % 2 == 0 ? 3 : -3;
    };
    CHECK(run(plant, motion, {.hold_us = 200'000}) == PortPhase::halted);
    CHECK(plant.port->stop_report(1).request == StopRequest::hold);
    CHECK(plant.port->stop_report(1).state == StopState::confirmed);
    CHECK(plant.drives[1]->machine().state() == PvtState::held);
    plant.port.reset();
}

TEST_CASE("PVT port, virtual: a serial line that is quicker than its rate carries a run", "[ports]") {
    for (const double pace : {0.0, 0.3, 1.0}) {
        INFO("frames take " << pace << " of their time");
        PvtPlant plant({.axes = {1}, .wire = Wire::rtu});
        plant.wires[0]->pace = pace;
        const SmoothMotion slow = smooth_motion(20000.0, 1, 60, 10'000);
        plant.begin(slow);
        CHECK(run(plant, slow, {}) == PortPhase::idle);
        CHECK(plant.executed_once(0) == slow.segments.size());
        plant.port.reset();
    }
}
