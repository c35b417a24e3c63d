// SPDX-License-Identifier: MIT
//
// Cells against an independent quadrature of order 40 in long double: lengths, speed along the curve, position on it,
// and the bounds of direction and curvature that the feed plan relies on.
//
// Where rounding enters. Control points are held within 2^16 units to control_rounding<S>() each; halving rounds again
// at every step. A first derivative of degree n is n times a difference of two, so its relative error is 2 n c / sigma
// with sigma = |dr/dw| in the same units, and twice that is allowed for the halvings. A second derivative takes n (n -
// 1) times four roundings over sigma^2. In Fixed a length in mm is rounded to 2^-32 mm.
#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"
#include "support/catch.hpp"
#include "support/cell_reference.hpp"

using namespace splinefeed_test;

namespace {

template <class S>
Refinement<S> refinement(int axes, double feed = 100.0) {
    MachineSettings settings;
    settings.axes = axes;
    settings.max_feed_mm_s = feed;
    return MotionLimits<S>::make(settings).value().refinement;
}

/// Relative rounding of what is computed from the first derivatives of a cell.
template <class S>
Real slope_noise(const Cell<S>& cell) {
    Real noise = 4.0L * cell.degree * control_rounding<S>() / slowest_units(cell) + 64.0L * rounding<S>();
    if constexpr (std::same_as<S, Fixed>) {
        noise += 0x1p-32L / exact(cell.length_mm);
    }
    return noise;
}

struct Worst {
    Real length = 0.0L;      // relative error of a cell's length
    Real fluctuation = 0.0L; // of |dr/ds| from one
    Real tangent = 0.0L;     // what exceeds tangent_max
    Real curvature = 0.0L;   // what exceeds curvature_max, as part of the largest curvature of the cell
    std::size_t cells = 0;
    std::size_t chords = 0;
};

/// Checks all cells of a path; the figures of the worst of them without what rounding explains.
template <class S>
void check_cells(const std::vector<Cell<S>>& cells, Worst& worst) {
    const std::size_t step =
        cells.size() > 4000 ? 16 : 1; // thousands of equal cells of a long line need not all be seen
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const Cell<S>& cell = cells[i];
        ++worst.cells;
        if (is_chord(cell)) {
            ++worst.chords;
        }
        // What is shorter than the finest piece is between the roundings of control points: the stream tests cover it.
        if (is_chord(cell) || i % step != 0 || slowest_units(cell) < 2.0L * finest_units<S>()) {
            continue;
        }
        const int axes = cell.axes;
        const Real noise = slope_noise(cell);
        const Real length = exact(cell.length_mm);
        const Real reference =
            quadrature().integrate([&](Real w) { return evaluate(cell, w).speed(axes); }, 0.0L, 1.0L);
        worst.length = std::max(worst.length, std::fabs(length / reference - 1.0L) - noise);
        Real sharpest = 0.0L;
        for (const unsigned k : splinefeed::indices(axes)) {
            sharpest = std::max(sharpest, exact(cell.curvature_max[k]));
        }
        const auto n = static_cast<Real>(cell.degree);
        const Real sigma = slowest_units(cell);
        // In curvature [1/mm]; the bounds themselves are rounded to the resolution of S.
        const Real bend_noise = 8.0L * n * n * control_rounding<S>() / (sigma * std::ldexp(sigma, cell.unit_log2)) +
                                sharpest * 64.0L * rounding<S>() + (std::same_as<S, Fixed> ? 0x1p-30L : 0.0L);
        for (int j = 0; j <= 24; ++j) {
            Real slope = 0.0L;
            const Real w = inverse_at(cell, j / 24.0L, slope);
            const Jet jet = evaluate(cell, w);
            worst.fluctuation = std::max(worst.fluctuation, std::fabs(jet.speed(axes) * slope / length - 1.0L) - noise);
            const Direction d = direction_at(cell, j / 24.0L);
            for (const unsigned k : splinefeed::indices(axes)) {
                worst.tangent = std::max(worst.tangent, std::fabs(d.tangent[k]) - exact(cell.tangent_max[k]) - noise);
                const Real excess = std::fabs(d.curvature[k]) - exact(cell.curvature_max[k]) - bend_noise;
                if (exact(cell.curvature_max[k]) < static_cast<Real>(PieceMeasure<S>::sharpest)) {
                    worst.curvature = std::max(worst.curvature, sharpest > 0.0L ? excess / sharpest : excess);
                }
            }
        }
    }
}

/// What every path must satisfy. The cells are accepted where two lengths, of order 4 and 6, differ by less
/// than 1.13e-6 (float: 1.13e-5); the error of the better one is smaller than that difference. The rest is the
/// specification.
template <class S>
void require_good(const Worst& worst) {
    CAPTURE(scalar_name<S>(), worst.cells, worst.chords, static_cast<double>(worst.length),
            static_cast<double>(worst.fluctuation), static_cast<double>(worst.tangent),
            static_cast<double>(worst.curvature));
    CHECK(worst.length < (std::same_as<S, float> ? 1.13e-5L : 1.13e-6L));
    CHECK(worst.fluctuation < 1e-4L);
    CHECK(worst.tangent < 1e-3L);
    CHECK(worst.curvature < 1e-3L);
}

/// Positions at the two ends of a cell.
template <class S>
void ends_of(const Cell<S>& cell, PerAxis<Position>& start, PerAxis<Position>& end) {
    cell.position_at(S{}, start);
    cell.position_at(from_integer<S>(1), end);
}

/// How far the end of a cell, at u + h, and its middle are from the curve [mm].
template <class S>
Real distance_to_curve(const CurveSegment<S>& segment, const Cell<S>& cell, const PerAxis<Position>& end, Real u,
                       Real h) {
    const Jet to = evaluate(segment, u + h);
    const Jet middle = evaluate(segment, u + h / 2.0L);
    const Jet on_cell = evaluate(cell, 0.5L);
    Real miss = 0.0L;
    for (const unsigned k : splinefeed::indices(segment.axes)) {
        const Real origin = exact_mm(segment.origin[k]);
        miss = std::max(miss, std::fabs(exact_mm(end[k]) - origin - to.r[k]));
        miss = std::max(miss, std::fabs(exact_mm(cell.origin[k]) - origin + on_cell.r[k] - middle.r[k]));
    }
    return miss;
}

/// One path: its cells follow the curve, their lengths add up, and each is good.
template <class S>
void check_path(const BezierPath& path, Worst& worst, double feed = 100.0) {
    const std::vector<CurveSegment<S>> segments = segments_of<S>(path);
    ListSource<S> source(segments);
    const std::vector<Cell<S>> cells = cells_of<S>(source, refinement<S>(path.front().axes, feed));
    REQUIRE(cells.size() < (1U << 18));
    check_cells(cells, worst);

    std::size_t at = 0;
    for (CurveSegment<S> segment : segments) {
        if constexpr (!std::same_as<S, float>) {
            segment.straighten(); // the cells of a line are even parts of it
        }
        const int axes = segment.axes;
        const Real grid = control_rounding<S>() * std::ldexp(1.0L, segment.unit_log2);
        // Halving adds at most half a rounding per step, n steps per level, 22 levels; and Horner's rule n roundings of
        // numbers as large as the cell, of which the segment is a bound. 2^-40 mm: the two positions that are compared.
        const Real near = (22.0L + 8.0L) * segment.degree * grid + 0x1p-40L;
        Real length = 0.0L;
        Real length_noise = 0.0L;
        Real u = 0.0L;
        bool located = true; // next to a cusp many pieces end at the same point: u is not known from there
        PerAxis<Position> here = segment.origin;
        int cusps = 0;
        for (; at < cells.size() && cells[at].waypoint == segment.waypoint; ++at) {
            const Cell<S>& cell = cells[at];
            cusps += cell.stop_before ? 1 : 0;
            PerAxis<Position> start{};
            PerAxis<Position> end{};
            ends_of(cell, start, end);
            Real gap = 0.0L;
            for (const unsigned k : splinefeed::indices(axes)) {
                gap = std::max(gap, std::fabs(exact_mm(start[k]) - exact_mm(here[k])));
            }
            here = end;
            located = located && !is_chord(cell) && !cell.stop_before;
            Real best = located ? 1e30L : 0.0L;
            Real step = 0.0L;
            // Cells are dyadic pieces in travel order: the level of each is the one that leads to its end.
            for (int level = 0; located && level <= 22; ++level) {
                const Real h = std::ldexp(1.0L, -level);
                const Real index = std::ldexp(u, level);
                if (u + h <= 1.0L && index == std::floor(index)) {
                    const Real miss = distance_to_curve(segment, cell, end, u, h);
                    step = miss < best ? h : step;
                    best = std::min(best, miss);
                }
            }
            u += step;
            // A cusp is left out: as much as the finest piece, a few of them; and what is shorter than 2e-8 mm.
            const Real left_out =
                cell.stop_before ? 8.0L * finest_units<S>() * std::ldexp(1.0L, segment.unit_log2) + 1e-7L : 0.0L;
            if (!(best <= near && gap <= near + left_out)) {
                CAPTURE(scalar_name<S>(), static_cast<double>(best / near), static_cast<double>(gap / near));
                FAIL("cell off the curve");
            }
            length += exact(cell.length_mm);
            length_noise += exact(cell.length_mm) * (is_chord(cell) ? 0.0L : slope_noise(cell)) + grid;
        }
        Real miss = 0.0L;
        for (const unsigned k : splinefeed::indices(axes)) {
            miss = std::max(miss, std::fabs(exact_mm(here[k]) - exact_mm(segment.end[k])));
        }
        REQUIRE(miss <= near);
        const Real total = quadrature().adaptive([&](Real x) { return evaluate(segment, x).speed(axes); }, 0.0L, 1.0L,
                                                 1e-13L * std::ldexp(65536.0L, segment.unit_log2));
        CAPTURE(scalar_name<S>(), static_cast<double>(length), static_cast<double>(total));
        length_noise += (cusps + 2) * (8.0L * finest_units<S>() * std::ldexp(1.0L, segment.unit_log2) + 1e-7L);
        CHECK(std::fabs(length - total) <= total * (std::same_as<S, float> ? 1.13e-5L : 1.13e-6L) + length_noise);
    }
    REQUIRE(at == cells.size());
}

} // namespace

TEMPLATE_TEST_CASE("cells of wandering curves of every degree", "[arc_length]", double, float, Fixed) {
    Random random(11);
    Worst worst;
    for (int degree = 3; degree <= max_degree; ++degree) {
        for (int i = 0; i < 12; ++i) {
            const int axes = random.integer(2, max_axes);
            check_path<TestType>({random_shape(random, axes, degree, random.decades(1.0, 300.0))}, worst);
        }
    }
    CHECK(worst.chords == 0); // nothing here is near a cusp
    require_good<TestType>(worst);
}

TEMPLATE_TEST_CASE("cells of curves whose speed varies up to a thousandfold", "[arc_length]", double, Fixed) {
    Random random(12);
    Worst worst;
    for (int degree = 3; degree <= max_degree; ++degree) {
        for (int i = 0; i < 10; ++i) {
            check_path<TestType>({random_shape(random, 3, degree, 30.0, i % 2 == 0 ? 30.0 : 1000.0)}, worst);
        }
    }
    require_good<TestType>(worst);
}

TEMPLATE_TEST_CASE("cells near cusps", "[arc_length]", double, Fixed) {
    Worst worst;
    for (const double gap : {1.0, 0.1, 0.01, 1e-3, 1e-4, 1e-6, 0.0}) {
        check_path<TestType>({cubic_shape(10.0, 10.0, gap, 10.0, 10.0, 0.0)}, worst);
        check_path<TestType>({cubic_shape(10.0, gap, 10.0, gap / 3.0, 0.0, gap)}, worst); // to and fro
        check_path<TestType>({cubic_shape(gap, gap / 2.0, 5.0, 10.0, 10.0, 0.0)}, worst); // cusp at the start
        check_path<TestType>({cubic_shape(5.0, 10.0, 10.0, gap, 10.0, 0.0)}, worst);      // at the end
        check_path<TestType>({cubic_shape(gap, gap, 2.0 * gap, 0.0, 10.0, 0.0)}, worst);
    }
    require_good<TestType>(worst);
}

TEMPLATE_TEST_CASE("tiny segments", "[arc_length]", double, Fixed) {
    Random random(13);
    Worst worst;
    for (int i = 0; i < 20; ++i) {
        check_path<TestType>({random_shape(random, 3, random.integer(3, 9), random.decades(1e-3, 0.1))}, worst);
    }
    check_path<TestType>({line_shape(3, 1, {1e-3, 0.0, 0.0})}, worst);
    check_path<TestType>({line_shape(3, 3, {1e-4, 1e-4, 1e-4})}, worst);
    // A near-cusp of 1 um: sigma^2 times the unit is below the resolution of Fixed
    check_path<TestType>({cubic_shape(1e-3, 1e-3, 1e-5, 1e-3, 1e-3, 0.0)}, worst);
    require_good<TestType>(worst);
}

TEMPLATE_TEST_CASE("long straight lines", "[arc_length]", double, float, Fixed) {
    // The sources refuse moves of more than 512 mm in float: shorter cells of them would be as coarse as control points
    Worst worst;
    const double longest = std::same_as<TestType, float> ? 500.0 : 60000.0;
    for (const int degree : {1, 9}) {
        check_path<TestType>({line_shape(3, degree, {longest, 0.0, 0.0})}, worst);
        check_path<TestType>({line_shape(3, degree, {-0.6 * longest, 0.6 * longest, 1.0})}, worst);
        check_path<TestType>({line_shape(1, degree, {-12.5})}, worst);
    }
    CHECK(worst.chords == 0);
    require_good<TestType>(worst);
}

TEMPLATE_TEST_CASE("a slow feed does not turn a line into a cusp", "[arc_length]", double, Fixed) {
    // Cells next to a stop shrink with feed^2, to 0.1 um at least: more halvings of 60 m than there are levels.
    Worst worst;
    check_path<TestType>({line_shape(3, 3, {60000.0, 0.0, 0.0})}, worst, 5.0);
    check_path<TestType>({line_shape(3, 3, {1000.0, 0.0, 0.0})}, worst, 0.1);
    CHECK(worst.chords == 0);
    require_good<TestType>(worst);
}

TEMPLATE_TEST_CASE("a cusp costs few cells and adds no length", "[arc_length]", double, Fixed) {
    const auto coincident = [](int degree) {
        TestShape shape;
        shape.axes = 2;
        shape.degree = degree;
        shape.offset[0][static_cast<unsigned>(degree)] = 10.0; // all other Bezier points at the start
        return shape;
    };
    for (const TestShape& shape :
         {cubic_shape(10.0, 10.0, 0.0, 10.0, 10.0, 0.0), cubic_shape(0.0, 0.0, 5.0, 10.0, 10.0, 0.0),
          cubic_shape(0.0, 0.0, 0.0, 0.0, 10.0, 0.0), cubic_shape(10.0, 0.0, 10.0, 0.0, 0.0, 0.0), coincident(5),
          coincident(9)}) {
        ListSource<TestType> source(BezierPath{shape});
        const std::vector<Cell<TestType>> cells = cells_of<TestType>(source, refinement<TestType>(2));
        Real chords = 0.0L;
        for (const Cell<TestType>& cell : cells) {
            chords += is_chord(cell) ? exact(cell.length_mm) : 0.0L;
        }
        CAPTURE(cells.size(), static_cast<double>(chords));
        // The speed grows with a power of the distance from the cusp: cells in a geometric row on both sides, a few per
        // halving, and what remains below the resolution of the control points is nothing.
        CHECK(cells.size() < 1000);
        CHECK(chords < 1e-6L);
    }
}
