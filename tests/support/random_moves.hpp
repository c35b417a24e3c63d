// SPDX-License-Identifier: MIT
//
// Random moves of all kinds and sizes.
#pragma once

#include "programmed_moves.hpp"

namespace splinefeed_test {

/// @param longest  of a move [mm]
inline MoveProgram random_moves(Random& random, Real longest = 2e3L) {
    MoveProgram program;
    program.axes = random.integer(1, max_axes);
    const double tolerance = random.decades(1e-3, 0.5);
    const double size = random.decades(1e-2, 100.0);
    const double spread = random.chance(0.5) ? 1.5 : 1000.0;
    const bool smooth = random.chance(0.4);
    PlaceMm direction{};
    direction[0] = 1.0L;
    for (int i = 0, count = random.integer(1, 20); i < count; ++i) {
        const Real length = std::min(longest, real_decades(random, size / spread, size * spread));
        Real sum = 0.0L;
        const double turn = smooth && random.chance(0.9) ? 0.3 : random.decades(1e-4, 10.0);
        for (const unsigned k : splinefeed::indices(program.axes)) {
            direction[k] += real_between(random, -turn, turn);
            sum += direction[k] * direction[k];
        }
        PlaceMm to = program.moves.empty() ? program.start : program.moves.back().to;
        for (const unsigned k : splinefeed::indices(program.axes)) {
            direction[k] /= std::sqrt(sum);
            to[k] += length * direction[k];
        }
        if (program.axes > 1 && random.chance(0.15)) {
            const PlaceMm from = program.moves.empty() ? program.start : program.moves.back().to;
            const Real radius = length * real_decades(random, 0.1, 10.0);
            const Real side = random.chance(0.5) ? 1.0L : -1.0L;
            const Real angle = random.chance(0.5) ? 0.0L : real_between(random, -1.0, 1.0);
            const Real plane = std::max(1e-3L, std::hypot(direction[0], direction[1]));
            const Real x = -side * (direction[1] * std::cos(angle) + direction[0] * std::sin(angle)) / plane;
            const Real y = side * (direction[0] * std::cos(angle) - direction[1] * std::sin(angle)) / plane;
            const Real rise = random.chance(0.3) ? length * 0.1L : 0.0L;
            const Real sweep = random.chance(0.2) ? real_between(random, 0.1, 15.0) : real_between(random, 0.05, 3.0);
            // A move has 65 m at most.
            program.arc(from[0] + radius * x, from[1] + radius * y, side * std::min(sweep, 6e4L / radius), rise);
        } else if (random.chance(0.1)) {
            const PlaceMm from = program.moves.empty() ? program.start : program.moves.back().to;
            std::vector<PlaceMm> offsets;
            for (int n = 1, degree = random.integer(1, 5); n <= degree; ++n) {
                PlaceMm offset{};
                for (const unsigned k : splinefeed::indices(program.axes)) {
                    offset[k] =
                        (to[k] - from[k]) * n / degree + 0.3L * length * real_between(random, -1.0, 1.0) / degree;
                }
                offsets.push_back(offset);
            }
            program.bezier(offsets);
        } else {
            program.line(to);
        }
        ProgrammedMove& move = program.moves.back();
        move.tolerance_mm = random.chance(0.05) ? 0.0 : random.chance(0.1) ? tolerance * 0.3 : tolerance;
        move.mode = random.chance(0.9)   ? splinefeed::PathMode::continuous
                    : random.chance(0.5) ? splinefeed::PathMode::exact_path
                                         : splinefeed::PathMode::exact_stop;
        move.stop_at_end = random.chance(0.03);
        move.feed_mm_s = random.chance(0.2) ? random.decades(1.0, 100.0) : 0.0;
    }
    return program;
}

} // namespace splinefeed_test
