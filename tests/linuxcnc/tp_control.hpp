// SPDX-License-Identifier: MIT
//
// LinuxCNC around the module, for tests without it.
#pragma once

#include "linuxcnc/tp_motion.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <memory>
#include <vector>

namespace linuxcnc_test {

using namespace splinefeed::linuxcnc;

/// Each look at the clock takes a microsecond, or what a test says; in a starved period the second one a second.
inline long long clock_ns = 0;
inline long long look_ns = 1'000;
inline bool starved = false;
inline long long look() {
    clock_ns += starved ? 1'000'000'000 : look_ns;
    return clock_ns;
}

inline tpc_machine machine_of(int axes, double period_s, double jerk) {
    tpc_machine machine{};
    machine.axes = axes;
    for (int k = 0; k < axes; ++k) {
        machine.axis[k] = k;
        machine.velocity[k] = 100.0;
        machine.acceleration[k] = 1000.0;
        machine.jerk[k] = jerk;
    }
    machine.mm_per_unit = 1.0;
    machine.period_s = period_s;
    return machine;
}

inline tpc_move line_to(double x, double y, double feed, double tolerance = 0.01) {
    tpc_move move{};
    move.mode = TPC_CONTINUOUS;
    move.to[0] = x;
    move.to[1] = y;
    move.tolerance = tolerance;
    move.feed = feed;
    return move;
}

/// LinuxCNC around the module: a move and a period at a time.
class Control {
public:
    explicit Control(const tpc_machine& of) : machine(of), motion_(std::make_unique<TpMotion>()) {
        motion_->create({look, 0.1, machine.jerk[0] > 0.0 ? 40 : 8, 0.01}, machine);
        const double zero[tpc_axes] = {};
        motion_->set(zero);
    }
    int add(const tpc_move& move) {
        const int error = motion_->add(move);
        out.last += error == 0 ? 1U : 0U;
        return error;
    }
    void period() {
        if (motion_->begins() && input.abort == 0) {
            motion_->begin(machine);
        }
        motion_->run(input, out);
        places.push_back({out.position[0], out.position[1], out.position[2]});
        aborted = aborted || input.abort != 0;
        input.abort = out.first == out.last ? 0 : input.abort;
    }
    void spindle(double turns, double per_s) { motion_->spindle(turns, per_s); }
    void set(double x) {
        const double position[tpc_axes] = {x};
        motion_->set(position);
    }
    void until_over() {
        for (int n = 0; n < 1'000'000 && out.first != out.last; ++n) {
            period();
        }
        REQUIRE(out.first == out.last);
    }
    /// The largest use of a limit of the axes.
    [[nodiscard]] double use() const {
        double most = 0.0;
        const double t = machine.period_s;
        for (std::size_t i = 3; i < places.size(); ++i) {
            for (unsigned k = 0; k < 3; ++k) {
                const auto d = [&](std::size_t n) {
                    return places[n][k] - places[n - 1][k];
                };
                most = std::max(most, std::fabs(d(i)) / t / machine.velocity[k]);
                most = std::max(most, std::fabs(d(i) - d(i - 1)) / (t * t) / machine.acceleration[k]);
                if (machine.jerk[k] > 0.0) {
                    most = std::max(most, std::fabs(d(i) - 2.0 * d(i - 1) + d(i - 2)) / (t * t * t) / machine.jerk[k]);
                }
            }
        }
        return most;
    }
    [[nodiscard]] const tpc_figures& figures() const { return motion_->figures(); }

    tpc_input input{1.0, 1.0, 1e6, 0, 0, 0, 0, 0};
    tpc_output out{};
    std::vector<std::array<double, 3>> places;
    bool aborted = false; // at any time
    tpc_machine machine;  // when the next path begins

private:
    std::unique_ptr<TpMotion> motion_;
};

/// Two moves of 10 mm. Before the second one the machine stands, and waits until it may begin.
inline void add_waiting(Control& control) {
    REQUIRE(control.add(line_to(10.0, 0.0, 50.0)) == 0);
    tpc_move waits = line_to(20.0, 0.0, 50.0);
    waits.stands_before = 1;
    REQUIRE(control.add(waits) == 0);
}

/// It waits there, and makes the second move when it may.
inline void expect_waiting(Control& control) {
    CHECK(control.out.waits == 1);
    CHECK(control.out.first == 1);
    CHECK(control.out.position[0] == Approx(10.0).margin(1e-9));
    control.input.may_begin = 1;
    control.until_over();
    CHECK(control.out.position[0] == 20.0);
}

} // namespace linuxcnc_test
