// SPDX-License-Identifier: MIT
//
// What an operator and HAL ask of the feed while the module moves the machine.
#include "tp_control.hpp"

using namespace linuxcnc_test;

TEST_CASE("the motion follows override, slider and hold at once, while it probes sooner", "[linuxcnc]") {
    struct Order {
        bool rapid;
        tpc_input input;
        double speed; // mm/s, where 50 are programmed, or as fast as the axis can
    };
    for (const Order& order :
         {Order{false, {0.5, 0.1, 1e6, 0, 0, 0, 0, 0}, 25.0}, Order{false, {1.6, 1.0, 1e6, 0, 0, 0, 0, 0}, 80.0},
          Order{false, {1.0, 1.0, 20.0, 0, 0, 0, 0, 0}, 20.0}, Order{false, {1.0, 1.0, 0.0, 0, 0, 0, 0, 0}, 0.0},
          Order{false, {1.0, 1.0, 1e6, 1, 0, 0, 0, 0}, 0.0}, Order{false, {0.0, 1.0, 1e6, 0, 0, 0, 0, 0}, 0.0},
          Order{true, {0.1, 0.5, 1e6, 0, 0, 0, 0, 0}, 50.0}, Order{true, {2.0, 1.0, 30.0, 0, 0, 0, 0, 0}, 30.0},
          Order{true, {1.0, 1.0, 1e6, 1, 0, 0, 0, 0}, 0.0}, Order{true, {0.0, 1.0, 1e6, 0, 0, 0, 0, 0}, 0.0}}) {
        for (const double jerk : {0.0, 30'000.0}) {
            double until_slower_s[2] = {};
            for (const bool probes : {false, true}) {
                Control control(machine_of(3, 0.001, jerk));
                tpc_move move = line_to(80.0, 0.0, 50.0);
                move.probes = probes ? 1 : 0;
                move.rapid = order.rapid ? 1 : 0;
                REQUIRE(control.add(move) == 0);
                const double before = order.rapid ? 100.0 : 50.0;
                const auto run = [&](int periods) {
                    for (int n = 0; n < periods; ++n) {
                        control.period();
                        until_slower_s[probes ? 1 : 0] += std::fabs(control.out.speed - before) < 0.01 ? 0.001 : 0.0;
                    }
                };
                run(300);
                CAPTURE(order.rapid, order.speed, order.input.hold, jerk, probes);
                REQUIRE(control.out.speed == Approx(before));
                until_slower_s[probes ? 1 : 0] = 0.0;
                control.input = order.input;
                run(250);
                CHECK(control.out.speed == Approx(order.speed).margin(1e-6));
                control.input = {1.0, 1.0, 1e6, 0, 0, 0, 0, 0};
                control.until_over();
                CHECK(control.out.position[0] == 80.0);
                CHECK(control.use() <= 1.0001);
            }
            CHECK(until_slower_s[1] < until_slower_s[0]);
        }
    }
}

TEST_CASE("overrides are for moves of their kind, and the slider is not for rotary axes alone", "[linuxcnc]") {
    tpc_machine machine = machine_of(4, 0.001, 0.0);
    Control control(machine);
    tpc_move rapid = line_to(40.0, 0.0, 50.0);
    rapid.rapid = 1;
    REQUIRE(control.add(rapid) == 0);
    REQUIRE(control.add(line_to(80.0, 0.0, 50.0)) == 0);
    tpc_move turn = line_to(80.0, 0.0, 100.0);
    turn.to[3] = 40.0; // degrees
    REQUIRE(control.add(turn) == 0);
    control.input = {0.5, 0.25, 20.0, 0, 0, 0, 0, 0};
    double fastest[3] = {};
    double x = 0.0;
    double a = 0.0;
    while (control.out.first != control.out.last) {
        const unsigned move = control.out.first;
        control.period();
        const double moved = std::fabs(control.out.position[0] - x) + std::fabs(control.out.position[3] - a);
        x = control.out.position[0];
        a = control.out.position[3];
        fastest[move % 3] = std::max(fastest[move % 3], moved / 0.001);
        if (move == 0 && x > 20.0) {
            control.input.max_feed = 1e6;
        }
        if (move == 1 && x > 60.0) {
            control.input = {1.0, 1.0, 20.0, 0, 0, 0, 0, 0};
        }
    }
    CHECK(fastest[0] == Approx(25.0).epsilon(1e-3));
    CHECK(fastest[1] == Approx(25.0).epsilon(1e-3));
    CHECK(fastest[2] == Approx(100.0).epsilon(1e-3));
}

TEST_CASE("a feed that changes in every period is followed", "[linuxcnc]") {
    for (const double jerk : {0.0, 30'000.0}) {
        Control control(machine_of(3, 0.001, jerk));
        REQUIRE(control.add(line_to(40.0, 0.0, 50.0)) == 0);
        REQUIRE(control.add(line_to(40.0, 30.0, 50.0)) == 0);
        int periods = 0;
        for (; control.out.first != control.out.last && periods < 4000; ++periods) {
            control.input.ratio = 0.8 + 0.0001 * (7919 * periods % 100);
            control.period();
        }
        CAPTURE(jerk, periods);
        CHECK(periods < 2000); // 1750 at 40 mm/s
        CHECK(control.out.position[1] == 30.0);
        CHECK(control.use() <= 1.0001);
    }
}

TEST_CASE("noise of the feed in every period costs at most 1 %", "[linuxcnc]") {
    for (const double jerk : {0.0, 30'000.0}) {
        for (const bool smooth : {false, true}) { // corners, or a curve that is travelled at the feed
            std::size_t periods[2] = {};
            for (const double noise : {0.0, 0.1}) {
                Control control(machine_of(3, 0.001, jerk));
                for (int i = 1; i <= (smooth ? 400 : 25); ++i) {
                    const double a = 0.02 * i;
                    REQUIRE(control.add(smooth ? line_to(30.0 * std::sin(a), 20.0 * std::sin(1.7 * a), 100.0)
                                               : line_to(3.0 * i, 8.0 * (i % 2), 30.0)) == 0);
                }
                for (int n = 0; control.out.first != control.out.last && n < 100'000; ++n) {
                    control.input.ratio = 0.9 + noise * (7919 * n % 201 - 100) / 100.0;
                    control.period();
                }
                REQUIRE(control.out.first == control.out.last);
                CHECK(control.use() <= 1.0001);
                periods[noise > 0.0 ? 1 : 0] = control.places.size();
            }
            CAPTURE(jerk, smooth, periods[0]);
            CHECK(static_cast<double>(periods[1]) < 1.01 * static_cast<double>(periods[0]));
        }
    }
}

TEST_CASE("a feed that is on and off in turn, from period to period, moves the machine with its mean", "[linuxcnc]") {
    for (const double jerk : {0.0, 30'000.0}) {
        for (const double period_s : {0.001, 0.00025}) {
            for (const auto& off : {tpc_input{0.0, 1.0, 1e6, 0, 0, 0, 0, 0}, tpc_input{0.05, 1.0, 1e6, 0, 0, 0, 0, 0},
                                    tpc_input{1.0, 1.0, 0.0, 0, 0, 0, 0, 0}, tpc_input{1.0, 1.0, 1e6, 1, 0, 0, 0, 0}}) {
                for (const int half : {1, 3}) { // periods
                    Control control(machine_of(3, period_s, jerk));
                    REQUIRE(control.add(line_to(40.0, 0.0, 50.0)) == 0);
                    REQUIRE(control.add(line_to(40.0, 30.0, 50.0)) == 0);
                    int periods = 0;
                    while (control.out.first != control.out.last && periods * period_s < 5.0) {
                        control.input = periods++ / half % 2 == 1 ? off : tpc_input{1.0, 1.0, 1e6, 0, 0, 0, 0, 0};
                        control.period();
                    }
                    CAPTURE(jerk, period_s, off.ratio, off.max_feed, off.hold, half);
                    CHECK(periods * period_s < 4.0); // 2.8 at 25 mm/s, and what late planning costs
                    CHECK(periods * period_s > 2.5); // it does not ignore half of what it is told
                    CHECK(control.out.position[1] == 30.0);
                    CHECK(control.use() <= 1.0001);
                    CHECK(control.figures().late == 0);
                }
            }
        }
    }
}

TEST_CASE("a value is passed on at its pace, and 0 at once", "[linuxcnc]") {
    PacedValue value(1.0);
    const auto passes = [&](double asked) {
        return value.take(asked, 0.022, 0.09);
    };
    CHECK_FALSE(passes(1.0));
    CHECK(passes(0.5)); // the first change
    CHECK_FALSE(passes(0.7));
    CHECK_FALSE(passes(0.9));
    CHECK(passes(0.0)); // a stop
    CHECK(value.value() == 0.0);
    CHECK(passes(1.0));
    CHECK(value.value() == 1.0);
    for (const double asked : {0.0, 1.0, 0.0, 0.0}) { // both again, shortly behind them: they wait
        CHECK_FALSE(passes(asked));
    }
    CHECK(passes(0.0));
    CHECK(value.value() == Approx(0.2)); // the mean
    for (int n = 0; n < 4; ++n) {
        CHECK_FALSE(passes(0.0));
    }
    CHECK(passes(0.0)); // and then what is asked
    CHECK(value.value() == 0.0);
}

TEST_CASE("however long a feed is on and off in turn, or nearly off, its mean is followed", "[linuxcnc]") {
    for (const double jerk : {0.0, 30'000.0}) {
        for (const double low : {0.0, 0.05}) {
            for (const int on : {1, 5, 12, 40}) { // ms
                for (const int off : {1, 5, 12, 40}) {
                    Control control(machine_of(3, 0.001, jerk));
                    REQUIRE(control.add(line_to(200.0, 0.0, 50.0)) == 0);
                    for (int n = 0; n < 2000; ++n) {
                        control.input.ratio = n % (on + off) < on ? 1.0 : low;
                        control.period();
                    }
                    CAPTURE(jerk, low, on, off);
                    const double mean_mm = 100.0 * (on + low * off) / (on + off);
                    CHECK(control.out.position[0] == Approx(mean_mm).margin(12.0)); // a start and a stop more
                    CHECK(control.use() <= 1.0001);
                }
            }
        }
    }
}

TEST_CASE("a feed that goes down by and by to a stop stops at once", "[linuxcnc]") {
    for (const double half : {0.4, 0.05}) {
        PacedValue value(1.0);
        CHECK(value.take(half, 0.001, 0.004));
        CHECK_FALSE(value.take(half, 0.001, 0.004));
        CHECK(value.take(0.0, 0.001, 0.004));
        CHECK(value.value() == 0.0);
    }
}

TEST_CASE("a pause shortly behind a resume acts as soon as another one", "[linuxcnc]") {
    for (const double jerk : {0.0, 30'000.0}) {
        for (const int between : {1, 3, 20, 50, 90}) { // ms
            Control control(machine_of(3, 0.001, jerk));
            REQUIRE(control.add(line_to(80.0, 0.0, 50.0)) == 0);
            const auto run = [&](int hold, int periods) {
                control.input.hold = hold;
                int moving = 0;
                for (int n = 0; n < periods; ++n) {
                    control.period();
                    moving = control.out.speed > 0.0 ? n : moving;
                }
                return moving;
            };
            run(0, 300);
            const int first = run(1, 400);
            run(0, between);
            CAPTURE(jerk, between, first);
            CHECK(run(1, 400) <= first + 40); // with a jerk limit the plan of the resume is ready, 40 segments
            CHECK(control.use() <= 1.0001);
        }
    }
}

TEST_CASE("of two changes that follow each other the second one comes through in time, too", "[linuxcnc]") {
    for (const double jerk : {0.0, 30'000.0}) {
        Control control(machine_of(3, 0.00025, jerk));
        REQUIRE(control.add(line_to(80.0, 0.0, 50.0)) == 0);
        const auto until_below = [&](double speed) {
            int periods = 0;
            for (; !(control.out.speed < speed) && periods < 10'000; ++periods) {
                control.period();
            }
            return periods * 0.00025;
        };
        while (control.places.size() < 1600) {
            control.period();
        }
        REQUIRE(control.out.speed == Approx(50.0));
        control.input.ratio = 0.9;
        control.period();
        control.input.ratio = 0.5;
        CAPTURE(jerk);
        // 8 segments of 0.25 ms, or 40 of 1 ms, are ready. The second change waits for the pace of changes, 4 or 100
        // ms.
        CHECK(until_below(44.0) < (jerk > 0.0 ? 0.17 : 0.0095));
        CHECK(until_below(25.1) < 0.15);
    }
}
