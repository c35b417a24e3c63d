// SPDX-License-Identifier: MIT
// The phases of a ModbusPort: no drive, whatever it reports or leaves undone, keeps the port in one for ever; and the
// page of docs has the table by which the port goes.
#include "ports/pvt_plant.hpp"
#include "ports/run_plant.hpp"
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

struct Told {
    PortPhase phase = PortPhase::running;
    std::optional<DriveFailure> failure;
    std::uint64_t took_us = 0;
};

Told run_with(const Lie& lie, std::uint64_t from_us, const Asked& asked, ModbusPhases* phases = nullptr) {
    PvtPlant plant({});
    plant.make();
    plant.sample_positions();
    REQUIRE_FALSE(plant.port->open());
    REQUIRE_FALSE(plant.port->prepare(motion.segments.front()));
    plant.began_us = plant.clock.now_us();
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
    if (phases != nullptr) {
        *phases = plant.port->phases();
    }
    plant.events.clear();
    for (std::size_t i = 0; i < 3; ++i) { // who tells the truth stands
        CHECK((i == 1 || plant.port->stop_report(i).request == StopRequest::none ||
               plant.port->stop_report(i).state == StopState::confirmed));
    }
    plant.port.reset();
    return told;
}

} // namespace

TEST_CASE("PVT port, virtual: whatever a drive reports or leaves undone, the run ends, and says it of that drive",
          "[ports]") {
    for (const Lie& lie : lies) {
        for (const std::uint64_t from_us : {0U, 300'000U}) {
            const Told told = run_with(lie, from_us, {});
            INFO(lie.what << " from " << from_us
                          << " us on: " << (told.failure ? describe(told.failure->problem) : "no failure"));
            CHECK(told.phase != PortPhase::running);
            CHECK(told.took_us < 12'000'000);
            CHECK((told.phase == PortPhase::idle) == !told.failure);
            if (told.failure) {
                CHECK(told.failure->drive == 1);
                CHECK(lie.says.count(told.failure->problem) == 1);
            }
        }
    }
}
