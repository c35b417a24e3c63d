// SPDX-License-Identifier: MIT
//
// Moves that follow a spindle, on spindles that turn as they like.
#include "tp_control.hpp"

#include "support/bezier_paths.hpp"
#include "support/rounds.hpp"

#include <algorithm>

using namespace linuxcnc_test;
using splinefeed_test::first_round;
using splinefeed_test::Random;
using splinefeed_test::rounds;

namespace {

constexpr std::uint64_t spindle_seed = 3310;

/// Turns from its index on, where a part of its speed changes all the time, and as an encoder counts them.
struct Spindle {
    double per_s = 10.0, wobble = 0.0, hz = 2.0, counts = 0.0;
    double turns = 0.0, time_s = 0.0;
    void period(Control& control) {
        const double speed = per_s * (1.0 + wobble * std::sin(2.0 * 3.14159265358979 * hz * time_s));
        time_s += control.machine.period_s;
        turns += speed * control.machine.period_s;
        control.spindle(counts > 0.0 ? std::floor(turns * counts) / counts : turns, speed);
        control.input.may_begin = control.out.waits;
        control.period();
    }
};

tpc_move thread_to(double x, double y, double pitch, bool first = true) {
    tpc_move move = line_to(x, y, 10.0);
    move.pitch = pitch;
    move.stands_before = first ? 1 : 0;
    return move;
}

} // namespace

TEST_CASE("moves follow a spindle within the limits of the axes, and end where they should", "[linuxcnc]") {
    for (std::uint64_t n = first_round(); n < static_cast<std::uint64_t>(rounds(100, 3000)); ++n) {
        Random random(spindle_seed + n);
        CAPTURE(n);
        const double period_s = random.chance(0.7) ? 0.001 : 0.00025;
        const double jerk = random.chance(0.5) ? 0.0 : random.between(20'000.0, 100'000.0);
        Control control(machine_of(3, period_s, jerk));
        control.machine.acceleration[1] = 700.0;
        control.machine.velocity[0] = control.machine.velocity[1] = random.chance(0.5) ? 100.0 : 32.0;
        Spindle spindle;
        const double pitch = random.between(0.2, 3.0);
        spindle.per_s = std::min(random.between(3.0, 20.0), 25.0 / pitch);
        spindle.wobble = random.between(0.0, 0.04);
        spindle.hz = random.between(0.2, 3.0);
        spindle.counts = random.chance(0.3) ? 0.0 : random.between(1000.0, 4000.0);
        const double length = random.chance(0.3) ? random.between(1.0, 10.0) : random.between(40.0, 80.0);
        const double angle = random.between(0.0, 1.5);
        const double x = length * std::cos(angle);
        const double y = length * std::sin(angle);
        REQUIRE(control.add(thread_to(x, y, pitch)) == 0);
        double end_x = x;
        double end_y = y;
        for (int more = random.chance(0.5) ? random.integer(1, 4) : 0; more > 0; --more) {
            end_x += random.between(-20.0, 20.0);
            end_y += random.between(-20.0, 20.0);
            tpc_move move = random.chance(0.8)
                                ? thread_to(end_x, end_y, random.between(0.1, 20.0 / spindle.per_s), false)
                                : line_to(end_x, end_y, 50.0);
            move.tolerance = random.decades(0.001, 10.0);
            move.stands_before = random.chance(0.1) || move.pitch == 0.0 ? 1 : 0;
            REQUIRE(control.add(move) == 0);
        }
        const unsigned thread = control.out.first;
        const long aborts_at = random.chance(0.2) ? random.integer(10, 1500) : -1;
        double most_um = 0.0;
        const double speed = spindle.per_s * pitch;
        for (long i = 0; i < 1'000'000 && (i < 4 || control.out.first != control.out.last); ++i) {
            control.input.abort = control.aborted || i == aborts_at ? 1 : 0;
            spindle.period(control);
            REQUIRE((control.out.error == nullptr ||
                     std::string_view(control.out.error).find("too fast") != std::string_view::npos));
            const double done = std::hypot(control.out.position[0], control.out.position[1]);
            const bool in_the_middle = control.out.first == thread && done > 20.0 && done < length - 5.0;
            const double off_um = 1e3 * std::fabs(done - pitch * spindle.turns);
            most_um = in_the_middle && aborts_at < 0 ? std::max(most_um, off_um) : most_um;
        }
        REQUIRE(control.out.first == control.out.last);
        CHECK(control.use() <= 1.0001);
        const double step_um = spindle.counts > 0.0 ? 1e3 * pitch / spindle.counts : 0.0;
        const double change = speed * spindle.wobble * 6.3 * spindle.hz; // mm/s^2
        CHECK(most_um <= 0.5 + 1.5 * step_um + 0.1 * change);
        if (aborts_at < 0) {
            CHECK(control.out.position[0] == end_x);
            CHECK(control.out.position[1] == end_y);
        }
        control.input.abort = 0;
        REQUIRE(control.add(line_to(1.0, 2.0, 50.0)) == 0);
        for (int i = 0; i < 20'000 && (i < 4 || control.out.first != control.out.last); ++i) {
            spindle.period(control);
        }
        CHECK(control.out.position[1] == 2.0);
        CHECK(control.use() <= 1.0001);
    }
}

TEST_CASE("moves of a thread go on into each other within the tolerance, and do not wait for the index again",
          "[linuxcnc]") {
    for (const double jerk : {0.0, 30'000.0}) {
        for (const double tolerance : {0.0, 0.01, 1.0}) {
            CAPTURE(jerk, tolerance);
            Control control(machine_of(3, 0.001, jerk));
            Spindle spindle;
            spindle.wobble = 0.02;
            tpc_move moves[] = {thread_to(30.0, 0.0, 1.5), thread_to(50.0, 0.0, 1.5, false),
                                thread_to(70.0, 20.0, 1.5 * 1.41421356, false), thread_to(100.0, 20.0, 1.5, false)};
            for (tpc_move& move : moves) {
                move.tolerance = tolerance;
                move.mode = tolerance > 0.0 ? TPC_CONTINUOUS : TPC_EXACT_PATH;
                REQUIRE(control.add(move) == 0);
            }
            double off_path = 0.0;
            int waited = 0;
            int stood = 0;
            for (int i = 0; i < 100'000 && (i < 4 || control.out.first != control.out.last); ++i) {
                spindle.period(control);
                waited += control.out.waits;
                const double px = control.out.position[0];
                const double py = control.out.position[1];
                const double along = px < 50.0   ? std::fabs(py)
                                     : px > 70.0 ? std::fabs(py - 20.0)
                                                 : std::fabs(px - 50.0 - py) / 1.41421356;
                off_path = std::max(off_path, along);
                stood += control.out.speed == 0.0 && px > 1.0 ? 1 : 0;
                const bool straight_on = px > 15.0 && px < 45.0;
                const double off_um =
                    1e3 * std::fabs(px - 1.5 * spindle.turns); // of x alone: the pitches are made for it
                CHECK((!straight_on || tolerance == 0.0 || off_um < 0.5));
                CHECK((!(px > 60.0 && px < 65.0) || off_um < 20.0));
                CHECK((!(px > 85.0 && px < 95.0) || off_um < 0.5));
            }
            CHECK(waited <= 2);
            CHECK(control.out.position[0] == 100.0);
            CHECK(control.out.position[1] == 20.0);
            CHECK(off_path <= tolerance + 1e-9);
            CHECK(control.use() <= 1.0001);
            CHECK((tolerance < 1.0 || stood == 0));
        }
    }
}

TEST_CASE("a tap goes in and back with a spindle that turns back as slowly as it does", "[linuxcnc]") {
    for (std::uint64_t n = first_round(); n < static_cast<std::uint64_t>(rounds(40, 2000)); ++n) {
        Random random(spindle_seed + n);
        CAPTURE(n);
        const double jerk = random.chance(0.5) ? 0.0 : random.between(20'000.0, 100'000.0);
        Control control(machine_of(3, random.chance(0.7) ? 0.001 : 0.00025, jerk));
        Spindle spindle;
        const double pitch = random.between(0.2, 2.0);
        const double asked = random.between(2.0, 15.0 / pitch);
        const double change = random.between(0.2, 1.0) * std::min(200.0, 300.0 / pitch); // 1/s^2
        const double depth = random.between(10.0, 20.0);
        const double back = random.chance(0.5) ? 1.0 : random.between(1.0, 2.0);
        spindle.counts = 4000.0;
        spindle.per_s = asked;
        REQUIRE(control.add(line_to(1.0, 2.0, 50.0)) == 0);
        tpc_move tap = thread_to(1.0, 2.0, pitch);
        tap.to[2] = -depth;
        tap.taps = 1;
        REQUIRE(control.add(tap) == 0);
        REQUIRE(control.add(line_to(3.0, 2.0, 50.0)) == 0);
        const long aborts_at = random.chance(0.3) ? random.integer(100, 3000) : -1;
        double wanted = asked;
        double most_um = 0.0;
        int turned = 0;
        for (long i = 0; i < 1'000'000 && (i < 4 || control.out.first != control.out.last); ++i) {
            const double most = change * control.machine.period_s;
            spindle.per_s += std::clamp(wanted - spindle.per_s, -most, most);
            control.input.abort = control.aborted || i == aborts_at ? 1 : 0;
            spindle.period(control);
            turned += control.out.reverses != 0 ? 1 : 0;
            wanted = control.out.reverses == 1 ? -back * asked : control.out.reverses == 2 ? asked : wanted;
            const double z = -control.out.position[2];
            CHECK((control.out.reverses != 1 || (z >= depth && z < depth + 0.2)));
            CHECK((control.out.reverses != 2 || (z <= 0.0 && z > -0.2)));
            const bool judged = z > depth / 2.0 && aborts_at < 0;
            most_um = judged ? std::max(most_um, 1e3 * std::fabs(z - pitch * spindle.turns)) : most_um;
            REQUIRE(z > -10.0);
        }
        REQUIRE(control.out.first == control.out.last);
        CHECK(control.use() <= 1.0001);
        if (aborts_at < 0) {
            CHECK(turned == 2);
            CHECK(control.out.position[0] == 3.0);
            CHECK(control.out.position[2] == 0.0);
            CHECK(most_um <= 2.0 + 0.25 * pitch * change);
        }
    }
}

TEST_CASE("the run-in is caught up in hardly more time than the limits ask for", "[linuxcnc]") {
    for (const auto& [jerk, most_s] : {std::pair{0.0, 0.085}, std::pair{30'000.0, 0.13}}) {
        CAPTURE(jerk);
        Control control(machine_of(3, 0.001, jerk));
        Spindle spindle;
        double last_s = 0.0;
        REQUIRE(control.add(thread_to(60.0, 0.0, 3.0)) == 0);
        for (int i = 0; i < 1000; ++i) {
            spindle.period(control);
            last_s = std::fabs(control.out.position[0] - 3.0 * spindle.turns) > 0.01 ? i * 0.001 : last_s;
        }
        CHECK(last_s <= most_s);
    }
}

TEST_CASE("a move that catches up for the one before it keeps the velocity with it", "[linuxcnc]") {
    for (double length = 2.0; length < 12.0; length += 0.02) {
        CAPTURE(length);
        Control control(machine_of(3, 0.001, 0.0));
        control.machine.velocity[0] = 30.0;
        Spindle spindle;
        for (const bool first : {true, false}) {
            tpc_move move = thread_to(first ? length : 60.0, 0.0, 2.8, first);
            move.tolerance = 1.0;
            REQUIRE(control.add(move) == 0);
        }
        for (int i = 0; i < 600 && (i < 4 || control.out.first != control.out.last); ++i) {
            spindle.period(control);
        }
        CHECK(control.use() <= 1.0001);
    }
}

TEST_CASE("a spindle that stops, turns back or is too fast moves nothing that it must not", "[linuxcnc]") {
    for (const double jerk : {0.0, 30'000.0}) {
        CAPTURE(jerk);
        Control control(machine_of(3, 0.001, jerk));
        Spindle spindle;
        REQUIRE(control.add(thread_to(30.0, 0.0, 2.0)) == 0);
        const auto run = [&](int periods, double per_s) {
            spindle.per_s = per_s;
            for (int i = 0; i < periods; ++i) {
                spindle.period(control);
            }
            return control.out.position[0];
        };
        const double followed = run(600, 10.0);
        CHECK(followed == Approx(2.0 * spindle.turns).margin(0.01));
        const double there = run(600, 0.0);
        CHECK(run(100, 0.0) == Approx(there).margin(1e-6));
        CHECK(run(100, -5.0) >= there - 1e-6); // it does not go back
        run(3000, 10.0);
        CHECK(control.out.position[0] == 30.0);
        CHECK(control.use() <= 1.0001);

        Control other(machine_of(3, 0.001, jerk));
        REQUIRE(other.add(thread_to(30.0, 0.0, 2.0)) == 0);
        spindle = {};
        spindle.per_s = 60.0;
        const char* error = nullptr;
        for (int i = 0; i < 100; ++i) {
            spindle.period(other);
            error = other.out.error != nullptr ? other.out.error : error;
        }
        REQUIRE(error != nullptr);
        CHECK(std::string_view(error).find("too fast") != std::string_view::npos);
        CHECK(other.out.position[0] == 0.0);
        CHECK(other.out.first == other.out.last);
        CHECK(other.use() <= 1.0001);
    }
}
