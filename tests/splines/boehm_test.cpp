// SPDX-License-Identifier: MIT
//
// Boehm's rule against de Boor's algorithm on the knots, in whole numbers against that, and the joints it makes.
#include "splinefeed/splines/boehm.hpp"

#include "splinefeed/splines/curve_hull.hpp"
#include "support/catch.hpp"
#include "support/curve_harness.hpp"

#include <limits>

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

template <class N>
using Vertices = std::vector<PerAxis<N>>;

/// Value of the B-spline at t by de Boor's algorithm; t lies in [U_j, U_j+1).
Vec de_boor(const std::vector<Vec>& d, const std::vector<Real>& knots, std::size_t degree, std::size_t j, Real t) {
    std::vector<Vec> row(d.begin() + static_cast<std::ptrdiff_t>(j - degree),
                         d.begin() + static_cast<std::ptrdiff_t>(j + 1));
    for (std::size_t r = 1; r <= degree; ++r) {
        for (std::size_t i = degree; i >= r; --i) {
            const std::size_t at = j - degree + i;
            const Real w = (t - knots[at]) / (knots[at + 1 + degree - r] - knots[at]);
            row[i] = (1.0L - w) * row[i - 1] + w * row[i];
        }
    }
    return row[degree];
}

/// The curve of the vertices at fraction u of piece `piece`.
Vec reference(std::vector<Vec> d, int degree, bool closed, std::size_t piece, Real u) {
    const auto k = static_cast<std::size_t>(degree);
    std::vector<Real> knots;
    if (closed) { // vertices wrapped on both sides, simple knots: piece i is made of vertices i - 1 to i - 1 + k
        const std::size_t n = d.size();
        std::vector<Vec> wrapped;
        for (std::size_t i = 0; i < n + k; ++i) {
            wrapped.push_back(d[(i + n - 1) % n]);
        }
        for (std::size_t i = 0; i < wrapped.size() + k + 1; ++i) {
            knots.push_back(static_cast<Real>(i));
        }
        d = wrapped;
    } else {
        const auto last = static_cast<int>(d.size() - k);
        for (int i = -degree; i <= last + degree; ++i) {
            knots.push_back(static_cast<Real>(std::clamp(i, 0, last)));
        }
    }
    const std::size_t j = piece + k;
    return de_boor(d, knots, k, j, knots[j] + u);
}

template <Scalar S>
Vec bernstein(const BezierPiece<S>& piece, Real u) {
    std::vector<Vec> row;
    for (int i = 0; i <= piece.degree; ++i) {
        Vec point{};
        for (unsigned k = 0; k < 6; ++k) {
            point[k] = exact(piece.point(i)[k]);
        }
        row.push_back(point);
    }
    for (std::size_t step = 1; step < row.size(); ++step) {
        for (std::size_t i = 0; i + step < row.size(); ++i) {
            row[i] = (1.0L - u) * row[i] + u * row[i + 1];
        }
    }
    return row[0];
}

template <Scalar S>
std::vector<BezierPiece<S>> pieces_of(const Vertices<S>& vertices, int degree, bool closed) {
    std::vector<BezierPiece<S>> out(
        static_cast<std::size_t>(boehm_pieces(static_cast<std::int64_t>(vertices.size()), degree, closed)));
    REQUIRE(boehm<S>(vertices, degree, closed, out).ok());
    return out;
}

Vertices<double> random_vertices(RandomPath& random, std::size_t count) {
    Vertices<double> out(count);
    for (auto& vertex : out) {
        for (double& x : vertex) {
            x = random.between(-1000.0, 1000.0);
        }
    }
    return out;
}

template <Scalar S>
Vertices<S> as(const Vertices<double>& vertices) {
    Vertices<S> out(vertices.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        for (unsigned k = 0; k < out[i].size(); ++k) {
            out[i][k] = from_double<S>(vertices[i][k]);
        }
    }
    return out;
}

std::vector<Vec> exact_of(const auto& vertices) {
    std::vector<Vec> out;
    for (const auto& vertex : vertices) {
        Vec v{};
        for (unsigned k = 0; k < 6; ++k) {
            v[k] = exact(vertex[k]);
        }
        out.push_back(v);
    }
    return out;
}

} // namespace

TEMPLATE_TEST_CASE("boehm: de Boor's algorithm on the knots gives the same curve", "[splines][boehm]", double, float,
                   Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 31);
    CAPTURE(path_seed);
    for (const int degree : {2, 3}) {
        for (const bool closed : {false, true}) {
            for (int count = closed ? 3 : degree + 1; count < 13; ++count) {
                const auto vertices = as<S>(random_vertices(random, static_cast<std::size_t>(count)));
                const auto pieces = pieces_of<S>(vertices, degree, closed);
                CAPTURE(degree, closed, count);
                // A handful of roundings of numbers up to 4000 (a difference of chords); Fixed has its 2^-33 besides.
                const Real allowed = 8.0L * (std::same_as<S, Fixed> ? 0x1p-33L : unit_roundoff<S>() * 4000.0L);
                for (std::size_t i = 0; i < pieces.size(); ++i) {
                    for (const Real u : {0.0L, 0.3L, 0.5L, 0.9L, 1.0L}) {
                        const Real miss =
                            distance_of(bernstein(pieces[i], u), reference(exact_of(vertices), degree, closed, i, u));
                        REQUIRE(miss <= allowed * 3.0L);
                    }
                }
            }
        }
    }
}

TEST_CASE("boehm: whole vertices times 12, 6 or 2 give whole Bezier points, exactly", "[splines][boehm]") {
    RandomPath random(path_seed + 32);
    CAPTURE(path_seed);
    const auto joins = [](const BoehmPoints<std::int64_t>& a, const BoehmPoints<std::int64_t>& b, unsigned n) {
        for (unsigned k = 0; k < 6; ++k) {
            REQUIRE(a[n][k] == b[0][k]);
            REQUIRE(a[n][k] - a[n - 1][k] == b[1][k] - b[0][k]);
            if (n == 3) {
                REQUIRE(a[3][k] - 2 * a[2][k] + a[1][k] == b[2][k] - 2 * b[1][k] + b[0][k]);
            }
        }
    };
    for (const int degree : {2, 3}) {
        for (const bool closed : {false, true}) {
            for (int count = closed ? 3 : degree + 1; count < 12; ++count) {
                CAPTURE(degree, closed, count);
                std::vector<PerAxis<std::int64_t>> vertices(static_cast<std::size_t>(count));
                Vertices<double> unscaled(vertices.size());
                const std::int64_t scale = boehm_scale(degree, closed);
                for (std::size_t i = 0; i < vertices.size(); ++i) {
                    for (unsigned k = 0; k < 6; ++k) {
                        const int x = random.below(2000001) - 1000000;
                        vertices[i][k] = scale * x;
                        unscaled[i][k] = x;
                    }
                }
                std::vector<BoehmPoints<std::int64_t>> pieces(
                    static_cast<std::size_t>(boehm_pieces(count, degree, closed)));
                REQUIRE(boehm(vertices, degree, closed, pieces).ok());
                const auto rounded = pieces_of<double>(unscaled, degree, closed);
                const auto n = static_cast<unsigned>(degree);
                for (std::size_t i = 0; i < pieces.size(); ++i) {
                    if (closed || i + 1 < pieces.size()) {
                        joins(pieces[i], pieces[(i + 1) % pieces.size()], n);
                    }
                    for (unsigned p = 0; p <= n; ++p) {
                        for (unsigned k = 0; k < 6; ++k) {
                            REQUIRE(std::llround(static_cast<double>(scale) * rounded[i].control[k][p]) ==
                                    pieces[i][p][k]);
                        }
                    }
                }
            }
        }
    }
}

TEST_CASE("boehm: degenerate input", "[splines][boehm]") {
    std::vector<BezierPiece<double>> pieces(8);
    const Vertices<double> four(4);
    CHECK(boehm<double>(four, 1, false, pieces).error() == Error::degree_out_of_range);
    CHECK(boehm<double>(four, 4, false, pieces).error() == Error::degree_out_of_range);
    CHECK(boehm<double>(Vertices<double>(3), 3, false, pieces).error() == Error::too_few_points);
    CHECK(boehm<double>(Vertices<double>(2), 2, false, pieces).error() == Error::too_few_points);
    CHECK(boehm<double>(Vertices<double>(2), 3, true, pieces).error() == Error::too_few_points);
    CHECK(boehm<double>(Vertices<double>(2), 2, true, pieces).error() == Error::too_few_points);
    CHECK(boehm<double>(Vertices<double>(), 2, true, pieces).error() == Error::too_few_points);
    CHECK(boehm<double>(Vertices<double>(20), 2, false, pieces).error() == Error::storage_too_small);
    for (const double bad : {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
        Vertices<double> vertices(5);
        vertices[3][1] = bad;
        CHECK(boehm<double>(vertices, 3, false, pieces).error() == Error::position_out_of_range);
    }
    Vertices<double> far(5);
    far[2][0] = 1e308;
    CHECK(boehm<double>(far, 3, false, pieces).error() == Error::result_out_of_range);
    Vertices<Fixed> far_fixed(5);
    std::vector<BezierPiece<Fixed>> fixed_pieces(8);
    far_fixed[2][0] = from_integer<Fixed>((1 << 28) + 1);
    CHECK(boehm<Fixed>(far_fixed, 3, false, fixed_pieces).error() == Error::result_out_of_range);
    // The largest that are taken, on both sides: nothing leaves the hull, so nothing overflows.
    for (unsigned i = 0; i < 5; ++i) {
        far_fixed[i][0] = from_integer<Fixed>(i % 2 == 0 ? 1 << 28 : -(1 << 28));
    }
    for (const bool closed : {false, true}) {
        for (const int degree : {2, 3}) {
            REQUIRE(boehm<Fixed>(far_fixed, degree, closed, fixed_pieces).ok());
            const Extent<Fixed> hull{from_integer<Fixed>(-(1 << 28)), from_integer<Fixed>(1 << 28)};
            for (std::int64_t i = 0; i < boehm_pieces(5, degree, closed); ++i) {
                CHECK(hull.contains(bezier_hull(fixed_pieces[static_cast<std::size_t>(i)])[0]));
            }
        }
    }
    std::vector<BoehmPoints<std::int64_t>> whole(8);
    std::vector<PerAxis<std::int64_t>> whole_far(5);
    whole_far[0][0] = (std::int64_t{1} << 60) + 1;
    CHECK(boehm(whole_far, 3, false, whole).error() == Error::result_out_of_range);
}
