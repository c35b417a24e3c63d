// SPDX-License-Identifier: MIT
#include "splinefeed/s1_blended_path/joint.hpp"

#include "support/moves_deviation.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr Real degree = std::numbers::pi_v<Real> / 180.0L;

/// Two lines that meet in the origin.
MoveProgram corner(Real degrees, Real before_mm, Real behind_mm, double tolerance_mm) {
    MoveProgram program;
    program.axes = 2;
    program.start = {-before_mm, 0.0L};
    program.line({});
    program.line({behind_mm * std::cos(degrees * degree), behind_mm * std::sin(degrees * degree)});
    for (ProgrammedMove& move : program.moves) {
        move.tolerance_mm = tolerance_mm;
    }
    return program;
}

template <Scalar S>
std::array<PathMove<S>, 2> moves_of(const MoveProgram& program) {
    std::array<PathMove<S>, 2> out;
    for (unsigned i = 0; i < 2; ++i) {
        const ProgrammedMove& move = program.moves[i];
        REQUIRE(out[i].set(position_of<S>(move.from), element_of<S>(move, program.axes), program.axes).ok());
    }
    return out;
}

template <Scalar S>
Joint<S> joint_of(const MoveProgram& program, PathMode mode = PathMode::continuous, double exact_mm = 0.001,
                  bool curvature = true) {
    const auto moves = moves_of<S>(program);
    const S tolerance = from_double<S>(program.moves[0].tolerance_mm * 4096.0);
    return decide_joint<S>(moves[0], moves[1], mode, {tolerance, from_double<S>(exact_mm * 4096.0), {}, curvature},
                           program.axes);
}

} // namespace

TEMPLATE_TEST_CASE("a corner between long lines is the cubic of its tolerance", "[blended_path]", double, float,
                   Fixed) {
    using S = TestType;
    for (const Real degrees : {1.0L, 10.0L, 45.0L, 90.0L, 135.0L, 170.0L, 179.0L}) {
        const MoveProgram program = corner(degrees, 1000.0L, 1000.0L, 0.05);
        const auto moves = moves_of<S>(program);
        const Joint<S> joint = joint_of<S>(program);
        Blend<S> blend;
        CAPTURE(static_cast<double>(degrees));
        REQUIRE(joint.kind == JointKind::blend);
        REQUIRE(fit_blend(joint, moves[0], moves[1], from_integer<S>(1 << 22), 2, blend));
        CHECK(blend.degree == 3);
        // l = 4 P / sin(phi/2); the middle is l sin(phi/2) / 4 from the corner
        const Real way = 4.0L * 0.05L * 4096.0L / std::sin(degrees * degree / 2.0L);
        CHECK(std::fabs(exact(blend.way) / way - 1.0L) < 4e-5L * (std::same_as<S, float> ? 1.0L : 1e-3L));
        const Real x = (exact(blend.points[0][0]) + exact(blend.points[0][3])) / 8.0L;
        const Real y = (exact(blend.points[1][0]) + exact(blend.points[1][3])) / 8.0L;
        CHECK(std::fabs(std::hypot(x, y) / (0.05L * 4096.0L) - 1.0L) < 1e-4L);
    }
}

TEMPLATE_TEST_CASE("a corner between short lines uses its tolerance on less way", "[blended_path]", double, float,
                   Fixed) {
    using S = TestType;
    const MoveProgram program = corner(90.0L, 10.0L, 10.0L, 0.1);
    const auto moves = moves_of<S>(program);
    const Joint<S> joint = joint_of<S>(program);
    const Real wished = exact(joint.way);
    for (const Real share : {0.95L, 0.8L, 0.7L, 0.5L, 0.1L}) {
        Blend<S> blend;
        REQUIRE(fit_blend(joint, moves[0], moves[1], from_double<S>(static_cast<double>(share * wished)), 2, blend));
        CHECK(blend.degree == 5);
        // e = l sin(phi/2) (1/4 + w/8), w at most 1
        const Real most = share * wished * std::sin(45.0L * degree) * 0.375L / 4096.0L;
        CurveSegment<S> segment;
        segment.axes = 2;
        segment.degree = 5;
        segment.assign(blend.points);
        const PlaceMm middle = place_of(segment, 0.5L);
        const Real deviation_mm = std::hypot(middle[0], middle[1]);
        CAPTURE(static_cast<double>(share), static_cast<double>(deviation_mm));
        CHECK(deviation_mm < std::min(0.1L, most) * 1.001L);
        CHECK(deviation_mm > std::min(0.1L, most) * 0.999L);
    }
}

TEMPLATE_TEST_CASE("a rounder corner uses a large tolerance on little way", "[blended_path]", double, float, Fixed) {
    using S = TestType;
    for (const Real degrees : {10.0L, 60.0L, 90.0L, 150.0L}) {
        const MoveProgram program = corner(degrees, 10.0L, 10.0L, 0.1);
        const auto moves = moves_of<S>(program);
        const Joint<S> joint = joint_of<S>(program);
        for (const Real share : {0.95L, 0.6L, 0.5L, 0.3L}) {
            Blend<S> blend;
            const Real way = share * exact(joint.way);
            REQUIRE(fit_blend(joint, moves[0], moves[1], from_double<S>(static_cast<double>(way)), 2, blend,
                              from_integer<S>(2)));
            CurveSegment<S> segment;
            segment.axes = 2;
            segment.degree = 5;
            segment.assign(blend.points);
            const PlaceMm middle = place_of(segment, 0.5L);
            const Real most = way * std::sin(degrees * degree / 2.0L) * 0.5L / 4096.0L; // as a parabola
            CAPTURE(static_cast<double>(degrees), static_cast<double>(share));
            CHECK(std::fabs(std::hypot(middle[0], middle[1]) / std::min(0.1L, most) - 1.0L) < 1e-3L);
        }
    }
}

TEMPLATE_TEST_CASE("what becomes of a joint depends on geometry and mode", "[blended_path]", double, float, Fixed) {
    using S = TestType;
    CHECK(joint_of<S>(corner(0.0L, 1.0L, 1.0L, 0.01)).kind == JointKind::through);
    CHECK(joint_of<S>(corner(30.0L, 1.0L, 1.0L, 0.01)).kind == JointKind::blend);
    CHECK(joint_of<S>(corner(179.8L, 1.0L, 1.0L, 0.01)).kind == JointKind::stop);
    CHECK(joint_of<S>(corner(180.0L, 1.0L, 1.0L, 0.01)).kind == JointKind::stop);
    CHECK(joint_of<S>(corner(30.0L, 1.0L, 1.0L, 0.0)).kind == JointKind::stop);
    CHECK(joint_of<S>(corner(30.0L, 1.0L, 1.0L, 0.01), PathMode::exact_path).kind == JointKind::stop);
    CHECK(joint_of<S>(corner(30.0L, 1.0L, 1.0L, 0.01), PathMode::exact_stop).kind == JointKind::stop);
    CHECK(joint_of<S>(corner(0.0L, 1.0L, 1.0L, 0.01), PathMode::exact_path).kind == JointKind::through);
    CHECK(joint_of<S>(corner(0.0L, 1.0L, 1.0L, 0.01), PathMode::exact_stop).kind == JointKind::stop);
    // Below a degree an exact path is rounded within its own tolerance, and not where that is 0.
    for (const Real degrees : {0.9L, 0.01L, 1e-4L}) {
        const MoveProgram kink = corner(degrees, 1.0L, 1.0L, 0.01);
        const Joint<S> joint = joint_of<S>(kink, PathMode::exact_path);
        CHECK(joint.kind == JointKind::blend);
        CHECK(std::fabs(exact(joint.tolerance) / 4096.0L - 0.001L) < 1e-6L);
        CHECK(joint_of<S>(kink, PathMode::exact_path, 0.0).kind == JointKind::through);
        CHECK(joint_of<S>(kink, PathMode::exact_stop).kind == JointKind::stop);
    }
    CHECK(joint_of<S>(corner(1.1L, 1.0L, 1.0L, 0.01), PathMode::exact_path).kind == JointKind::stop);
    // The curvature jumps: a blend within the tolerance of tangents, also in exact_path mode
    MoveProgram program;
    program.start = {-20.0L, 0.0L, 0.0L};
    program.line({});
    program.arc(0.0L, 10.0L, 1.5L);
    for (const PathMode mode : {PathMode::continuous, PathMode::exact_path}) {
        const Joint<S> joint = joint_of<S>(program, mode);
        CHECK(joint.kind == JointKind::blend);
        const Real tolerance = mode == PathMode::exact_path ? 0.001L : 0.01L;
        CHECK(std::fabs(exact(joint.tolerance) / 4096.0L - tolerance) < 1e-6L);
        // a = sqrt(e / (0.011 |K1 - K0|))
        CHECK(std::fabs(exact(joint.way) / 4096.0L / std::sqrt(tolerance / (0.011L * 0.1L)) - 1.0L) < 1e-4L);
    }
    // but where such a jump costs nothing an exact path stays
    CHECK(joint_of<S>(program, PathMode::exact_path, 0.001, false).kind == JointKind::through);
    CHECK(joint_of<S>(program, PathMode::continuous, 0.001, false).kind == JointKind::blend);
}

TEMPLATE_TEST_CASE("a corner whose blend would be too sharp is a stop", "[blended_path]", double, float, Fixed) {
    using S = TestType;
    // The curvature in the middle is (2/3) tan^2(phi/2) / e: 0.48 / mm and 1.14 / mm
    for (const double tolerance : {0.1, 0.05}) {
        for (const Real degrees : {30.0L, 45.0L}) {
            const MoveProgram program = corner(degrees, 10.0L, 10.0L, tolerance);
            TolerancePath<S> path(2, {from_double<S>(0.001), {from_double<S>(0.5), S{}}});
            REQUIRE(path.start(position_of<S>(program.start)).ok());
            REQUIRE(path.push(element_of<S>(program.moves[0], 2)).ok());
            REQUIRE(path.push(element_of<S>(program.moves[1], 2)).ok());
            REQUIRE(path.finish().ok());
            CurveSegment<S> segment;
            while (path.next(segment) == Pull::item) {
            }
            CHECK(path.counts().joints.blended == (tolerance > 0.07 && degrees < 40.0L ? 1U : 0U));
        }
    }
}

TEMPLATE_TEST_CASE("how sharp a blend may be depends on the turn", "[blended_path]", double, float, Fixed) {
    using S = TestType;
    // Within 0.01 mm: 22 / mm at 60 degrees, 67 / mm at 90. The limits are multiplied by 1 / 0.6^2, 1 / 0.2^2, without
    // end.
    struct Case {
        Real degrees;
        double most_1_mm;
        unsigned blends;
    };
    for (const Case& c : {Case{60.0L, 8.3, 1}, {60.0L, 7.7, 0}, {90.0L, 2.8, 1}, {90.0L, 2.5, 0}, {120.0L, 0.001, 1}}) {
        const MoveProgram program = corner(c.degrees, 10.0L, 10.0L, 0.01);
        TolerancePath<S> path(2, {from_double<S>(0.001), {from_double<S>(c.most_1_mm), from_double<S>(1.6)}});
        REQUIRE(path.start(position_of<S>(program.start)).ok());
        REQUIRE(path.push(element_of<S>(program.moves[0], 2)).ok());
        REQUIRE(path.push(element_of<S>(program.moves[1], 2)).ok());
        REQUIRE(path.finish().ok());
        CurveSegment<S> segment;
        while (path.next(segment) == Pull::item) {
        }
        CAPTURE(static_cast<double>(c.degrees), c.most_1_mm);
        CHECK(path.counts().joints.blended == c.blends);
    }
}

TEMPLATE_TEST_CASE("parts of one curve meet in no joint, and what bends there is one", "[blended_path]", double,
                   Fixed) {
    using S = TestType;
    // A cubic that is divided in the middle; the second part begins in another direction, or with another curvature.
    const auto parts = [](Real size, Real turn, Real bend) {
        const Real x[] = {0.0L, 0.3L * size, 0.7L * size, size};
        const Real y[] = {0.0L, 0.1L * size, 0.4L * size, 0.3L * size};
        const auto half = [](const Real(&p)[4], int from) {
            const Real a = (p[0] + p[1]) / 2.0L;
            const Real b = (p[1] + p[2]) / 2.0L;
            const Real c = (p[2] + p[3]) / 2.0L;
            const Real d = (a + b) / 2.0L;
            const Real e = (b + c) / 2.0L;
            return from == 0 ? std::array<Real, 4>{p[0], a, d, (d + e) / 2.0L}
                             : std::array<Real, 4>{(d + e) / 2.0L, e, c, p[3]};
        };
        MoveProgram program;
        program.axes = 2;
        for (const int from : {0, 1}) {
            const auto px = half(x, from);
            auto py = half(y, from);
            if (from == 1) {
                const Real leg = px[1] - px[0];
                py[1] += turn * leg;
                py[2] += 2.0L * turn * leg + bend * leg * leg * 1.5L; // the curvature is 2/3 of that over leg^2, about
            }
            std::vector<PlaceMm> offsets;
            for (std::size_t i = 1; i < 4; ++i) {
                offsets.push_back({px[i] - px[0], py[i] - py[0]});
            }
            program.bezier(offsets).tolerance_mm = 0.01;
        }
        return program;
    };
    const auto kind = [](const MoveProgram& program) {
        const auto moves = moves_of<S>(program);
        JointTolerances<S> tolerances{from_double<S>(0.01 * 4096.0), from_double<S>(0.001 * 4096.0), {}, true};
        tolerances.smooth = {from_double<S>(1e-8), S{}};
        return decide_joint<S>(moves[0], moves[1], PathMode::continuous, tolerances, 2).kind;
    };
    for (const Real size : {0.05L, 1.0L, 30.0L, 500.0L}) {
        CAPTURE(static_cast<double>(size));
        CHECK(kind(parts(size, 0.0L, 0.0L)) == JointKind::through);
        CHECK(kind(parts(size, 1e-6L, 0.0L)) == JointKind::blend);
        CHECK(kind(parts(size, 0.0L, 1e-3L / size)) == JointKind::blend);
    }
}
