// SPDX-License-Identifier: MIT
// Random runs of drives that follow target positions, with everything that goes wrong, on a virtual clock. Every run is
// one of its seed alone.
#include "ports/phase_act.hpp"
#include "ports/run_plant.hpp"
#include "ports/setpoint_plant.hpp"
#include "ports/visited_cells.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <map>

using namespace splinefeed::hal;
using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;

namespace {

constexpr std::uint64_t away_us = 1'500'000;
constexpr double way_counts = 8000.0; // of the first axis, there and back
// Of the first axis: each axis stands within 2 counts of the path and what its registers round, up to 3; that of the
// axis which goes a quarter of the way counts four times.
constexpr double most_held_counts = (1.0 + 4.0) * (2.0 + 3.0);

/// What a run is like, by its seed.
struct Scenario {
    std::mt19937_64 random;
    SetpointPlantParameters parameters;
    Asked asked;
    std::string text;       ///< what goes wrong
    bool fatal = false;     ///< it ends in fault, unless it ends before
    bool dishonest = false; ///< a drive does not tell the truth
    bool setup_spoilt = false;
    std::size_t cut = 0; ///< so many segments come, the last one in motion; 0: all
    bool outage = false; ///< a drive does not answer for a while, or not the truth

    explicit Scenario(std::uint64_t seed) : random(seed) {
        parameters.profile = setpoint_profiles[dice(setpoint_profiles.size())];
        parameters.drives = 1 + static_cast<int>(dice(3));
        parameters.one_wire = dice(2) == 0;
        parameters.seed = seed;
    }
    /// 0 to n - 1
    std::uint64_t dice(std::uint64_t n) { return random() % n; }

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
            spoil_line(*plant.wires[dice(plant.wires.size())]);
        }
        if (dice(2) == 0) {
            spoil_drive(plant, length_us);
        } else if (dice(3) == 0) {
            spoil_model(plant, length_us);
        }
        if (dice(4) == 0) {
            asked.starved_from_us = dice(length_us);
            asked.starved_to_us = asked.starved_from_us + 20'000 + dice(800'000);
            text += " starved " + std::to_string(asked.starved_from_us) + " to " + std::to_string(asked.starved_to_us);
        }
        if (dice(10) == 0) {
            cut = 1 + dice(length_us / 4000);
            text += " cut behind " + std::to_string(cut);
        }
        const std::uint64_t stops = dice(6);
        if (stops >= 3) {
            asked.hold_us = dice(2) == 0 ? dice(120'000) : dice(length_us);
            text += " hold " + std::to_string(asked.hold_us);
        }
        if (stops == 5) {
            asked.quick_us = asked.hold_us + dice(300'000);
            text += " quick stop " + std::to_string(asked.quick_us);
        }
        if (dice(4) == 0) {
            add_act(plant);
        }
    }
    /// Whoever plans does something when the port is in a phase, or some time later.
    void add_act(SetpointPlant& plant) {
        const PhaseAct<SetpointPhase> act{
            .kind = static_cast<ActKind>(dice(static_cast<std::uint64_t>(ActKind::count))),
            .in = static_cast<SetpointPhase>(dice(static_cast<std::uint64_t>(SetpointPhase::halted))),
            .after_us = dice(2) == 0 ? 0 : dice(40'000),
            .pause_us = 1000 + dice(4'000'000)};
        text += act.text();
        fatal = fatal || act.fatal();
        asked.also = act_in_phase(plant, asked, act);
    }
    void spoil_line(SimulatedWire& wire) {
        const auto share = [&] {
            return dice(2) == 0 ? 0.0 : 1e-4 * static_cast<double>(dice(50));
        };
        wire.faults = {.lost_request = share(),
                       .lost_answer = share(),
                       .corrupt = 0.0, // tcp: no checksum of its own would notice
                       .exception = share(),
                       .repeated = 0.0, // a block that takes effect twice is a relative move too many
                       .stale = 0.0,
                       .late = share(),
                       .late_us = 1 + dice(30'000)};
        text += " bad line";
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
    void spoil_drive(SetpointPlant& plant, std::uint64_t length_us) {
        const std::size_t i = dice(plant.drives.size());
        const std::uint64_t from_us = plant.began_us + dice(length_us);
        const std::uint64_t long_us = dice(4) == 0 ? 3'000'000 : 20'000 + dice(900'000);
        const Span span{from_us, from_us + long_us};
        const auto kind = dice(5);
        constexpr std::array names{"unplugged", "mute", "frozen", "dead", "stops by itself"};
        text += " drive " + std::to_string(i) + " " + names[kind] + " at " + std::to_string(from_us - plant.began_us) +
                " for " + std::to_string(long_us);
        outage = outage || kind < 4;
        const std::uint64_t watchdog_us = 1000ULL * plant.profile.watchdog_timeout_ms;
        fatal = fatal || kind >= 3 || long_us > (watchdog_us > 0 ? std::min(away_us, watchdog_us) : away_us) / 2;
        switch (kind) {
        case 0: plant.wires[plant.wires.size() == 1 ? 0 : i]->unplugged.push_back(span); break;
        case 1: plant.stations[i]->mute.push_back(span); break;
        case 2: plant.stations[i]->frozen.push_back(span); break;
        case 3: plant.stations[i]->mute.push_back({from_us, UINT64_MAX}); break;
        default: plant.events.emplace_back(from_us, [&plant, i] { plant.drives[i]->stop_by_itself(); }); break;
        }
    }
};

using Cells = VisitedCells<SetpointPhase, SetpointEvent>;
using Phase = SetpointPhase;
using Event = SetpointEvent;
constexpr auto unasked = "no stop was requested";

// Cells that no run can visit.
const std::vector<Cells::Never> never_visited{
    {Phase::filling,
     {Event::slows, Event::stands, Event::ready, Event::ran_out, Event::arrived},
     "the clock was not started"},
    {Phase::filling, {Event::settles, Event::fails}, unasked},
    {Phase::running, {Event::stands, Event::ready}, "the clock slows down first"},
    {Phase::running, {Event::arrived}, "the time runs out first"},
    {Phase::running, {Event::settles, Event::fails}, unasked},
    {Phase::arriving, {Event::stands, Event::ready}, "the clock slows down first"},
    {Phase::arriving, {Event::settles, Event::fails}, unasked},
    {Phase::stopping, {Event::ready}, "the clock stands first"},
    {Phase::stopping, {Event::settles, Event::fails}, unasked},
    {Phase::starved, {Event::ran_out, Event::arrived}, "a motion that has its end is filled"},
    {Phase::starved, {Event::settles, Event::fails}, unasked},
    {Phase::returning, {Event::settles, Event::fails}, unasked},
    {Phase::ending, {Event::trouble}, "nobody looks for more trouble"},
    {Phase::halted, {Event::trouble, Event::fails}, "nobody looks for trouble any more"},
    {Phase::done,
     {Event::slows, Event::stands, Event::ready, Event::trouble, Event::settles, Event::fails},
     "the drives have arrived, and no stop was requested"},
    {Phase::fault, {Event::trouble, Event::settles}, "it has its trouble"},
};

struct Tally {
    std::map<std::string, int> endings;
    Cells cells;                  ///< of the port's table
    double most_off_counts = 0.0; ///< off the path where it was held
};

/// What the port has been through is counted at last.
void finish(SetpointPlant& plant, Scenario& scenario, Tally& tally) {
    act_behind_end(plant, scenario.dice(8));
    tally.cells.add(plant.port->phases());
}

void judge(SetpointPlant& plant, Scenario& scenario, const SmoothMotion& motion, PortPhase phase, Tally& tally) {
    SetpointPort& port = *plant.port;
    INFO("trouble: " << port.trouble() << ", " << port.poll().executed << " segments executed, " << port.resumes()
                     << " resumes");
    CHECK(phase != PortPhase::running);
    // A drive that is not told what comes next goes on for a period, and brakes; who catches up goes no further.
    const double beyond_counts = 1.2 * motion.fastest_counts_s * 1e-6 * port.period_us() + 0.05 * way_counts;
    CHECK((scenario.dishonest || plant.lowest_counts > -beyond_counts));
    CHECK((scenario.dishonest || plant.highest_counts < way_counts + beyond_counts));
    CHECK((phase != PortPhase::halted || scenario.asked.hold_us != UINT64_MAX || scenario.cut > 0));
    CHECK((phase != PortPhase::fault || scenario.fatal));
    if (phase == PortPhase::idle) {
        ++tally.endings["done"];
        for (const double position : plant.positions) {
            CHECK((scenario.dishonest || scenario.cut > 0 || std::fabs(position) < 1.5)); // back where it began
        }
        finish(plant, scenario, tally);
        return;
    }
    bool all_held = true;
    bool all_confirmed = true;
    const std::uint64_t ended_us = plant.clock.now_us();
    const std::vector<double> ended_counts = plant.positions;
    std::vector<bool> confirmed;
    for (std::size_t i = 0; i < plant.drives.size(); ++i) {
        const StopReport report = port.stop_report(i);
        const bool sure = report.state == StopState::confirmed;
        CHECK((sure || report.state == StopState::unconfirmed));
        CHECK((sure || scenario.outage)); // who answers confirms
        all_held = all_held && report.held();
        all_confirmed = all_confirmed && sure;
        confirmed.push_back(sure);
    }
    ++tally.endings[all_held ? "held" : all_confirmed ? "stopped" : "unconfirmed"];
    if (all_held && !scenario.dishonest) {
        CHECK(plant.now_off_counts < most_held_counts);
        tally.most_off_counts = std::max(tally.most_off_counts, plant.now_off_counts);
    }
    finish(plant, scenario, tally);
    plant.port.reset();
    plant.events.clear();
    plant.clock.sleep_us(800'000);
    for (std::size_t k = 0; k < confirmed.size(); ++k) {
        INFO("drive " << k << " moved until " << static_cast<std::int64_t>(plant.moved_us[k] - ended_us)
                      << " us behind the end, by " << plant.positions[k] - ended_counts[k] << " counts");
        CHECK((!confirmed[k] || plant.moved_us[k] <= ended_us || scenario.dishonest));
    }
}

void run_seed(std::uint64_t seed, Tally& tally) {
    Scenario scenario(seed);
    SetpointPlant plant(scenario.parameters);
    plant.make({.away_us = away_us});
    plant.sample_positions();
    REQUIRE(plant.port->open() == "");
    SmoothMotion motion = smooth_motion(way_counts, 2, 60 + static_cast<int>(scenario.dice(80)), 4000);
    scenario.spoil_setup(plant);
    const std::string what = plant.port->prepare(motion.segments.front());
    if (!what.empty()) {
        INFO("seed " << seed << ": " << scenario.text << ": " << what);
        CHECK(scenario.setup_spoilt);
        CHECK(plant.port->poll().phase == PortPhase::fault);
        ++tally.endings["not ready"];
        finish(plant, scenario, tally);
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
    const char* const only = std::getenv("SPLINEFEED_SEED");
    const std::uint64_t first = only != nullptr ? std::strtoull(only, nullptr, 10) : 1;
    const int runs = only != nullptr ? 1 : rounds(100, 5000);
    Tally tally;
    for (int run = 0; run < runs; ++run) {
        run_seed(first + static_cast<std::uint64_t>(run), tally);
    }
    std::string text;
    for (const auto& [ending, count] : tally.endings) {
        text += ending + " " + std::to_string(count) + ", ";
    }
    const std::string missed = tally.cells.missed(never_visited);
    text += "cells not visited:" + missed + "; ";
    WARN(runs << " runs from seed " << first << ": " << text << "off the path when held " << tally.most_off_counts
              << " counts");
    CHECK((only != nullptr || tally.endings.size() >= 4));
    tally.cells.require_unvisited(never_visited);
    CHECK((runs < 5000 || missed == " none"));
}
