// SPDX-License-Identifier: MIT
// Stops of drives that follow target positions, on a virtual clock.
#include "ports/run_plant.hpp"
#include "ports/setpoint_plant.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

using namespace splinefeed::hal;
using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;

namespace {

const SmoothMotion motion = smooth_motion(8000.0, 2, 100, 4000);

void prepare(SetpointPlant& plant) {
    plant.sample_positions();
    REQUIRE_FALSE(plant.begin(motion));
}

} // namespace

TEST_CASE("Set-point port, virtual: a whole motion near the path, with every profile", "[ports]") {
    for (const char* const profile : setpoint_profiles) {
        INFO(profile);
        SetpointPlant plant({.profile = profile});
        prepare(plant);
        CHECK(run(plant, motion, {}) == PortPhase::idle);
        CHECK(plant.port->resumes() == 0);
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(std::fabs(plant.positions[i]) < 1.5); // back where it began
        }
        INFO(plant.off_path_counts << " counts, period " << plant.port->period_us());
        CHECK(plant.off_path_counts > 0.0); // it is measured
        CHECK(plant.off_path_counts < motion.fastest_counts_s * 0.002);
        check_stands_since(plant, plant.clock.now_us());
    }
}

TEST_CASE("Set-point port, virtual: the longest stop has room for four answers that do not come", "[ports]") {
    const auto longest_us = [](std::uint32_t answer_us) {
        SetpointPlant plant({});
        REQUIRE_FALSE(plant.begin(motion, {.timing = {.answer_us = answer_us}}));
        return plant.port->longest_stop_us();
    };
    CHECK(longest_us(900'000) - longest_us(800'000) == 4 * 100'000); // slower than any drive of a profile
}

TEST_CASE("Set-point port, virtual: a drive that was away when the path stopped is confirmed when it has come to rest",
          "[ports]") {
    // It stands where it was, gets the target of the hold when it is back, and moves there: that it stood before says
    // nothing of that.
    int confirmed = 0;
    const std::uint64_t step_us = whole_sweep() ? 61'000 : 183'000; // 7 s with sanitizers for the finer one
    for (const char* const profile : setpoint_profiles) {
        for (std::uint64_t away_us = 100'000; away_us < 1'300'000; away_us += step_us) {
            for (const std::uint64_t from_us : {20'000U, 60'000U, 150'000U}) {
                SetpointPlant plant({.profile = profile, .one_wire = true});
                prepare(plant);
                plant.stations[2]->mute.push_back({plant.began_us + from_us, plant.began_us + from_us + away_us});
                INFO(profile << ", away from " << from_us << " us on for " << away_us << " us");
                CHECK(run(plant, motion, {.hold_us = 200'000}) != PortPhase::running);
                const std::uint64_t ended_us = plant.clock.now_us();
                if (plant.port->stop_report(2).state == StopState::confirmed) {
                    ++confirmed;
                    check_stands_since(plant, ended_us);
                }
            }
        }
    }
    CHECK(confirmed > (whole_sweep() ? 200 : 70));
}

TEST_CASE("Set-point port, virtual: after a long pause of the host a stop still sends what is due", "[ports]") {
    for (const char* const profile : {"cia402-index", "lexium32m"}) {
        INFO(profile);
        SetpointPlant plant({.profile = profile});
        REQUIRE_FALSE(plant.begin(motion));
        const std::uint64_t pause_us = plant.port->longest_stop_us() + 5'000'000;
        plant.stations[1]->mute.push_back({plant.began_us + 190'000, plant.began_us + 200'000 + pause_us});
        while (plant.clock.now_us() < plant.began_us + 200'000) {
            while (plant.next < motion.segments.size() && plant.port->room() > 0 &&
                   plant.port->submit(motion.segments[plant.next])) {
                ++plant.next;
            }
            static_cast<void>(plant.port->poll());
            plant.clock.sleep_us(1000);
        }
        plant.port->halt();
        plant.clock.sleep_us(pause_us); // nobody polls
        while (plant.port->poll().phase == PortPhase::running) {
            plant.clock.sleep_us(1000);
        }
        CHECK(plant.port->stop_report(1).request >= StopRequest::quick_stop);
        CHECK(plant.port->stop_report(1).state == StopState::confirmed);
    }
}
