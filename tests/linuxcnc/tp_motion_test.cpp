// SPDX-License-Identifier: MIT
//
// The module without LinuxCNC: moves come as task sends them, one a period; the operator interferes at random, and in a
// tenth of the periods planning gets no time. What is judged are the positions of all periods.
#include "tp_control.hpp"

#include "support/bezier_paths.hpp"
#include "support/rounds.hpp"

using namespace linuxcnc_test;
using splinefeed_test::first_round;
using splinefeed_test::Random;
using splinefeed_test::rounds;

namespace {

constexpr std::uint64_t seed = 90210;

/// What an operator may do in a period.
void interfere(Random& random, Control& control) {
    tpc_input& input = control.input;
    switch (random.integer(0, 6)) {
    case 0: input.hold = 1; break;
    case 1: input.hold = 0; break;
    case 2: input.ratio = random.between(0.0, 2.0); break;
    case 3: input.ratio = random.chance(0.5) ? 0.0 : 1.0; break;
    case 4: input.rapids = random.between(0.01, 1.0); break;
    case 5: input.max_feed = random.chance(0.3) ? 1e6 : random.between(1.0, 120.0); break;
    default: input.abort = random.chance(0.1) ? 1 : 0; break;
    }
}

} // namespace

TEST_CASE("whatever an operator does, and however late planning is, all limits are kept and the ends are exact",
          "[linuxcnc]") {
    for (std::uint64_t n = first_round(); n < static_cast<std::uint64_t>(rounds(30, 1000)); ++n) {
        Random random(seed + n);
        const double period_s = random.chance(0.5) ? 0.001 : 0.00025;
        Control control(machine_of(3, period_s, random.chance(0.5) ? 30'000.0 : 0.0));
        const bool steered = random.chance(0.8);
        const double starving = random.chance(0.3) ? 0.1 : 0.0;
        double x = 0.0;
        double y = 0.0;
        const int moves = random.integer(1, 80);
        const double size = random.decades(0.05, 10.0);
        CAPTURE(n, period_s, steered, starving, moves, size);
        for (int i = 0; i < moves; ++i) {
            x += random.between(-size, size);
            y += random.between(-size, size);
            tpc_move move = line_to(x, y, random.decades(20.0, 200.0));
            move.mode = random.chance(0.1) ? TPC_EXACT_PATH : TPC_CONTINUOUS;
            move.rapid = random.chance(0.2) ? 1 : 0;
            const int error = control.add(move);
            REQUIRE((error == 0 || error == -1));
            starved = random.chance(starving);
            if (steered && random.chance(0.01)) {
                interfere(random, control);
            }
            control.period();
            if (control.input.abort != 0) {
                break;
            }
        }
        for (int i = 0; steered && i < 3000 && control.out.first != control.out.last; ++i) {
            starved = random.chance(starving);
            if (random.chance(0.003)) {
                interfere(random, control);
            }
            control.period();
        }
        starved = false;
        control.input = {1.0, 1.0, 1e6, 0, control.input.abort, 0, 0, 0};
        control.until_over();
        CHECK(control.use() <= 1.0001);
        CHECK(control.figures().late == 0);
        if (!control.aborted) {
            CHECK(control.out.position[0] == x);
            CHECK(control.out.position[1] == y);
        }
        // It goes on from there.
        REQUIRE(control.add(line_to(control.out.position[0] + 5.0, 1.0, 50.0)) == 0);
        control.until_over();
        CHECK(control.out.position[1] == 1.0);
        CHECK(control.use() <= 1.0001);
    }
}

TEST_CASE("the feed, the speed and the way left are those of X Y Z, else of U V W, else of A B C", "[linuxcnc]") {
    struct Way {
        std::array<double, 9> to;
        double length; // that the feed of 20 units/s is of, units
        double jerk;
        double mm_per_unit;
    };
    for (const Way& way :
         {Way{{50.0, 0, 0, 0, 0, 0, 100.0}, 50.0, 0.0, 1.0}, Way{{30.0, 0, 40.0, 90.0, 0, 0, 5.0}, 50.0, 0.0, 1.0},
          Way{{0, 0, 0, 90.0, 0, 0, 0, 50.0}, 50.0, 0.0, 1.0}, Way{{0, 0, 0, 50.0}, 50.0, 0.0, 1.0},
          Way{{50.0, 0, 0, 0, 0, 0, 100.0}, 50.0, 30'000.0, 1.0}, Way{{20.0, 0, 0, 0, 0, 0, 10.0}, 20.0, 0.0, 25.4}}) {
        CAPTURE(way.to, way.mm_per_unit);
        tpc_machine machine = machine_of(6, 0.001, way.jerk);
        machine.axis[4] = 6;
        machine.axis[5] = 7;
        machine.mm_per_unit = way.mm_per_unit;
        Control control(machine);
        tpc_move move{};
        move.mode = TPC_EXACT_PATH;
        std::copy(way.to.begin(), way.to.end(), move.to);
        move.feed = 20.0;
        REQUIRE(control.add(move) == 0);
        double fastest = 0.0;
        double first_left = 0.0;
        while (control.out.first != control.out.last) {
            control.period();
            fastest = std::max(fastest, control.out.speed);
            first_left = std::max(first_left, control.out.left);
        }
        CHECK(fastest == Approx(20.0).epsilon(1e-3));
        CHECK(first_left == Approx(way.length).epsilon(1e-3));
        CHECK(static_cast<double>(control.places.size()) * 0.001 == Approx(way.length / 20.0).margin(0.15));
    }
}

TEST_CASE("the feed of an arc is that of X Y Z, whatever U does beside it", "[linuxcnc]") {
    tpc_machine machine = machine_of(4, 0.001, 0.0);
    machine.axis[3] = 6;
    Control control(machine);
    tpc_move circle = line_to(0.0, 0.0, 20.0);
    circle.arc = 1;
    circle.centre[0] = 10.0;
    circle.normal[2] = 1.0;
    circle.sweep_rad = 2.0 * 3.14159265358979323846;
    circle.to[6] = 80.0;
    REQUIRE(control.add(circle) == 0);
    control.until_over();
    CHECK(static_cast<double>(control.places.size()) * 0.001 == Approx(circle.sweep_rad * 10.0 / 20.0).margin(0.15));
}

TEST_CASE("without a tolerance corners are as fast as they can be, and short lines keep their shape", "[linuxcnc]") {
    const auto seconds = [](double tolerance, double joins) {
        Control control(machine_of(3, 0.001, 0.0));
        for (int i = 1; i <= 8; ++i) {
            tpc_move side =
                line_to(i % 4 == 1 || i % 4 == 2 ? 20.0 : 0.0, i % 4 == 2 || i % 4 == 3 ? 20.0 : 0.0, 100.0, tolerance);
            side.joins = joins;
            REQUIRE(control.add(side) == 0);
        }
        control.until_over();
        CHECK(control.use() <= 1.0001);
        return static_cast<double>(control.places.size()) * 0.001;
    };
    CHECK(seconds(TPC_MOST_TOLERANCE, 0.05) < 0.65 * seconds(0.05, 0.0)); // 0.69 with blends that are less round

    Control control(machine_of(3, 0.001, 0.0));
    constexpr int chords = 360;
    constexpr double radius = 20.0;
    for (int i = 1; i <= chords; ++i) {
        const double angle = 2.0 * 3.14159265358979323846 * i / chords;
        tpc_move chord = line_to(radius * (1.0 - std::cos(angle)), radius * std::sin(angle), 100.0, TPC_MOST_TOLERANCE);
        chord.joins = 0.05;
        REQUIRE(control.add(chord) == 0);
    }
    control.until_over();
    for (const auto& place : control.places) {
        REQUIRE(std::fabs(std::hypot(place[0] - radius, place[1]) - radius) < 0.06);
    }
}

TEST_CASE("a short slow line keeps its feed, however short it is beside the tolerance", "[linuxcnc]") {
    for (const double tolerance : {0.01, 0.05, 1.0}) {
        for (const double length : {0.002, 0.005, 0.02, 0.1}) {
            CAPTURE(tolerance, length);
            Control control(machine_of(3, 0.001, 0.0));
            REQUIRE(control.add(line_to(10.0, 0.0, 20.0, tolerance)) == 0);
            REQUIRE(control.add(line_to(10.0 + length, 0.0, 0.1, tolerance)) == 0);
            REQUIRE(control.add(line_to(20.0, 0.0, 20.0, tolerance)) == 0);
            control.until_over();
            const auto within = std::ranges::count_if(
                control.places, [&](const auto& place) { return place[0] > 10.0 && place[0] < 10.0 + length; });
            CHECK(static_cast<double>(within) * 0.001 == Approx(length / 0.1).margin(0.002));
        }
    }
}

TEST_CASE("the move under way is the one whose end is ahead, also on circles and in chains", "[linuxcnc]") {
    Control control(machine_of(3, 0.001, 0.0));
    REQUIRE(control.add(line_to(10.0, 0.0, 50.0)) == 0);
    tpc_move circle = line_to(10.0, 0.0, 50.0);
    circle.arc = 1;
    circle.normal[2] = 1.0;
    circle.sweep_rad = 2.0 * 3.14159265358979323846;
    REQUIRE(control.add(circle) == 0);
    for (int i = 1; i <= 40; ++i) { // a chain: one curve for all of them
        REQUIRE(control.add(line_to(10.0 + 0.5 * i, 0.01 * i * i, 50.0)) == 0);
    }
    unsigned first = 0;
    while (control.out.first != control.out.last) {
        control.period();
        REQUIRE(control.out.first - first <= 1U); // none is left out
        const double from_start = std::hypot(control.out.position[0], control.out.position[1]);
        if (control.out.first == 1 && control.out.first != first) {
            CHECK(from_start == Approx(10.0).margin(0.2));
        }
        if (control.out.first >= 2 && control.out.first + 1 < control.out.last) {
            CHECK(control.out.position[0] == Approx(10.25 + 0.5 * (control.out.first - 2)).margin(0.5));
        }
        first = control.out.first;
    }
    CHECK(first == 42);
}

TEST_CASE("a move that goes back on its own way begins at its start", "[linuxcnc]") {
    Control control(machine_of(3, 0.001, 0.0));
    for (const double x : {10.0, 4.0, 12.0}) {
        REQUIRE(control.add(line_to(x, 0.0, 50.0)) == 0);
    }
    double farthest[3] = {};
    while (control.out.first != control.out.last) {
        const unsigned under_way = control.out.first;
        control.period();
        farthest[under_way] = control.out.position[0];
    }
    CHECK(farthest[0] == Approx(10.0).margin(0.01));
    CHECK(farthest[1] == Approx(4.0).margin(0.01));
    CHECK(farthest[2] == 12.0);
}

TEST_CASE("moves of no length are left out, and what cannot be is refused before motion", "[linuxcnc]") {
    Control control(machine_of(3, 0.001, 0.0));
    CHECK(control.add(line_to(0.0, 0.0, 50.0)) == -1);
    CHECK(control.add(line_to(1e9, 0.0, 50.0)) == static_cast<int>(splinefeed::Error::position_out_of_range));
    tpc_move arc = line_to(1.0, 0.0, 50.0); // its centre is its start
    arc.arc = 1;
    arc.normal[2] = 1.0;
    arc.sweep_rad = 1.0;
    CHECK(control.add(arc) == static_cast<int>(splinefeed::Error::arc_invalid));
    control.period();
    CHECK(control.places.back()[0] == 0.0);
}

TEST_CASE("a move that waits for the spindle begins when it may, after a stop", "[linuxcnc]") {
    Control control(machine_of(3, 0.001, 0.0));
    add_waiting(control);
    for (int i = 0; i < 1000; ++i) {
        control.period();
    }
    expect_waiting(control);
    CHECK(control.use() <= 1.0001);
}

TEST_CASE("the end of what is queued is planned before the motion gets there", "[linuxcnc]") {
    double seconds[2] = {};
    for (const bool at_once : {false, true}) { // else planning has ten looks at the clock a period
        Control control(machine_of(3, 0.001, 30'000.0));
        look_ns = at_once ? 0 : 10'000;
        double x = 0.0;
        double y = 0.0;
        for (int i = 1; i <= 20; ++i) {
            x += 6.0 * std::cos(0.7 * i);
            y += 6.0 * std::sin(0.7 * i);
            REQUIRE(control.add(line_to(x, y, 80.0)) == 0);
        }
        control.until_over();
        look_ns = 1'000;
        seconds[at_once ? 1 : 0] = 0.001 * static_cast<double>(control.places.size());
        CHECK(control.figures().urgent == 0);
        CHECK(control.use() <= 1.0001);
    }
    CHECK(seconds[0] < seconds[1] + 0.06); // the first plan is made at standstill
}

TEST_CASE("a path whose moves come one by one is as fast as one that is known", "[linuxcnc]") {
    struct Step {
        double x;
        double y;
        double sweep_rad; // 0: a line
        double centre_x;
        double centre_y;
    };
    struct Path {
        double feed;
        double tolerance;
        std::vector<Step> steps;
    };
    // A long line, a short one and arcs: as long as these are not known, the plan of the first ends at a stop.
    const Path paths[] = {{43.8,
                           0.0452,
                           {{-2.830212, 0.148244, 0.0, 0.0, 0.0},
                            {-3.004687, 0.116556, 0.0, 0.0, 0.0},
                            {-3.009216, 0.117292, 0.460, -3.008516, 0.107292},
                            {-3.012457, 0.194595, 0.921, -3.088826, 0.152674},
                            {-2.880372, -0.114005, -4.855, -2.766921, 0.117121},
                            {-4.132509, 0.462637, 0.0, 0.0, 0.0}}},
                          {16.07,
                           0.0064,
                           {{0.842747, 0.120988, 0.0, 0.0, 0.0},
                            {0.907837, 0.148128, 0.0, 0.0, 0.0},
                            {0.576972, 0.669789, -2.2099, 0.873441, 0.492069},
                            {0.531218, 0.661636, 0.0, 0.0, 0.0},
                            {0.554196, 0.706696, 0.0, 0.0, 0.0},
                            {0.552839, 0.962123, 0.0, 0.0, 0.0}}}};
    for (const auto& [feed, tolerance, steps] : paths) {
        for (const double jerk : {0.0, 30'000.0}) {
            std::size_t periods[2] = {};
            for (const bool at_once : {false, true}) {
                Control control(machine_of(3, 0.001, jerk));
                for (const Step& step : steps) {
                    tpc_move move = line_to(step.x, step.y, feed, tolerance);
                    move.arc = step.sweep_rad != 0.0 ? 1 : 0;
                    move.sweep_rad = step.sweep_rad;
                    move.centre[0] = step.centre_x;
                    move.centre[1] = step.centre_y;
                    move.normal[2] = 1.0;
                    REQUIRE(control.add(move) == 0);
                    if (!at_once) {
                        control.period();
                    }
                }
                control.until_over();
                periods[at_once ? 1 : 0] = control.places.size();
                CHECK(control.use() <= 1.0001);
            }
            CAPTURE(feed, jerk);
            CHECK(periods[0] <= periods[1] + 8); // they come within six
        }
    }
}

TEST_CASE("feed and tolerance are in the machine's units", "[linuxcnc]") {
    for (const double mm_per_unit : {1.0, 25.4}) {
        tpc_machine machine = machine_of(3, 0.001, 0.0);
        machine.mm_per_unit = mm_per_unit;
        for (unsigned k = 0; k < 3; ++k) {
            machine.velocity[k] /= mm_per_unit;
            machine.acceleration[k] /= mm_per_unit;
        }
        const double feed = 50.0 / mm_per_unit;
        const double tolerance = 0.05 / mm_per_unit;
        const double side = 20.0 / mm_per_unit;
        Control control(machine);
        REQUIRE(control.add(line_to(side, 0.0, feed, tolerance)) == 0);
        REQUIRE(control.add(line_to(side, side, feed, tolerance)) == 0);
        double fastest = 0.0;
        double to_corner = side;
        while (control.out.first != control.out.last) {
            control.period();
            fastest = std::max(fastest, control.out.speed);
            to_corner = std::min(to_corner, std::hypot(control.out.position[0] - side, control.out.position[1]));
        }
        CAPTURE(mm_per_unit);
        CHECK(fastest == Approx(feed));
        CHECK(to_corner < tolerance + feed * 0.0005); // and half a period's way
        CHECK(to_corner > 0.5 * tolerance);
        CHECK(control.use() <= 1.0001);
    }
}

TEST_CASE("a hundred thousand short moves", "[linuxcnc]") {
    Control control(machine_of(3, 0.001, 0.0));
    double angle = 0.0;
    for (int i = 0; i < 100'000; ++i) {
        angle += 0.003;
        while (control.out.last - control.out.first > tpc_capacity - 48U) {
            control.period();
            control.places.erase(control.places.begin(),
                                 control.places.end() - std::min<long>(4, static_cast<long>(control.places.size())));
            REQUIRE(control.use() <= 1.0001);
        }
        REQUIRE(control.add(line_to(30.0 * std::sin(angle), 20.0 * std::sin(1.7 * angle), 80.0)) == 0);
    }
    control.until_over();
    CHECK(control.use() <= 1.0001);
    CHECK(control.figures().late == 0);
    CHECK(control.out.position[0] == 30.0 * std::sin(angle));
}
