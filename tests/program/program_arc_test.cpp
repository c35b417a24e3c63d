// SPDX-License-Identifier: MIT
#include "support/gcode.hpp"
#include "support/rounds.hpp"

#include "splinefeed/s1_blended_path/path_move.hpp"

#include <cmath>
#include <random>

using namespace splinefeed_test;

namespace {

std::string word(char letter, double value) {
    char text[40];
    std::snprintf(text, sizeof text, " %c%.4f", letter, value);
    return text;
}

} // namespace

TEST_CASE("random arcs lead from their start to their end about their centre", "[program][arc]") {
    const unsigned seed = random_seed();
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    GcodeRun<double> run;
    run.run("F600 G0 X0 Y0");
    for (int i = 0; i < rounds(2000); ++i) {
        const double reach = std::pow(10.0, 3.0 * unit(random));
        const bool by_radius = random() % 2 == 0;
        const bool clockwise = random() % 2 == 0;
        const double x = std::round(to_mm(run.interpreter().position()[0]) * 1e4) / 1e4;
        const double y = std::round(to_mm(run.interpreter().position()[1]) * 1e4) / 1e4;
        const double angle = M_PI * unit(random);
        const double turn = M_PI * (1.0 + 0.98 * unit(random));
        const double cx = reach * std::cos(angle);
        const double cy = reach * std::sin(angle);
        // Turn the start about the centre.
        const double signed_turn = clockwise ? -turn : turn;
        const double ex = x + cx - (cx * std::cos(signed_turn) - cy * std::sin(signed_turn));
        const double ey = y + cy - (cx * std::sin(signed_turn) + cy * std::cos(signed_turn));
        std::string line = clockwise ? "G2" : "G3";
        line += word('X', ex) + word('Y', ey);
        line += by_radius ? word('R', turn > M_PI ? -reach : reach) : word('I', cx) + word('J', cy);
        if (std::hypot(ex - x, ey - y) < 0.02 || (by_radius && std::fabs(turn - M_PI) < 0.2)) {
            continue; // four decimals do not say the centre
        }
        CAPTURE(line, x, y, reach, turn);
        const BlockStatus status = run.push(line);
        if (reach < 0.1 && !status.ok()) {
            continue; // 0.1 um of rounding are much of so small a radius
        }
        REQUIRE(status.ok());
        const PathElement<double>& element = run.items().back().element;
        const double close = 2e-3 + 1e-3 * reach;
        CHECK(std::fabs(to_mm(element.arc.centre[0]) - (x + cx)) < close * 10);
        CHECK(std::fabs(to_mm(element.arc.centre[1]) - (y + cy)) < close * 10);
        // Four decimals: the chord c is wrong by 7e-5, R by 5e-5, and the turn t of R by (dc + 2 dR) / (R |cos(t/2)|).
        CHECK(std::fabs(element.arc.sweep_rad - signed_turn) < 0.05 + (by_radius ? 0.0018 : 0.001) / reach);
        PathMove<double> move; // the core takes it
        PerAxis<Position> from{};
        from[0] = position_from_mm(x);
        from[1] = position_from_mm(y);
        REQUIRE(move.set(from, element, 3).ok());
        CHECK(move.length() == Approx(turn * reach * 4096.0).epsilon(0.01).margin(20.0));
    }
}

TEST_CASE("radii may differ as in grbl", "[program][arc]") {
    const auto push = [](const char* line) {
        ProgramSettings settings = six_axes();
        settings.dialect = Dialect::grbl;
        GcodeRun<double> run(settings);
        run.run("F600 G0 X0 Y0");
        return run.push(line).error;
    };
    CHECK(push("G2 X20.009 I10") == ProgramError::none);                // 0.009 of 10: below 0.1 %
    CHECK(push("G2 X20.012 I10") == ProgramError::arc_radius_mismatch); // above both
    CHECK(push("G2 X2.0049 I1") == ProgramError::none);                 // below 0.005 mm
    CHECK(push("G2 X2.006 I1") == ProgramError::arc_radius_mismatch);
    CHECK(push("G2 X2000.4 I1000") == ProgramError::none);
    CHECK(push("G2 X2000.6 I1000") == ProgramError::arc_radius_mismatch); // more than 0.5 mm
    CHECK(push("G2 X0.1049 I0.05") == ProgramError::none);                // a tenth of the radius: the centre moves
}

TEST_CASE("an arc that all but closes is a whole turn, one that barely opens is not", "[program][arc]") {
    const auto sweep = [](const char* line) {
        GcodeRun<double> run;
        run.run("F600 G0 X0 Y0");
        return run.run(line).back().element.arc.sweep_rad;
    };
    CHECK(sweep("G3 X0 Y0 I10") == Approx(2.0 * M_PI));
    CHECK(sweep("G3 Y-0.000001 I10") == Approx(2.0 * M_PI)); // 1e-7 rad
    CHECK(sweep("G3 Y-0.0001 I10") == Approx(1e-5));
    CHECK(sweep("G2 Y-0.0001 I10") == Approx(-2.0 * M_PI + 1e-5));
    CHECK(sweep("G3 Y0.0001 I10") == Approx(2.0 * M_PI - 1e-5));
}

TEST_CASE("arcs on machines whose axes stand in another order", "[program][arc]") {
    ProgramSettings settings;
    settings.axes = 3;
    settings.letters = {'Y', 'X', 'Z'};
    GcodeRun<double> run(settings);
    run.run("F600");
    const auto items = run.run("G3 X10 Y10 I0 J10");
    CHECK(to_mm(items.back().element.to[0]) == Approx(10.0));
    PathMove<double> move;
    REQUIRE(move.set({}, items.back().element, 3).ok());
    PathState<double> state;
    move.behind_start(1.0, state);
    CHECK(state.tangent[1] == Approx(1.0).margin(1e-3)); // along X first
    CHECK(move.length() / 4096.0 == Approx(5.0 * M_PI).margin(1e-6));

    settings.letters = {'X', 'A', 'B'};
    GcodeRun<double> turning(settings);
    turning.run("F600");
    CHECK(turning.push("G2 X1 I1").error == ProgramError::arc_axes_unsuited);

    settings.axes = 2;
    settings.letters = {'X', 'Y', 'Z'};
    GcodeRun<double> flat(settings);
    CHECK(flat.last("F600 G2 X10 I5", 2) == "feed arc 10 0 about 5 0 0 by -180");
    CHECK(flat.push("G18 G2 X0 I-5").error == ProgramError::arc_axes_unsuited);
}
