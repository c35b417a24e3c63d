// SPDX-License-Identifier: MIT
//
// G2Spline against splines that are solved for all waypoints at once, in long double, from their second derivatives.
#include "splinefeed/s1_curve/g2_spline.hpp"

#include "support/curve_harness.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

/// How far the elimination may carry rounding errors. Row i is wrong by a few u times the longest chord over its pivot;
/// the pivot is at least 1 - a - c, about 1/(1 + r) with r the largest ratio of neighbouring spans. Back-substitution
/// adds errors that fall geometrically (below 1/2 each in slopes): 16 roundings a row, doubled by the sum.
Real amplification(const std::vector<Real>& h, std::size_t i) {
    Real ratio = 1.0L;
    for (std::size_t j = i > 16 ? i - 16 : 0; j + 1 < std::min(i + 18, h.size()); ++j) {
        ratio = std::max({ratio, h[j] / h[j + 1], h[j + 1] / h[j]});
    }
    return 32.0L * (1.0L + ratio);
}

struct Worst {
    Real error = 0.0L;  ///< mm
    Real excess = 0.0L; ///< error over its bound
};

/// Compares the segments of one run with the batch solution.
template <Scalar S>
void compare(Worst& worst, const std::vector<CurveSegment<S>>& segments, std::size_t first,
             const std::vector<Vec>& chords, const std::vector<Real>& h, const std::vector<Cubic>& cubics,
             const std::vector<Real>& loss) {
    for (std::size_t i = 0; i < chords.size(); ++i) {
        Real truncation = 0.0L; // a Bezier point is a mean of the control points around it
        for (std::size_t j = i > 0 ? i - 1 : 0; j < std::min(i + 3, loss.size()); ++j) {
            truncation = std::max(truncation, loss[j]);
        }
        Real longest = 0.0L;
        for (std::size_t j = i > 16 ? i - 16 : 0; j < std::min(i + 17, chords.size()); ++j) {
            longest = std::max(longest, size(chords[j]));
        }
        const Real bound = truncation + amplification(h, i) * rounding<S>(longest);
        for (int p = 0; p <= 3; ++p) {
            const Real error = distance_of(bezier(segments[first + i], p), cubics[i][static_cast<unsigned>(p)]);
            worst.error = std::max(worst.error, error);
            worst.excess = std::max(worst.excess, error / bound);
        }
    }
}

/// Streams the path with the given breaks (besides its ends) and compares run by run.
template <Scalar S>
Worst against_batch(const Path& path, Parameterization how, const std::vector<std::size_t>& breaks = {},
                    Corner between = Corner::forbidden) {
    std::vector<Feed<S>> feeds = feeds_of<S>(path);
    for (Feed<S>& feed : feeds) {
        feed.point.corner = between;
    }
    for (const std::size_t b : breaks) {
        feeds[b].point.corner = between == Corner::automatic ? Corner::automatic : Corner::forced;
    }
    G2Spline<S> curve({path.axes, how, literal<S>(0.5)});
    const auto segments = run_curve<S>(curve, feeds);
    const std::vector<Vec> chords = chords_of(path);
    REQUIRE(segments.size() == chords.size());
    const std::vector<Real> h = spans_of(chords, how);
    std::vector<std::size_t> ends = breaks;
    ends.push_back(chords.size());
    Worst worst;
    std::size_t from = 0;
    for (const std::size_t end : ends) {
        const std::vector<Vec> c(chords.begin() + static_cast<long>(from), chords.begin() + static_cast<long>(end));
        const std::vector<Real> s(h.begin() + static_cast<long>(from), h.begin() + static_cast<long>(end));
        const std::vector<Cubic> cubics = solve_run(c, s);
        compare(worst, segments, from, c, s, cubics, truncation_of(cubics, s, false));
        for (std::size_t i = from; i < end; ++i) {
            REQUIRE(segments[i].stop_at_end == (i + 1 == end));
            REQUIRE(segments[i].waypoint == i + 1);
            REQUIRE(segments[i].degree == 3);
            REQUIRE(segments[i].axes == path.axes);
            REQUIRE(segments[i].origin == path.points[i]);
            REQUIRE(segments[i].end == path.points[i + 1]);
        }
        // Ends of runs are met exactly, whatever the joints before them missed: the chord is rounded once, its unit
        // once.
        REQUIRE(size(bezier(segments[from], 0)) == 0.0L);
        const Vec miss = bezier(segments[end - 1], 3) - chords[end - 1];
        for (const unsigned k : indices(path.axes)) {
            REQUIRE(std::fabs(miss[k]) <= rounding<S>(std::fabs(chords[end - 1][k])));
        }
        from = end;
    }
    return worst;
}

constexpr Parameterization parameterizations[] = {Parameterization::uniform, Parameterization::chordal,
                                                  Parameterization::centripetal};

} // namespace

TEMPLATE_TEST_CASE("g2: Bezier points are those of the spline solved at once", "[curve][g2]", double, float, Fixed) {
    RandomPath random;
    CAPTURE(path_seed);
    for (const Shape shape : all_shapes) {
        Worst all;
        for (const Parameterization how : parameterizations) {
            for (const int count : {2, 3, 4, 5, 15, 16, 17, 18, 19, 20, 40, 400}) {
                const int axes = 1 + random.below(6);
                CAPTURE(static_cast<int>(shape), static_cast<int>(how), count, axes);
                const Worst worst = against_batch<TestType>(random.make(shape, axes, count), how);
                REQUIRE(static_cast<double>(worst.excess) <= 1.0);
                all.error = std::max(all.error, worst.error);
            }
        }
        INFO("shape " << static_cast<int>(shape) << ": largest deviation " << static_cast<double>(all.error) << " mm");
        if (!std::same_as<TestType, float> && shape == Shape::even) {
            CHECK(all.error < 1e-7L); // 0.268^13 * 0.21 of a second difference of delta, at most about 1 mm
        }
    }
}

TEMPLATE_TEST_CASE("g2: corners cut the curve into independent runs", "[curve][g2]", double, float, Fixed) {
    RandomPath random(path_seed + 3);
    CAPTURE(path_seed);
    const std::vector<std::vector<std::size_t>> choices = {{1},  {38}, {1, 38},    {1, 2, 3},    {18, 19}, {17},
                                                           {16}, {15}, {5, 7, 10}, {20, 22, 25}, {2, 37}};
    for (const auto& breaks : choices) {
        for (const Shape shape : {Shape::uneven, Shape::zigzag}) {
            const Path path = random.make(shape, 3, 40);
            CAPTURE(breaks.front(), breaks.back(), breaks.size());
            REQUIRE(static_cast<double>(against_batch<TestType>(path, Parameterization::chordal, breaks).excess) <=
                    1.0);
        }
    }
    std::vector<std::size_t> everywhere;
    for (std::size_t i = 1; i < 39; ++i) {
        everywhere.push_back(i);
    }
    const Path path = random.make(Shape::uneven, 2, 40);
    REQUIRE(static_cast<double>(against_batch<TestType>(path, Parameterization::chordal, everywhere).excess) <= 1.0);
}

TEMPLATE_TEST_CASE("g2: end tangents", "[curve][g2]", double, float, Fixed) {
    RandomPath random(path_seed + 4);
    CAPTURE(path_seed);
    for (const int count : {2, 3, 4, 17, 18, 40}) {
        for (int which = 1; which <= 3; ++which) {
            const Path path = random.make(Shape::uneven, 3, count);
            EndTangents<TestType> tangents;
            tangents.has_start = (which & 1) != 0;
            tangents.has_end = (which & 2) != 0;
            tangents.start = {literal<TestType>(0.5), literal<TestType>(-1.25), literal<TestType>(2.0)};
            tangents.end = {literal<TestType>(-1.0), literal<TestType>(0.25), literal<TestType>(0.75)};
            std::vector<Feed<TestType>> feeds = feeds_of<TestType>(path);
            for (auto& feed : feeds) {
                feed.point.corner = Corner::forbidden;
            }
            for (const bool corner : {false, true}) { // a corner between must not see the tangents
                if (corner && count < 4) {
                    continue;
                }
                const std::size_t cut = corner ? static_cast<std::size_t>(count) / 2 : 0;
                feeds[cut].point.corner = Corner::forced;
                G2Spline<TestType> curve({3, Parameterization::chordal, literal<TestType>(0.5)}, tangents);
                const auto segments = run_curve<TestType>(curve, feeds);
                const std::vector<Vec> chords = chords_of(path);
                const std::vector<Real> h = spans_of(chords, Parameterization::chordal);
                Worst worst;
                for (const bool second : {false, true}) {
                    const auto from = static_cast<long>(second ? cut : 0);
                    const auto to = static_cast<long>(corner && !second ? cut : chords.size());
                    if (second && !corner) {
                        continue;
                    }
                    const std::vector<Vec> c(chords.begin() + from, chords.begin() + to);
                    const std::vector<Real> s(h.begin() + from, h.begin() + to);
                    Ends ends;
                    ends.start = tangents.has_start && !second;
                    ends.end = tangents.has_end && (second || !corner);
                    // Units of the end chord: the derivative by a chordal parameter is the tangent itself.
                    ends.start_derivative = {0.5L, -1.25L, 2.0L};
                    ends.end_derivative = {-1.0L, 0.25L, 0.75L};
                    const std::vector<Cubic> cubics = solve_run(c, s, ends);
                    compare(worst, segments, static_cast<std::size_t>(from), c, s, cubics,
                            truncation_of(cubics, s, ends.start));
                }
                CAPTURE(count, which, corner);
                REQUIRE(static_cast<double>(worst.excess) <= 1.0);
            }
        }
    }
}

TEMPLATE_TEST_CASE("g2: the magnitude of an end tangent does not depend on the parameterization", "[curve][g2]", double,
                   float, Fixed) {
    for (const Parameterization how : parameterizations) {
        EndTangents<TestType> tangents;
        tangents.has_start = tangents.has_end = true;
        tangents.start[1] = literal<TestType>(2.0);
        tangents.end[0] = literal<TestType>(-0.5);
        G2Spline<TestType> curve({2, how, literal<TestType>(0.5)}, tangents);
        const auto segments = run_curve<TestType>(curve, feeds_of<TestType>(path_of(2, {0, 0, 3, 4, 6, 9, 12, 17})));
        REQUIRE(segments.size() == 3);
        // chords of 5 and 10 mm at the ends: legs of 2 * 5/3 and -0.5 * 10/3 mm
        const Real u = 8.0L * rounding<TestType>(10.0L) + (std::same_as<TestType, Fixed> ? 1e-9L : 0.0L);
        CHECK(distance_of(bezier(segments[0], 1), Vec{0.0L, 10.0L / 3.0L}) <= u);
        CHECK(distance_of(bezier(segments[2], 3) - bezier(segments[2], 2), Vec{-5.0L / 3.0L}) <= u);
    }
}
