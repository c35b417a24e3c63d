// SPDX-License-Identifier: MIT
//
// ferguson against the conditions of its joints, measured on the pieces; the condition; singular systems;
// degenerate inputs.
#include "ferguson_harness.hpp"
#include "support/curve_harness.hpp"
#include "support/spline_points.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

std::vector<FergusonJoint<double>> all(std::size_t count, double mu, int delta = 1, double lambda = 1.0) {
    return std::vector<FergusonJoint<double>>(count, {lambda, mu, delta});
}

/// Largest failure of r'' = delta lambda^2 r'' + mu r' and r' = lambda r' over all joints, relative to the curve's
/// size.
template <Scalar S>
Real broken_conditions(const Made<S>& made, const std::vector<FergusonJoint<S>>& joints, bool closed) {
    const std::size_t n = made.pieces.size();
    Real worst = 0.0L;
    Real largest = 1.0L;
    for (const auto& piece : made.pieces) {
        for (int j = 0; j <= 3; ++j) {
            largest = std::max(largest, size(exact_point(piece.point(j))));
        }
    }
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const BezierPiece<S>& a = made.pieces[closed ? (j + n - 1) % n : j];
        const BezierPiece<S>& b = made.pieces[closed ? j : j + 1];
        const auto p = [](const BezierPiece<S>& piece, int i) {
            return exact_point(piece.point(i));
        };
        const Vec in1 = 3.0L * (p(a, 3) - p(a, 2));
        const Vec out1 = 3.0L * (p(b, 1) - p(b, 0));
        const Vec in2 = 6.0L * (p(a, 3) - 2.0L * p(a, 2) + p(a, 1));
        const Vec out2 = 6.0L * (p(b, 2) - 2.0L * p(b, 1) + p(b, 0));
        const Real lambda = exact(joints[j].lambda);
        const Real square = static_cast<Real>(joints[j].delta) * lambda * lambda;
        const Real weight = 1.0L + lambda * lambda + std::fabs(exact(joints[j].mu));
        worst = std::max(worst, distance_of(p(a, 3), p(b, 0)) / largest);
        worst = std::max(worst, distance_of(out1, lambda * in1) / (largest * weight));
        worst = std::max(worst, distance_of(out2, square * in2 + exact(joints[j].mu) * in1) / (largest * weight));
    }
    return worst;
}

Matrix dense(const std::vector<FergusonJoint<double>>& joints, bool closed) {
    const std::size_t n = joints.size();
    Matrix m(n, std::vector<Real>(n, 0.0L));
    for (std::size_t i = 0; i < n; ++i) {
        const Real l = static_cast<Real>(joints[i].lambda);
        const Real d = static_cast<Real>(joints[i].delta);
        m[i][i] += static_cast<Real>(joints[i].mu) / 2.0L + 2.0L * l * (d * l + 1.0L);
        if (closed || i > 0) {
            const std::size_t before = (i + n - 1) % n;
            m[i][before] += d * l * l * static_cast<Real>(joints[before].lambda);
        }
        if (closed || i + 1 < n) {
            m[i][(i + 1) % n] += 1.0L;
        }
    }
    return m;
}

} // namespace

// Every misprint of (7) and (9) breaks the condition of some joint: not the first one, and not with lambda = 1.
TEMPLATE_TEST_CASE("ferguson: the joints keep their conditions, measured", "[splines][ferguson]", double, float,
                   Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 60);
    CAPTURE(path_seed);
    for (int round = 0; round < 400; ++round) {
        const bool closed = round % 2 == 1;
        const int axes = 1 + random.below(6);
        const auto points = random_points<S>(random, axes, (closed ? 3 : 2) + random.below(30), round % 3 == 0);
        std::vector<FergusonJoint<S>> joints(closed ? points.size() : points.size() - 2);
        for (auto& joint : joints) {
            joint.delta = random.below(3) == 0 ? -1 : 1;
            joint.lambda = from_double<S>(random.between(0.5, 2.0));
        }
        for (std::size_t i = 0; i < joints.size(); ++i) {
            const S before = i > 0 || closed ? joints[(i + joints.size() - 1) % joints.size()].lambda : literal<S>(1);
            joints[i].mu =
                stable_mu(from_double<S>(random.between(-30.0, 30.0)), joints[i].delta, joints[i].lambda, before);
        }
        const auto ends = random_points<S>(random, axes, 2);
        const auto made = make<S>(points, joints, closed, ends[0], ends[1]);
        CAPTURE(round, closed, axes, points.size());
        REQUIRE(made.error == Error::none);
        REQUIRE(made.pieces.size() == (closed ? points.size() : points.size() - 1));
        const auto bad = static_cast<double>(broken_conditions(made, joints, closed));
        // Bezier points are off by an ulp of their size, second derivatives by 24 of those; the solve by the condition,
        // below 100 with these tensions.
        REQUIRE(bad <= static_cast<double>(400.0L * unit_roundoff<S>()));
        if (!closed) {
            REQUIRE(made.in.front() == ends[0]);
            REQUIRE(made.in.back() == ends[1]);
            REQUIRE(made.out.front() == ends[0]);
        }
    }
}

TEST_CASE("ferguson: the condition against that of the dense matrix", "[splines][ferguson]") {
    RandomPath random(path_seed + 61);
    CAPTURE(path_seed);
    for (int round = 0; round < 200; ++round) {
        const bool closed = round % 2 == 1;
        const auto points = random_points<double>(random, 3, (closed ? 3 : 3) + random.below(12));
        std::vector<FergusonJoint<double>> joints(closed ? points.size() : points.size() - 2);
        for (auto& joint : joints) {
            joint = {random.between(0.4, 2.5), random.between(-20.0, 20.0), random.below(2) == 0 ? -1 : 1};
        }
        const auto matrix = dense(joints, closed);
        const Real condition = condition_of(matrix);
        const auto made = make<double>(points, joints, closed);
        CAPTURE(round, closed, points.size(), static_cast<double>(condition));
        REQUIRE(made.error == Error::none);
        REQUIRE(made.report.condition <= static_cast<double>(condition) * 1.000001);
        REQUIRE(made.report.condition >= static_cast<double>(condition) / 20.0);
    }
}

TEST_CASE("ferguson: zero pivots are not singular, singular systems are", "[splines][ferguson]") {
    RandomPath random(path_seed + 62);
    for (std::size_t unknowns = 1; unknowns <= 24; ++unknowns) {
        const auto points = random_points<double>(random, 2, static_cast<int>(unknowns) + 2);
        const auto made = make<double>(points, all(unknowns, 0.0, -1));
        CAPTURE(unknowns);
        REQUIRE_FALSE(made.report.elimination_without_pivoting_ok);
        REQUIRE_FALSE(made.report.diagonally_dominant);
        if (unknowns % 2 == 0) {
            REQUIRE(made.error == Error::none);
            REQUIRE(static_cast<double>(broken_conditions(made, all(unknowns, 0.0, -1), false)) < 1e-13);
        } else {
            REQUIRE(made.error == Error::system_singular);
            REQUIRE((made.report.weakest_knot >= 1 && made.report.weakest_knot <= unknowns));
        }
        // delta = +1, lambda = 1: singular exactly at mu = -8 - 4 cos(j pi / (N + 1)).
        for (std::size_t j = 1; j <= unknowns; ++j) {
            const double mu =
                -8.0 - 4.0 * std::cos(static_cast<double>(j) * std::acos(-1.0) / static_cast<double>(unknowns + 1));
            REQUIRE(make<double>(points, all(unknowns, mu)).error == Error::system_singular);
        }
        REQUIRE(make<double>(points, all(unknowns, -3.9)).error == Error::none);
        REQUIRE(make<double>(points, all(unknowns, -12.1)).error == Error::none);
    }
    // Mixed signs (+, -, +), mu = 0.
    const auto five = random_points<double>(random, 2, 5);
    auto mixed = all(3, 0.0);
    mixed[1].delta = -1;
    REQUIRE(make<double>(five, mixed).error == Error::system_singular);
    // Far below the article's |mu| >= 4 the system is well conditioned.
    const auto many = random_points<double>(random, 2, 21);
    const auto far_below = make<double>(many, all(19, 0.4, -1));
    REQUIRE(far_below.error == Error::none);
    REQUIRE(far_below.report.condition < 25.0);
    REQUIRE(far_below.report.condition > 2.0);
    REQUIRE(far_below.report.elimination_without_pivoting_ok);
    REQUIRE_FALSE(far_below.report.diagonally_dominant);
}

TEST_CASE("ferguson: dominance with lambda, as corrected", "[splines][ferguson]") {
    RandomPath random(path_seed + 63);
    const auto points = random_points<double>(random, 2, 6);
    // lambda = 2, delta = 1: dominant from mu = 2 * 8 - 16 - 8 + 2 = -6 on; the printed lambda^2 + 1 would say -14.
    REQUIRE(make<double>(points, all(4, -5.99, 1, 2.0)).report.diagonally_dominant);
    REQUIRE_FALSE(make<double>(points, all(4, -6.01, 1, 2.0)).report.diagonally_dominant);
    REQUIRE(make<double>(points, all(4, -42.01, 1, 2.0)).report.diagonally_dominant);
    REQUIRE_FALSE(make<double>(points, all(4, -41.99, 1, 2.0)).report.diagonally_dominant);
}

TEST_CASE("ferguson: classes as the conditions give them", "[splines][ferguson]") {
    REQUIRE(ferguson_class<double>({1.0, 0.0, 1}, false) == FergusonClass::c2);
    REQUIRE(ferguson_class<double>({1.0, 2.0, 1}, false) == FergusonClass::c1_g2);
    REQUIRE(ferguson_class<double>({2.0, 0.0, 1}, false) == FergusonClass::g2);
    REQUIRE(ferguson_class<double>({1.0, 0.0, -1}, false) == FergusonClass::c1_abs_kappa); // never G2
    REQUIRE(ferguson_class<double>({2.0, 0.0, -1}, false) == FergusonClass::g1_abs_kappa);
    REQUIRE(ferguson_class<double>({1.0, 0.0, 1}, true) == FergusonClass::undefined);
}

TEMPLATE_TEST_CASE("ferguson: degenerate inputs", "[splines][ferguson]", double, float, Fixed) {
    using S = TestType;
    const auto at = [](double x, double y) {
        return Point<S>{from_double<S>(x), from_double<S>(y)};
    };
    using Joints = std::vector<FergusonJoint<S>>;
    const std::vector<Point<S>> four{at(0, 0), at(1, 0), at(2, 1), at(3, 3)};
    const Joints two(2);
    REQUIRE(make<S>({}, {}).error == Error::too_few_points);
    REQUIRE(make<S>({at(1, 1)}, {}).error == Error::too_few_points);
    REQUIRE(make<S>({at(0, 0), at(1, 1), at(0, 0)}, two, true).error == Error::too_few_points);
    REQUIRE(make<S>(four, Joints(3)).error == Error::parameters_invalid);
    REQUIRE(make<S>(four, two, true).error == Error::parameters_invalid);
    auto repeated = four;
    repeated.push_back(four[0]);
    REQUIRE(make<S>(repeated, Joints(4), true).in[1] == make<S>(four, Joints(4), true).in[1]);
    // Two points: one Hermite segment from the tangents.
    const auto segment = make<S>({at(0, 0), at(3, 0)}, {}, false, at(3, 3), at(3, -3));
    REQUIRE(segment.pieces.size() == 1);
    REQUIRE(segment.pieces[0].point(1) == at(1, 1));
    REQUIRE(segment.pieces[0].point(2) == at(2, 1));
    REQUIRE(segment.report.condition == literal<S>(1));
    // Parameters.
    const auto with = [&](double lambda, double mu, int delta) {
        return make<S>(four, {{}, {from_double<S>(lambda), from_double<S>(mu), delta}}).error;
    };
    REQUIRE(with(0.0, 0.0, 1) == Error::lambda_not_positive);
    REQUIRE(with(-1.0, 0.0, 1) == Error::lambda_not_positive);
    REQUIRE(with(1.0, 0.0, 0) == Error::curvature_sign_invalid);
    REQUIRE(with(1.0, 0.0, 2) == Error::curvature_sign_invalid);
    REQUIRE(with(0x1p22, 0.0, 1) == Error::lambda_or_mu_out_of_range);
    REQUIRE(with(0x1p-22, 0.0, 1) == Error::lambda_or_mu_out_of_range);
    REQUIRE(with(1.0, 65536.0, 1) == Error::none);
    auto far = four;
    far[2][0] = from_double<S>(std::same_as<S, Fixed> ? 0x1.1p18 : 0x1.1p40);
    REQUIRE(make<S>(far, two).error == Error::position_out_of_range);
    REQUIRE(make<S>(four, two, false, far[2]).error == Error::tangent_out_of_range);
    if constexpr (!std::same_as<S, Fixed>) {
        for (const S bad : {std::numeric_limits<S>::quiet_NaN(), std::numeric_limits<S>::infinity()}) {
            auto points = four;
            points[1][0] = bad;
            REQUIRE(make<S>(points, two).error == Error::position_out_of_range);
            REQUIRE(make<S>(four, two, false, {}, points[1]).error == Error::tangent_out_of_range);
            REQUIRE(make<S>(four, {{bad, S{}, 1}, {}}).error != Error::none);
            REQUIRE(make<S>(four, {{S{1}, bad, 1}, {}}).error == Error::lambda_or_mu_out_of_range);
        }
    }
    // Duplicates are regular; all points equal and no end tangents: the curve stands still and says so.
    REQUIRE(make<S>({at(0, 0), at(1, 0), at(1, 0), at(3, 3)}, two).error == Error::none);
    const auto still = make<S>({at(1, 1), at(1, 1), at(1, 1), at(1, 1)}, two);
    REQUIRE(still.error == Error::none);
    REQUIRE(still.report.vanishing == 4);
    // Collinear points stay on their line.
    for (const auto& piece : make<S>({at(0, 2), at(1, 2), at(4, 2), at(5, 2)}, two).pieces) {
        for (unsigned j = 0; j <= 3; ++j) {
            REQUIRE(piece.control[1][j] == from_double<S>(2));
        }
    }
    std::vector<Point<S>> storage(3);
    std::vector<BezierPiece<S>> pieces(4);
    std::vector<CyclicRow<S>> system(4);
    FergusonReport<S> report;
    REQUIRE(ferguson<S>({four, two, false, {}, {}}, {storage, storage, pieces, system}, report).error() ==
            Error::storage_too_small);
}

// In a debug build an overflow would stop the test.
TEST_CASE("ferguson: nothing overflows in Fixed", "[splines][ferguson]") {
    RandomPath random(path_seed + 65);
    int solved = 0;
    for (int round = 0; round < 3000; ++round) {
        const bool closed = round % 2 == 1;
        std::vector<Point<Fixed>> points(static_cast<unsigned>(3 + random.below(10)));
        for (auto& point : points) {
            for (auto& x : point) {
                x = from_double<Fixed>(random.below(2) == 0 ? -0x1p18 : 0x1p18);
            }
        }
        std::vector<FergusonJoint<Fixed>> joints(closed ? points.size() : points.size() - 2);
        for (auto& joint : joints) {
            joint.lambda = from_double<Fixed>(std::pow(2.0, random.between(-4.0, 4.0)));
            joint.mu = from_double<Fixed>(random.below(2) == 0 ? random.between(-65536.0, 65536.0)
                                                               : random.between(-16.0, 4.0));
            joint.delta = random.below(2) == 0 ? 1 : -1;
        }
        const auto made = make<Fixed>(points, joints, closed, points[0], points[1]);
        solved += made.error == Error::none ? 1 : 0;
        REQUIRE((made.error == Error::none || made.error == Error::system_singular ||
                 made.error == Error::result_out_of_range ||
                 (closed && points.front() == points.back()))); // one joint too many
    }
    REQUIRE(solved > 1500);
}
