// SPDX-License-Identifier: MIT
// Moves from rest to rest by Ruckig, for bench/peers.py: rows "x y z" of displacements on standard input; the duration
// of each [s], and behind all of them the processor time of one [us].
#include <ruckig/ruckig.hpp>

#include <array>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <vector>

int main(int argc, char** argv) {
    if (argc != 4) {
        return 2;
    }
    ruckig::InputParameter<3> input;
    input.max_velocity.fill(std::atof(argv[1]));
    input.max_acceleration.fill(std::atof(argv[2]));
    input.max_jerk.fill(std::atof(argv[3]));
    input.synchronization = ruckig::Synchronization::Phase; // on a straight line, as the other one
    ruckig::Ruckig<3> planner;
    ruckig::Trajectory<3> trajectory;
    std::vector<std::array<double, 3>> moves;
    for (std::array<double, 3> to{}; std::cin >> to[0] >> to[1] >> to[2];) {
        moves.push_back(to);
    }
    std::vector<double> durations;
    const std::clock_t begin = std::clock();
    for (const auto& to : moves) {
        input.target_position = to;
        if (planner.calculate(input, trajectory) != ruckig::Result::Working) {
            return 1;
        }
        durations.push_back(trajectory.get_duration());
    }
    const double took_us = 1e6 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC; // of the processor
    for (const double duration : durations) {
        std::cout << duration << '\n';
    }
    std::cout << took_us / static_cast<double>(moves.size()) << '\n';
}
