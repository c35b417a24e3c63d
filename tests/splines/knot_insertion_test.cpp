// SPDX-License-Identifier: MIT
#include "splinefeed/splines/knot_insertion.hpp"
#include "splines/bspline_harness.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

template <Scalar S>
struct Spline {
    int degree;
    std::vector<S> knots;
    std::vector<Point<S>> controls;
    [[nodiscard]] Point<S> at(S t) const { return bspline_curve<S>(knots, degree, controls, 2, t).position; }
};

/// Control points of the size that the host makes of them in Fixed.
template <Scalar S>
Spline<S> random_spline(std::mt19937_64& random, int degree, bool closed, int repeats) {
    Spline<S> out{degree, {}, {}};
    const auto k = static_cast<std::size_t>(degree);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::vector<double> knots;
    double t = 0.0;
    for (int i = 0; i < 8; ++i) {
        const int times = closed || i == 0 ? 1 : 1 + static_cast<int>(random() % static_cast<unsigned>(repeats));
        knots.insert(knots.end(), static_cast<std::size_t>(times), t);
        t += static_cast<double>(1U + random() % 100U);
    }
    if (closed) {
        const std::size_t count = knots.size();
        for (std::size_t i = 0; i <= k; ++i) {
            knots.push_back(knots[i] + t);
        }
        for (std::size_t i = 0; i < k; ++i) {
            knots.insert(knots.begin(), knots[count - 1U] - t);
        }
        // the one inserted first moved the others up: the same index is the next one below
    } else {
        knots.insert(knots.begin(), k, 0.0);
        knots.insert(knots.end(), k + 1U, t);
    }
    for (const double u : knots) {
        out.knots.push_back(from_double<S>(u));
    }
    const std::size_t controls = closed ? 8U : knots.size() - k - 1U;
    for (std::size_t i = 0; i < controls; ++i) {
        out.controls.push_back(to_point<S>({std::round(0x1p20 * unit(random)), std::round(0x1p20 * unit(random))}));
    }
    return out;
}

template <Scalar S>
constexpr double tolerance = 0x1p20 * (std::same_as<S, double>  ? 1e-13
                                       : std::same_as<S, float> ? 3e-5
                                                                : 1e-12);

double distance_of(const auto& a, const auto& b) {
    return std::hypot(to_double(a[0]) - to_double(b[0]), to_double(a[1]) - to_double(b[1]));
}

template <Scalar S>
Point<S> bezier_at(const BezierPiece<S>& piece, S u) {
    PerDegree<Point<S>> c{};
    for (int i = 0; i <= piece.degree; ++i) {
        c[static_cast<unsigned>(i)] = piece.point(i);
    }
    for (int s = 1; s <= piece.degree; ++s) {
        for (unsigned i = 0; i + static_cast<unsigned>(s) <= static_cast<unsigned>(piece.degree); ++i) {
            for (unsigned k = 0; k < 2; ++k) {
                c[i][k] += u * (c[i + 1U][k] - c[i][k]);
            }
        }
    }
    return c[0];
}

} // namespace

TEMPLATE_TEST_CASE("Bezier pieces are the curve, bit by bit one at their joints", "[splines]", double, float, Fixed) {
    using S = TestType;
    std::mt19937_64 random(77);
    for (int degree = 1; degree <= 9; ++degree) {
        for (const bool closed : {false, true}) {
            for (int round = 0; round < 4; ++round) {
                const Spline<S> spline = random_spline<S>(random, degree, closed, degree);
                const std::size_t count = bezier_piece_count<S>(spline.knots, degree);
                REQUIRE(count == 8);
                std::vector<BezierPiece<S>> pieces(count);
                std::vector<S> breaks(count + 1U);
                REQUIRE(bezier_pieces<S>(spline.knots, degree, spline.controls, 2, closed, pieces, breaks).ok());
                CAPTURE(degree, closed, round);
                for (std::size_t i = 0; i < count; ++i) {
                    REQUIRE(pieces[i].degree == degree);
                    for (const double u : {0.0, 0.25, 0.5, 0.75}) {
                        const S t = breaks[i] + from_double<S>(u) * (breaks[i + 1U] - breaks[i]);
                        REQUIRE(distance_of(bezier_at(pieces[i], from_double<S>(u)), spline.at(t)) <=
                                degree * tolerance<S>);
                    }
                    if (i > 0 || closed) {
                        REQUIRE((pieces[i].point(0) == pieces[i > 0 ? i - 1U : count - 1U].point(degree)));
                    }
                    // nothing leaves the range of the control points
                    for (int j = 0; j <= degree; ++j) {
                        REQUIRE(std::abs(to_double(pieces[i].point(j)[0])) <= 0x1p20 + tolerance<S>);
                    }
                }
                std::vector<S> few(count);
                REQUIRE(bezier_pieces<S>(spline.knots, degree, spline.controls, 2, closed, pieces, few).error() ==
                        Error::storage_too_small);
            }
        }
    }
}

TEMPLATE_TEST_CASE("a curve may jump where a knot repeats degree + 1 times", "[splines]", double, Fixed) {
    using S = TestType;
    std::vector<S> knots;
    for (const int u : {0, 0, 1, 1, 2, 2}) {
        knots.push_back(from_integer<S>(u));
    }
    std::vector<Point<S>> controls;
    for (const double x : {0.0, 1.0, 5.0, 6.0}) {
        controls.push_back(to_point<S>({x}));
    }
    std::vector<BezierPiece<S>> pieces(2);
    std::vector<S> breaks(3);
    REQUIRE(bezier_pieces<S>(knots, 1, controls, 1, false, pieces, breaks).ok());
    REQUIRE(to_double(pieces[0].point(1)[0]) == 1.0);
    REQUIRE(to_double(pieces[1].point(0)[0]) == 5.0);
}

TEMPLATE_TEST_CASE("inserting knots leaves the curve as it is", "[splines]", double, float, Fixed) {
    using S = TestType;
    std::mt19937_64 random(79);
    for (int degree = 1; degree <= 9; ++degree) {
        for (int round = 0; round < 5; ++round) {
            const Spline<S> spline = random_spline<S>(random, degree, false, degree > 1 ? degree - 1 : 1);
            GrowingCurve<S> grown{degree, 2, spline.knots.size(), {}, {}};
            std::vector<S> knots = spline.knots;
            std::vector<Point<S>> controls = spline.controls;
            knots.resize(knots.size() + 30);
            controls.resize(controls.size() + 30);
            grown.knots = knots;
            grown.controls = controls;
            std::vector<S> finer = spline.knots;
            const double end = to_double(spline.knots.back());
            for (int i = 0; i < 10; ++i) { // on old knots, too
                const double t = i < 3 ? to_double(spline.knots[static_cast<std::size_t>(degree + 1 + i)])
                                       : std::round(64.0 * end * (i - 2.5) / 8.0) / 64.0;
                const auto times = std::count(finer.begin(), finer.end(), from_double<S>(t));
                const bool possible = t > 0.0 && t < end && times < degree;
                REQUIRE(insert_knot(grown, from_double<S>(t)).error() ==
                        (possible ? Error::none : Error::knots_invalid));
                if (possible) {
                    finer.push_back(from_double<S>(t));
                    std::sort(finer.begin(), finer.end());
                }
            }
            CAPTURE(degree, round);
            REQUIRE(grown.knot_count == finer.size());
            REQUIRE(std::equal(finer.begin(), finer.end(), knots.begin()));
            const Spline<S> result{
                degree,
                finer,
                {controls.begin(), controls.begin() + static_cast<std::ptrdiff_t>(finer.size() - spline.knots.size() +
                                                                                  spline.controls.size())}};
            for (int i = 0; i <= 60; ++i) {
                const S t = from_double<S>(std::floor(64.0 * end * i / 60.0) / 64.0);
                REQUIRE(distance_of(result.at(t), spline.at(t)) <= 10 * degree * tolerance<S>);
            }
            // The same at once.
            std::vector<S> again = spline.knots;
            std::vector<Point<S>> again_controls = spline.controls;
            again.resize(finer.size());
            again_controls.resize(result.controls.size());
            GrowingCurve<S> at_once{degree, 2, spline.knots.size(), again, again_controls};
            REQUIRE(refine_knots<S>(at_once, finer).ok());
            REQUIRE(again == finer);
            for (std::size_t i = 0; i < again_controls.size(); ++i) {
                REQUIRE(distance_of(again_controls[i], result.controls[i]) <= 10 * degree * tolerance<S>);
            }
            REQUIRE(refine_knots<S>(at_once, spline.knots).error() == Error::knots_invalid); // coarser
            REQUIRE(insert_knot(at_once, from_double<S>(end / 2.0)).error() == Error::storage_too_small);
        }
    }
}
