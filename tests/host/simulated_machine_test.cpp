// SPDX-License-Identifier: MIT
//
// Motions are made as the stream makes them: samples of a position become control points of a uniform B-spline.
#include "host_sim/simulated_machine.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <random>
#include <stdexcept>

using namespace splinefeed;
using namespace splinefeed::host;
using hal::PortPhase;

namespace {

constexpr std::uint32_t millisecond = 8000; // ticks
constexpr double period_s = 1e-3;

using Motion = std::vector<FeedSegment>;

MachineDescription machine_of(std::vector<std::string> names) {
    MachineDescription machine;
    machine.settings.axes = static_cast<int>(names.size());
    machine.settings.max_feed_mm_s = 1000.0;
    for (unsigned k = 0; k < names.size(); ++k) {
        machine.axis_name[k] = names[k];
        machine.settings.axis[k] = {100.0, 1000.0, 0.0, 1000.0};
    }
    return machine;
}

std::int64_t units(double mm) {
    return std::llround(mm * 1000.0 * static_cast<double>(units_per_count));
}

// Samples [mm] of one axis of `axes`; the others stand still.
Motion motion_of(const std::vector<long double>& samples, unsigned axis = 0, std::uint32_t duration = millisecond) {
    const long double sixths = 1000.0L * static_cast<long double>(units_per_count) / 6.0L;
    std::vector<std::int64_t> c(3, std::llround(samples.front() * sixths));
    for (const long double sample : samples) {
        c.push_back(std::llround(sample * sixths));
    }
    c.insert(c.end(), 3, c.back());
    Motion motion;
    for (std::size_t i = 1; i + 2 < c.size(); ++i) {
        FeedSegment segment;
        segment.index = motion.size();
        segment.waypoint = static_cast<std::uint32_t>(motion.size() / 10);
        segment.duration_ticks = duration;
        segment.start[axis] = c[i - 1] + 4 * c[i] + c[i + 1];
        segment.end[axis] = c[i] + 4 * c[i + 1] + c[i + 2];
        segment.start_velocity[axis] = 3 * (c[i + 1] - c[i - 1]);
        segment.end_velocity[axis] = 3 * (c[i + 2] - c[i]);
        motion.push_back(segment);
    }
    return motion;
}

void repeat(std::vector<long double>& list, int n, long double value) {
    list.insert(list.end(), static_cast<std::size_t>(n), value);
}

// Positions from rest with these second differences [mm/s^2].
std::vector<long double> integrated(const std::vector<long double>& accelerations) {
    std::vector<long double> q{0.0L, 0.0L, 0.0L};
    for (const long double a : accelerations) {
        q.push_back(2.0L * q.back() - q[q.size() - 2] + a * 1e-6L);
    }
    return q;
}

// From rest to `velocity`, and to rest again, at this acceleration at most.
Motion there(double velocity, double acceleration, unsigned axis = 0) {
    const int n = static_cast<int>(std::ceil(velocity / (acceleration * period_s)));
    const long double a = static_cast<long double>(velocity) / (n * 1e-3L);
    std::vector<long double> list;
    repeat(list, n, a);
    repeat(list, 10, 0.0L);
    repeat(list, n, -a);
    repeat(list, 3, 0.0L);
    return motion_of(integrated(list), axis);
}

// A raw segment of axis 0 from rest at 0 to `end_mm`, `duration` long.
FeedSegment stroke(double end_mm, std::uint32_t duration, std::int64_t end_velocity = 0) {
    FeedSegment segment;
    segment.duration_ticks = duration;
    segment.end[0] = units(end_mm);
    segment.end_velocity[0] = end_velocity;
    return segment;
}

PortPhase run(SimulatedMachine& machine, const Motion& motion) {
    for (const FeedSegment& segment : motion) {
        while (machine.room() == 0) {
            machine.poll();
        }
        if (!machine.submit(segment)) {
            return machine.poll().phase;
        }
    }
    PortPhase phase = PortPhase::running;
    while (phase == PortPhase::running) {
        phase = machine.poll().phase;
    }
    return phase;
}

std::string fault_of(const MachineDescription& description, const Motion& motion,
                     const SimulationOptions& options = {}) {
    SimulatedMachine machine(description, 1, options);
    run(machine, motion);
    return machine.fault() ? fault_name(machine.fault()->kind) : "none";
}

struct Row {
    double t;
    double x;
    double speed;
};

struct Recorder final : TraceSink {
    std::vector<Row> rows;
    std::size_t breaks_at = 1000000;
    void row(double t_s, const PerAxis<double>& position_mm, double speed_mm_s) override {
        if (rows.size() == breaks_at) {
            throw std::runtime_error("disk full");
        }
        rows.push_back({t_s, position_mm[0], speed_mm_s});
    }
};

constexpr double over = 1.0 + 1e-5;
constexpr double hardly_over = 1.0 + 1e-9;

} // namespace

TEST_CASE("a motion within the limits is executed to the last count") {
    SimulatedMachine machine(machine_of({"x"}), 1);
    const Motion motion = there(80.0, 400.0);
    CHECK(run(machine, motion) == PortPhase::idle);
    CHECK_FALSE(machine.fault());
    CHECK(machine.segments() == motion.size());
    CHECK(machine.cycle_time_s() == static_cast<double>(motion.size()) * 0.001);
    CHECK(machine.use(0).velocity == Approx(0.8).epsilon(1e-9));
    CHECK(machine.use(0).acceleration == Approx(0.4).epsilon(1e-7));
    CHECK(machine.use(0).jerk == 0.0);
    CHECK(machine.max_path_speed_mm_s() == Approx(80.0).epsilon(1e-9));
    const double end = static_cast<double>(motion.back().end[0]) / (1000.0 * static_cast<double>(units_per_count));
    CHECK(machine.position_mm()[0] == end);
    CHECK(machine.counts(0) == std::llround(end * 1000.0));
    CHECK(machine.pulses(0) == static_cast<std::uint64_t>(machine.counts(0)));
}

TEST_CASE("pulses count to and fro") {
    SimulatedMachine machine(machine_of({"x"}), 1);
    Motion motion = there(50.0, 500.0);
    const std::int64_t far = (motion.back().end[0] + units_per_count / 2) / units_per_count;
    for (std::size_t i = motion.size(); i-- > 0;) {
        FeedSegment back = motion[i];
        std::swap(back.start, back.end);
        std::swap(back.start_velocity, back.end_velocity);
        back.start_velocity[0] = -back.start_velocity[0];
        back.end_velocity[0] = -back.end_velocity[0];
        motion.push_back(back);
    }
    CHECK(run(machine, motion) == PortPhase::idle);
    CHECK(machine.counts(0) == 0);
    CHECK(machine.pulses(0) == 2 * static_cast<std::uint64_t>(far));
}

TEST_CASE("each limit is kept to 1e-5 and forgiven to 1e-9") {
    MachineDescription machine = machine_of({"x", "y"});
    const unsigned axis = GENERATE(0U, 1U);
    SECTION("velocity") {
        CHECK(fault_of(machine, there(100.0 * over, 500.0, axis)) == "velocity");
        CHECK(fault_of(machine, there(100.0 * hardly_over, 500.0, axis)) == "none");
    }
    SECTION("acceleration") {
        CHECK(fault_of(machine, there(50.0 * over, 1000.0 * over, axis)) == "acceleration");
        CHECK(fault_of(machine, there(50.0 * hardly_over, 1000.0 * hardly_over, axis)) == "none");
    }
    SECTION("path speed") {
        machine.settings.max_feed_mm_s = 60.0;
        CHECK(fault_of(machine, there(60.0 * over, 500.0, axis)) == "feed");
        CHECK(fault_of(machine, there(60.0 * hardly_over, 500.0, axis)) == "none");
    }
    SECTION("jerk") {
        machine.settings.axis[axis].max_jerk_mm_s3 = 20000.0;
        const auto ramp = [&](long double jerk) {
            std::vector<long double> list;
            for (const int sign : {1, -1, -1, 1}) {
                for (int i = 1; i <= 20; ++i) {
                    list.push_back((list.empty() ? 0.0L : list.back()) + sign * jerk * 1e-3L);
                }
            }
            repeat(list, 3, 0.0L);
            return motion_of(integrated(list), axis);
        };
        CHECK(fault_of(machine, ramp(20000.0L * static_cast<long double>(over))) == "jerk");
        CHECK(fault_of(machine, ramp(20000.0L * static_cast<long double>(hardly_over))) == "none");
        CHECK(fault_of(machine, there(50.0, 30.0, axis)) == "jerk"); // the step of 30 mm/s^2 in a millisecond
        SimulatedMachine measured(machine, 1);
        run(measured, ramp(10000.0L));
        CHECK(measured.use(static_cast<int>(axis)).jerk == Approx(0.5).epsilon(1e-5));
        CHECK(measured.use(1 - static_cast<int>(axis)).jerk == 0.0);
    }
    SECTION("travel") {
        const double end = 200.0;
        const Motion up = motion_of({0.0L}, axis);
        Motion motion = up;
        motion.front().end[axis] = units(end);
        motion.front().duration_ticks = 8000 * 10000;
        motion.resize(1);
        machine.travel[axis] = Travel{-10.0, end * hardly_over};
        CHECK(fault_of(machine, motion) == "none");
        machine.travel[axis] = Travel{-10.0, end / hardly_over};
        CHECK(fault_of(machine, motion) == "none");
        machine.travel[axis] = Travel{-10.0, end / over};
        CHECK(fault_of(machine, motion) == "travel");
        motion.front().end[axis] = -units(10.0 * hardly_over);
        CHECK(fault_of(machine, motion) == "none");
        motion.front().end[axis] = -units(10.0 + 210.0 * 1e-5);
        CHECK(fault_of(machine, motion) == "travel");
    }
}

TEST_CASE("a machine that starts beyond its travel is stopped before it moves") {
    MachineDescription description = machine_of({"x"});
    description.travel[0] = Travel{1.0, 10.0};
    SimulatedMachine machine(description, 1);
    CHECK(run(machine, there(50.0, 500.0)) == PortPhase::fault);
    CHECK(machine.fault()->time_s == 0.0);
    CHECK(machine.segments() == 0);
}

TEST_CASE("velocity between ticks and between segment ends is seen") {
    const int ticks = GENERATE(1, 3, 8);
    const MachineDescription machine = machine_of({"x"});
    // from rest to rest in 1 s: the peak is 1.5 times the mean, in the middle, where 1 and 3 ticks do not look
    CHECK(fault_of(machine, {stroke(100.0 * over / 1.5, 8000000)}, {.ticks_per_segment = ticks}) == "velocity");
    CHECK(fault_of(machine, {stroke(100.0 * hardly_over / 1.5, 8000000)}, {.ticks_per_segment = ticks}) == "none");
    SimulatedMachine slow(machine, 1, {.ticks_per_segment = ticks});
    run(slow, {stroke(100.0 * over / 1.5, 8000000)});
    CHECK(slow.fault()->time_s == Approx(0.5));
    CHECK(slow.fault()->value == Approx(100.0 * over));
}

TEST_CASE("acceleration is seen at the start and at the end of a segment") {
    // D = 10 mm in 1 s, m1 = 7.5 mm/s: 45 mm/s^2 at the start, -30 at the end
    const FeedSegment early = stroke(10.0, 8000000, units(7.5));
    MachineDescription machine = machine_of({"x"});
    machine.settings.axis[0].max_acceleration_mm_s2 = 45.0 / over;
    CHECK(fault_of(machine, {early}) == "acceleration");
    SimulatedMachine measured(machine_of({"x"}), 1);
    static_cast<void>(measured.submit(early));
    measured.poll();
    CHECK(measured.use(0).acceleration == Approx(0.045).epsilon(1e-9));
    SimulatedMachine late(machine_of({"x"}), 1);
    static_cast<void>(late.submit(stroke(10.0, 8000000, units(30.0))));
    late.poll();
    CHECK(late.use(0).acceleration == Approx(0.06).epsilon(1e-9)); // -6 D + 4 m1 = 60, at the start 6 D - 2 m1 = 0
}

TEST_CASE("path speed between ticks is seen") {
    // m1 = 0.75 D: the peak is 1.35 D/T at u = 0.6
    const FeedSegment segment = stroke(1000.0 / 15.0, 8000000, units(50.0));
    const auto with_feed = [&](double feed) {
        MachineDescription machine = machine_of({"x"});
        machine.settings.max_feed_mm_s = feed;
        SimulatedMachine simulated(machine, 1, {.ticks_per_segment = 8});
        static_cast<void>(simulated.submit(segment));
        simulated.poll();
        return simulated.fault() ? fault_name(simulated.fault()->kind) : "none";
    };
    CHECK(with_feed(90.0 / over) == std::string("feed"));
    CHECK(with_feed(90.0 * 1.0000001) == std::string("none"));
}

TEST_CASE("the path is made of x, y and z, or of all axes where there are none of these") {
    const auto speed = [](std::vector<std::string> names) {
        SimulatedMachine machine(machine_of(std::move(names)), 1);
        Motion motion = there(40.0, 500.0, 0);
        for (FeedSegment& segment : motion) {
            segment.start[1] = segment.start[0] / 4 * 3;
            segment.end[1] = segment.end[0] / 4 * 3;
            segment.start_velocity[1] = segment.start_velocity[0] / 4 * 3;
            segment.end_velocity[1] = segment.end_velocity[0] / 4 * 3;
        }
        run(machine, motion);
        return machine.max_path_speed_mm_s();
    };
    CHECK(speed({"x", "z"}) == Approx(50.0));
    CHECK(speed({"x", "a"}) == Approx(40.0));
    CHECK(speed({"c", "y"}) == Approx(30.0));
    CHECK(speed({"a", "b"}) == Approx(50.0));
}

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
    description.travel[0] = Travel{0.0, 1.0};
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

TEST_CASE("a trace that cannot be written stops the machine, and finish says why") {
    Recorder recorder;
    recorder.breaks_at = 5;
    SimulatedMachine machine(machine_of({"x"}), 1, {.trace = &recorder});
    CHECK(run(machine, there(50.0, 500.0)) == PortPhase::fault);
    CHECK(machine.fault()->kind == FaultKind::trace);
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
