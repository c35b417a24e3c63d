// SPDX-License-Identifier: MIT
//
// Programs within a tolerance, of the kinds that people cut: nearly every leg that begins in motion is planned anew.
#include "wild_run.hpp"

#include "host/temporary_folder.hpp"
#include "support/bezier_paths.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <cmath>
#include <fmt/format.h>
#include <fstream>

using namespace splinefeed_test;
using splinefeed::host::RunArguments;

namespace {

constexpr std::uint64_t seed = 39;

/// Lines and arcs that turn by all angles, as long as the legs of a pocket or of letters.
std::string program(Random& random, double tolerance_mm, bool gentle) {
    std::string text = fmt::format("G21 G90 G64 P{} F{:.0f}\n", tolerance_mm, random.decades(1500.0, 6000.0));
    const double step = random.decades(0.4, 8.0) * (gentle ? 10.0 : 1.0);
    double x = 0.0;
    double y = 0.0;
    double heading = 0.0;
    for (int i = 0; i < 120; ++i) {
        heading += (gentle ? 0.2 : 1.0) * (random.chance(0.5) ? random.between(-0.3, 0.3) : random.between(-2.6, 2.6));
        const double length = step * random.decades(0.3, 3.0);
        x += length * std::cos(heading);
        y += length * std::sin(heading);
        const bool curved = random.chance(gentle ? 0.5 : 0.3);
        const double out = random.between(-1.0, 1.0);
        const double in = random.between(-1.0, 1.0);
        if (curved && gentle) {
            text += fmt::format("G5 I{:.4f} J{:.4f} P{:.4f} Q{:.4f} X{:.4f} Y{:.4f}\n", out * length, length, length,
                                in * length, x, y);
        } else if (curved) {
            text += fmt::format("G{} X{:.4f} Y{:.4f} R{:.4f}\n", in > 0.0 ? 2 : 3, x, y, (1.8 + 1.2 * out) * length);
        } else {
            text += fmt::format("G1 X{:.4f} Y{:.4f}\n", x, y);
        }
    }
    return text + "M2\n";
}

} // namespace

TEST_CASE("legs that begin in motion are planned anew", "[wild][jerk]") {
    // One in 40 was not, because an axis, or the start, that no smaller share of the limits could change kept the rest
    // from it
    const TemporaryFolder folder;
    RunArguments arguments;
    arguments.motion.quiet = true;
    arguments.path.format = splinefeed::host::input_format("gcode");
    arguments.path.input = folder.file("moving.ngc");
    arguments.machine = folder.file("moving.toml");
    std::ofstream(arguments.machine) << "sample_period_us = 1000\n[path]\nmax_feed_mm_s = 100\n";
    for (const char axis : {'x', 'y'}) {
        std::ofstream(arguments.machine, std::ios::app)
            << fmt::format("[[axis]]\nname = \"{}\"\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\n"
                           "max_jerk_mm_s3 = 30000\nsteps_per_mm = 320\n",
                           axis);
    }
    std::uint64_t searched = 0;
    std::uint64_t slow = 0;
    for (std::uint64_t round = first_round(); round < static_cast<std::uint64_t>(rounds(48)); ++round) {
        Random random(seed + round);
        std::ofstream(arguments.path.input) << program(random, round % 2 == 0 ? 0.01 : 0.05, round % 3 == 0);
        const WildRun run = wild_run(arguments, 400'000);
        CAPTURE(seed, round, run.refused, run.slow_legs, run.searched_legs);
        CHECK(run.fault == "");
        CHECK(run.ended);
        searched += run.searched_legs;
        slow += run.slow_legs;
    }
    CAPTURE(searched, slow);
    CHECK(600 * slow <= searched);
}
