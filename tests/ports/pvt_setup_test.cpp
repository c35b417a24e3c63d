// SPDX-License-Identifier: MIT
// What is wrong with a drive while it is made ready is what the failure says, at whatever instant it begins.
#include "ports/pvt_plant.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

using namespace splinefeed::hal;
using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;

namespace {

struct Prepared {
    PortFailure failure;
    std::uint64_t took_us = 0;
};

/// @param what  happens to the second of three drives at an instant behind open() [us]
Prepared prepare(std::uint64_t seed, std::uint64_t at_us, double lost,
                 void (*what)(splinefeed::host::PvtDrive& drive)) {
    PvtPlantParameters parameters;
    parameters.seed = seed;
    PvtPlant plant(parameters);
    plant.open();
    const SmoothMotion motion = smooth_motion(10000.0, 1, 40, 10'000);
    plant.wires[1]->faults = {.lost_request = lost, .lost_answer = lost};
    const std::uint64_t opened_us = plant.clock.now_us();
    plant.events.emplace_back(opened_us + at_us, [&plant, what] { what(*plant.drives[1]); });
    Prepared out{plant.port->prepare(motion.segments.front())};
    out.took_us = plant.clock.now_us() - opened_us;
    plant.port.reset();
    plant.events.clear();
    return out;
}

} // namespace

TEST_CASE("PVT setup: words that are swapped while drives are made ready are what the failure names", "[ports]") {
    const std::uint64_t usual_us = prepare(1, UINT64_MAX / 2, 0.0, [](auto&) {}).took_us;
    REQUIRE(usual_us > 1000);
    int named = 0;
    for (std::uint64_t seed = first_round(); seed < static_cast<std::uint64_t>(rounds(60)); ++seed) {
        const std::uint64_t at_us = seed * usual_us / 60;
        const double lost = seed % 2 == 0 ? 0.0 : 0.3;
        const Prepared prepared =
            prepare(seed, at_us, lost, [](splinefeed::host::PvtDrive& drive) { drive.swap_words(); });
        CAPTURE(seed, at_us, lost, prepared.took_us);
        if (prepared.failure) { // else it was ready before
            CHECK(prepared.failure.drive == 1);
            CHECK(names(prepared.failure, DriveProblem::words_swapped));
            ++named;
        }
    }
    CHECK((named > 0 || first_round() > 0));
}
