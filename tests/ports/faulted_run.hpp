// SPDX-License-Identifier: MIT
// FaultedRun: random runs of drives with everything that goes wrong, on a virtual clock; what drives of either kind
// have in common. Every run is one of its seed alone.
#pragma once

#include "ports/phase_act.hpp"
#include "ports/simulated_link.hpp"
#include "ports/visited_cells.hpp"
#include "splinefeed/hal/stop_sequence.hpp"
#include "support/rounds.hpp"

#include <map>

namespace splinefeed_test {

/// So long a drive may be away. [us]
inline constexpr std::uint64_t away_us = 1'500'000;

/// What a run is like, by its seed.
struct FaultedRun {
    std::mt19937_64 random;
    Asked asked;
    std::string text;                    ///< what goes wrong
    bool fatal = false;                  ///< it ends in fault, unless it ends before
    bool outage = false;                 ///< a drive does not answer for a while
    bool dishonest = false;              ///< a drive does not tell the truth
    std::size_t pushed_drive = SIZE_MAX; ///< a load pushes it
    std::uint64_t pushed_to_us = 0;      ///< until then

    explicit FaultedRun(std::uint64_t seed) : random(seed) {}
    /// 0 to n - 1
    std::uint64_t dice(std::uint64_t n) { return random() % n; }

    /// No segments come for a while.
    void starve(std::uint64_t length_us) {
        asked.starved_from_us = dice(length_us);
        asked.starved_to_us = asked.starved_from_us + 20'000 + dice(800'000);
        text += " starved " + std::to_string(asked.starved_from_us) + " to " + std::to_string(asked.starved_to_us);
    }
    void ask_for_stops(std::uint64_t length_us) {
        const std::uint64_t stops = dice(6);
        if (stops >= 3) {
            asked.hold_us = dice(2) == 0 ? dice(120'000) : dice(length_us);
            text += " hold " + std::to_string(asked.hold_us);
        }
        if (stops == 5) {
            asked.quick_us = asked.hold_us + dice(300'000);
            text += " quick stop " + std::to_string(asked.quick_us);
        }
    }
    /// @param most     of ten thousand requests, of each kind of fault
    /// @param repeats  what is written may be damaged, and may take effect twice
    void spoil_line(SimulatedWire& wire, std::uint64_t most, std::uint64_t late_us, bool repeats, bool stale) {
        const auto share = [&](bool possible = true) {
            return !possible || dice(2) == 0 ? 0.0 : 1e-4 * static_cast<double>(dice(most));
        };
        wire.faults = {.lost_request = share(),
                       .lost_answer = share(),
                       .corrupt = share(repeats),
                       .exception = share(),
                       .repeated = share(repeats),
                       .stale = share(stale),
                       .late = share(),
                       .late_us = 1 + dice(late_us)};
        text += " bad line";
    }
    struct DriveFault {
        std::size_t drive;
        std::size_t kind; ///< 0 to 3: an outage, which is arranged already
        std::uint64_t from_us;
    };
    /// @param bearable_us  an outage of half of this does no harm
    template <class Plant, std::size_t kinds>
    DriveFault spoil_drive(Plant& plant, std::uint64_t length_us, const std::array<const char*, kinds>& names,
                           std::uint64_t bearable_us) {
        const std::size_t i = dice(plant.drives.size());
        const std::uint64_t from_us = plant.began_us + dice(length_us);
        const std::uint64_t long_us = dice(4) == 0 ? 3'000'000 : 20'000 + dice(900'000);
        const Span span{from_us, from_us + long_us};
        const auto kind = dice(kinds);
        text += " drive " + std::to_string(i) + " " + names[kind] + " at " + std::to_string(from_us - plant.began_us) +
                " for " + std::to_string(long_us);
        outage = outage || kind < 4;
        fatal = fatal || kind >= 3 || long_us > bearable_us / 2;
        switch (kind) {
        case 0: plant.wires[plant.wires.size() == 1 ? 0 : i]->unplugged.push_back(span); break;
        case 1: plant.stations[i]->mute.push_back(span); break;
        case 2: plant.stations[i]->frozen.push_back(span); break;
        case 3: plant.stations[i]->mute.push_back({from_us, UINT64_MAX}); break;
        default: break;
        }
        return {i, kind, from_us};
    }
    /// Whoever plans does something when the port is in a phase up to `last`, or some time later.
    /// @param long_pauses  also of 75 s
    template <class Phase>
    PhaseAct<Phase> draw_act(Phase last, bool long_pauses) {
        return {.kind = static_cast<ActKind>(dice(static_cast<std::uint64_t>(ActKind::count))),
                .in = static_cast<Phase>(dice(static_cast<std::uint64_t>(last))),
                .after_us = dice(2) == 0 ? 0 : dice(40'000),
                .pause_us = long_pauses && dice(8) == 0 ? 75'000'000 : 1000 + dice(4'000'000)};
    }
    template <class Plant, class Phase>
    void add_act(Plant& plant, const PhaseAct<Phase>& act) {
        text += act.text();
        fatal = fatal || act.fatal();
        asked.also = act_in_phase(plant, asked, act);
    }
};

template <class Phase, class Event>
struct FaultedTally {
    std::map<std::string, int> endings;
    VisitedCells<Phase, Event> cells; ///< of the port's table
    double most_off = 0.0;            ///< off the path where it was held, of what is allowed
};

/// What the port has been through is counted at last.
template <class Plant, class Tally>
void finish_run(Plant& plant, FaultedRun& run, Tally& tally) {
    act_behind_end(plant, run.dice(8));
    CHECK((plant.port->poll().phase != splinefeed::hal::PortPhase::fault || plant.port->failure()));
    tally.cells.add(plant.port->phases());
}

/// A run that did not come to its end: what the port says of each drive is true, and who is confirmed stands.
template <class Plant, class Tally>
void judge_stop(Plant& plant, FaultedRun& run, double allowed_counts, Tally& tally) {
    using splinefeed::hal::StopState;
    bool all_held = true;
    bool all_confirmed = true;
    const std::uint64_t ended_us = plant.clock.now_us();
    const std::vector<double> ended_counts = plant.positions;
    std::vector<bool> confirmed;
    for (std::size_t i = 0; i < plant.models.size(); ++i) {
        const splinefeed::hal::StopReport report = plant.port->stop_report(i);
        const bool sure = report.state == StopState::confirmed;
        CHECK((sure || report.state == StopState::unconfirmed));
        CHECK((sure || run.outage || run.dishonest)); // who answers confirms
        all_held = all_held && report.held();
        all_confirmed = all_confirmed && sure;
        // What pushes it after its last answer nobody can know.
        const bool pushed_since = i == run.pushed_drive && run.pushed_to_us > report.status_us;
        confirmed.insert(confirmed.end(), static_cast<std::size_t>(plant.models[i]->axes()), sure && !pushed_since);
    }
    ++tally.endings[all_held ? "held" : all_confirmed ? "stopped" : "unconfirmed"];
    if (all_held && !run.dishonest) {
        CHECK(plant.now_off_counts < allowed_counts);
        tally.most_off = std::max(tally.most_off, plant.now_off_counts / allowed_counts);
    }
    finish_run(plant, run, tally);
    plant.port.reset();
    plant.events.clear();
    plant.clock.sleep_us(800'000);
    for (std::size_t k = 0; k < confirmed.size(); ++k) {
        INFO("axis " << k << " moved until " << static_cast<std::int64_t>(plant.moved_us[k] - ended_us)
                     << " us behind the end, by " << plant.positions[k] - ended_counts[k] << " counts");
        CHECK((!confirmed[k] || plant.moved_us[k] <= ended_us || run.dishonest));
    }
}

/// The runs of as many seeds, or of the one that SPLINEFEED_SEED names. With `many` of them every cell is visited.
template <class Phase, class Event, class RunSeed>
void run_seeds(int few, int many, const std::vector<NeverVisited<Phase, Event>>& never, RunSeed&& run_seed) {
    const char* const only = std::getenv("SPLINEFEED_SEED");
    const std::uint64_t first = only != nullptr ? std::strtoull(only, nullptr, 10) : 1;
    const int runs = only != nullptr ? 1 : rounds(few, many);
    FaultedTally<Phase, Event> tally;
    for (int run = 0; run < runs; ++run) {
        run_seed(first + static_cast<std::uint64_t>(run), tally);
    }
    std::string text;
    for (const auto& [ending, count] : tally.endings) {
        text += ending + " " + std::to_string(count) + ", ";
    }
    const std::string missed = tally.cells.missed(never);
    WARN(runs << " runs from seed " << first << ": " << text << "cells not visited:" << missed
              << "; off the path when held up to " << 100.0 * tally.most_off << " % of what is allowed");
    CHECK((only != nullptr || tally.endings.size() >= 4));
    tally.cells.require_unvisited(never);
    CHECK((runs < many || missed == " none"));
}

} // namespace splinefeed_test
