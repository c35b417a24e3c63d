// SPDX-License-Identifier: MIT
// Room for segments: what the drive does not have yet is never overwritten, whatever ring, buffer and link.
#include "ports/pvt_plant.hpp"
#include "ports/run_plant.hpp"
#include "support/catch.hpp"

using namespace splinefeed::hal;
using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;

TEST_CASE("PVT port, virtual: rings beyond its queue and segments of 0.1 ms: a gap of the link moves no shaft abruptly",
          "[ports]") {
    for (const auto ring : std::array<std::uint16_t, 2>{4096, 65535}) {
        for (const std::uint32_t segment_us : {100U, 190U}) {
            INFO("ring of " << ring << ", segments of " << segment_us << " us");
            PvtPlantParameters parameters{.axes = {1}};
            parameters.drive.ring = ring;
            PvtPlant plant(parameters);
            ModbusPortSettings settings;
            settings.buffer_us = 900'000; // more than the queue holds
            const SmoothMotion motion = smooth_motion(20000.0, 1, static_cast<int>(2'000'000 / segment_us), segment_us);
            plant.begin(motion, settings);
            plant.most_step_counts = 0.0; // the position was preset
            plant.wires[0]->unplugged.push_back({plant.began_us + 1'500'000, plant.began_us + 1'850'000});
            CHECK(run(plant, motion, {}) == PortPhase::idle);
            CHECK(plant.executed_once(0) == motion.segments.size());
            CHECK(plant.most_step_counts < 1.2e-3 * motion.fastest_counts_s);
            plant.port.reset();
        }
    }
}

TEST_CASE("PVT client: a segment without room is not taken") {
    PvtPlant plant({.axes = {1}});
    SimulatedLink line(*plant.wires[0], plant.wirings[0].link, {}, plant.clock);
    PvtClient client(line, 1);
    for (std::size_t i = 0; i < PvtClient::queue_capacity; ++i) {
        CHECK(client.push({.duration_ticks = static_cast<std::uint32_t>(i)}));
    }
    CHECK_FALSE(client.push({.duration_ticks = 77}));
    CHECK(client.segment(0).duration_ticks == 0);
    CHECK(client.room() == 0);
}

TEST_CASE("PVT port, virtual: a segment that was submitted without room ends in a stop and a fault", "[ports]") {
    PvtPlantParameters parameters{.axes = {1}};
    parameters.drive.ring = 65535;
    PvtPlant plant(parameters);
    plant.make();
    plant.sample_positions();
    const SmoothMotion motion = smooth_motion(10000.0, 1, 5000, 100);
    REQUIRE_FALSE(plant.port->open());
    REQUIRE_FALSE(plant.port->prepare(motion.segments.front()));
    std::size_t taken = 0;
    while (taken < motion.segments.size() && plant.port->submit(motion.segments[taken])) {
        ++taken;
    }
    CHECK(taken == PvtClient::queue_capacity);
    REQUIRE(plant.port->failure());
    CHECK(names(plant.port->failure(), DriveProblem::overrun));
    plant.port.reset();
}

TEST_CASE("PVT port, virtual: a ring of less than 16 segments is refused before anything moves", "[ports]") {
    for (const auto ring : std::array<std::uint16_t, 4>{0, 1, 15, 16}) {
        PvtPlantParameters parameters{.axes = {1}};
        parameters.drive.ring = ring;
        PvtPlant plant(parameters);
        plant.make();
        CHECK(plant.port->open().what == (ring < 16 ? describe(DriveProblem::ring) : ""));
    }
}
