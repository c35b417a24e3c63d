// SPDX-License-Identifier: MIT
//
// Reverse run: back along the path, and forward again, as motmod asks for it where the adaptive feed is below 0.
#include "tp_control.hpp"

#include "support/bezier_paths.hpp"
#include "support/rounds.hpp"

using namespace linuxcnc_test;
using splinefeed_test::first_round;
using splinefeed_test::Random;
using splinefeed_test::rounds;

namespace {

constexpr double pi = 3.14159265358979323846;
using Place = std::array<double, 3>;

double apart(const Place& a, const Place& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// From a place to the lines between others, `around` of them before and behind the nearest one of before.
double off(const Place& at, const std::vector<Place>& way, std::size_t& near, std::size_t around = 20) {
    const auto distance = [&](std::size_t i) {
        double along = 0.0;
        double length_sq = 0.0;
        for (unsigned k = 0; k < 3; ++k) {
            along += (at[k] - way[i][k]) * (way[i + 1][k] - way[i][k]);
            length_sq += (way[i + 1][k] - way[i][k]) * (way[i + 1][k] - way[i][k]);
        }
        const double u = length_sq > 0.0 ? std::clamp(along / length_sq, 0.0, 1.0) : 0.0;
        Place foot{};
        for (unsigned k = 0; k < 3; ++k) {
            foot[k] = way[i][k] + u * (way[i + 1][k] - way[i][k]);
        }
        return apart(at, foot);
    };
    const std::size_t from = near > around ? near - around : 0;
    double least = 1e9;
    for (std::size_t i = from; i + 1 < way.size() && i < from + 2 * around; ++i) {
        if (const double d = distance(i); d < least) {
            least = d;
            near = i;
        }
    }
    return least;
}

void until_standing(Control& control) {
    for (int still = 0, n = 0; still < 60; ++n) { // with a jerk limit a ring of 40 is filled before motion
        REQUIRE(n < 100'000);
        control.period();
        still = control.out.speed > 0.0 ? 0 : still + 1;
    }
}

/// As motmod does: with a feed of 0 until it stands.
void turn(Control& control, bool backward) {
    const double ratio = control.input.ratio;
    control.input.ratio = 0.0;
    until_standing(control);
    control.input.ratio = ratio;
    control.input.backward = backward ? 1 : 0;
}

struct Path {
    std::vector<tpc_move> moves;
    std::vector<Place> ends;
};

/// Lines, arcs and short lines that become a curve; some of them stop.
Path some_path(Random& random, int moves, double size, double tolerance) {
    Path out;
    Place at{};
    double angle = 0.0;
    const bool smooth = random.chance(0.5);
    for (int i = 0; i < moves; ++i) {
        angle = smooth ? angle + random.between(-0.3, 0.3) : random.between(-pi, pi);
        const double length = random.between(0.2, 1.0) * size;
        tpc_move move = line_to(at[0] + length * std::cos(angle), at[1] + length * std::sin(angle),
                                random.decades(10.0, 120.0), tolerance);
        move.to[2] = at[2] + random.between(-0.1, 0.1) * size;
        move.mode = random.chance(0.95) ? TPC_CONTINUOUS : random.chance(0.5) ? TPC_EXACT_PATH : TPC_EXACT_STOP;
        move.rapid = random.chance(0.1) ? 1 : 0;
        if (!smooth && length > 0.05 && random.chance(0.3)) { // a half circle, or more turns
            move.arc = 1;
            move.centre[0] = 0.5 * (move.to[0] + at[0]);
            move.centre[1] = 0.5 * (move.to[1] + at[1]);
            move.normal[2] = random.chance(0.5) ? 1.0 : -1.0;
            move.sweep_rad = (random.chance(0.5) ? 1.0 : -1.0) * (random.chance(0.3) ? 5.0 : 1.0) * pi;
        }
        at = {move.to[0], move.to[1], move.to[2]};
        out.moves.push_back(move);
        out.ends.push_back(at);
    }
    return out;
}

} // namespace

TEST_CASE("back along the path through 300 moves, and forward again to its end", "[linuxcnc]") {
    for (const double jerk : {0.0, 30'000.0}) {
        for (const double size : {0.3, 4.0}) {
            Random random(77);
            const Path path = some_path(random, 320, size, 0.05);
            Control control(machine_of(3, 0.001, jerk));
            CAPTURE(jerk, size);
            for (const tpc_move& move : path.moves) {
                REQUIRE(control.add(move) == 0);
            }
            while (control.out.first < 310) {
                control.period();
            }
            turn(control, true);
            const std::vector<Place> way = control.places;
            std::size_t near = way.size() - 2;
            double most = 0.0;
            unsigned first = control.out.first;
            control.period();
            for (int n = 0; control.out.back_over == 0; ++n) {
                REQUIRE(n < 1'000'000);
                control.period();
                CHECK(control.out.first <= first);
                CHECK(control.out.first + 2 > first); // none is left out
                first = control.out.first;
                most = std::max(most, off(control.places.back(), way, near));
            }
            CHECK(most < 0.002); // places are samples of a curve
            CHECK(control.out.first == 0);
            CHECK(control.out.speed == 0.0);
            CHECK(apart(control.places.back(), Place{}) < 1e-9);
            until_standing(control);
            CHECK(apart(control.places.back(), Place{}) < 1e-9);
            control.input.backward = 0;
            near = 0;
            while (control.out.first != control.out.last) {
                control.period();
                if (control.out.first < 300) {
                    most = std::max(most, off(control.places.back(), way, near));
                }
            }
            CHECK(most < 0.002);
            CHECK(apart(control.places.back(), path.ends.back()) == 0.0);
            CHECK(control.use() <= 1.0001);
            CHECK(control.figures().late == 0);
        }
    }
}

TEST_CASE("the way back takes as long as the way there, with its feeds and overrides", "[linuxcnc]") {
    for (const double ratio : {1.0, 0.5, 1.5}) {
        Control control(machine_of(3, 0.001, 0.0));
        control.input.ratio = ratio;
        for (const double x : {20.0, 40.0, 60.0}) {
            tpc_move move = line_to(x, 0.0, x == 40.0 ? 10.0 : 40.0);
            REQUIRE(control.add(move) == 0);
        }
        while (control.out.position[0] < 50.0) {
            control.period();
        }
        turn(control, true);
        control.places.clear();
        const double slow_s = (control.out.position[0] - 40.0) / 40.0 + 20.0 / 10.0 + 20.0 / 40.0;
        double fastest[3] = {};
        while (control.out.back_over == 0) {
            control.period();
            fastest[control.out.first] = std::max(fastest[control.out.first], control.out.speed);
        }
        CAPTURE(ratio);
        CHECK(fastest[2] == Approx(40.0 * ratio).epsilon(1e-3));
        CHECK(fastest[0] == Approx(40.0 * ratio).epsilon(1e-3));
        CHECK(static_cast<double>(control.places.size()) * 0.001 == Approx(slow_s / ratio).margin(0.12));
        CHECK(control.use() <= 1.0001);
    }
}

TEST_CASE("what is kept is bounded: the machine stands at the end of it, and goes on forward", "[linuxcnc]") {
    Control control(machine_of(3, 0.001, 0.0));
    unsigned sent = 0;
    const auto period = [&] {
        if (sent < 4000 && control.out.last - control.out.first < tpc_capacity - tpc_kept - 48U) {
            ++sent;
            const double angle = 0.3 * sent;
            REQUIRE(control.add(line_to(5.0 * std::cos(angle) + 0.01 * sent, 5.0 * std::sin(angle), 100.0, 0.01)) == 0);
        }
        control.period();
    };
    while (control.out.first < 2500) {
        period();
    }
    control.input.backward = 1;
    const unsigned front = control.out.first;
    while (control.out.back_over == 0) {
        period();
    }
    const unsigned back = control.out.first;
    CHECK(front - back >= 200U);
    CHECK(front - back <= tpc_kept + 4U);
    control.input.backward = 0;
    unsigned first = back;
    while (control.out.first != control.out.last) {
        period();
        REQUIRE(control.out.first - first <= 1U);
        first = control.out.first;
    }
    CHECK(sent == 4000);
    CHECK(control.use() <= 1.0001);
    CHECK(control.places.back()[0] == 5.0 * std::cos(0.3 * 4000) + 40.0);
}

TEST_CASE("a path that has not begun has no way back, and begins when it may go forward", "[linuxcnc]") {
    Control control(machine_of(3, 0.001, 0.0));
    REQUIRE(control.add(line_to(10.0, 0.0, 50.0)) == 0);
    control.input.backward = 1;
    for (int i = 0; i < 200; ++i) {
        control.period();
    }
    CHECK(control.out.back_over == 1);
    CHECK(control.places.back()[0] == 0.0);
    control.input.backward = 0;
    control.until_over();
    CHECK(control.out.position[0] == 10.0);
}

TEST_CASE("the way back ends where an axis was locked, and not where the machine waited for a spindle", "[linuxcnc]") {
    for (const bool locks : {false, true}) {
        Control control(machine_of(3, 0.001, 0.0));
        control.input.may_begin = 1;
        REQUIRE(control.add(line_to(10.0, 0.0, 50.0)) == 0);
        tpc_move waits = line_to(20.0, 0.0, 50.0);
        waits.stands_before = 1;
        waits.stops = locks ? 1 : 0;
        REQUIRE(control.add(waits) == 0);
        tpc_move behind = line_to(30.0, 0.0, 50.0);
        behind.stands_before = 1;
        REQUIRE(control.add(behind) == 0);
        while (control.out.position[0] < 25.0) {
            control.period();
        }
        control.input.backward = 1;
        while (control.out.back_over == 0) {
            control.period();
        }
        CHECK(control.out.position[0] == Approx(locks ? 20.0 : 0.0).margin(1e-9));
        control.input.backward = 0;
        control.until_over();
        CHECK(control.out.position[0] == 30.0);
        CHECK(control.use() <= 1.0001);
    }
}

TEST_CASE("a machine that waits before a move turns, comes back, and waits again", "[linuxcnc]") {
    Control control(machine_of(3, 0.001, 0.0));
    add_waiting(control);
    while (control.out.waits == 0) {
        control.period();
    }
    control.input.backward = 1;
    while (control.out.back_over == 0) {
        control.period();
        CHECK(control.out.waits == 0);
    }
    CHECK(apart(control.places.back(), Place{}) < 1e-9);
    control.input.backward = 0;
    for (int n = 0; n < 2000; ++n) {
        control.period();
    }
    expect_waiting(control);
}

TEST_CASE("at the end of its moves a held machine turns, and does not jump there", "[linuxcnc]") {
    Control control(machine_of(3, 0.001, 0.0));
    REQUIRE(control.add(line_to(10.0, 0.0, 50.0)) == 0);
    while (control.out.position[0] < 9.99) {
        control.period();
    }
    control.input.hold = 1;
    until_standing(control);
    control.input.hold = 0;
    control.input.backward = 1;
    while (control.out.position[0] > 6.0) {
        control.period();
    }
    control.input.backward = 0;
    control.input.ratio = 0.0;
    until_standing(control);
    CHECK(control.out.first == 0);
    CHECK(control.out.last == 1);
    CHECK(control.out.position[0] < 6.0);
    control.input.ratio = 1.0;
    control.until_over();
    CHECK(control.out.position[0] == 10.0);
    CHECK(control.use() <= 1.0001);
}

TEST_CASE("an abort on the way back ends it there, and the next path goes forward", "[linuxcnc]") {
    Control control(machine_of(3, 0.001, 0.0));
    REQUIRE(control.add(line_to(20.0, 0.0, 50.0)) == 0);
    while (control.out.position[0] < 15.0) {
        control.period();
    }
    control.input.backward = 1;
    while (control.out.position[0] > 10.0) {
        control.period();
    }
    control.input.abort = 1;
    control.until_over();
    const double x = control.out.position[0];
    CHECK(x < 10.0);
    CHECK(x > 5.0);
    control.input.backward = 0;
    REQUIRE(control.add(line_to(x + 5.0, 0.0, 50.0)) == 0);
    control.until_over();
    CHECK(control.out.position[0] == x + 5.0);
    CHECK(control.use() <= 1.0001);
}

TEST_CASE("wherever it turns, the machine stays on its path within its limits, and ends at its end", "[linuxcnc]") {
    for (std::uint64_t n = first_round(); n < static_cast<std::uint64_t>(rounds(12, 1000)); ++n) {
        Random random(31'337 + n);
        const double jerk = random.chance(0.5) ? 30'000.0 : 0.0;
        const double size = random.decades(0.05, 15.0);
        const double tolerance = random.decades(0.005, 0.2);
        const Path path = some_path(random, random.integer(2, 40), size, tolerance);
        CAPTURE(n, jerk, size, tolerance, path.moves.size());
        Control plain(machine_of(3, 0.001, jerk));
        Control control(machine_of(3, 0.001, jerk));
        for (const tpc_move& move : path.moves) {
            REQUIRE(plain.add(move) == 0);
            REQUIRE(control.add(move) == 0);
        }
        plain.until_over();
        const double starving = random.chance(0.3) ? 0.1 : 0.0;
        for (int k = random.integer(1, 8); k > 0 && control.out.first != control.out.last; --k) {
            for (int i = random.integer(1, 600); i > 0 && control.out.first != control.out.last; --i) {
                starved = random.chance(starving);
                control.period();
            }
            control.input.backward ^= 1;
            control.input.ratio = random.chance(0.2) ? random.between(0.2, 2.0) : control.input.ratio;
            control.input.hold = random.chance(0.1) ? 1 : 0;
        }
        starved = false;
        control.input.hold = control.input.backward = 0;
        control.until_over();
        CHECK(apart(control.places.back(), path.ends.back()) == 0.0);
        CHECK(control.use() <= 1.0001);
        CHECK(control.figures().late == 0);
        double most = 0.0; // each place is on the path without a turn
        for (std::size_t i = 0; i < control.places.size(); i += 1 + control.places.size() / 60) {
            double least = 1e9;
            for (std::size_t j = 0; j + 1 < plain.places.size(); j += 300) {
                std::size_t near = j + 150;
                least = std::min(least, off(control.places[i], plain.places, near, 151));
            }
            most = std::max(most, least);
        }
        CHECK(most < 0.003);
    }
}
