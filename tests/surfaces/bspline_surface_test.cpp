// SPDX-License-Identifier: MIT
//
// Surfaces against the tensor product of printed basis functions in long double, and what interpolation refuses.
#include "splinefeed/surfaces/surface_interpolation.hpp"

#include "support/catch.hpp"
#include "support/random_path.hpp"

#include <limits>

using namespace splinefeed;
using splinefeed_test::path_seed;
using splinefeed_test::RandomPath;

namespace {

using Real = long double;

template <Scalar S>
struct Interpolated {
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::vector<Point<S>> grid;
    std::vector<S> parameters_u, parameters_v, knots_u, knots_v, entries, row_parameters;
    std::vector<Point<S>> net, row;
    BSplineSurface<S> surface;

    Status make(std::size_t m, std::size_t n, const SurfaceKind& kind, double length_u, double length_v, int axes = 3) {
        rows = m;
        columns = n;
        const std::size_t longest = std::max(m, n);
        parameters_u.resize(m);
        parameters_v.resize(n);
        knots_u.resize(m + 10);
        knots_v.resize(n + 10);
        entries.resize(kind.entries(m, n));
        row_parameters.resize(longest);
        net.resize(m * n);
        row.resize(longest);
        const auto result = interpolate_surface<S>({axes, m, n, grid}, kind, from_double<S>(length_u),
                                                   from_double<S>(length_v), storage());
        if (result.has_value()) {
            surface = *result;
            REQUIRE(check_surface(surface).ok());
        }
        return result.error();
    }
    SurfaceStorage<S> storage() {
        return {parameters_u, parameters_v, knots_u, knots_v, net, entries, row, row_parameters};
    }
};

template <Scalar S>
Interpolated<S> random_surface(RandomPath& random, const SurfaceKind& kind, std::size_t m, std::size_t n) {
    Interpolated<S> made;
    for (std::size_t i = 0; i < m; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            made.grid.push_back({from_double<S>(256.0 * (static_cast<double>(i) + random.between(-0.3, 0.3))),
                                 from_double<S>(256.0 * (static_cast<double>(j) + random.between(-0.3, 0.3))),
                                 from_double<S>(random.between(-256.0, 256.0))});
        }
    }
    REQUIRE(made.make(m, n, kind, 1024.0, 2048.0).ok());
    return made;
}

/// N_i^k(t) as printed, spans half-open but the last.
template <Scalar S>
Real basis(std::span<const S> knots, std::size_t i, int k, Real t) {
    const auto u = [&](std::size_t j) {
        return static_cast<Real>(to_double(knots[j]));
    };
    if (k == 0) {
        const bool last = u(i + 1) >= u(knots.size() - 1) && t >= u(i + 1);
        return u(i) < u(i + 1) && t >= u(i) && (t < u(i + 1) || last) ? 1.0L : 0.0L;
    }
    const auto n = static_cast<std::size_t>(k);
    const Real left = u(i + n) > u(i) ? (t - u(i)) / (u(i + n) - u(i)) * basis(knots, i, k - 1, t) : 0.0L;
    const Real right =
        u(i + n + 1) > u(i + 1) ? (u(i + n + 1) - t) / (u(i + n + 1) - u(i + 1)) * basis(knots, i + 1, k - 1, t) : 0.0L;
    return left + right;
}

template <Scalar S>
std::array<Real, 3> reference(const BSplineSurface<S>& surface, Real u, Real v) {
    std::array<Real, 3> out{};
    for (std::size_t i = 0; i < surface.count_u(); ++i) {
        for (std::size_t j = 0; j < surface.count_v(); ++j) {
            const Real weight =
                basis(surface.knots_u, i, surface.degree_u, u) * basis(surface.knots_v, j, surface.degree_v, v);
            for (unsigned k = 0; k < 3; ++k) {
                out[k] += weight * static_cast<Real>(to_double(surface.net[i * surface.count_v() + j][k]));
            }
        }
    }
    return out;
}

template <Scalar S>
constexpr double accuracy = std::same_as<S, double>  ? 1e-9
                            : std::same_as<S, float> ? 0.02
                                                     : 2e-5;

template <Scalar S>
double length(const Point<S>& p) {
    return std::hypot(to_double(p[0]), to_double(p[1]), to_double(p[2]));
}

} // namespace

TEMPLATE_TEST_CASE("surface: passes its grid; values and derivatives are those of the tensor product", "[surface]",
                   double, float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 60);
    CAPTURE(path_seed);
    for (const auto& [ku, kv] : {std::pair{3, 3}, {3, 2}, {1, 3}, {2, 4}, {5, 2}, {1, 1}}) {
        for (const KnotRule rule : {KnotRule::average, KnotRule::uniform}) {
            const Parameterization how =
                rule == KnotRule::average ? Parameterization::chordal : Parameterization::uniform;
            const SurfaceKind kind{ku, kv, how, rule};
            const auto made = random_surface<S>(random, kind, static_cast<std::size_t>(ku + 1 + random.below(4)),
                                                static_cast<std::size_t>(kv + 1 + random.below(4)));
            CAPTURE(ku, kv);
            const BSplineSurface<S>& surface = made.surface;
            for (std::size_t i = 0; i < made.rows; ++i) {
                for (std::size_t j = 0; j < made.columns; ++j) {
                    const auto jet = evaluate(surface, made.parameters_u[i], made.parameters_v[j]);
                    for (unsigned k = 0; k < 3; ++k) {
                        REQUIRE(std::fabs(to_double(jet.position[k]) - to_double(made.grid[i * made.columns + j][k])) <
                                10.0 * accuracy<S>);
                    }
                }
            }
            for (int round = 0; round < 20; ++round) {
                const S u = from_double<S>(random.between(1.0, 1023.0));
                const S v = from_double<S>(random.between(1.0, 2047.0));
                const auto jet = evaluate(surface, u, v);
                const Real h_u = static_cast<Real>(to_double(jet.length_u));
                const Real h_v = static_cast<Real>(to_double(jet.length_v));
                const auto x = static_cast<Real>(to_double(u));
                const auto y = static_cast<Real>(to_double(v));
                // Differences across a knot see another polynomial; these steps are short and rarely meet one.
                const Real e = 1e-5L;
                const auto at = [&](Real du, Real dv) {
                    return reference(surface, x + du * e * h_u, y + dv * e * h_v);
                };
                const auto o = at(0, 0), pu = at(1, 0), mu = at(-1, 0), pv = at(0, 1), mv = at(0, -1);
                const auto pp = at(1, 1), pm = at(1, -1), mp = at(-1, 1), mm = at(-1, -1);
                for (unsigned k = 0; k < 3; ++k) {
                    const auto near = [&](const Point<S>& mine, Real theirs, double factor) {
                        REQUIRE(std::fabs(to_double(mine[k]) - static_cast<double>(theirs)) <
                                factor * accuracy<S> + 1e-4);
                    };
                    REQUIRE(std::fabs(to_double(jet.position[k]) - static_cast<double>(o[k])) < accuracy<S>);
                    near(jet.u, (pu[k] - mu[k]) / (2 * e), 20.0);
                    near(jet.v, (pv[k] - mv[k]) / (2 * e), 20.0);
                    near(jet.uu, (pu[k] - 2 * o[k] + mu[k]) / (e * e), 200.0);
                    near(jet.vv, (pv[k] - 2 * o[k] + mv[k]) / (e * e), 200.0);
                    near(jet.uv, (pp[k] - pm[k] - mp[k] + mm[k]) / (4 * e * e), 200.0);
                }
            }
        }
    }
}

TEMPLATE_TEST_CASE("surface: an iso-parametric curve lies on it", "[surface]", double, float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 61);
    const auto made = random_surface<S>(random, {3, 2, Parameterization::chordal, KnotRule::average}, 7, 5);
    for (const SurfaceDirection along : {SurfaceDirection::u, SurfaceDirection::v}) {
        const bool along_u = along == SurfaceDirection::u;
        std::vector<Point<S>> controls(along_u ? 7 : 5);
        CHECK(iso_curve<S>(made.surface, along, S{}, std::span(controls).first(4)).error() == Error::storage_too_small);
        for (const double at : {0.0, 300.0, 1000.0, 1024.0}) {
            REQUIRE(iso_curve<S>(made.surface, along, from_double<S>(at), controls).ok());
            for (const double t : {0.0, 17.0, 512.0, 1000.0}) {
                const auto curve = bspline_curve<S>(along_u ? made.surface.knots_u : made.surface.knots_v,
                                                    along_u ? made.surface.degree_u : made.surface.degree_v, controls,
                                                    3, from_double<S>(t));
                const auto jet = along_u ? evaluate(made.surface, from_double<S>(t), from_double<S>(at))
                                         : evaluate(made.surface, from_double<S>(at), from_double<S>(t));
                for (unsigned k = 0; k < 3; ++k) {
                    CHECK(std::fabs(to_double(curve.position[k]) - to_double(jet.position[k])) < accuracy<S>);
                }
            }
        }
    }
}

TEMPLATE_TEST_CASE("surface: the normal, its limit at a pole, and where there is none", "[surface]", double, float,
                   Fixed) {
    using S = TestType;
    // A cone's mantle as it stands: the row u = 0 is the tip. z falls with the distance from the axis.
    Interpolated<S> cone;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 6; ++j) {
            const double r = 100.0 * i;
            const double a = 0.3 * j;
            cone.grid.push_back({from_double<S>(r * std::cos(a)), from_double<S>(r * std::sin(a)), from_double<S>(-r)});
        }
    }
    REQUIRE(cone.make(4, 6, {3, 3, Parameterization::chordal, KnotRule::average}, 1024.0, 1024.0).ok());
    const auto& surface = cone.surface;
    for (const double v : {0.0, 300.0, 1000.0}) {
        const auto tip = normal_at(surface, S{}, from_double<S>(v));
        REQUIRE(tip.has_value());
        CHECK(tip->limit);
        const auto near = normal_at(surface, from_double<S>(1.0), from_double<S>(v));
        REQUIRE(near.has_value());
        CHECK_FALSE(near->limit);
        CHECK(length(near->direction) == Approx(1.0).margin(1e-6));
        for (unsigned k = 0; k < 3; ++k) {
            CHECK(to_double(tip->direction[k]) == Approx(to_double(near->direction[k])).margin(5e-3));
        }
        // outward and up, 45 degrees
        CHECK(to_double(near->direction[2]) == Approx(std::sqrt(0.5)).margin(5e-3));
    }
    // Turned round, the pole is at the end of the domain; the limit keeps the side of the normals beside it.
    Interpolated<S> turned;
    for (std::size_t i = 4; i-- > 0;) {
        turned.grid.insert(turned.grid.end(), cone.grid.begin() + static_cast<std::ptrdiff_t>(6 * i),
                           cone.grid.begin() + static_cast<std::ptrdiff_t>(6 * i + 6));
    }
    REQUIRE(turned.make(4, 6, {3, 3, Parameterization::chordal, KnotRule::average}, 1024.0, 1024.0).ok());
    const auto tip = normal_at(turned.surface, from_double<S>(1024.0), from_double<S>(500.0));
    const auto near = normal_at(turned.surface, from_double<S>(1023.0), from_double<S>(500.0));
    REQUIRE(tip.has_value());
    REQUIRE(near.has_value());
    for (unsigned k = 0; k < 3; ++k) {
        CHECK(to_double(tip->direction[k]) == Approx(to_double(near->direction[k])).margin(5e-3));
    }
    // A flat strip folded into a line: both derivatives are parallel.
    Interpolated<S> line;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            line.grid.push_back({from_double<S>(100.0 * (i + j))});
        }
    }
    REQUIRE(line.make(3, 3, {2, 2, Parameterization::chordal, KnotRule::average}, 1024.0, 1024.0).ok());
    CHECK(normal_at(line.surface, from_double<S>(300.0), from_double<S>(300.0)).error() == Error::tangent_vanishes);
    line.surface.axes = 2;
    CHECK(normal_at(line.surface, S{}, S{}).error() == Error::axes_out_of_range);
}

TEMPLATE_TEST_CASE("surface: a derivative is measured by the net of its span, not by the whole net", "[surface]",
                   double, float, Fixed) {
    using S = TestType;
    const double fine = std::same_as<S, double> ? 1e-10 : 1e-3;
    Interpolated<S> uneven; // fine near the origin, coarse beyond
    for (const double x : {0.0, fine, 1000.0}) {
        for (const double y : {0.0, fine, 1000.0}) {
            uneven.grid.push_back({from_double<S>(x), from_double<S>(y), S{}});
        }
    }
    REQUIRE(uneven.make(3, 3, {1, 1, Parameterization::uniform, KnotRule::uniform}, 2.0, 2.0).ok());
    const auto normal = normal_at(uneven.surface, from_double<S>(0.5), from_double<S>(0.5));
    REQUIRE(normal.has_value());
    CHECK_FALSE(normal->limit);
    CHECK(to_double(normal->direction[2]) == Approx(1.0).margin(1e-6));
}

TEST_CASE("surface: parameters are means over the rows that have chords", "[surface]") {
    // Three rows along v; the first one is a pole.
    Interpolated<double> pole;
    for (int i = 0; i < 3; ++i) {
        for (const double y : {0.0, 1.0, i == 2 ? 2.0 : 4.0, 5.0}) {
            pole.grid.push_back({static_cast<double>(i), i * y});
        }
    }
    REQUIRE(pole.make(3, 4, {2, 3, Parameterization::chordal, KnotRule::average}, 1.0, 1.0, 2).ok());
    CHECK(pole.parameters_v[1] == Approx(0.2));
    CHECK(pole.parameters_v[2] == Approx((0.8 + 0.4) / 2.0));
    // Columns: all of them have both chords.
    CHECK(pole.parameters_u[1] > 0.0);
    // A coincidence in one column only: it has no say.
    Interpolated<double> once = pole;
    once.grid[4] = once.grid[0];
    REQUIRE(once.make(3, 4, {2, 3, Parameterization::chordal, KnotRule::average}, 1.0, 1.0, 2).ok());
    // In all rows: refused; with uniform parameters it does not matter.
    Interpolated<double> everywhere = pole;
    for (std::size_t i = 0; i < 3; ++i) {
        everywhere.grid[i * 4 + 1] = everywhere.grid[i * 4];
    }
    CHECK(everywhere.make(3, 4, {2, 3, Parameterization::chordal, KnotRule::average}, 1.0, 1.0, 2).error() ==
          Error::coincident_points);
    CHECK(everywhere.make(3, 4, {2, 3, Parameterization::uniform, KnotRule::uniform}, 1.0, 1.0, 2).ok());
    Interpolated<double> point = pole;
    for (auto& p : point.grid) {
        p = {};
    }
    CHECK(point.make(3, 4, {2, 3, Parameterization::chordal, KnotRule::average}, 1.0, 1.0, 2).error() ==
          Error::coincident_points);
}

TEST_CASE("surface: degenerate input is refused by name", "[surface]") {
    RandomPath random(path_seed + 62);
    Interpolated<double> made =
        random_surface<double>(random, {3, 2, Parameterization::chordal, KnotRule::average}, 5, 4);
    const auto error = [&](std::size_t m, std::size_t n, const SurfaceKind& kind, int axes = 3) {
        Interpolated<double> other;
        other.grid = made.grid;
        return other.make(m, n, kind, 1.0, 1.0, axes).error();
    };
    using enum Error;
    CHECK(error(3, 4, {3, 2}) == too_few_points);
    CHECK(error(5, 2, {3, 2}) == too_few_points);
    CHECK(error(5, 4, {3, 10}) == degree_out_of_range);
    CHECK(error(5, 4, {3, 2}, 7) == axes_out_of_range);
    CHECK(error(6, 4, {3, 2}) == storage_too_small); // a grid with fewer points than it says
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        const auto kept = made.grid[7];
        made.grid[7][1] = bad;
        CHECK(error(5, 4, {3, 2}) == position_out_of_range);
        made.grid[7] = kept;
    }
    CHECK(error(5, 4, {3, 2}) == none);
    BSplineSurface<double> surface = made.surface;
    surface.net = surface.net.first(19);
    CHECK(check_surface(surface).error() == storage_too_small);
    surface = made.surface;
    surface.knots_u = surface.knots_v;
    CHECK_FALSE(check_surface(surface).ok());
    std::vector<double> falling(surface.knots_v.rbegin(), surface.knots_v.rend());
    surface = made.surface;
    surface.knots_v = falling;
    CHECK(check_surface(surface).error() == knots_invalid);
    // Beyond the domain the nearest of it answers.
    CHECK(evaluate(made.surface, -5.0, 1e9).position == evaluate(made.surface, 0.0, 2048.0).position);
}
