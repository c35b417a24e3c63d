// SPDX-License-Identifier: MIT
//
// G2Bezier: by default G2Spline bit by bit; with bias and tension the curve that is solved for all waypoints at once,
// and joints that are what was asked however little is seen ahead.
#include "splinefeed/s1_curve/g2_bezier.hpp"

#include "splinefeed/s1_curve/g2_spline.hpp"
#include "splinefeed/splines/g2_bezier.hpp"
#include "support/curve_harness.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

template <Scalar S>
BetaJoints<S> joints_of(double beta1, double beta2) { // beta1 0: the ratio of the spans
    BetaJoints<S> joints;
    joints.span_ratio = beta1 == 0.0;
    joints.beta1 = from_double<S>(beta1 == 0.0 ? 1.0 : beta1);
    joints.beta2 = from_double<S>(beta2);
    return joints;
}

template <Scalar S>
std::vector<Feed<S>> smooth_feeds(const Path& path) {
    std::vector<Feed<S>> feeds = feeds_of<S>(path);
    for (auto& feed : feeds) {
        feed.point.corner = Corner::forbidden;
    }
    return feeds;
}

/// The curve solved at once, in double; control points from the start of each piece. Ends in units of the end chord.
std::vector<Cubic> at_once(const Path& path, const BetaJoints<double>& joints, bool closed,
                           const EndTangents<double>& ends = {}) {
    const auto axes = static_cast<std::size_t>(path.axes);
    std::vector<double> points;
    for (const auto& point : path.points) {
        for (std::size_t k = 0; k < axes; ++k) {
            points.push_back(to_mm(point[k]));
        }
    }
    const G2BezierJoint<double> joint{joints.span_ratio, joints.beta1, joints.beta2};
    const auto chords = chords_of(path);
    std::vector<double> start;
    std::vector<double> end;
    for (unsigned k = 0; k < axes; ++k) {
        start.push_back(ends.start[k] * static_cast<double>(size(chords.front())));
        end.push_back(ends.end[k] * static_cast<double>(size(chords.back())));
    }
    G2BezierInput<double> input;
    input.axes = path.axes;
    input.closed = closed;
    input.coordinates = points;
    input.joints = {&joint, 1};
    if (ends.has_start) {
        input.start = start;
    }
    if (ends.has_end) {
        input.end = end;
    }
    std::vector<double> tangents(points.size());
    std::vector<double> scratch(path.points.size());
    std::vector<BezierPiece<double>> pieces(path.points.size() - (closed ? 0U : 1U));
    REQUIRE(g2_bezier_tangents<double>(input, tangents, scratch).ok());
    REQUIRE(g2_bezier_pieces<double>(input, tangents, pieces).ok());
    std::vector<Cubic> cubics;
    for (const auto& piece : pieces) {
        Cubic& cubic = cubics.emplace_back();
        for (unsigned p = 0; p < 4; ++p) {
            for (unsigned k = 0; k < axes; ++k) {
                cubic[p][k] = static_cast<Real>(piece.control[k][p]) - static_cast<Real>(piece.control[k][0]);
            }
        }
    }
    return cubics;
}

template <Scalar S>
Real deviation(const std::vector<CurveSegment<S>>& segments, const std::vector<Cubic>& cubics) {
    REQUIRE(segments.size() == cubics.size());
    Real worst = 0.0L;
    for (std::size_t i = 0; i < cubics.size(); ++i) {
        for (int p = 0; p < 4; ++p) {
            worst = std::max(worst, distance_of(bezier(segments[i], p), cubics[i][static_cast<unsigned>(p)]));
        }
    }
    return worst;
}

/// Joints are G2, with these betas. `tangent` mm is where directions begin to mean something.
template <Scalar S>
void require_joints(const std::vector<CurveSegment<S>>& segments, const Path& path, const BetaJoints<S>& joints,
                    std::size_t count) {
    const double fine = std::same_as<S, float> ? 1e-2 : 1e-7;
    for (std::size_t i = 0; i < count; ++i) {
        const CurveSegment<S>& a = segments[i];
        const CurveSegment<S>& b = segments[(i + 1) % segments.size()];
        const Joint joint = joint_of(a, b);
        const Vec q1 = 3.0L * (bezier(a, 3) - bezier(a, 2));
        const Vec r1 = 3.0L * (bezier(b, 1) - bezier(b, 0));
        const Vec q2 = 6.0L * (bezier(a, 3) - 2.0L * bezier(a, 2) + bezier(a, 1));
        const Vec r2 = 6.0L * (bezier(b, 0) - 2.0L * bezier(b, 1) + bezier(b, 2));
        const Real from = size(origin_from(b, a.origin)); // the chords, also across the seam
        const Real to = size(origin_from(segments[(i + 2) % segments.size()], b.origin));
        const Real chord = i + 2 < segments.size() || count == segments.size() ? to : size(chords_of(path).back());
        const Real beta1 = joints.span_ratio ? chord / from : exact(joints.beta1);
        const Real square = beta1 * beta1;
        CAPTURE(i, static_cast<double>(beta1), static_cast<double>(joint.least_leg));
        const double leg = static_cast<double>(joint.least_leg);
        if (leg < 0.02) {
            continue;
        }
        CHECK(static_cast<double>(joint.gap) < (std::same_as<S, float> ? 1e-4 : 1e-11));
        CHECK(static_cast<double>(joint.direction) < fine / leg);
        CHECK(static_cast<double>(joint.curvature_jump) <
              fine / (leg * leg) * (1.0 + static_cast<double>(joint.curvature)));
        CHECK(static_cast<double>(size(r1) / size(q1)) == Approx(static_cast<double>(beta1)).epsilon(fine / leg));
        const Vec left = r2 - square * q2;
        const double beta2 = static_cast<double>(dot(left, q1) / dot(q1, q1));
        CHECK(beta2 == Approx(to_double(joints.beta2)).margin(fine * static_cast<double>(1.0L + square) * 40.0 / leg));
    }
}

} // namespace

TEMPLATE_TEST_CASE("g2-bezier: the default is g2, bit by bit", "[curve][g2bezier]", double, float, Fixed) {
    using S = TestType;
    RandomPath random;
    CAPTURE(path_seed);
    EndTangents<S> ends;
    ends.has_start = true;
    ends.start[0] = literal<S>(0.5);
    for (const Shape shape : all_shapes) {
        for (const auto how : {Parameterization::uniform, Parameterization::chordal, Parameterization::centripetal}) {
            for (const int count : {2, 3, 4, 17, 60}) {
                for (const bool given : {false, true}) {
                    const Path path = random.make(shape, 3, count);
                    const CurveOptions<S> options{3, how, literal<S>(0.5)};
                    const EndTangents<S> tangents = given ? ends : EndTangents<S>{};
                    G2Spline<S> plain(options, tangents);
                    G2Bezier<S> joined(options, {}, tangents);
                    CAPTURE(static_cast<int>(shape), static_cast<int>(how), count, given);
                    CHECK(same_curve(run_curve<S>(joined, feeds_of<S>(path)), run_curve<S>(plain, feeds_of<S>(path))));
                }
            }
        }
    }
}

TEMPLATE_TEST_CASE("g2-bezier: the curve that is solved at once, with joints as asked", "[curve][g2bezier]", double,
                   float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 20);
    CAPTURE(path_seed);
    const double settings[][2] = {{0, 0}, {0, 0.5},  {0, 8}, {0, 300}, {1, 0},
                                  {1, 5}, {1.25, 0}, {2, 3}, {0.9, 1}, {0.75, 6}};
    for (const auto& [beta1, beta2] : settings) {
        const BetaJoints<S> joints = joints_of<S>(beta1, beta2);
        REQUIRE(joints.check().ok());
        const BetaJoints<double> exact_joints = joints_of<double>(beta1, beta2);
        Real worst = 0.0L;
        for (const int count : {2, 3, 4, 5, 16, 17, 18, 40, 200}) {
            const Path path = random.make(beta1 == 0 ? Shape::uneven : Shape::even, 3, count);
            for (int which = 0; which < 4; ++which) {
                EndTangents<S> ends;
                EndTangents<double> exact_ends;
                ends.has_start = exact_ends.has_start = (which & 1) != 0;
                ends.has_end = exact_ends.has_end = (which & 2) != 0;
                ends.start[1] = literal<S>(0.75);
                exact_ends.start[1] = 0.75;
                ends.end[0] = literal<S>(-0.5);
                exact_ends.end[0] = -0.5;
                G2Bezier<S> curve({3, Parameterization::chordal, literal<S>(0.5)}, joints, ends);
                const auto segments = run_curve<S>(curve, smooth_feeds<S>(path));
                CAPTURE(beta1, beta2, count, which);
                worst = std::max(worst, deviation(segments, at_once(path, exact_joints, false, exact_ends)));
                require_joints(segments, path, joints, segments.size() - 1);
            }
        }
        CAPTURE(beta1, beta2);
        CHECK(static_cast<double>(worst) < (std::same_as<S, float> ? 1e-3 : 1e-6));
    }
}

TEMPLATE_TEST_CASE("g2-bezier: a closed curve has a seam like any joint", "[curve][g2bezier][closed]", double, float,
                   Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 21);
    CAPTURE(path_seed);
    const double settings[][2] = {{0, 0}, {0, 2}, {0, 50}, {1, 0}, {1.25, 4}, {0.9, 2}};
    for (const auto& [beta1, beta2] : settings) {
        for (const int count : {3, 4, 5, 8, 16, 17, 33, 60}) {
            std::vector<double> mm;
            for (int i = 0; i < count; ++i) {
                const double angle = 6.283185307179586 * (i + random.between(-0.2, 0.2)) / count;
                const double radius = random.between(8.0, 12.0);
                mm.insert(mm.end(), {radius * std::cos(angle), radius * std::sin(angle)});
            }
            const Path path = path_of(2, mm);
            auto points = waypoints_of<S>(path);
            for (auto& point : points) {
                point.corner = Corner::forbidden;
            }
            const BetaJoints<S> joints = joints_of<S>(beta1, beta2);
            G2Bezier<S> curve({2, Parameterization::chordal, literal<S>(0.5)}, joints);
            const auto segments = run_curve<S>(curve, closed_feeds(points));
            CAPTURE(beta1, beta2, count);
            REQUIRE(segments.size() == static_cast<std::size_t>(count));
            require_joints(segments, path, joints, segments.size());
            const Real worst = deviation(segments, at_once(path, joints_of<double>(beta1, beta2), true));
            // Up to 20 mm of chord: twenty times what one of 1 mm loses.
            CHECK(static_cast<double>(worst) < (std::same_as<S, float> ? 5e-3 : 1e-5));
        }
    }
}

TEMPLATE_TEST_CASE("g2-bezier: a beta1 other than 1 goes on for ever", "[curve][g2bezier]", double, float, Fixed) {
    using S = TestType;
    for (const double beta1 : {0.5, 0.75, 1.5, 2.0}) { // 2^20000 would be beyond every number
        RandomPath random(path_seed + 22);
        const BetaJoints<S> joints = joints_of<S>(beta1, 0.0);
        REQUIRE(joints.check().ok());
        const Path path = random.make(Shape::helix, 3, 20000);
        G2Bezier<S> curve({3, Parameterization::chordal, literal<S>(0.5)}, joints);
        const auto segments = run_curve<S>(curve, feeds_of<S>(path));
        REQUIRE(segments.size() == 19999);
        CAPTURE(beta1);
        require_joints(segments, path, joints, 200);
        // The same piece of helix again and again: the curve has settled, and stays what it is.
        for (const std::size_t i : {std::size_t{10000}, std::size_t{19000}}) {
            const Real ratio = size(bezier(segments[i], 2)) / size(bezier(segments[100], 2));
            CHECK(static_cast<double>(ratio) == Approx(1.0).epsilon(0.02));
        }
    }
}

TEMPLATE_TEST_CASE("g2-bezier: corners cut it, and the pace changes nothing", "[curve][g2bezier]", double, float,
                   Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 23);
    CAPTURE(path_seed);
    for (const double beta1 : {0.0, 1.25}) {
        const BetaJoints<S> joints = joints_of<S>(beta1, 1.5);
        const Path path = random.make(Shape::even, 2, 50);
        for (const std::size_t cut : {std::size_t{1}, std::size_t{2}, std::size_t{20}, std::size_t{48}}) {
            auto feeds = smooth_feeds<S>(path);
            feeds[cut].point.corner = Corner::forced;
            const CurveOptions<S> options{2, Parameterization::chordal, literal<S>(0.5)};
            G2Bezier<S> curve(options, joints);
            G2Bezier<S> again(options, joints);
            const auto segments = run_curve<S>(curve, feeds, Pace::eager);
            CAPTURE(beta1, cut);
            CHECK(same_curve(segments, run_curve<S>(again, feeds, Pace::lazy)));
            const auto middle = static_cast<std::ptrdiff_t>(cut);
            const Path first{2, {path.points.begin(), path.points.begin() + middle + 1}};
            const Path second{2, {path.points.begin() + middle, path.points.end()}};
            const std::vector<CurveSegment<S>> before(segments.begin(), segments.begin() + middle);
            const std::vector<CurveSegment<S>> after(segments.begin() + middle, segments.end());
            const double fine = std::same_as<S, float> ? 1e-3 : 1e-6;
            const auto exact_joints = joints_of<double>(beta1, 1.5);
            CHECK(static_cast<double>(deviation(before, at_once(first, exact_joints, false))) < fine);
            CHECK(static_cast<double>(deviation(after, at_once(second, exact_joints, false))) < fine);
            CHECK(segments[cut - 1].stop_at_end);
        }
    }
}

TEMPLATE_TEST_CASE("g2-bezier: joints that do not settle are refused", "[curve][g2bezier]", double, float, Fixed) {
    using S = TestType;
    const auto error = [](double beta1, double beta2) {
        BetaJoints<S> joints = joints_of<S>(1.0, beta2);
        joints.beta1 = from_double<S>(beta1);
        return joints.check().error();
    };
    CHECK(error(1.0, 0.0) == Error::none);
    CHECK(error(0.0, 0.0) == Error::beta1_not_positive);
    CHECK(error(-1.0, 0.0) == Error::beta1_not_positive);
    CHECK(error(1.0, -0.125) == Error::beta2_out_of_range);
    CHECK(error(1.0, 1000.5) == Error::beta2_out_of_range);
    CHECK(error(2.6, 0.0) == Error::none);
    CHECK(error(2.63, 0.0) == Error::beta1_out_of_range);
    CHECK(error(2.63, 1.0) == Error::none);
    CHECK(error(0.385, 0.0) == Error::none);
    CHECK(error(0.38, 0.0) == Error::beta1_out_of_range);
    CHECK(error(0.38, 1.0) == Error::none);
    CHECK(error(8.25, 1000.0) == Error::beta1_out_of_range);
    CHECK(error(0.12, 1000.0) == Error::beta1_out_of_range);
}
