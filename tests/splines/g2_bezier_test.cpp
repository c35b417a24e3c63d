// SPDX-License-Identifier: MIT
//
// G2 Bezier interpolation: with the defaults against the chord-length spline from moments in long double; with bias and
// tension against its own conditions, which have one solution: points, joints as measured, ends.
#include "splinefeed/splines/g2_bezier.hpp"

#include "splinefeed/splines/beta_joint.hpp"
#include "support/curve_harness.hpp"

#include <limits>

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

template <Scalar S>
struct Solved {
    Status status;
    std::vector<S> tangents;
    std::vector<BezierPiece<S>> pieces;
};

template <Scalar S>
Solved<S> solve(const G2BezierInput<S>& input) {
    Solved<S> out;
    const std::size_t n = input.point_count();
    out.tangents.resize(input.coordinates.size());
    std::vector<S> scratch(n);
    out.pieces.resize(input.closed ? n : n - 1);
    out.status = g2_bezier_tangents<S>(input, out.tangents, scratch);
    if (out.status.ok()) {
        out.status = g2_bezier_pieces<S>(input, out.tangents, out.pieces);
    }
    return out;
}

/// Random walk in steps of 1/4 to 4 on a grid of 2^-10.
template <Scalar S>
std::vector<S> walk(RandomPath& random, int axes, int count) {
    std::vector<S> out;
    std::vector<int> at(static_cast<std::size_t>(axes), 0);
    for (int i = 0; i < count; ++i) {
        const int step = 256 << random.below(5);
        for (std::size_t k = 0; k < at.size(); ++k) { // ever forward on the first axis: no two points are the same
            out.push_back(scale2(from_integer<S>(at[k]), -10));
            at[k] += k == 0 ? 1 + random.below(step) : random.below(2 * step) - step;
        }
    }
    return out;
}

template <Scalar S>
std::vector<Vec> chords_of(const std::vector<S>& coordinates, int axes, bool closed) {
    std::vector<Vec> chords;
    const std::size_t n = coordinates.size() / static_cast<std::size_t>(axes);
    for (std::size_t i = 0; i + (closed ? 0U : 1U) < n; ++i) {
        Vec chord{};
        for (const unsigned k : indices(axes)) {
            const std::size_t a = static_cast<std::size_t>(axes);
            chord[k] = exact(coordinates[(i + 1) % n * a + k]) - exact(coordinates[i * a + k]);
        }
        chords.push_back(chord);
    }
    return chords;
}

/// Rounding of a tangent: 16 units of the longest chord times the ratio of neighbours, as for the streaming spline.
template <Scalar S>
Real bound_of(const std::vector<Vec>& chords, Real largest) {
    Real ratio = 1.0L;
    Real longest = 0.0L;
    for (std::size_t i = 0; i < chords.size(); ++i) {
        const Real a = size(chords[i]);
        const Real b = size(chords[(i + 1) % chords.size()]);
        ratio = std::max({ratio, a / b, b / a});
        longest = std::max(longest, a);
    }
    return 64.0L * (1.0L + ratio) * unit_roundoff<S>() * (std::same_as<S, Fixed> ? 1.0L + longest : longest) +
           4.0L * unit_roundoff<S>() * largest;
}

} // namespace

TEMPLATE_TEST_CASE("g2 bezier: the default is the cubic spline by chord length", "[splines][g2bezier]", double, float,
                   Fixed) {
    using S = TestType;
    RandomPath random;
    CAPTURE(path_seed);
    for (const bool closed : {false, true}) {
        for (int count = closed ? 3 : 2; count < 40; ++count) {
            const int axes = 1 + (count + (closed ? 1 : 0)) % 6;
            const std::vector<S> points = walk<S>(random, axes, count);
            G2BezierInput<S> input;
            input.axes = axes;
            input.closed = closed;
            input.coordinates = points;
            CAPTURE(closed, count, axes);
            const Solved<S> solved = solve(input);
            REQUIRE(solved.status.ok());
            const auto chords = chords_of(points, axes, closed);
            const auto h = spans_of(chords, Parameterization::chordal);
            const auto cubics = closed ? solve_periodic(chords, h) : solve_run(chords, h);
            const Real e = bound_of<S>(chords, 200.0L);
            for (std::size_t i = 0; i < cubics.size(); ++i) {
                REQUIRE(solved.pieces[i].degree == 3);
                for (unsigned p = 0; p < 4; ++p) {
                    Vec error{};
                    for (unsigned k = 0; k < 6; ++k) {
                        error[k] = exact(solved.pieces[i].control[k][p]) - exact(solved.pieces[i].control[k][0]) -
                                   cubics[i][p][k];
                    }
                    REQUIRE(size(error) <= e);
                }
            }
        }
    }
}

TEMPLATE_TEST_CASE("g2 bezier: bias and tension are what is measured", "[splines][g2bezier]", double, float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 1);
    CAPTURE(path_seed);
    const double fine = std::same_as<S, float> ? 1e-2 : 2e-6;
    for (const bool closed : {false, true}) {
        for (int round = 0; round < 60; ++round) {
            const int count = (closed ? 3 : 2) + random.below(30);
            const int axes = 2 + random.below(5);
            const std::vector<S> points = walk<S>(random, axes, count);
            std::vector<G2BezierJoint<S>> joints(static_cast<std::size_t>(closed ? count : count - 2));
            for (auto& joint : joints) {
                joint.chord_ratio = random.below(2) == 0;
                joint.beta1 = scale2(from_integer<S>(48 + random.below(48)), -6);
                joint.beta2 = random.below(2) == 0 ? S{} : scale2(from_integer<S>(random.below(640)), -6);
            }
            const bool one_for_all = round % 3 == 0 && joints.size() > 1;
            G2BezierInput<S> input;
            input.axes = axes;
            input.closed = closed;
            input.coordinates = points;
            input.joints = one_for_all ? std::span<const G2BezierJoint<S>>(joints).first(1)
                                       : std::span<const G2BezierJoint<S>>(joints);
            std::vector<S> end(static_cast<std::size_t>(axes), literal<S>(0.75));
            const bool has_start = !closed && round % 4 == 1;
            const bool has_end = !closed && round % 5 == 1;
            if (has_start) {
                input.start = end;
            }
            if (has_end) {
                input.end = end;
            }
            CAPTURE(closed, round, count, axes);
            const Solved<S> solved = solve(input);
            REQUIRE(solved.status.ok());
            const auto chords = chords_of(points, axes, closed);
            const std::size_t pieces = solved.pieces.size();
            for (std::size_t i = 0; i < pieces; ++i) {
                for (unsigned k = 0; k < 6; ++k) { // the points themselves, bit by bit
                    const auto& c = solved.pieces[i].control[k];
                    const auto a = static_cast<std::size_t>(axes);
                    REQUIRE(c[0] == (k < a ? points[i * a + k] : S{}));
                    REQUIRE(c[3] == (k < a ? points[(i + 1) % static_cast<std::size_t>(count) * a + k] : S{}));
                }
                if (!closed && i + 1 == pieces) {
                    break;
                }
                const std::size_t next = (i + 1) % pieces;
                const auto& joint = joints[one_for_all ? 0 : closed ? next : i];
                const double beta1 = joint.chord_ratio ? static_cast<double>(size(chords[next]) / size(chords[i]))
                                                       : to_double(joint.beta1);
                const auto found = measure_joint(solved.pieces[i], solved.pieces[next]);
                REQUIRE(found.has_value());
                const double leg = to_double(norm(solved.tangents.data() + (i + 1) % static_cast<std::size_t>(count) *
                                                                               static_cast<std::size_t>(axes),
                                                  axes));
                if (leg * std::min(beta1, 1.0) < 0.05) {
                    continue; // too little tangent to measure by
                }
                CHECK(to_double(found->tangent_jump) < fine / leg);
                CHECK(to_double(found->beta.beta1) == Approx(beta1).epsilon(fine / leg));
                CHECK(to_double(found->curvature_jump) < 40.0 * fine / (leg * leg * std::min(1.0, beta1 * beta1)));
                CHECK(to_double(found->beta.beta2) ==
                      Approx(to_double(joint.beta2)).margin(40.0 * fine * (1.0 + beta1 * beta1) / leg));
            }
            const auto leg = [&](std::size_t piece, unsigned from, unsigned k) {
                const auto& c = solved.pieces[piece].control[k];
                return static_cast<double>(exact(c[from + 1]) - exact(c[from]));
            };
            for (unsigned k = 0; !closed && k < static_cast<unsigned>(axes); ++k) {
                CHECK(leg(0, 0, k) == Approx(has_start ? 0.25 : leg(0, 1, k)).margin(fine));
                CHECK(leg(pieces - 1, 2, k) == Approx(has_end ? 0.25 : leg(pieces - 1, 1, k)).margin(fine));
            }
        }
    }
}

TEMPLATE_TEST_CASE("g2 bezier: a beta1 other than 1 at thousands of joints", "[splines][g2bezier]", double, float,
                   Fixed) {
    using S = TestType;
    std::vector<S> points; // a zigzag of even chords
    for (int i = 0; i < 5000; ++i) {
        points.push_back(from_integer<S>(i));
        points.push_back(from_integer<S>(i % 2));
    }
    for (const double beta1 : {0.5, 0.75, 1.5, 2.0}) { // 2^5000 would be beyond every number
        G2BezierJoint<S> joint;
        joint.chord_ratio = false;
        joint.beta1 = from_double<S>(beta1);
        G2BezierInput<S> input;
        input.axes = 2;
        input.coordinates = points;
        input.joints = {&joint, 1};
        const Solved<S> solved = solve(input);
        REQUIRE(solved.status.ok());
        CAPTURE(beta1);
        // Far from both ends every joint is like the others: t (beta + (2 + 2/beta) + 1/beta^2) = 3 e (1 + 1/beta^2) in
        // x
        const double r = 1.0 / beta1;
        const double expected = 3.0 * (1.0 + r * r) / (beta1 + 2.0 + 2.0 * r + r * r);
        CHECK(to_double(solved.tangents[2 * 2500]) == Approx(expected).epsilon(1e-4));
    }
}

TEMPLATE_TEST_CASE("g2 bezier: a closed curve of one beta1 can be singular, and says so", "[splines][g2bezier]", double,
                   float) {
    using S = TestType;
    RandomPath random(path_seed + 3);
    for (int count = 3; count < 9; ++count) {
        const std::vector<S> points = walk<S>(random, 2, count);
        G2BezierJoint<S> joint;
        joint.chord_ratio = false;
        joint.beta1 = literal<S>(2.6180339887498949); // beta1^3 - 2 beta1^2 - 2 beta1 + 1 = 0
        G2BezierInput<S> input;
        input.axes = 2;
        input.closed = true;
        input.coordinates = points;
        input.joints = {&joint, 1};
        CAPTURE(count);
        CHECK(solve(input).status.error() == (count % 2 == 0 ? Error::system_singular : Error::none));
        joint.beta2 = from_integer<S>(1);
        CHECK(solve(input).status.ok());
    }
}

TEMPLATE_TEST_CASE("g2 bezier: what is refused", "[splines][g2bezier]", double, float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 4);
    const std::vector<S> good = walk<S>(random, 3, 5);
    const auto refused = [](const std::vector<S>& points, auto change) {
        G2BezierInput<S> input;
        input.coordinates = points;
        change(input);
        std::vector<S> tangents(64);
        std::vector<S> scratch(64);
        return g2_bezier_tangents<S>(input, tangents, scratch).error();
    };
    const auto nothing = [](G2BezierInput<S>&) {
    };
    const auto with_joint = [&](const G2BezierJoint<S>& joint) {
        return refused(good, [&joint](G2BezierInput<S>& input) { input.joints = {&joint, 1}; });
    };
    CHECK(refused(good, nothing) == Error::none);
    CHECK(refused({}, nothing) == Error::too_few_points);
    CHECK(refused({good.begin(), good.begin() + 3}, nothing) == Error::too_few_points);
    CHECK(refused({good.begin(), good.begin() + 7}, nothing) == Error::too_few_points);
    CHECK(refused({good.begin(), good.begin() + 6}, [](auto& input) { input.closed = true; }) == Error::too_few_points);
    CHECK(refused(good, [](auto& input) { input.axes = 0; }) == Error::axes_out_of_range);
    CHECK(refused(good, [](auto& input) { input.axes = 7; }) == Error::axes_out_of_range);
    const std::vector<G2BezierJoint<S>> two(2);
    CHECK(refused(good, [&](auto& input) { input.joints = two; }) == Error::too_few_points); // 3 are needed
    CHECK(refused(good, [&](auto& input) { input.start = std::span(good).first(2); }) == Error::tangent_out_of_range);
    CHECK(refused(good, [&](auto& input) {
              input.closed = true;
              input.end = std::span(good).first(3);
          }) == Error::tangent_out_of_range);
    const S one = from_integer<S>(1);
    CHECK(with_joint({false, S{}, S{}}) == Error::beta1_not_positive);
    CHECK(with_joint({false, -one, S{}}) == Error::beta1_not_positive);
    CHECK(with_joint({true, S{}, S{}}) == Error::none); // not used
    CHECK(with_joint({true, one, -one}) == Error::beta2_out_of_range);
    auto points = good;
    std::copy(points.begin() + 3, points.begin() + 6, points.begin() + 6);
    CHECK(refused(points, nothing) == Error::coincident_points);
    const G2BezierJoint<S> uniform{false, one, S{}};
    CHECK(refused(points, [&](auto& input) { input.joints = {&uniform, 1}; }) == Error::none);
    points = good;
    std::copy(points.begin(), points.begin() + 3, points.begin() + 12); // the first point again at the end
    CHECK(refused(points, [](auto& input) { input.closed = true; }) == Error::coincident_points);
    std::vector<S> tangents(good.size() - 1);
    std::vector<S> scratch(5);
    G2BezierInput<S> input;
    input.coordinates = good;
    CHECK(g2_bezier_tangents<S>(input, tangents, scratch).error() == Error::storage_too_small);
    tangents.resize(good.size());
    CHECK(g2_bezier_tangents<S>(input, tangents, std::span(scratch).first(4)).error() == Error::storage_too_small);
    std::vector<BezierPiece<S>> pieces(3);
    CHECK(g2_bezier_pieces<S>(input, tangents, pieces).error() == Error::storage_too_small);
    if constexpr (std::same_as<S, Fixed>) { // refused before it overflows, where a debug build would stop
        points = good;
        points[3] = from_integer<S>(1 << 28);
        CHECK(refused(points, nothing) == Error::result_out_of_range);
        CHECK(with_joint({false, literal<S>(1e-9), one}) == Error::result_out_of_range);
    } else {
        const S nan = std::numeric_limits<S>::quiet_NaN();
        const S infinite = std::numeric_limits<S>::infinity();
        CHECK(with_joint({false, nan, S{}}) == Error::beta1_not_positive);
        CHECK(with_joint({false, infinite, S{}}) == Error::beta1_not_positive);
        CHECK(with_joint({true, one, nan}) == Error::beta2_out_of_range);
        CHECK(with_joint({true, one, infinite}) == Error::beta2_out_of_range);
        for (std::size_t i = 0; i < good.size(); ++i) {
            for (const S bad : {nan, infinite, -infinite}) {
                points = good;
                points[i] = bad;
                CHECK(refused(points, nothing) == Error::result_out_of_range);
                CHECK(refused(points, [](auto& in) { in.closed = true; }) == Error::result_out_of_range);
                CHECK(refused(points, [&](auto& in) { in.joints = {&uniform, 1}; }) == Error::result_out_of_range);
            }
        }
    }
}
