// SPDX-License-Identifier: MIT
//
// What the machine does about segments that do not join, faults, running dry and its trace.
#include "host_sim/machine/simulated_machine.hpp"

#include "support/catch.hpp"
#include "support/machine_motion.hpp"

#include <random>

using namespace splinefeed;
using namespace splinefeed::host;

TEST_CASE("a broken chain is a fault at once, down to one unit") {
    const MachineDescription description = machine_of({"x", "y"});
    Motion motion = there(50.0, 500.0, 1);
    const std::size_t at = 57;
    std::string quantity = "position";
    SECTION("position up") {
        motion[at].start[1] += 1;
    }
    SECTION("position down") {
        motion[at].start[1] -= 1;
    }
    SECTION("velocity") {
        motion[at].start_velocity[1] += 1;
        quantity = "velocity";
    }
    SECTION("lost segment") {
        motion.erase(motion.begin() + at);
    }
    SECTION("repeated segment") {
        motion.insert(motion.begin() + at, motion[at - 1]);
    }
    SECTION("other duration") { // the same units per segment are another velocity
        motion[at].duration_ticks *= 2;
        quantity = "velocity";
    }
    for (const bool enforce : {true, false}) {
        SimulatedMachine machine(description, 1, {.enforce = enforce});
        CHECK(run(machine, motion) == PortPhase::fault);
        REQUIRE(machine.fault());
        CHECK(machine.fault()->kind == FaultKind::chain);
        CHECK(machine.fault()->axis == "y");
        CHECK(machine.segments() == at);
        CHECK(describe(*machine.fault()).find(quantity + " is off by") != std::string::npos);
        CHECK(machine.position_mm()[1] * 1000.0 * static_cast<double>(units_per_count) ==
              Approx(static_cast<double>(motion[at - 1].end[1])));
    }
}

TEST_CASE("the chain is a matter of velocity, not of units per segment") {
    Motion motion = there(50.0, 500.0);
    for (std::size_t i = 40; i < motion.size(); ++i) {
        motion[i].duration_ticks *= 2;
    }
    CHECK(fault_of(machine_of({"x"}), motion) == "chain");
    FeedSegment first = stroke(1.0, 8000000, units(1.0)); // ends at 1 mm/s
    FeedSegment second = stroke(2.0, 16000000);
    second.start = first.end;
    second.start_velocity[0] = units(2.0); // 2 mm in 2 s
    CHECK(fault_of(machine_of({"x"}), {first, second}) == "none");
}

TEST_CASE("the first segment may start anywhere, but at rest") {
    FeedSegment segment = stroke(5.0, 8000000);
    segment.start[0] = units(4.5);
    CHECK(fault_of(machine_of({"x"}), {segment}) == "none");
    segment.start_velocity[0] = 1;
    CHECK(fault_of(machine_of({"x"}), {segment}) == "chain");
}

TEST_CASE("a segment without duration is a fault") {
    CHECK(fault_of(machine_of({"x"}), {stroke(0.0, 0)}) == "duration");
}

TEST_CASE("a fault freezes the machine") {
    SimulatedMachine machine(machine_of({"x"}), 1);
    const Motion motion = there(100.0 * 1.5, 500.0);
    CHECK(run(machine, motion) == PortPhase::fault);
    REQUIRE(machine.fault());
    const Fault fault = *machine.fault();
    CHECK(fault.kind == FaultKind::velocity);
    CHECK(fault.axis == "x");
    CHECK(fault.limit == 100.0);
    CHECK(fault.value > 100.0);
    CHECK(fault.value < 100.0 + 1.001 * 500.0 * period_s / 8.0); // the first tick above the limit
    CHECK(fault.time_s == Approx(0.2).margin(0.005));
    CHECK(fault.waypoint == motion[machine.segments()].waypoint);
    CHECK(describe(fault).find("axis x: velocity 100.") == 0);
    CHECK(describe(fault).find("mm/s is above the limit of 100 mm/s, at t = 0.2") != std::string::npos);
    const std::uint64_t segments = machine.segments();
    const std::int64_t counts = machine.counts(0);
    const auto pulses = machine.pulses(0);
    CHECK_FALSE(machine.submit(motion[segments]));
    for (int i = 0; i < 5; ++i) {
        const hal::PortState state = machine.poll();
        CHECK(state.phase == PortPhase::fault);
        CHECK(state.executed == segments);
    }
    CHECK(machine.counts(0) == counts);
    CHECK(machine.pulses(0) == pulses);
    CHECK(machine.fault()->time_s == fault.time_s);
    CHECK(std::llround(machine.position_mm()[0] * 1000.0) == counts);
}

TEST_CASE("the first of several violations is the one reported") {
    MachineDescription description = machine_of({"x", "y"});
    description.settings.max_feed_mm_s = 60.0;
    SimulatedMachine machine(description, 1);
    run(machine, there(150.0, 500.0));
    CHECK(machine.fault()->kind == FaultKind::feed);
    CHECK(machine.fault()->axis.empty());
    CHECK(describe(*machine.fault()).find("path: feed 60.") == 0);
    CHECK(machine.fault()->time_s == Approx(0.12).margin(0.005));
}

TEST_CASE("without enforcement the use of the limits is measured and nothing stops") {
    MachineDescription description = machine_of({"x"});
    description.settings.max_feed_mm_s = 50.0;
    description.travel[0] = splinefeed::host::Travel{0.0, 1.0};
    SimulatedMachine machine(description, 1, {.enforce = false});
    CHECK(run(machine, there(150.0, 3000.0)) == PortPhase::idle);
    CHECK_FALSE(machine.fault());
    CHECK(machine.use(0).velocity == Approx(1.5));
    CHECK(machine.use(0).acceleration == Approx(3.0));
    CHECK(machine.max_path_speed_mm_s() == Approx(150.0));
}

TEST_CASE("running dry in motion is a fault, at rest it is not") {
    SimulatedMachine machine(machine_of({"x"}), 1);
    CHECK(machine.poll().phase == PortPhase::idle);
    Motion motion = there(50.0, 500.0);
    motion.resize(motion.size() / 2);
    CHECK(run(machine, motion) == PortPhase::fault);
    CHECK(machine.fault()->kind == FaultKind::underrun);
    CHECK(machine.fault()->value == Approx(50.0));
    CHECK(machine.fault()->waypoint == motion.back().waypoint);
}

TEST_CASE("halt drops what is queued") {
    SimulatedMachine machine(machine_of({"x"}), 1, {.queue = 4});
    const Motion motion = there(50.0, 500.0);
    CHECK(machine.room() == 4);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(machine.submit(motion[i]));
    }
    CHECK(machine.room() == 0);
    CHECK_FALSE(machine.submit(motion[4]));
    CHECK(machine.poll().executed == 1);
    CHECK(machine.room() == 1);
    machine.halt();
    CHECK(machine.poll().phase == PortPhase::halted);
    CHECK(machine.poll().executed == 1);
    CHECK_FALSE(machine.submit(motion[1]));
    CHECK_FALSE(machine.fault());
}

TEST_CASE("the trace has a row per sample period and one for an incomplete last") {
    const Motion motion = there(50.0, 500.0);
    const int per_sample = GENERATE(1, 4, 8);
    Recorder recorder;
    SimulatedMachine machine(machine_of({"x"}), per_sample, {.trace = &recorder});
    CHECK(recorder.rows.empty());
    run(machine, motion);
    const std::size_t whole = motion.size() / static_cast<std::size_t>(per_sample);
    const bool incomplete = motion.size() % static_cast<std::size_t>(per_sample) != 0;
    CHECK(recorder.rows.size() == whole + 1);
    machine.finish();
    machine.finish();
    REQUIRE(recorder.rows.size() == whole + 1 + (incomplete ? 1 : 0));
    for (std::size_t i = 0; i <= whole; ++i) {
        const Row& row = recorder.rows[i];
        const std::size_t n = i * static_cast<std::size_t>(per_sample);
        CHECK(row.t == static_cast<double>(n) / 1000.0);
        const std::int64_t position = n == 0 ? motion[0].start[0] : motion[n - 1].end[0];
        const std::int64_t velocity = n == 0 ? 0 : motion[n - 1].end_velocity[0];
        CHECK(row.x == static_cast<double>(position) / (1000.0 * static_cast<double>(units_per_count)));
        CHECK(row.speed == Approx(static_cast<double>(std::abs(velocity)) / (static_cast<double>(units_per_count))));
    }
    CHECK(recorder.rows.back().x == machine.position_mm()[0]);
    CHECK(recorder.rows.back().t == machine.cycle_time_s());
}

TEST_CASE("a trace that cannot be written is no fault of the machine, and finish says why") {
    Recorder recorder;
    recorder.breaks_at = 5;
    SimulatedMachine machine(machine_of({"x"}), 1, {.trace = &recorder});
    CHECK(run(machine, there(50.0, 500.0)) == PortPhase::idle);
    CHECK_FALSE(machine.fault().has_value());
    CHECK(machine.trace_failure() != nullptr);
    CHECK_THROWS_WITH(machine.finish(), "disk full");
}

TEST_CASE("the check does not depend on the number of ticks") {
    std::mt19937 random(11);
    std::vector<long double> samples{0.0L};
    std::uniform_real_distribution<double> step(-0.02, 0.02);
    for (int i = 0; i < 300; ++i) {
        samples.push_back(samples.back() + static_cast<long double>(step(random)));
    }
    SimulatedMachine coarse(machine_of({"x"}), 1, {.enforce = false, .ticks_per_segment = 1});
    SimulatedMachine fine(machine_of({"x"}), 1, {.enforce = false, .ticks_per_segment = 100});
    run(coarse, motion_of(samples));
    run(fine, motion_of(samples));
    CHECK(coarse.use(0).velocity == fine.use(0).velocity);
    CHECK(coarse.use(0).acceleration == fine.use(0).acceleration);
    CHECK(coarse.counts(0) == fine.counts(0));
    CHECK(coarse.pulses(0) <= fine.pulses(0));
    // path speed of one axis is that axis' speed, which is known exactly
    CHECK(fine.max_path_speed_mm_s() == Approx(fine.use(0).velocity * 100.0).epsilon(1e-9));
}
