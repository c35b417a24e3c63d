// SPDX-License-Identifier: MIT
//
// What a servo period of splinefeed_tp.so takes, without LinuxCNC, as processor time: other programs do not count, but
// interrupts, cold caches and a host below this system do. So the same periods are repeated, with the same answers of
// the clock, by which each repetition does the same: what the quickest of a period takes is its work.
//
//     cmake --build build/linuxcnc --target linuxcnc_period && build/linuxcnc/linuxcnc/linuxcnc_period
#include "tp_core.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <random>
#include <vector>

namespace {

long long processor_ns() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return t.tv_sec * 1'000'000'000LL + t.tv_nsec;
}

std::vector<long long> answers; // of the clock
std::size_t answered = 0;
long long asked_ns() {
    answers.push_back(processor_ns());
    return answers.back();
}
long long repeated_ns() {
    return answers.at(answered++);
}

tpc_machine machine_of(double period_s, double jerk) {
    tpc_machine machine{};
    machine.axes = 3;
    for (int k = 0; k < machine.axes; ++k) {
        machine.axis[k] = k;
        machine.velocity[k] = 100.0;
        machine.acceleration[k] = 1000.0;
        machine.jerk[k] = jerk;
    }
    machine.mm_per_unit = 1.0;
    machine.period_s = period_s;
    return machine;
}

/// Short lines along a curve, or corners: a move comes in each period, as LinuxCNC's task sends them.
std::vector<double> run(const tpc_machine& machine, bool corners) {
    const double zero[tpc_axes] = {};
    tpc_set(zero);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    const tpc_input input{1.0, 1.0, 1e6, 0, 0, 0, 0, 0};
    tpc_output output{};
    std::vector<double> us;
    double angle = 0.0;
    tpc_move move{};
    move.mode = TPC_CONTINUOUS;
    move.tolerance = 0.01;
    move.feed = 80.0;
    for (int left = corners ? 400 : 6000; left > 0 || output.first != output.last;) {
        if (left > 0 && output.last - output.first < tpc_capacity - 48U) {
            angle += 0.01 + 0.02 * any(random);
            move.to[0] = corners ? move.to[0] + 10.0 * any(random) : 30.0 * std::sin(angle);
            move.to[1] = corners ? move.to[1] + 10.0 * any(random) : 20.0 * std::sin(1.7 * angle);
            output.last += tpc_add(&move) == 0 ? 1U : 0U;
            --left;
        }
        const long long start = processor_ns();
        if (tpc_begins() != 0) {
            tpc_begin(&machine);
        }
        tpc_run(&input, &output);
        us.push_back(static_cast<double>(processor_ns() - start) * 1e-3);
    }
    return us;
}

} // namespace

/// The longest period, each by its quickest run.
double longest_work_us(const tpc_machine& machine, tpc_settings settings, bool corners, std::vector<double> least) {
    settings.now_ns = repeated_ns;
    for (int n = 0; n < 15; ++n) {
        answered = 0;
        tpc_create(&settings, &machine);
        const std::vector<double> us = run(machine, corners);
        if (us.size() != least.size() || answered != answers.size()) {
            return NAN; // it did not do the same
        }
        std::transform(us.begin(), us.end(), least.begin(), least.begin(),
                       [](double a, double b) { return std::min(a, b); });
    }
    return *std::max_element(least.begin(), least.end());
}

int main() {
    answers.reserve(1U << 24);
    std::puts("| period us | jerk | path | mean us | 99 % | 99.9 % | longest | least of 15, longest "
              "|\n|---|---|---|---|---|---|---|---|");
    for (const double period_s : {0.001, 0.00025}) {
        for (const double jerk : {0.0, 30'000.0}) {
            const tpc_machine machine = machine_of(period_s, jerk);
            const tpc_settings settings{asked_ns, 0.1, jerk > 0.0 ? 40 : 8, 0.01};
            for (const bool corners : {false, true}) {
                tpc_create(&settings, &machine);
                answers.clear();
                std::vector<double> us = run(machine, corners);
                double sum = 0.0;
                for (const double one : us) {
                    sum += one;
                }
                const double work_us = longest_work_us(machine, settings, corners, us);
                std::sort(us.begin(), us.end());
                std::printf("| %.0f | %.0f | %s | %.1f | %.0f | %.0f | %.0f | %.1f |\n", period_s * 1e6, jerk,
                            corners ? "corners" : "short lines", sum / static_cast<double>(us.size()),
                            us[us.size() * 99 / 100], us[us.size() * 999 / 1000], us.back(), work_us);
            }
        }
    }
}
