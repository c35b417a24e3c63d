// SPDX-License-Identifier: MIT
//
// Joints against Barsky's and DeRose's constraints of the derivatives, in long double; and against the degenerate
// inputs.
#include "splinefeed/splines/beta_joint.hpp"

#include "support/curve_harness.hpp"

#include <limits>

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

/// Two derivatives of a piece at one of its ends.
struct Derivatives {
    Vec first{};
    Vec second{};
};

template <Scalar S>
Vec point_of(const BezierPiece<S>& piece, int i) {
    Vec out{};
    for (unsigned k = 0; k < 6; ++k) {
        out[k] = exact(piece.control[k][static_cast<unsigned>(i)]);
    }
    return out;
}

template <Scalar S>
Derivatives derivatives(const BezierPiece<S>& piece, bool at_end) {
    const int d = piece.degree;
    const auto at = [&](int i) {
        return point_of(piece, at_end ? d - i : i);
    };
    Derivatives out;
    out.first = static_cast<Real>(at_end ? -d : d) * (at(1) - at(0));
    out.second = static_cast<Real>(d * (d - 1)) * (at(0) - 2.0L * at(1) + at(d > 1 ? 2 : 0));
    return out;
}

/// Random polygon on a grid of 2^-10 within +-64, so that float holds it and no two neighbours are the same.
template <Scalar S>
BezierPiece<S> random_piece(RandomPath& random, int degree, int axes) {
    BezierPiece<S> piece;
    piece.degree = degree;
    for (const unsigned k : indices(axes)) {
        for (unsigned i = 0; i <= static_cast<unsigned>(degree); ++i) {
            piece.control[k][i] = scale2(from_integer<S>(random.below(1 << 17) * 2 + (i % 2 ? 1 : 0) - (1 << 17)), -11);
        }
    }
    return piece;
}

/// beta1 from 1/8 to 8, beta2 from -16 to 16, on grids of 2^-6.
template <Scalar S>
Beta<S> random_beta(RandomPath& random) {
    return {scale2(from_integer<S>(8 + random.below(505)), -6), scale2(from_integer<S>(random.below(2049) - 1024), -6)};
}

template <Scalar S>
BezierPiece<S> after(const BetaJoint<S>& joint, int degree) {
    BezierPiece<S> piece;
    piece.degree = degree;
    piece.set_point(0, joint.w0);
    piece.set_point(1, joint.w1);
    if (degree > 1) {
        piece.set_point(2, joint.w2);
    }
    return piece;
}

/// 12 roundings of the largest sum: |coordinate| <= 64 times the growth.
template <Scalar S>
Real bound_of(const Beta<S>& beta, int degree, int order) {
    return 12.0L * (std::same_as<S, Fixed> ? 0x1p-33L * 64.0L : unit_roundoff<S>()) * 64.0L *
           exact(*beta_growth(beta, degree, order));
}

} // namespace

TEMPLATE_TEST_CASE("beta joint: r' = beta1 q' and r'' = beta1^2 q'' + beta2 q'", "[splines][beta]", double, float,
                   Fixed) {
    using S = TestType;
    RandomPath random;
    CAPTURE(path_seed);
    for (int round = 0; round < 4000; ++round) {
        const int degree = 2 + random.below(8);
        const int axes = 1 + random.below(6);
        const auto piece = random_piece<S>(random, degree, axes);
        const Beta<S> beta = random_beta<S>(random);
        const Real beta1 = exact(beta.beta1);
        const Real beta2 = exact(beta.beta2);
        CAPTURE(round, degree, axes, static_cast<double>(beta1), static_cast<double>(beta2));
        const auto joint = beta_joint(piece, beta, 2);
        REQUIRE(joint.has_value());
        const Real e = bound_of(beta, degree, 2);
        const Derivatives q = derivatives(piece, true);
        const Derivatives r = derivatives(after(*joint, degree), false);
        REQUIRE(joint->w0 == piece.point(degree));
        const Real dd = static_cast<Real>(degree * (degree - 1));
        REQUIRE(distance_of(r.first, beta1 * q.first) <= 3.0L * degree * e);
        REQUIRE(distance_of(r.second, beta1 * beta1 * q.second + beta2 * q.first) <= 12.0L * dd * e);
        // (8b) as it is printed
        const Real c = beta2 / static_cast<Real>(degree - 1);
        const Vec w2 = beta1 * beta1 * point_of(piece, degree - 2) +
                       (-(2.0L * beta1 * beta1 + 2.0L * beta1 + c)) * point_of(piece, degree - 1) +
                       ((1.0L + beta1) * (1.0L + beta1) + c) * point_of(piece, degree);
        REQUIRE(distance_of(point_of(after(*joint, degree), 2), w2) <= 3.0L * e);
        for (unsigned k = static_cast<unsigned>(axes); k < 6; ++k) {
            REQUIRE(joint->w2[k] == S{});
        }
    }
}

TEMPLATE_TEST_CASE("beta joint: W2 is where Farin's and Boehm's construction puts it", "[splines][beta]", double,
                   Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 1);
    CAPTURE(path_seed);
    int tested = 0;
    for (int round = 0; round < 2000; ++round) {
        const int degree = 2 + random.below(8);
        const auto piece = random_piece<S>(random, degree, 3);
        const Beta<S> beta = random_beta<S>(random);
        const auto joint = beta_joint(piece, beta, 2);
        REQUIRE(joint.has_value());
        if (!joint->gamma_known || exact(absolute(joint->gamma)) > 64.0L) {
            continue;
        }
        ++tested;
        const Real beta1 = exact(beta.beta1);
        const Real inverse = beta1 + exact(beta.beta2) / static_cast<Real>(degree - 1) / (1.0L + beta1); // 1/gamma
        const Real gamma = exact(joint->gamma);
        CHECK(std::fabs(static_cast<double>(gamma * inverse - 1.0L)) <= 1e-6);
        Vec apex{};
        for (unsigned k = 0; k < 6; ++k) {
            apex[k] = exact(joint->apex[k]);
        }
        const auto next = after(*joint, degree);
        const Vec built = (1.0L + inverse) * point_of(next, 1) + (-inverse) * apex;
        CHECK(distance_of(built, point_of(next, 2)) <=
              (1.0L + std::fabs(inverse)) * (1.0L + std::fabs(gamma)) * 64.0L * bound_of(beta, degree, 2));
    }
    CHECK(tested > 1500);
}

TEMPLATE_TEST_CASE("beta joint: where gamma is infinite W2 is not", "[splines][beta]", double, float, Fixed) {
    using S = TestType;
    for (int degree = 2; degree <= 9; ++degree) {
        RandomPath random(path_seed + 2);
        const auto piece = random_piece<S>(random, degree, 3);
        const S two = from_integer<S>(2);
        const Beta<S> beta{two, from_integer<S>(-2 * (degree - 1) * 3)};
        const auto joint = beta_joint(piece, beta, 2);
        REQUIRE(joint.has_value());
        CHECK_FALSE(joint->gamma_known);
        for (unsigned k = 0; k < 3; ++k) { // W2 = W1 - beta1^2 (B - A)
            const PerDegree<S>& row = piece.control[k];
            const auto d = static_cast<unsigned>(degree);
            const Real expected = exact(joint->w1[k]) - 4.0L * (exact(row[d - 1]) - exact(row[d - 2]));
            CHECK(std::fabs(static_cast<double>(exact(joint->w2[k]) - expected)) <=
                  static_cast<double>(bound_of(beta, degree, 2)));
        }
        // Beyond it gamma is negative, before it positive.
        const S little = literal<S>(0.5);
        CHECK(beta_joint(piece, {two, beta.beta2 - little}, 2)->gamma < S{});
        CHECK(beta_joint(piece, {two, beta.beta2 + little}, 2)->gamma > S{});
    }
}

TEMPLATE_TEST_CASE("beta joint: betas are measured back, from either side", "[splines][beta]", double, float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 3);
    CAPTURE(path_seed);
    for (int round = 0; round < 2000; ++round) {
        const int degree = 2 + random.below(8);
        const auto before = random_piece<S>(random, degree, 3);
        const Beta<S> beta = random_beta<S>(random);
        const auto joint = beta_joint(before, beta, 2);
        REQUIRE(joint.has_value());
        const auto next = after(*joint, degree);
        const auto found = measure_joint(before, next);
        REQUIRE(found.has_value());
        const Derivatives q = derivatives(before, true);
        const Real beta1 = exact(beta.beta1);
        const Real beta2 = exact(beta.beta2);
        // Errors: of W1 and W2 in derivatives (d, 4 d (d-1)), over the speeds they are measured by.
        const Real e = bound_of(beta, degree, 2);
        const Real speed = size(q.first);
        const Real first = 8.0L * degree * e / speed;
        const Real second = 64.0L * degree * degree * (e + first * size(q.second) / 64.0L * beta1) / speed;
        CAPTURE(round, degree, static_cast<double>(beta1), static_cast<double>(beta2), static_cast<double>(speed));
        REQUIRE(found->gap == S{});
        REQUIRE(std::fabs(exact(found->beta.beta1) - beta1) <= first);
        REQUIRE(std::fabs(exact(found->beta.beta2) - beta2) <= second);
        REQUIRE(exact(found->tangent_jump) <= 4.0L * first / beta1);
        REQUIRE(exact(found->curvature_jump) <= 4.0L * second / (beta1 * beta1 * speed) + 0x1p-30L);
        if (!std::same_as<S, double>) {
            continue;
        }
        // Travelled backwards: beta1' = 1/beta1, beta2' = beta2/beta1^3.
        BezierPiece<S> a = next;
        BezierPiece<S> b = before;
        for (int i = 0; i <= degree; ++i) {
            a.set_point(i, next.point(degree - i));
            b.set_point(i, before.point(degree - i));
        }
        const auto back = measure_joint(a, b);
        REQUIRE(back.has_value());
        REQUIRE(exact(back->beta.beta1) == Approx(static_cast<double>(1.0L / beta1)));
        REQUIRE(static_cast<double>(exact(back->beta.beta2)) ==
                Approx(static_cast<double>(beta2 / (beta1 * beta1 * beta1))).margin(1e-6));
    }
}

TEMPLATE_TEST_CASE("beta joint: what is refused", "[splines][beta]", double, float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 5);
    auto piece = random_piece<S>(random, 3, 2);
    const S one = from_integer<S>(1);
    CHECK(beta_joint(piece, {S{}, S{}}, 2).error() == Error::beta1_not_positive);
    CHECK(beta_joint(piece, {-one, S{}}, 1).error() == Error::beta1_not_positive);
    CHECK(beta_joint(piece, {one, S{}}, 0).error() == Error::degree_out_of_range);
    CHECK(beta_joint(piece, {one, S{}}, 3).error() == Error::degree_out_of_range);
    CHECK(beta_joint(piece, {largest<S>(), S{}}, 1).error() == Error::result_out_of_range);
    CHECK(beta_joint(piece, {one, largest<S>()}, 2).error() == Error::result_out_of_range);
    CHECK(beta_joint(piece, {one, largest<S>()}, 1).has_value()); // it has no part in G1
    for (const int degree : {-1, 0, 1, 10}) {
        BezierPiece<S> other = piece;
        other.degree = degree;
        CHECK(beta_joint(other, {one, S{}}, 2).error() == Error::degree_out_of_range);
        CHECK(beta_joint(other, {one, S{}}, 1).has_value() == (degree == 1));
    }
    auto still = piece; // V_{d-1} = V_d
    still.set_point(2, still.point(3));
    CHECK(beta_joint(still, {one, S{}}, 2).error() == Error::tangent_vanishes);
    CHECK(measure_joint(still, piece).error() == Error::tangent_vanishes);
    auto start = piece;
    start.set_point(1, start.point(0));
    CHECK(measure_joint(piece, start).error() == Error::tangent_vanishes);
    auto far = piece; // no sum may overflow: Fixed would stop in a debug build
    far.control[0][3] = scale2(largest<S>(), -3);
    CHECK(beta_joint(far, {from_integer<S>(8), S{}}, 2).error() == Error::result_out_of_range);
    CHECK(measure_joint(far, piece).error() == Error::result_out_of_range);
    if constexpr (!std::same_as<S, Fixed>) {
        const S nan = std::numeric_limits<S>::quiet_NaN();
        const S infinite = std::numeric_limits<S>::infinity();
        CHECK(beta_joint(piece, {nan, S{}}, 2).error() == Error::beta1_not_positive);
        CHECK(beta_joint(piece, {infinite, S{}}, 2).error() == Error::result_out_of_range);
        CHECK(beta_joint(piece, {one, nan}, 2).error() == Error::beta2_out_of_range);
        CHECK(beta_joint(piece, {one, -infinite}, 2).error() == Error::beta2_out_of_range);
        for (const S bad : {nan, infinite, -infinite}) {
            auto broken = piece;
            broken.control[1][2] = bad;
            CHECK(beta_joint(broken, {one, S{}}, 2).error() == Error::result_out_of_range);
            CHECK(measure_joint(broken, piece).error() == Error::result_out_of_range);
        }
    }
}
