// SPDX-License-Identifier: MIT
//
// What the core refuses: nothing moves, the reason is told once, and nothing of the queue is travelled.
#include "tp_control.hpp"

#include "splinefeed/s3_feed_plan/limits/limit_errors.hpp"

#include <limits>
#include <string>

using namespace linuxcnc_test;
using splinefeed::LimitError;

TEST_CASE("with limits that cannot be nothing moves, and with others the machine goes on from there", "[linuxcnc]") {
    struct Limits {
        double velocity;
        double acceleration;
        double jerk;
        LimitError error;
    };
    for (const double begun : {0.0, 7.0}) {
        for (const Limits& bad :
             {Limits{100.0, 2e6, 0.0, LimitError::acceleration_out_of_range},
              Limits{100.0, 0.0, 0.0, LimitError::acceleration_out_of_range},
              Limits{0.0, 1000.0, 0.0, LimitError::velocity_out_of_range},
              Limits{2e4, 1000.0, 0.0, LimitError::velocity_out_of_range},
              Limits{std::numeric_limits<double>::quiet_NaN(), 1000.0, 0.0, LimitError::velocity_out_of_range},
              Limits{100.0, 1000.0, 0.5, LimitError::jerk_out_of_range}}) {
            CAPTURE(begun, bad.velocity, bad.acceleration, bad.jerk);
            const tpc_machine good = machine_of(3, 0.001, 0.0);
            Control control(good);
            if (begun > 0.0) {
                REQUIRE(control.add(line_to(begun, 0.0, 50.0)) == 0);
                control.until_over();
            }
            control.machine.velocity[1] = bad.velocity;
            control.machine.acceleration[1] = bad.acceleration;
            control.machine.jerk[1] = bad.jerk;
            REQUIRE(control.add(line_to(30.0, 0.0, 50.0)) == 0);
            REQUIRE(control.add(line_to(300.0, 0.0, 50.0)) == 0);
            control.period();
            REQUIRE(control.out.error != nullptr);
            CHECK(std::string(control.out.error) == splinefeed::describe(bad.error));
            CHECK(control.out.first == control.out.last);
            CHECK(control.out.complete == 0);
            CHECK(control.out.position[0] == begun);
            control.period();
            CHECK(control.out.error == nullptr);
            CHECK(control.out.position[0] == begun);
            control.machine = good;
            REQUIRE(control.add(line_to(begun + 1.0, 2.0, 50.0)) == 0);
            control.until_over();
            CHECK(control.out.complete == 1);
            CHECK(control.out.position[0] == begun + 1.0);
            CHECK(control.out.position[1] == 2.0);
            CHECK(control.use() <= 1.0001);
        }
    }
}

TEST_CASE("the largest limits that the module hands on are taken, in both units", "[linuxcnc]") {
    for (const double mm : {1.0, 25.4}) {
        for (const double jerk : {0.0, TPC_MOST_JERK / mm}) {
            CAPTURE(mm, jerk);
            tpc_machine machine = machine_of(3, 0.001, jerk);
            machine.mm_per_unit = mm;
            machine.velocity[1] = TPC_MOST_VELOCITY / mm;
            machine.acceleration[1] = TPC_MOST_ACCELERATION / mm;
            Control control(machine);
            REQUIRE(control.add(line_to(5.0, 5.0, 50.0)) == 0);
            control.until_over();
            CHECK(control.out.position[1] == 5.0);
            CHECK(control.figures().late == 0);
        }
    }
}

TEST_CASE("from a position that the core does not have no move begins", "[linuxcnc]") {
    Control control(machine_of(3, 0.001, 0.0));
    control.set(1.5e6);
    CHECK(control.add(line_to(1.04e6, 0.0, 50.0)) == static_cast<int>(splinefeed::Error::position_out_of_range));
    control.set(0.0);
    REQUIRE(control.add(line_to(1.0, 0.0, 50.0)) == 0);
    control.until_over();
    CHECK(control.out.position[0] == 1.0);
}

TEST_CASE("axes that are fast alone are not too fast together", "[linuxcnc]") {
    tpc_machine machine = machine_of(4, 0.001, 0.0);
    for (double& velocity : machine.velocity) {
        velocity = 9000.0;
    }
    Control control(machine);
    REQUIRE(control.add(line_to(5.0, 5.0, 50.0)) == 0);
    control.until_over();
    CHECK(control.out.position[0] == 5.0);
}
