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

TEST_CASE("Set-point port, virtual: a hold at any time is confirmed, and nothing moves behind it", "[ports]") {
    for (const char* const profile : setpoint_profiles) {
        for (std::uint64_t hold_us = 0; hold_us < 700'000; hold_us += 47'000) {
            INFO(profile << ", hold at " << hold_us << " us");
            SetpointPlant plant({.profile = profile});
            prepare(plant);
            CHECK(run(plant, motion, {.hold_us = hold_us}) == PortPhase::halted);
            for (std::size_t i = 0; i < 3; ++i) {
                CHECK(plant.port->stop_report(i).held());
            }
            CHECK(plant.clock.now_us() < plant.began_us + hold_us + 800'000);
            CHECK(plant.now_off_counts < 12.0);
            check_stands_since(plant, plant.clock.now_us());
        }
    }
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

TEST_CASE("Set-point port, virtual: a quick stop reaches every drive, on one wire as on several", "[ports]") {
    for (const char* const profile : setpoint_profiles) {
        for (const bool one_wire : {false, true}) {
            for (std::uint64_t quick_us = 20'000; quick_us < 700'000; quick_us += 83'000) {
                INFO(profile << ", quick stop at " << quick_us << " us, one wire " << one_wire);
                SetpointPlant plant({.profile = profile, .one_wire = one_wire});
                prepare(plant);
                CHECK(run(plant, motion, {.hold_us = quick_us - 20'000, .quick_us = quick_us}) == PortPhase::halted);
                for (std::size_t i = 0; i < 3; ++i) {
                    CHECK(plant.port->stop_report(i).request == StopRequest::quick_stop);
                    CHECK(plant.port->stop_report(i).state == StopState::confirmed);
                }
                CHECK(plant.clock.now_us() < plant.began_us + quick_us + 500'000);
                check_stands_since(plant, plant.clock.now_us());
            }
        }
    }
}

TEST_CASE("Set-point port, virtual: a quick stop is sent again where the line is away", "[ports]") {
    for (const char* const profile : setpoint_profiles) {
        INFO(profile);
        SetpointPlant plant({.profile = profile, .one_wire = true});
        prepare(plant);
        plant.wires[0]->unplugged.push_back({plant.began_us + 290'000, plant.began_us + 600'000});
        CHECK(run(plant, motion, {.quick_us = 300'000}) == PortPhase::halted);
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(plant.port->stop_report(i).state == StopState::confirmed);
        }
        check_stands_since(plant, plant.clock.now_us());
    }
}

TEST_CASE("Set-point port, virtual: a dead drive is unconfirmed, the others stop; in bounded time", "[ports]") {
    for (const char* const profile : setpoint_profiles) {
        for (const bool quick : {false, true}) {
            INFO(profile << ", quick " << quick);
            SetpointPlant plant({.profile = profile, .one_wire = true});
            prepare(plant);
            plant.stations[1]->mute.push_back({plant.began_us + 300'000, UINT64_MAX});
            const Asked asked = quick ? Asked{.quick_us = 300'000} : Asked{.hold_us = 300'000};
            CHECK(run(plant, motion, asked) == PortPhase::halted);
            CHECK(plant.clock.now_us() < plant.began_us + 300'000 + plant.port->longest_stop_us() + 5000);
            CHECK(plant.port->stop_report(0).state == StopState::confirmed);
            CHECK(plant.port->stop_report(1).state == StopState::unconfirmed);
            CHECK(plant.port->stop_report(2).state == StopState::confirmed);
            CHECK_FALSE(plant.port->stop_report(0).held());
        }
    }
}

TEST_CASE("Set-point port, virtual: drives are switched off at the end, and one that does not confirm it is told",
          "[ports]") {
    for (const char* const profile : setpoint_profiles) {
        for (const bool deaf : {false, true}) {
            INFO(profile << ", deaf " << deaf);
            SetpointPlant plant({.profile = profile});
            prepare(plant);
            CHECK(run(plant, motion, {}) == PortPhase::idle);
            const std::uint64_t asked_us = plant.clock.now_us();
            if (deaf) {
                plant.stations[1]->mute.push_back({asked_us, UINT64_MAX});
            }
            plant.port->power_off();
            CHECK(plant.clock.now_us() < asked_us + plant.port->longest_stop_us() + 5000);
            for (std::size_t i = 0; i < 3; ++i) {
                const bool on = deaf && i == 1;
                CHECK(plant.port->stop_report(i).request == StopRequest::disable);
                CHECK((plant.port->stop_report(i).state == StopState::confirmed) != on);
                CHECK((plant.drives[i]->axis().power() == splinefeed::host::AxisPower::off) != on);
            }
        }
    }
}

TEST_CASE("Set-point port, virtual: one drive stops for itself, and all stop", "[ports]") {
    for (const char* const profile : setpoint_profiles) {
        INFO(profile);
        SetpointPlant plant({.profile = profile});
        prepare(plant);
        const std::uint64_t trips_us = plant.began_us + 250'000;
        plant.events.emplace_back(trips_us, [&] { plant.drives[2]->stop_by_itself(); });
        CHECK(run(plant, motion, {}) == PortPhase::fault);
        INFO(plant.port->failure().what);
        CHECK(plant.port->failure().drive == 2);
        CHECK(plant.clock.now_us() < trips_us + 1'000'000);
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(plant.port->stop_report(i).state == StopState::confirmed);
        }
        check_stands_since(plant, plant.clock.now_us());
    }
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
