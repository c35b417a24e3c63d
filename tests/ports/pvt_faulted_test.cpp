// SPDX-License-Identifier: MIT
// Random runs of drives that interpolate, with everything that goes wrong, on a virtual clock. Every run is one of its
// seed alone.
#include "ports/phase_act.hpp"
#include "ports/pvt_plant.hpp"
#include "ports/run_plant.hpp"
#include "ports/visited_cells.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <map>

using namespace splinefeed::hal;
using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;

namespace {

constexpr std::uint64_t away_us = 1'500'000;
constexpr std::uint64_t push_us = 3000; // of a load on a shaft

/// What a run is like, by its seed.
struct Scenario {
    std::mt19937_64 random;
    PvtPlantParameters parameters;
    ModbusPortSettings settings;
    Asked asked;
    std::string text;                    ///< what goes wrong
    bool fatal = false;                  ///< it ends in fault, unless it ends before
    bool outage = false;                 ///< a drive does not answer for a while
    bool off = false;                    ///< and not all stop in time, or a drive stops for itself: off the path
    std::size_t pushed_drive = SIZE_MAX; ///< a load pushes it
    std::uint64_t pushed_to_us = 0;      ///< until then
    bool dishonest = false;              ///< a drive does not tell the truth
    bool empty = false;                  ///< there are no segments

    explicit Scenario(std::uint64_t seed) : random(seed) {
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
    /// 0 to n - 1
    std::uint64_t dice(std::uint64_t n) { return random() % n; }
    [[nodiscard]] bool serial() const { return parameters.wire == Wire::rtu; }

    /// Times are those of the run.
    void spoil(PvtPlant& plant, std::uint64_t length_us) {
        if (dice(3) != 0) {
            spoil_line(*plant.wires[dice(plant.wires.size())]);
        }
        if (dice(2) == 0) {
            spoil_drive(plant, length_us);
        }
        if (dice(4) == 0) {
            asked.starved_from_us = dice(length_us);
            asked.starved_to_us = asked.starved_from_us + 20'000 + dice(800'000);
            text += " starved " + std::to_string(asked.starved_from_us) + " to " + std::to_string(asked.starved_to_us);
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
        if (dice(15) == 0) {
            spoil_model(plant, length_us);
        }
        if (dice(4) == 0) {
            add_act(plant, length_us);
        }
        empty = dice(40) == 0;
        text += empty ? " no segments" : "";
    }
    void spoil_line(SimulatedWire& wire) {
        const auto share = [&] {
            return dice(2) == 0 ? 0.0 : 1e-4 * static_cast<double>(dice(400));
        };
        wire.faults = {.lost_request = share(),
                       .lost_answer = share(),
                       .corrupt = share(),
                       .exception = share(),
                       .repeated = share(),
                       .stale = serial() ? share() : 0.0,
                       .late = share(),
                       .late_us = 1 + dice(80'000)};
        text += " bad line";
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
    /// Whoever plans does something when the port is in a phase, or some time later.
    void add_act(PvtPlant& plant, std::uint64_t length_us) {
        const PhaseAct<ModbusPhase> act{
            .kind = static_cast<ActKind>(dice(static_cast<std::uint64_t>(ActKind::count))),
            .in = static_cast<ModbusPhase>(dice(static_cast<std::uint64_t>(ModbusPhase::halted))),
            .after_us = dice(2) == 0 ? 0 : dice(40'000),
            .pause_us = dice(8) == 0 ? 75'000'000 : 1000 + dice(4'000'000)};
        const bool starves = act.in == ModbusPhase::stopping || act.in == ModbusPhase::waiting;
        if (starves && asked.starved_from_us == UINT64_MAX) {
            asked.starved_from_us = dice(length_us);
            asked.starved_to_us = asked.starved_from_us + 20'000 + dice(800'000);
        }
        if (act.in == ModbusPhase::halting && asked.hold_us == UINT64_MAX) {
            asked.hold_us = dice(length_us);
        }
        text += act.text();
        fatal = fatal || act.fatal();
        asked.also = act_in_phase(plant, asked, act);
    }
    void spoil_drive(PvtPlant& plant, std::uint64_t length_us) {
        const std::size_t i = dice(plant.drives.size());
        const std::uint64_t from_us = plant.began_us + dice(length_us);
        const std::uint64_t long_us = dice(4) == 0 ? 3'000'000 : 20'000 + dice(900'000);
        const Span span{from_us, from_us + long_us};
        const auto kind = dice(6);
        constexpr std::array names{"unplugged", "mute", "frozen", "dead", "power cycle", "over its limit"};
        text += " drive " + std::to_string(i) + " " + names[kind] + " at " + std::to_string(from_us - plant.began_us) +
                " for " + std::to_string(long_us);
        outage = outage || kind < 4;
        fatal = fatal || kind >= 3 || long_us > away_us / 2;
        switch (kind) {
        case 0: plant.wires[plant.wires.size() == 1 ? 0 : i]->unplugged.push_back(span); break;
        case 1: plant.stations[i]->mute.push_back(span); break;
        case 2: plant.stations[i]->frozen.push_back(span); break;
        case 3: plant.stations[i]->mute.push_back({from_us, UINT64_MAX}); break;
        case 4:
            plant.events.emplace_back(from_us, [&plant, i] { plant.drives[i]->power_cycle(); });
            off = true;
            break;
        default:
            plant.events.emplace_back(from_us, [&plant, i] {
                PvtConfiguration strict = plant.drives[i]->machine().configuration();
                strict.following_window = 1;
                plant.drives[i]->machine().configure(strict);
                plant.drives[i]->machine().shaft(0).disturb(1e7);
            });
            pushed_drive = i;
            pushed_to_us = from_us + push_us;
            plant.events.emplace_back(pushed_to_us, [&plant, i] { plant.drives[i]->machine().shaft(0).disturb(0.0); });
            off = true;
            break;
        }
    }
};

using Cells = VisitedCells<ModbusPhase, ModbusEvent>;
using Phase = ModbusPhase;
using Event = ModbusEvent;

constexpr auto unasked = "no stop was requested";
constexpr auto not_started = "nothing was started";
constexpr auto once_more = "a port that is asked for a stop looks at nothing but the stop";

// Cells that no run can visit.
const std::vector<Cells::Never> never_visited{
    {Phase::filling, {Event::started, Event::disturbed, Event::stands}, not_started},
    {Phase::filling, {Event::settled, Event::failed}, unasked},
    {Phase::starting,
     {Event::ready, Event::disturbed, Event::stands, Event::executed},
     "it waits for the answers to the start alone"},
    {Phase::starting, {Event::settled, Event::failed}, unasked},
    {Phase::running, {Event::ready, Event::started, Event::stands}, "who runs was ready and started"},
    {Phase::running, {Event::settled, Event::failed}, unasked},
    {Phase::stopping,
     {Event::ready, Event::started, Event::disturbed, Event::executed},
     "it waits until all stand, whatever they have executed"},
    {Phase::stopping, {Event::settled, Event::failed}, unasked},
    {Phase::waiting, {Event::started, Event::disturbed, Event::stands}, "all stand already, and nothing was started"},
    {Phase::waiting, {Event::settled, Event::failed}, unasked},
    {Phase::halting, {Event::ready, Event::started, Event::disturbed, Event::stands, Event::executed}, once_more},
    {Phase::halting, {Event::broken}, "no segment is accepted any more, and nobody looks for another problem"},
    {Phase::halting,
     {Event::overdue},
     "a StopSequence ends or makes its next request before, and its bound counts from that"},
    {Phase::halted, {Event::ready, Event::started, Event::disturbed, Event::stands, Event::executed}, once_more},
    {Phase::halted, {Event::broken, Event::failed}, "no segment is accepted any more, so there is no failure"},
    {Phase::halted, {Event::overdue}, "it has no bound"},
    {Phase::done,
     {Event::ready, Event::started, Event::disturbed, Event::stands, Event::executed, Event::settled, Event::failed},
     "nothing is looked at any more"},
    {Phase::done, {Event::overdue}, "it has no bound"},
    {Phase::fault, {Event::ready, Event::started, Event::disturbed, Event::stands, Event::executed}, once_more},
    {Phase::fault, {Event::broken, Event::settled}, "it has its failure"},
    {Phase::fault, {Event::overdue}, "it has no bound"},
};

struct Tally {
    std::map<std::string, int> endings;
    Cells cells;             ///< of the port's table
    double most_off_s = 0.0; ///< off the path where it was held, by the largest speed
};

/// What the port has been through is counted at last.
void finish(PvtPlant& plant, Scenario& scenario, Tally& tally) {
    act_behind_end(plant, scenario.dice(8));
    CHECK((plant.port->phase() != Phase::fault || plant.port->failure().has_value()));
    tally.cells.add(plant.port->phases());
}

void judge(PvtPlant& plant, Scenario& scenario, const SmoothMotion& motion, PortPhase phase, Tally& tally) {
    ModbusPort& port = *plant.port;
    const bool asked = scenario.asked.hold_us != UINT64_MAX;
    for (std::size_t i = 0; i < plant.drives.size(); ++i) {
        CHECK(plant.executed_once(i).has_value());
    }
    CHECK(phase != PortPhase::running);
    CHECK((phase != PortPhase::halted || asked));
    CHECK((phase != PortPhase::fault || scenario.fatal));
    const double off_s = plant.now_off_counts / motion.fastest_counts_s;
    if (phase == PortPhase::idle) {
        ++tally.endings["done"];
        for (std::size_t i = 0; i < plant.drives.size(); ++i) {
            CHECK(plant.executed_once(i) == motion.segments.size());
        }
        CHECK(plant.now_off_counts < 0.5);
        finish(plant, scenario, tally);
        return;
    }
    bool all_held = true;
    bool all_confirmed = true;
    const std::uint64_t ended_us = plant.clock.now_us();
    std::vector<bool> confirmed;
    for (std::size_t i = 0; i < plant.drives.size(); ++i) {
        const StopReport report = port.stop_report(i);
        const bool sure = report.state == StopState::confirmed;
        CHECK((sure || report.state == StopState::unconfirmed));
        CHECK((sure || scenario.outage || scenario.dishonest)); // who answers confirms
        all_held = all_held && report.held();
        all_confirmed = all_confirmed && sure;
        // What pushes it after its last answer nobody can know.
        const bool pushed_since = i == scenario.pushed_drive && scenario.pushed_to_us > report.status_us;
        confirmed.insert(confirmed.end(), static_cast<std::size_t>(scenario.parameters.axes[i]), sure && !pushed_since);
    }
    ++tally.endings[all_held ? "held" : all_confirmed ? "stopped" : "unconfirmed"];
    if (all_held && !scenario.dishonest) {
        CHECK(off_s < 0.001);
        tally.most_off_s = std::max(tally.most_off_s, off_s);
    }
    finish(plant, scenario, tally);
    plant.port.reset();
    plant.events.clear();
    plant.clock.sleep_us(800'000);
    for (std::size_t k = 0; k < confirmed.size(); ++k) {
        CHECK((!confirmed[k] || plant.moved_us[k] <= ended_us || scenario.dishonest));
    }
}

void run_seed(std::uint64_t seed, Tally& tally) {
    Scenario scenario(seed);
    PvtPlant plant(scenario.parameters);
    plant.make(scenario.settings);
    plant.sample_positions();
    REQUIRE_FALSE(plant.port->open());
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
    const char* const only = std::getenv("SPLINEFEED_SEED");
    const std::uint64_t first = only != nullptr ? std::strtoull(only, nullptr, 10) : 1;
    const int runs = only != nullptr ? 1 : rounds(150, 10'000);
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
    WARN(runs << " runs from seed " << first << ": " << text << "off the path when held " << 1e6 * tally.most_off_s
              << " us of the largest speed");
    CHECK((only != nullptr || tally.endings.size() == 4));
    tally.cells.require_unvisited(never_visited);
    CHECK((runs < 10'000 || missed == " none"));
}
