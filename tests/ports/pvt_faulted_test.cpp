// SPDX-License-Identifier: MIT
// Random runs of drives that interpolate, with everything that goes wrong, on a virtual clock. Every run is one of its
// seed alone.
#include "ports/faulted_run.hpp"
#include "ports/pvt_plant.hpp"
#include "ports/run_plant.hpp"
#include "support/catch.hpp"

using namespace splinefeed::hal;
using namespace splinefeed::hal::modbus;
using splinefeed::host::PvtDrive;
using namespace splinefeed_test;

namespace {

constexpr std::uint64_t push_us = 3000; // of a load on a shaft

/// What a run is like, by its seed.
struct Scenario : FaultedRun {
    PvtPlantParameters parameters;
    ModbusPortSettings settings;
    bool empty = false; ///< there are no segments

    explicit Scenario(std::uint64_t seed) : FaultedRun(seed) {
        parameters.axes.clear();
        for (std::uint64_t drives = 1 + dice(3); drives > 0; --drives) {
            parameters.axes.push_back(1 + static_cast<int>(dice(2)));
            parameters.clock_ppm.push_back(static_cast<double>(dice(400)) - 200.0);
        }
        parameters.one_wire = dice(2) == 0;
        parameters.wire = dice(3) == 0 ? Wire::rtu : Wire::tcp;
        parameters.drive.ring = static_cast<std::uint16_t>(100 + dice(400));
        parameters.seed = seed;
        settings.buffer_us = static_cast<std::uint32_t>(250'000 + dice(150'000));
        settings.away_us = away_us;
    }
    [[nodiscard]] bool serial() const { return parameters.wire == Wire::rtu; }

    /// Times are those of the run.
    void spoil(PvtPlant& plant, std::uint64_t length_us) {
        if (dice(3) != 0) {
            spoil_line(*plant.wires[dice(plant.wires.size())], 400, 80'000, true, serial());
        }
        if (dice(2) == 0) {
            spoil_shaft(plant, length_us);
        }
        if (dice(4) == 0) {
            starve(length_us);
        }
        ask_for_stops(length_us);
        if (dice(15) == 0) {
            spoil_model(plant, length_us);
        }
        if (dice(4) == 0) {
            const PhaseAct<ModbusPhase> act = draw_act(ModbusPhase::halted, true);
            const bool starves = act.in == ModbusPhase::stopping || act.in == ModbusPhase::waiting;
            if (starves && asked.starved_from_us == UINT64_MAX) {
                starve(length_us);
            }
            if (act.in == ModbusPhase::halting && asked.hold_us == UINT64_MAX) {
                asked.hold_us = dice(length_us);
            }
            add_act(plant, act);
        }
        empty = dice(40) == 0;
        text += empty ? " no segments" : "";
    }
    /// What a drive reports from some time on.
    void spoil_model(PvtPlant& plant, std::uint64_t length_us) {
        const std::size_t i = dice(plant.liars.size());
        const std::uint64_t from_us = plant.began_us + (dice(2) == 0 ? 0 : dice(length_us));
        constexpr std::array names{"no room", "always running", "always stopping", "stuck number"};
        const auto kind = dice(names.size());
        text += " drive " + std::to_string(i) + " " + names[kind] + " from " + std::to_string(from_us - plant.began_us);
        dishonest = fatal = true;
        plant.events.emplace_back(from_us, [&plant, i, kind] {
            const std::uint32_t executed = plant.port->report(i).status.executed;
            plant.liars[i]->lie = [kind, executed](PvtStatus& status) {
                status.free = kind == 0 ? 0 : status.free;
                status.state = kind == 1 ? PvtState::running : kind == 2 ? PvtState::stopping : status.state;
                status.executed = kind == 3 ? executed : status.executed;
            };
        });
    }
    void spoil_shaft(PvtPlant& plant, std::uint64_t length_us) {
        constexpr std::array names{"unplugged", "mute", "frozen", "dead", "power cycle", "over its limit"};
        const auto [i, kind, from_us] = spoil_drive(plant, length_us, names, away_us);
        PvtDrive& drive = *plant.drives[i];
        if (kind == 4) {
            plant.events.emplace_back(from_us, [&drive] { drive.power_cycle(); });
        } else if (kind == 5) {
            plant.events.emplace_back(from_us, [&drive] {
                PvtConfiguration strict = drive.machine().configuration();
                strict.following_window = 1;
                drive.machine().configure(strict);
                drive.machine().shaft(0).disturb(1e7);
            });
            pushed_drive = i;
            pushed_to_us = from_us + push_us;
            plant.events.emplace_back(pushed_to_us, [&drive] { drive.machine().shaft(0).disturb(0.0); });
        }
    }
};

using Phase = ModbusPhase;
using Event = ModbusEvent;

// Cells that no run can visit.
const std::vector<NeverVisited<Phase, Event>> never_visited{
    {{Phase::filling}, {Event::started, Event::disturbed, Event::stands}, "nothing was started"},
    {{Phase::filling, Phase::starting, Phase::running, Phase::stopping, Phase::waiting},
     {Event::settled, Event::failed},
     "no stop was requested"},
    {{Phase::starting},
     {Event::ready, Event::disturbed, Event::stands, Event::executed},
     "it waits for the answers to the start alone"},
    {{Phase::running}, {Event::ready, Event::started, Event::stands}, "who runs was ready and started"},
    {{Phase::stopping},
     {Event::ready, Event::started, Event::disturbed, Event::executed},
     "it waits until all stand, whatever they have executed"},
    {{Phase::waiting}, {Event::started, Event::disturbed, Event::stands}, "all stand already, and nothing was started"},
    {{Phase::halting, Phase::halted, Phase::done, Phase::fault},
     {Event::ready, Event::started, Event::disturbed, Event::stands, Event::executed},
     "a port that is asked for a stop looks at nothing but the stop"},
    {{Phase::halting}, {Event::broken}, "no segment is accepted any more, and nobody looks for another problem"},
    {{Phase::halting},
     {Event::overdue},
     "a StopSequence ends or makes its next request before, and its bound counts from that"},
    {{Phase::halted}, {Event::broken, Event::failed}, "no segment is accepted any more, so there is no failure"},
    {{Phase::halted, Phase::done, Phase::fault}, {Event::overdue}, "it has no bound"},
    {{Phase::done}, {Event::settled, Event::failed}, "nothing is looked at any more"},
    {{Phase::fault}, {Event::broken, Event::settled}, "it has its failure"},
    {{Phase::starting, Phase::running, Phase::stopping, Phase::waiting, Phase::halting, Phase::halted, Phase::done,
      Phase::fault},
     {Event::renewed},
     "a run has one motion"},
};

using Tally = FaultedTally<ModbusPhase, ModbusEvent>;

void judge(PvtPlant& plant, Scenario& scenario, const SmoothMotion& motion, PortPhase phase, Tally& tally) {
    for (std::size_t i = 0; i < plant.drives.size(); ++i) {
        CHECK(plant.executed_once(i).has_value());
    }
    CHECK(phase != PortPhase::running);
    CHECK((phase != PortPhase::halted || scenario.asked.hold_us != UINT64_MAX));
    CHECK((phase != PortPhase::fault || scenario.fatal));
    if (phase != PortPhase::idle) {
        judge_stop(plant, scenario, 0.001 * motion.fastest_counts_s, tally); // 1 ms of the largest speed
        return;
    }
    ++tally.endings["done"];
    for (std::size_t i = 0; i < plant.drives.size(); ++i) {
        CHECK(plant.executed_once(i) == motion.segments.size());
    }
    CHECK(plant.now_off_counts < 0.5);
    finish_run(plant, scenario, tally);
}

void run_seed(std::uint64_t seed, Tally& tally) {
    Scenario scenario(seed);
    PvtPlant plant(scenario.parameters);
    plant.open(scenario.settings);
    const double least_us = std::max(1000.0, plant.port->least_segment_us());
    const auto segment_us =
        static_cast<std::uint32_t>(least_us * (1.0 + 1e-3 * static_cast<double>(scenario.dice(2000))));
    const int segments = 20 + static_cast<int>(400'000 / segment_us);
    SmoothMotion motion = smooth_motion(10000.0, 1 + static_cast<int>(scenario.dice(2)), segments, segment_us);
    REQUIRE_FALSE(plant.port->prepare(motion.segments.front()));
    plant.began_us = plant.clock.now_us();
    scenario.spoil(plant, segment_us * motion.segments.size());
    motion.segments.resize(scenario.empty ? 0 : motion.segments.size());
    INFO("seed " << seed << ":" << scenario.text << "; " << plant.drives.size() << " drives, one wire "
                 << scenario.parameters.one_wire << ", rtu " << scenario.serial() << ", segments of " << segment_us);
    const PortPhase phase = run(plant, motion, scenario.asked);
    judge(plant, scenario, motion, phase, tally);
}

} // namespace

TEST_CASE("PVT port, virtual: random faulted runs lose nothing, and say of a stop what is true", "[ports][random]") {
    run_seeds(150, 10'000, never_visited, run_seed);
}
