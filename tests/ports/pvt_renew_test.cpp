// SPDX-License-Identifier: MIT
// One motion of a ModbusPort behind the other, as a machine that is served has them.
#include "ports/pvt_plant.hpp"
#include "ports/run_plant.hpp"

using namespace splinefeed;
using namespace splinefeed::hal;
using namespace splinefeed_test;

namespace {

constexpr int segments_a_leg = 150;
const SmoothMotion out_and_back = smooth_motion(20000.0, 2, segments_a_leg, 2000);

class Motions {
public:
    Motions() { plant.begin(out_and_back); }

    /// The same way from where the drives stand.
    SmoothMotion from_here() {
        SmoothMotion motion = out_and_back;
        for (FeedSegment& segment : motion.segments) {
            for (unsigned k = 0; k < plant.drives.size(); ++k) {
                segment.start[k] += places()[k] * units_per_count;
                segment.end[k] += places()[k] * units_per_count;
            }
        }
        return motion;
    }
    std::vector<std::int64_t> places() {
        std::vector<std::int64_t> out;
        for (std::size_t i = 0; i < plant.drives.size(); ++i) {
            out.push_back(plant.port->report(i).status.position[0]);
        }
        return out;
    }
    PortPhase go(const SmoothMotion& motion, const Asked& asked = {}) {
        plant.next = 0;
        plant.began_us = plant.clock.now_us();
        return run(plant, motion, asked);
    }

    PvtPlant plant{{}};
};

} // namespace

TEST_CASE("PVT port, virtual: behind an end the next motion follows, numbered on", "[ports]") {
    Motions motions;
    for (std::size_t count = 1; count <= 3; ++count) {
        REQUIRE(motions.go(out_and_back) == PortPhase::idle);
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(motions.plant.executed_once(i) == count * 2 * segments_a_leg);
        }
        CHECK(motions.places() == std::vector<std::int64_t>(3, 0));
        REQUIRE_FALSE(motions.plant.port->renew(out_and_back.segments.front()));
        CHECK(motions.plant.port->poll().phase == PortPhase::running); // it waits, and watches the drives
    }
}

TEST_CASE("PVT port, virtual: behind a hold and a quick stop the next motion begins where the drives stand",
          "[ports]") {
    Motions motions;
    SmoothMotion motion = out_and_back;
    for (const bool quick : {false, true, false}) {
        const std::uint64_t when_us = 400'000;
        REQUIRE(motions.go(motion, {.hold_us = when_us, .quick_us = quick ? when_us : UINT64_MAX}) ==
                PortPhase::halted);
        const std::vector<std::int64_t> stood = motions.places();
        CHECK(stood[0] > 1000);
        motion = motions.from_here();
        REQUIRE_FALSE(motions.plant.port->renew(motion.segments.front()));
        for (auto& executed : motions.plant.executed) {
            executed.clear(); // another session
        }
        REQUIRE(motions.go(motion) == PortPhase::idle);
        CHECK(motions.places() == stood);
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(motions.plant.executed_once(i) == 2 * segments_a_leg);
        }
        REQUIRE_FALSE(motions.plant.port->renew(motion.segments.front()));
        for (auto& executed : motions.plant.executed) {
            executed.clear();
        }
    }
}

TEST_CASE("PVT port, virtual: a port whose drive was away is opened and prepared again", "[ports]") {
    Motions motions;
    PvtPlant& plant = motions.plant;
    plant.wires[1]->unplugged.push_back({plant.began_us + 450'000, plant.began_us + 8'000'000});
    REQUIRE(motions.go(out_and_back) == PortPhase::fault);
    plant.clock.sleep_us(10'000'000);
    plant.port->close();
    REQUIRE_FALSE(plant.port->open());
    REQUIRE_FALSE(plant.port->await_standstill());
    const SmoothMotion motion = motions.from_here();
    REQUIRE_FALSE(plant.port->prepare(motion.segments.front()));
    const std::vector<std::int64_t> stood = motions.places();
    CHECK(motions.go(motion) == PortPhase::idle);
    CHECK(motions.places() == stood);
}
