// SPDX-License-Identifier: MIT
// Stops of drives that interpolate, on a virtual clock.
#include "ports/pvt_plant.hpp"
#include "ports/run_plant.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

using namespace splinefeed::hal;
using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;

namespace {

const SmoothMotion motion = smooth_motion(20000.0, 2, 150, 2000);

} // namespace

TEST_CASE("PVT port, virtual: segments that are sent again are counted, of the drive that did not get them",
          "[ports]") {
    PvtPlant plant({});
    plant.begin(motion);
    plant.wires[1]->faults.lost_request = 0.2;
    CHECK(run(plant, motion, {}) == PortPhase::idle);
    CHECK(plant.port->report(0).counts.resent == 0);
    CHECK(plant.port->report(1).counts.resent > 0);
    CHECK(plant.port->report(1).counts.resent <= plant.port->report(1).counts.timeouts);
    CHECK(plant.executed_once(1) == motion.segments.size());
    plant.port->close();
}

TEST_CASE("PVT port, virtual: drives whose clocks differ stay in step for as long as the motion lasts", "[ports]") {
    // 200 ppm are 2 ms in ten seconds. What is in the rings at the start is not corrected, the rate of a clock is known
    // to some 50 ppm in the first seconds, and then a segment is corrected by up to 250 ppm: 0.42 ms, most of it early
    const SmoothMotion longer = smooth_motion(20000.0, 4, 1250, 2000);
    PvtPlant plant({.clock_ppm = {100.0, -100.0, 0.0}});
    plant.begin(longer);
    CHECK(run(plant, longer, {}) == PortPhase::idle);
    CHECK(plant.port->resumes() == 0);
    INFO(1e6 * plant.off_path_counts / longer.fastest_counts_s << " us of the largest speed");
    CHECK(plant.off_path_counts > 0.0); // it is measured
    CHECK(plant.off_path_counts < longer.fastest_counts_s * 700e-6);
    plant.port->close();
}

TEST_CASE("PVT port, virtual: a shaft that a load pushes while its stop is confirmed rests before it is confirmed",
          "[ports]") {
    // Two answers 20 ms apart, before the push and behind it, reported one position: it counted as standstill
    int pushed = 0;
    for (const std::uint32_t window_counts : {0U, 1U}) {     // without a fault, and with one of following error
        for (const std::uint64_t hold_us : {0U, 200'000U}) { // before the start, and in motion
            for (std::uint64_t push_us = 0; push_us < 60'000; push_us += splinefeed_test::sanitized ? 1500 : 500) {
                PvtPlant plant({});
                plant.begin(motion);
                const std::uint64_t from_us = plant.began_us + hold_us + (hold_us > 0 ? 250'000 : 0) + push_us;
                constexpr std::uint64_t long_us = 3000;
                auto& machine = plant.drives[1]->machine();
                plant.events.emplace_back(from_us, [&] {
                    PvtConfiguration configuration = machine.configuration();
                    configuration.following_window = window_counts;
                    machine.configure(configuration);
                    machine.shaft(0).disturb(1e7);
                });
                plant.events.emplace_back(from_us + long_us, [&] { machine.shaft(0).disturb(0.0); });
                INFO("window " << window_counts << ", hold at " << hold_us << ", pushed " << push_us << " us later");
                CHECK(run(plant, motion, {.hold_us = hold_us}) != PortPhase::running);
                const std::uint64_t halted_us = plant.clock.now_us();
                const StopReport report = plant.port->stop_report(1);
                CHECK(report.state == StopState::confirmed);
                if (from_us + long_us <= report.status_us) { // else nobody can know
                    ++pushed;
                    check_stands_since(plant, halted_us);
                }
            }
        }
    }
    CHECK(pushed > (splinefeed_test::sanitized ? 33 : 100));
}

TEST_CASE("PVT port, virtual: drives that ran before they could be told to cancel their start are not held on the path",
          "[ports]") {
    // Out of reach they begin at their start, run to the ends of their rings, and stand there. The `begin` that was to
    // cancel the start is accepted there, and makes `executed` what it was before.
    int ran = 0;
    for (const bool all : {false, true}) {
        for (std::uint64_t hold_us = 10'000; hold_us < 260'000; hold_us += 5000) {
            PvtPlant plant({.one_wire = all});
            plant.begin(motion);
            const Span away{plant.began_us + hold_us - 8000, plant.began_us + hold_us + 600'000};
            if (all) {
                plant.wires[0]->unplugged.push_back(away);
            } else {
                plant.stations[1]->frozen.push_back(away);
            }
            INFO("hold at " << hold_us << " us, all drives away: " << all);
            CHECK(run(plant, motion, {.hold_us = hold_us}) == PortPhase::halted);
            const double off_s = plant.now_off_counts / motion.fastest_counts_s;
            bool held = true;
            for (std::size_t i = 0; i < 3; ++i) {
                CHECK(plant.port->stop_report(i).state == StopState::confirmed);
                held = held && plant.port->stop_report(i).held();
            }
            CHECK((!held || off_s < 0.0004));
            ran += off_s > 0.0004 ? 1 : 0;
        }
    }
    CHECK(ran > 20);
}

TEST_CASE("PVT port, virtual: a drive that is not heard while it slows down is not waited for as one that brakes",
          "[ports]") {
    int braked = 0; // by its last word
    for (std::uint64_t after_us = 60'000; after_us < 300'000; after_us += 10'000) {
        PvtPlant plant({});
        plant.begin(motion);
        constexpr std::uint64_t hold_us = 350'000;
        plant.stations[1]->mute.push_back({plant.began_us + hold_us + after_us, UINT64_MAX});
        INFO("mute " << after_us << " us behind the hold");
        CHECK(run(plant, motion, {.hold_us = hold_us}) == PortPhase::halted);
        CHECK(plant.clock.now_us() - plant.began_us < hold_us + plant.port->longest_stop_us() + after_us + 100'000);
        braked += plant.port->report(1).status.state == PvtState::stopping ? 1 : 0;
    }
    CHECK(braked > 3);
}

TEST_CASE("PVT port, virtual: a port that goes while its drives run holds them first", "[ports]") {
    PvtPlant plant({});
    plant.begin(motion);
    for (int i = 0; i < 200; ++i) {
        while (plant.port->room() > 0 && plant.port->submit(motion.segments[plant.next])) {
            ++plant.next;
        }
        plant.port->poll();
        plant.clock.sleep_us(1000);
    }
    CHECK(plant.moved_us[0] > plant.clock.now_us() - 5000);
    plant.port.reset();
    check_stands_since(plant, plant.clock.now_us());
    CHECK(plant.off_path_counts < motion.fastest_counts_s * 0.0004);
}
