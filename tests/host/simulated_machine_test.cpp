// SPDX-License-Identifier: MIT
//
// What the machine checks and counts while segments move it.
#include "host_sim/machine/simulated_machine.hpp"

#include "support/catch.hpp"
#include "support/machine_motion.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

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

TEST_CASE("a machine that measures nothing counts the time, and sees a broken chain") {
    SimulatedMachine machine(machine_of({"x"}), 1, {.enforce = false, .measures = false});
    Motion motion = there(80.0 * over * 2.0, 4000.0);
    CHECK(run(machine, motion) == PortPhase::idle);
    CHECK(machine.cycle_time_s() == static_cast<double>(motion.size()) * 0.001);
    CHECK(machine.position_mm()[0] ==
          static_cast<double>(motion.back().end[0]) / (1000.0 * static_cast<double>(units_per_count)));
    CHECK(machine.use(0).velocity == 0.0);
    SimulatedMachine other(machine_of({"x"}), 1, {.enforce = false, .measures = false});
    motion[5].start[0] += 1;
    CHECK(run(other, motion) == PortPhase::fault);
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
    SECTION("velocity near the end of the travel") {
        const Motion motion = there(20.0, 500.0, axis); // to 1 mm, 20 mm/s from 0.4 to 0.6 mm
        machine.travel[axis] = Travel{-10.0, 10.5};
        machine.settings.axis[axis].travel_end_zone_mm = 10.0;
        machine.settings.axis[axis].travel_end_velocity_mm_s = 20.0 / hardly_over;
        CHECK(fault_of(machine, motion) == "none");
        machine.settings.axis[axis].travel_end_velocity_mm_s = 20.0 / over;
        CHECK(fault_of(machine, motion) == "travel end");
        machine.travel[axis] = Travel{-10.0, 10.9};
        CHECK(fault_of(machine, motion) == "none");
        machine.travel[axis] = Travel{-9.5, 90.0};
        CHECK(fault_of(machine, motion) == "travel end");
    }
    SECTION("braking") {
        const auto with_braking = [&](double limit, double acceleration) {
            machine.settings.axis[axis].max_braking_mm_s2 = limit;
            Motion motion = there(acceleration / 20.0, acceleration, axis);
            const std::string up = fault_of(machine, motion);
            for (FeedSegment& segment : motion) { // the same downwards
                segment.end[axis] = -segment.end[axis];
                segment.start[axis] = -segment.start[axis];
                segment.start_velocity[axis] = -segment.start_velocity[axis];
                segment.end_velocity[axis] = -segment.end_velocity[axis];
            }
            CHECK(fault_of(machine, motion) == up);
            return up;
        };
        CHECK(with_braking(500.0, 500.0 * over) == "braking");
        CHECK(with_braking(500.0, 500.0 * hardly_over) == "none");
        CHECK(with_braking(5000.0, 1000.0 * over) == "acceleration");
        machine.settings.axis[axis].max_acceleration_mm_s2 = 100.0;
        CHECK(with_braking(500.0, 300.0) == "acceleration");
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

TEST_CASE("braking is seen up to the instant at which the axis turns round") {
    // From 1 mm/s back to where it was in 1 s: v = 1 - 4 u + 3 u^2, a = -4 + 6 u; it turns round at 1/3, where a = -2
    FeedSegment segment = stroke(0.0, 8000000);
    segment.start_velocity[0] = units(1.0);
    const SegmentCubic cubic(segment, 0, 1000.0 * static_cast<double>(units_per_count), 1.0);
    const Accelerations all = cubic.accelerations(0.0, 1.0);
    CHECK(all.braking == Approx(4.0));
    CHECK(all.speeding == Approx(2.0)); // from 1/3 to 2/3; then it brakes again, with 2 at the end
    const Accelerations late = cubic.accelerations(0.5, 1.0);
    CHECK(late.speeding == Approx(1.0));
    CHECK(late.braking == Approx(2.0));
    CHECK(cubic.accelerations(0.0, 0.0).braking == Approx(4.0));
    CHECK(cubic.accelerations(0.25, 0.3).speeding == 0.0);
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

TEST_CASE("the feed is that of the linear axes, and where they stand that of the rotary ones") {
    MachineDescription machine = machine_of({"a", "x"}); // which is rotary is the file's word, not the name's
    machine.settings.axis[0].rotary = true;
    machine.settings.max_feed_mm_s = 40.0;
    CHECK(fault_of(machine, there(40.0 * hardly_over, 500.0, 0)) == "none");
    CHECK(fault_of(machine, there(40.0 * over, 500.0, 0)) == "feed");
    CHECK(fault_of(machine, there(40.0 * over, 500.0, 1)) == "feed");
    SimulatedMachine simulated(machine, 1);
    run(simulated, both(there(80.0, 500.0, 0), there(40.0, 250.0, 1))); // x at half the speed
    CHECK_FALSE(simulated.fault());
    CHECK(simulated.max_path_speed_mm_s() == Approx(40.0));
    SimulatedMachine turning(machine, 1);
    run(turning, there(40.0 * over, 500.0, 0));
    REQUIRE(turning.fault());
    CHECK(describe(*turning.fault()).find("degrees/s is above the limit of 40 degrees/s") != std::string::npos);
    machine.settings.axis[0].max_velocity_mm_s = 30.0;
    SimulatedMachine slow(machine, 1);
    run(slow, there(40.0, 500.0, 0));
    REQUIRE(slow.fault());
    CHECK(describe(*slow.fault()).find("axis a: velocity 30.") == 0);
    CHECK(describe(*slow.fault()).find("degrees/s is above the limit of 30 degrees/s") != std::string::npos);
}

TEST_CASE("the path is made of x, y and z, or of all axes where there are none of these") {
    const auto speed = [](std::vector<std::string> names) {
        SimulatedMachine machine(machine_of(std::move(names)), 1);
        run(machine, both(there(40.0, 500.0, 0), there(30.0, 375.0, 1)));
        return machine.max_path_speed_mm_s();
    };
    CHECK(speed({"x", "z"}) == Approx(50.0));
    CHECK(speed({"x", "a"}) == Approx(40.0));
    CHECK(speed({"c", "y"}) == Approx(30.0));
    CHECK(speed({"a", "b"}) == Approx(50.0));
}
