// SPDX-License-Identifier: MIT
// The phases of a ModbusPort: no drive, whatever it reports or leaves undone, keeps the port in one for ever.
#include "ports/pvt_plant.hpp"
#include "ports/run_plant.hpp"
#include "ports/visited_cells.hpp"
#include "support/catch.hpp"

#include <set>

using namespace splinefeed::hal;
using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;

namespace {

const SmoothMotion motion = smooth_motion(20000.0, 2, 150, 2000);

using Problems = std::set<DriveProblem>;

/// What the second of three drives does from an instant of the run on, and what the port may say of it.
struct Lie {
    const char* what;
    std::function<std::function<void(PvtStatus&)>(const PvtStatus& then)> make; ///< by its status at that instant
    std::optional<PvtCommand> ignores;
    Problems says; ///< empty: the run comes to its end
};

const auto same = [](void (*lie)(PvtStatus&)) {
    return [lie](const PvtStatus&) {
        return lie;
    };
};

const std::vector<Lie> lies{
    {"state 6", same([](PvtStatus& s) { s.state = PvtState::homing; }), {}, {DriveProblem::not_standing}},
    {"state 99", same([](PvtStatus& s) { s.state = static_cast<PvtState>(99); }), {}, {DriveProblem::unknown_state}},
    {"always running",
     same([](PvtStatus& s) { s.state = PvtState::running; }),
     {},
     {DriveProblem::not_standing, DriveProblem::unfinished}},
    {"always stopping", same([](PvtStatus& s) { s.state = PvtState::stopping; }), {}, {DriveProblem::not_standing}},
    {"always standing",
     same([](PvtStatus& s) { s.state = PvtState::standing; }),
     {},
     {DriveProblem::frozen, DriveProblem::refused}},
    {"disabled", same([](PvtStatus& s) { s.state = PvtState::disabled; }), {}, {DriveProblem::switched_off}},
    {"executed frozen",
     [](const PvtStatus& then) {
         return [executed = then.executed](PvtStatus& s) {
             s.executed = executed;
         };
     },
     {},
     {DriveProblem::frozen, DriveProblem::unfinished}},
    {"next frozen",
     [](const PvtStatus& then) {
         return [next = then.next](PvtStatus& s) {
             s.next = next;
             s.executed = pvt::earlier(s.executed, next);
         };
     },
     {},
     {DriveProblem::takes_nothing, DriveProblem::frozen}},
    {"free = 0", same([](PvtStatus& s) { s.free = 0; }), {}, {DriveProblem::takes_nothing}},
    {"everything refused", same([](PvtStatus& s) { s.refused = PvtRefusal::state; }), {}, {DriveProblem::refused}},
    {"no room for anything", same([](PvtStatus& s) { s.refused = PvtRefusal::no_room; }), {}, {DriveProblem::ignores}},
    {"segments that were never sent", same([](PvtStatus& s) { s.next += 5000; }), {}, {DriveProblem::out_of_step}},
    {"executed beyond next", same([](PvtStatus& s) { s.executed = s.next + 1; }), {}, {DriveProblem::out_of_step}},
    {"its session is gone", same([](PvtStatus& s) { s.refused = PvtRefusal::session; }), {}, {DriveProblem::taken}},
    {"the clock stands",
     [](const PvtStatus& then) {
         return [clock_us = then.clock_us](PvtStatus& s) {
             s.clock_us = clock_us;
         };
     },
     {},
     {DriveProblem::frozen}},
    {"a dithering shaft", same([](PvtStatus& s) { s.position[0] += s.nonce % 2 == 0 ? 3 : -3; }), {}, {}},
    {"no start", {}, PvtCommand::start, {DriveProblem::ignores}},
    {"no resume", {}, PvtCommand::resume, {DriveProblem::ignores}},
    {"no end", {}, PvtCommand::end, {}},
    {"no hold", {}, PvtCommand::hold, {}},
};

using Cells = VisitedCells<ModbusPhase, ModbusEvent>;

struct Told {
    PortPhase phase = PortPhase::running;
    PortFailure failure;
    std::uint64_t took_us = 0;
};

Told run_with(const Lie& lie, std::uint64_t from_us, const Asked& asked, Cells& visits) {
    PvtPlant plant({});
    plant.begin(motion);
    plant.events.emplace_back(plant.began_us + from_us, [&] {
        LyingDrive& liar = *plant.liars[1];
        liar.ignores = lie.ignores;
        liar.lie = lie.make ? lie.make(plant.port->report(1).status) : liar.lie;
    });
    if (from_us > 0) { // a gap of its link, so that it is stopped and resumed on the way
        plant.wires[0]->unplugged.push_back({plant.began_us + 450'000, plant.began_us + 900'000});
    }
    const PortPhase phase = run(plant, motion, asked);
    Told told{phase, plant.port->failure(), plant.clock.now_us() - plant.began_us};
    plant.port->power_off(); // whatever its end
    visits.add(plant.port->phases());
    plant.events.clear();
    // Who tells the truth stands, and has no power; the first one may be away just then.
    CHECK(plant.port->stop_report(2).state == StopState::confirmed);
    plant.port.reset();
    return told;
}

} // namespace

TEST_CASE("PVT port, virtual: whatever a drive reports or leaves undone, the run ends, and says it of that drive",
          "[ports]") {
    Cells visits;
    for (const Lie& lie : lies) {
        for (const std::uint64_t from_us : {0U, 300'000U}) {
            const Told told = run_with(lie, from_us, {}, visits);
            INFO(lie.what << " from " << from_us << " us on: " << told.failure.what);
            CHECK(told.phase != PortPhase::running);
            CHECK(told.took_us < 12'000'000);
            CHECK((told.phase == PortPhase::idle) == !told.failure);
            if (told.failure) {
                CHECK(told.failure.drive == 1);
                CHECK(std::any_of(lie.says.begin(), lie.says.end(),
                                  [&](DriveProblem problem) { return names(told.failure, problem); }));
            }
        }
    }
    const Lie nothing{"nothing", {}, {}, {}};
    for (const std::uint64_t hold_us : {0U, 60'000U, 200'000U, 350'000U, 500'000U, 800'000U}) {
        const std::uint64_t quick_us = hold_us + 10'000;
        CHECK(run_with(nothing, 1'000'000, {.hold_us = hold_us, .quick_us = quick_us}, visits).phase ==
              PortPhase::halted);
    }
    std::vector<Cells::Never> never{
        {{ModbusPhase::halting}, {ModbusEvent::overdue}, "a StopSequence ends before: it has bounds of its own"},
        {{ModbusPhase::filling}, {ModbusEvent::executed}, "motions without segments are not run"},
        {{ModbusPhase::starting}, {ModbusEvent::stop}, "it lasts for some ms: pvt_stop_test.cpp asks for holds then"},
        {{ModbusPhase::stopping, ModbusPhase::waiting},
         {ModbusEvent::stop},
         "no run of this test asks for a stop just then"},
        {{ModbusPhase::waiting}, {ModbusEvent::executed}, "no run of this test stops at its last segment"},
        {{ModbusPhase::starting, ModbusPhase::running, ModbusPhase::stopping},
         {ModbusEvent::broken},
         "of a segment out of range: pvt_counters_test.cpp"},
        {{ModbusPhase::halted, ModbusPhase::done, ModbusPhase::fault},
         {ModbusEvent::renewed},
         "a run has one motion: pvt_renew_test.cpp has more"},
        {{ModbusPhase::done}, {ModbusEvent::broken}, "it comes behind complete(): an error of the caller"},
    };
    for (std::size_t i = 0; i < ModbusPhases::phases; ++i) {
        for (std::size_t j = 0; j < ModbusPhases::events; ++j) {
            if (modbus_phase_table()[i][j] == static_cast<ModbusPhase>(i)) {
                never.push_back({{static_cast<ModbusPhase>(i)}, {static_cast<ModbusEvent>(j)}, "it changes nothing"});
            }
        }
    }
    CHECK(visits.missed(never) == " none");
}
