// SPDX-License-Identifier: MIT
//
// Joints in single precision, between chords that differ a thousandfold.
#include "splinefeed/s1_curve/g2_bezier.hpp"
#include "splinefeed/s1_curve/g2_spline.hpp"

#include "support/curve_harness.hpp"
#include "support/rounds.hpp"

#include <cstdio>
#include <cstdlib>

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

/// Points 0.02 to 20 mm apart, more or less, on a random smooth loop that bends by 20 to 60 mm.
std::vector<Waypoint<float>> uneven_loop(RandomPath& random, int axes, int count) {
    std::vector<double> at{0.0};
    for (int i = 0; i < count; ++i) {
        const double step = i == count / 2 ? 1.0 : i == count / 3 ? 0.0 : random.between(0.0, 1.0);
        at.push_back(at.back() + 0.02 * std::pow(1000.0, step));
    }
    std::vector<double> phases;
    for (int k = 0; k < 2 * axes; ++k) {
        phases.push_back(random.between(0.0, 6.283185307179586));
    }
    std::vector<double> mm;
    for (int i = 0; i < count; ++i) {
        const double angle = 6.283185307179586 * at[static_cast<unsigned>(i)] / at.back();
        for (unsigned k = 0; k < static_cast<unsigned>(axes); ++k) {
            mm.push_back(at.back() / 6.0 *
                         (std::sin(angle + phases[2 * k]) + 0.1 * std::sin(2.0 * angle + phases[2 * k + 1])));
        }
    }
    std::vector<Waypoint<float>> points = waypoints_of<float>(path_of(axes, mm));
    for (Waypoint<float>& point : points) {
        point.corner = Corner::forbidden;
    }
    return points;
}

/// What one rounding of the Bezier points changes of a curvature at an end of a segment, in 1/mm.
Real rounding_of(Real curvature, const CurveSegment<float>& segment, bool at_end) {
    const Real leg = size(at_end ? bezier(segment, 3) - bezier(segment, 2) : bezier(segment, 1));
    Real reach = 0.0L;
    for (int i = 1; i <= 3; ++i) {
        reach = std::max(reach, size(bezier(segment, i)));
    }
    return 0x1p-24L * reach / leg * (1.0L / leg + 2.0L * curvature);
}

struct Jumps {
    Real by_chord = 0.0L;    ///< largest curvature jump times the shorter chord
    Real by_rounding = 0.0L; ///< and over what one rounding makes of it on both sides
    Real turn = 0.0L;        ///< of the tangent
};

void measure(Jumps& most, const std::vector<CurveSegment<float>>& segments, bool closed) {
    const std::size_t count = segments.size();
    for (std::size_t i = 0; i + (closed ? 0U : 1U) < count; ++i) {
        const CurveSegment<float>& a = segments[i];
        const CurveSegment<float>& b = segments[(i + 1) % count];
        const Joint joint = joint_of(a, b);
        const Real chord = std::min(size(bezier(a, 3)), size(bezier(b, 3)));
        most.by_chord = std::max(most.by_chord, joint.curvature_jump * chord);
        const Real one = rounding_of(joint.curvature, a, true) + rounding_of(joint.curvature, b, false);
        most.by_rounding = std::max(most.by_rounding, joint.curvature_jump / one);
        most.turn = std::max(most.turn, joint.direction);
    }
}

} // namespace

// The figures and their derivation: docs/explanation/numbers.md, "Continuity in float".
TEST_CASE("float: the curvature at joints of uneven chords jumps by roundings of the shorter chord alone",
          "[curve][g2][g2bezier][random]") {
    RandomPath random(path_seed + 30);
    CAPTURE(path_seed);
    Jumps chordal;
    Jumps others; // spans that are not the chords
    Jumps under_tension;
    for (int round = 0; round < rounds(60); ++round) {
        const int axes = 2 + round % 5;
        const auto points = uneven_loop(random, axes, 60);
        for (const bool closed : {false, true}) {
            const auto feeds = closed ? closed_feeds(points) : open_feeds(points);
            for (const Parameterization how :
                 {Parameterization::uniform, Parameterization::chordal, Parameterization::centripetal}) {
                CAPTURE(round, closed, static_cast<int>(how));
                G2Spline<float> plain({axes, how, 0.5F});
                const auto segments = run_curve<float>(plain, feeds);
                REQUIRE(segments.size() == points.size() - (closed ? 0U : 1U));
                measure(how == Parameterization::chordal ? chordal : others, segments, closed);
                G2Bezier<float> weighted({axes, how, 0.5F});
                REQUIRE(same_curve(run_curve<float>(weighted, feeds), segments));
                G2Bezier<float> tense({axes, how, 0.5F}, {true, 1.0F, 5.0F});
                measure(under_tension, run_curve<float>(tense, feeds), closed);
            }
        }
    }
    if (std::getenv("SPLINEFEED_FIGURES") != nullptr) {
        std::printf(
            "curvature jump times the shorter chord %.2g, turn %.2g rad; roundings: chordal %.2g, other spans %.2g, "
            "tension %.2g\n",
            static_cast<double>(chordal.by_chord), static_cast<double>(chordal.turn),
            static_cast<double>(chordal.by_rounding), static_cast<double>(others.by_rounding),
            static_cast<double>(under_tension.by_rounding));
    }
    CHECK(static_cast<double>(chordal.by_chord) <= 2.5e-6);
    CHECK(static_cast<double>(chordal.turn) <= 1e-6);
    CHECK(static_cast<double>(chordal.by_rounding) <= 4.0);
    CHECK(static_cast<double>(others.by_rounding) <= 8.0);
    // Tangents are small beside the chords that they come from.
    CHECK(static_cast<double>(under_tension.by_rounding) <= 100.0);
}
