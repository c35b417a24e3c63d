// SPDX-License-Identifier: MIT
// Drives that follow target positions: shafts dither, segments are short, motions pause.
#include "ports/run_plant.hpp"
#include "ports/setpoint_plant.hpp"
#include "support/catch.hpp"

using namespace splinefeed::hal;
using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;

namespace {

const SmoothMotion motion = smooth_motion(8000.0, 2, 100, 4000);

} // namespace

TEST_CASE("Set-point port, virtual: a shaft that dithers holds, goes on after a common stop, and arrives", "[ports]") {
    struct Dither {
        int counts;
        double window_counts;
        bool held; ///< its positions say that it is on the path
    };
    for (const char* const profile : setpoint_profiles) {
        const bool blocks = splinefeed::host::find_profile(profile).stream == StreamWay::blocks;
        for (const Dither& dither : {Dither{3, 3.2, true}, Dither{12, 25.0, true}, Dither{12, 2.0, false}}) {
            if (!blocks && !dither.held) {
                continue; // a cyclic drive has no word of its own for it
            }
            INFO(profile << ", +-" << dither.counts << " counts in a window of " << dither.window_counts);
            SetpointPlantParameters parameters{.profile = profile, .standstill_counts = dither.window_counts};
            parameters.faults.dither_counts = dither.counts;
            SetpointPlant plant(parameters);
            REQUIRE_FALSE(plant.begin(motion));
            CHECK(run(plant, motion, {.starved_from_us = 100'000, .starved_to_us = 900'000}) == PortPhase::idle);
            CHECK(plant.port->resumes() == 1);
            plant.port.reset();
            REQUIRE_FALSE(plant.begin(motion));
            CHECK(run(plant, motion, {.hold_us = 250'000}) == PortPhase::halted);
            for (std::size_t i = 0; i < 3; ++i) {
                CHECK(plant.port->stop_report(i).request == StopRequest::hold);
                CHECK(plant.port->stop_report(i).state == StopState::confirmed);
                CHECK((plant.port->stop_report(i).held() || !dither.held));
                CHECK(plant.drives[i]->axis().power() == splinefeed::host::AxisPower::on);
            }
        }
    }
}

TEST_CASE("Set-point port, virtual: a drive that nobody can switch off is refused before anything is written",
          "[ports]") {
    for (const bool factory : {true, false}) {
        INFO("as from the factory: " << factory);
        SetpointPlant plant({.profile = "leadshine-pr", .drives = 1, .change_drives = [&](DriveProfile& theirs) {
                                 theirs.fields[theirs.index_of("input_1")].value = factory ? 0x0088 : 0;
                             }});
        plant.make();
        const PortFailure failure = plant.port->open();
        CHECK((failure.what.find("stays on when the program disables it") != std::string::npos) == factory);
        CHECK(plant.drives[0]->axis().power() ==
              (factory ? splinefeed::host::AxisPower::on : splinefeed::host::AxisPower::off));
        if (!factory) {
            CHECK_FALSE(failure);
            REQUIRE_FALSE(plant.port->prepare(motion.segments.front()));
            CHECK(plant.drives[0]->axis().power() == splinefeed::host::AxisPower::on);
            plant.port->power_off();
            plant.clock.sleep_us(500'000);
            CHECK(plant.drives[0]->axis().power() == splinefeed::host::AxisPower::off);
        }
    }
}

TEST_CASE("Set-point port, virtual: segments of any duration fit the buffer", "[ports]") {
    struct Short {
        std::uint32_t segment_us;
        std::uint32_t period_us; ///< of the drive's profile; 0: as it is
    };
    for (const char* const profile : {"cia402-index", "lexium32m"}) {
        for (const Short& segments : {Short{50, 0}, Short{70, 0}, Short{7, 0}, Short{100, 400'000}}) {
            INFO(profile << ", segments of " << segments.segment_us << " us, period_ms " << segments.period_us / 1000);
            SetpointPlant plant({.profile = profile, .drives = 1, .change = [&](DriveProfile& changed) {
                                     changed.period_us =
                                         segments.period_us != 0 ? segments.period_us : changed.period_us;
                                 }});
            const auto a_leg = static_cast<int>(300'000 / segments.segment_us);
            const SmoothMotion brief = smooth_motion(800.0, 2, a_leg, segments.segment_us);
            REQUIRE_FALSE(plant.begin(brief));
            CHECK(run(plant, brief, {}) == PortPhase::idle);
            CHECK(plant.port->poll().executed == brief.segments.size());
        }
    }
}

TEST_CASE("Set-point port, virtual: a motion that ends while it moves is slowed down on its path", "[ports]") {
    for (const char* const profile : setpoint_profiles) {
        INFO(profile);
        std::vector<double> places; // every 20 ms
        SetpointPlant plant({.profile = profile});
        plant.sample_positions();
        SmoothMotion cut = smooth_motion(8000.0, 1, 250, 4000);
        REQUIRE_FALSE(plant.begin(cut));
        plant.each_ms = [&, next_us = plant.began_us]() mutable {
            if (plant.clock.now_us() >= next_us) {
                next_us += 20'000;
                places.push_back(plant.drives[0]->position_counts(0));
            }
        };
        cut.segments.resize(150); // of a leg of 250
        CHECK(run(plant, cut, {}) == PortPhase::halted);
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(plant.port->stop_report(i).held());
        }
        CHECK(plant.now_off_counts < 12.0);
        REQUIRE(places.size() > 10);
        double hardest = 0.0; // change of speed within 20 ms
        for (std::size_t i = 2; i < places.size(); ++i) {
            hardest = std::max(hardest, std::fabs(places[i] - 2.0 * places[i - 1] + places[i - 2]) / 0.02);
        }
        CHECK(hardest < 0.5 * cut.fastest_counts_s); // from full speed to standstill it would be all of it
        check_stands_since(plant, plant.clock.now_us());
    }
}

TEST_CASE("Set-point port, virtual: no shaft jumps to a target after a gap of its line", "[ports]") {
    for (const std::uint64_t gap_us : {15'000U, 60'000U, 200'000U, 700'000U}) {
        for (const bool mute : {false, true}) {
            for (const std::uint64_t from_us : {0U, 60'000U, 150'000U, 350'000U}) {
                INFO("a gap of " << gap_us << " us at " << from_us << ", mute " << mute);
                SetpointPlant plant({.profile = "cia402-index", .fastest_counts_s = motion.fastest_counts_s});
                plant.sample_positions();
                REQUIRE_FALSE(plant.begin(motion));
                const Span gap{plant.began_us + from_us, plant.began_us + from_us + gap_us};
                (mute ? plant.stations[1]->mute : plant.wires[1]->unplugged).push_back(gap);
                CHECK(run(plant, motion, {}) == PortPhase::idle);
                CHECK(plant.most_step_counts < 1.3 * motion.fastest_counts_s * 1e-3);
            }
        }
    }
}

TEST_CASE("Set-point port, virtual: a motion that late answers stop again and again is ended, and says of which drive",
          "[ports]") {
    const SmoothMotion longer = smooth_motion(8000.0, 3, 400, 4000); // 5 s, and 14 pauses of 3 s
    for (const char* const profile : {"cia402-index", "lexium32m"}) {
        INFO(profile);
        SetpointPlant plant({.profile = profile});
        plant.sample_positions();
        REQUIRE_FALSE(plant.begin(longer));
        plant.wires[1]->faults.late = 0.3;
        plant.wires[1]->faults.late_us = 49'000; // less than the time-out
        CHECK(run(plant, longer, {}) == PortPhase::fault);
        INFO(plant.port->failure().what << ", " << plant.port->resumes() << " resumes");
        CHECK(plant.port->failure().what.find("its line is too slow for targets: ") == 0);
        CHECK(plant.port->failure().drive == 1);
        CHECK(plant.clock.now_us() < plant.began_us + 25'000'000);
    }
}

TEST_CASE("Set-point port, virtual: pauses of a program are no late answers, however long they are", "[ports]") {
    // 2 s, and more than six pauses of 3 s: 18.2 s of late answers would be too many
    const SmoothMotion longer = smooth_motion(8000.0, 3, 170, 4000);
    for (const char* const profile : {"cia402-index", "lexium32m"}) {
        INFO(profile);
        SetpointPlant plant({.profile = profile});
        plant.sample_positions();
        REQUIRE_FALSE(plant.begin(longer));
        PortPhase phase = PortPhase::running;
        for (int ms = 0; phase == PortPhase::running && ms < 100'000; ++ms) {
            for (int i = 0; ms % 3000 == 0 && i < 40 && plant.next < longer.segments.size(); ++i) {
                plant.next += plant.port->submit(longer.segments[plant.next]) ? 1 : 0;
            }
            if (plant.next == longer.segments.size()) {
                plant.port->complete();
            }
            phase = plant.port->poll().phase;
            plant.clock.sleep_us(1000);
        }
        CHECK(phase == PortPhase::idle);
        CHECK(plant.port->resumes() > 6);
    }
}
