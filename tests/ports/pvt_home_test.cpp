// SPDX-License-Identifier: MIT
// Drives that interpolate and that another program uses, whose shafts dither, and whose line is quick.
#include "ports/pvt_plant.hpp"
#include "ports/run_plant.hpp"
#include "support/catch.hpp"

using namespace splinefeed::hal;
using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;

namespace {

const SmoothMotion motion = smooth_motion(20000.0, 1, 150, 2000);

} // namespace

TEST_CASE("PVT port, virtual: a drive that another program uses is refused at once, and its motion goes on",
          "[ports]") {
    PvtPlant plant({});
    plant.open();
    CHECK_FALSE(plant.port->known_position(0, 0));
    REQUIRE_FALSE(plant.port->prepare(motion.segments.front()));
    CHECK(plant.port->known_position(0, 0) == 0);
    plant.began_us = plant.clock.now_us();
    ModbusPortSettings settings;
    settings.make_wire = plant.make_wire();
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
