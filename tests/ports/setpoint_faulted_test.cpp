// SPDX-License-Identifier: MIT
// Random runs of drives that follow target positions, with everything that goes wrong, on a virtual clock. Every run is
// one of its seed alone.
#include "ports/faulted_run.hpp"
#include "ports/run_plant.hpp"
#include "ports/setpoint_plant.hpp"
#include "support/catch.hpp"

using namespace splinefeed::hal;
using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;

namespace {

constexpr double way_counts = 8000.0; // of the first axis, there and back
// Of the first axis: each axis stands within 2 counts of the path and what its registers round, up to 3; that of the
// axis which goes a quarter of the way counts four times.
constexpr double most_held_counts = (1.0 + 4.0) * (2.0 + 3.0);

/// What a run is like, by its seed.
struct Scenario : FaultedRun {
    SetpointPlantParameters parameters;
    bool setup_spoilt = false;
    std::size_t cut = 0; ///< so many segments come, the last one in motion; 0: all

    explicit Scenario(std::uint64_t seed) : FaultedRun(seed) {
        parameters.profile = setpoint_profiles[dice(setpoint_profiles.size())];
        parameters.drives = 1 + static_cast<int>(dice(3));
        parameters.one_wire = dice(2) == 0;
        parameters.seed = seed;
    }

    /// Before the drives are made ready.
    void spoil_setup(SetpointPlant& plant) {
        if (dice(15) == 0) {
            setup_spoilt = outage = fatal = true; // it may begin during the motion
            const std::uint64_t silent_us = dice(2) == 0 ? 150'000 : 4'000'000;
            SimulatedWire& wire = *plant.wires[dice(plant.wires.size())];
            wire.silences.emplace_back(wire.requests + 1 + dice(25), silent_us);
            text += " silent while it is made ready";
        }
    }
    /// Times are those of the run.
    void spoil(SetpointPlant& plant, std::uint64_t length_us) {
        if (dice(3) != 0) {
            // On tcp no checksum would notice what is damaged; a block that takes effect twice is a move too many.
            spoil_line(*plant.wires[dice(plant.wires.size())], 50, 30'000, false, false);
        }
        if (dice(2) == 0) {
            const std::uint64_t watchdog_us = 1000ULL * plant.profile.watchdog_timeout_ms;
            constexpr std::array names{"unplugged", "mute", "frozen", "dead", "stops by itself"};
            const auto [i, kind, from_us] =
                spoil_drive(plant, length_us, names, watchdog_us > 0 ? std::min(away_us, watchdog_us) : away_us);
            if (kind == 4) {
                plant.events.emplace_back(from_us, [&drive = *plant.drives[i]] { drive.stop_by_itself(); });
            }
        } else if (dice(3) == 0) {
            spoil_model(plant, length_us);
        }
        if (dice(4) == 0) {
            starve(length_us);
        }
        if (dice(10) == 0) {
            cut = 1 + dice(length_us / 4000);
            text += " cut behind " + std::to_string(cut);
        }
        ask_for_stops(length_us);
        if (dice(4) == 0) {
            add_act(plant, draw_act(SetpointPhase::halted, false));
        }
    }
    /// What a drive says or refuses from some time on.
    void spoil_model(SetpointPlant& plant, std::uint64_t length_us) {
        const std::size_t i = dice(plant.drives.size());
        const std::uint64_t from_us = plant.began_us + dice(length_us);
        constexpr std::array names{"dithers", "refuses stops", "stuck state", "stuck place"};
        const auto kind = dice(names.size());
        splinefeed::host::ModelFaults faults;
        faults.dither_counts = kind == 0 ? 1 + static_cast<int>(dice(15)) : 0;
        faults.refuses_stops = kind == 1;
        faults.stuck_state = kind == 2;
        faults.stuck_place = kind == 3;
        text += " drive " + std::to_string(i) + " " + names[kind] + " from " + std::to_string(from_us - plant.began_us);
        dishonest = outage = fatal = true;
        plant.events.emplace_back(from_us, [&plant, i, faults] { plant.models[i]->set_faults(faults); });
    }
};

using Phase = SetpointPhase;
using Event = SetpointEvent;

// Cells that no run can visit.
const std::vector<NeverVisited<Phase, Event>> never_visited{
    {{Phase::filling},
     {Event::slows, Event::stands, Event::ready, Event::ran_out, Event::arrived},
     "the clock was not started"},
    {{Phase::filling, Phase::running, Phase::arriving, Phase::stopping, Phase::starved, Phase::returning},
     {Event::settles, Event::fails},
     "no stop was requested"},
    {{Phase::running, Phase::arriving}, {Event::stands, Event::ready}, "the clock slows down first"},
    {{Phase::running}, {Event::arrived}, "the time runs out first"},
    {{Phase::stopping}, {Event::ready}, "the clock stands first"},
    {{Phase::starved}, {Event::ran_out, Event::arrived}, "a motion that has its end is filled"},
    {{Phase::ending}, {Event::trouble}, "nobody looks for more trouble"},
    {{Phase::halted}, {Event::trouble, Event::fails}, "nobody looks for trouble any more"},
    {{Phase::done},
     {Event::slows, Event::stands, Event::ready, Event::trouble, Event::settles, Event::fails},
     "the drives have arrived, and no stop was requested"},
    {{Phase::fault}, {Event::trouble, Event::settles}, "it has its trouble"},
};

using Tally = FaultedTally<SetpointPhase, SetpointEvent>;

void judge(SetpointPlant& plant, Scenario& scenario, const SmoothMotion& motion, PortPhase phase, Tally& tally) {
    SetpointPort& port = *plant.port;
    INFO("trouble: " << port.failure().what << ", " << port.poll().executed << " segments executed, " << port.resumes()
                     << " resumes");
    CHECK(phase != PortPhase::running);
    // A drive that is not told what comes next goes on for a period, and brakes; who catches up goes no further.
    const double beyond_counts = 1.2 * motion.fastest_counts_s * 1e-6 * port.period_us() + 0.05 * way_counts;
    CHECK((scenario.dishonest || plant.lowest_counts > -beyond_counts));
    CHECK((scenario.dishonest || plant.highest_counts < way_counts + beyond_counts));
    CHECK((phase != PortPhase::halted || scenario.asked.hold_us != UINT64_MAX || scenario.cut > 0));
    CHECK((phase != PortPhase::fault || scenario.fatal));
    if (phase != PortPhase::idle) {
        judge_stop(plant, scenario, most_held_counts, tally);
        return;
    }
    ++tally.endings["done"];
    for (const double position : plant.positions) {
        CHECK((scenario.dishonest || scenario.cut > 0 || std::fabs(position) < 1.5)); // back where it began
    }
    finish_run(plant, scenario, tally);
}

void run_seed(std::uint64_t seed, Tally& tally) {
    Scenario scenario(seed);
    SetpointPlant plant(scenario.parameters);
    plant.open({.away_us = away_us});
    SmoothMotion motion = smooth_motion(way_counts, 2, 60 + static_cast<int>(scenario.dice(80)), 4000);
    scenario.spoil_setup(plant);
    if (const auto failure = plant.port->prepare(motion.segments.front())) {
        INFO("seed " << seed << ": " << scenario.text << ": " << failure.what);
        CHECK(scenario.setup_spoilt);
        CHECK(plant.port->poll().phase == PortPhase::fault);
        ++tally.endings["not ready"];
        finish_run(plant, scenario, tally);
        return;
    }
    plant.began_us = plant.clock.now_us();
    scenario.spoil(plant, 4000 * motion.segments.size());
    motion.segments.resize(scenario.cut > 0 ? std::min(scenario.cut, motion.segments.size()) : motion.segments.size());
    INFO("seed " << seed << ": " << scenario.parameters.profile << "," << scenario.text << "; " << plant.drives.size()
                 << " drives, one wire " << scenario.parameters.one_wire);
    const PortPhase phase = run(plant, motion, scenario.asked);
    judge(plant, scenario, motion, phase, tally);
}

} // namespace

TEST_CASE("Set-point port, virtual: random faulted runs end at the end or stop, and say of it what is true",
          "[ports][random]") {
    run_seeds(100, 5000, never_visited, run_seed);
}
