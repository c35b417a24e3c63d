// SPDX-License-Identifier: MIT
#include "support/gcode.hpp"
#include "support/rounds.hpp"

#include <algorithm>
#include <cmath>
#include <random>

using namespace splinefeed_test;

namespace {

using Real = long double;

struct Control {
    Real x, y, w;
};

/// The clamped uniform NURBS at u by de Boor, a second way.
std::array<Real, 2> at(const std::vector<Control>& points, int order, Real u) {
    const int d = order - 1;
    const int n = static_cast<int>(points.size());
    const auto knot = [&](int i) {
        return static_cast<Real>(std::clamp(i - d, 0, n - d));
    };
    int k = d;
    while (k < n - 1 && u >= knot(k + 1)) {
        ++k;
    }
    std::vector<std::array<Real, 3>> q;
    for (int j = 0; j <= d; ++j) {
        const Control& p = points[static_cast<std::size_t>(j + k - d)];
        q.push_back({p.x * p.w, p.y * p.w, p.w});
    }
    for (int r = 1; r <= d; ++r) {
        for (int j = d; j >= r; --j) {
            const Real low = knot(j + k - d);
            const Real high = knot(j + 1 + k - r);
            const Real a = (u - low) / (high - low);
            for (unsigned c = 0; c < 3; ++c) {
                auto& to = q[static_cast<std::size_t>(j)][c];
                to = (1 - a) * q[static_cast<std::size_t>(j - 1)][c] + a * to;
            }
        }
    }
    const auto& last = q[static_cast<std::size_t>(d)];
    return {last[0] / last[2], last[1] / last[2]};
}

std::array<Real, 2> on_bezier(const PathElement<double>& element, const std::array<Real, 2>& from, Real t) {
    std::array<Real, 2> out{};
    for (unsigned k = 0; k < 2; ++k) {
        std::vector<Real> b;
        for (unsigned i = 0; i <= static_cast<unsigned>(element.bezier.degree); ++i) {
            b.push_back(static_cast<Real>(element.bezier.points[k][i]));
        }
        for (std::size_t level = b.size() - 1; level > 0; --level) {
            for (std::size_t i = 0; i < level; ++i) {
                b[i] += t * (b[i + 1] - b[i]);
            }
        }
        out[k] = from[k] + b[0] / 4096.0L;
    }
    return out;
}

/// Of a point from the curve.
Real distance(const std::vector<Control>& points, int order, const std::array<Real, 2>& p) {
    const Real end = static_cast<Real>(static_cast<int>(points.size()) - order + 1);
    const auto apart = [&](Real u) {
        const auto q = at(points, order, std::clamp(u, 0.0L, end));
        return std::hypot(p[0] - q[0], p[1] - q[1]);
    };
    // Each place where the curve comes near; and the neighbourhood of each sample that is nearly as near as the nearest
    // one: in a turn of a few micrometres it comes near twice between two samples.
    Real best = 1e9L;
    const auto sampled = [&](Real low, Real high, int samples) {
        std::vector<std::pair<Real, Real>> found; // how far, where
        for (int i = 0; i <= samples; ++i) {
            const Real u = low + (high - low) * i / samples;
            found.emplace_back(apart(u), u);
        }
        return found;
    };
    constexpr int samples = 2000;
    constexpr int finer = 40;
    const auto coarse = sampled(0.0L, end, samples);
    const Real near = 3 * std::min_element(coarse.begin(), coarse.end())->first;
    for (std::size_t i = 0; i <= samples; ++i) {
        const auto [far, around] = coarse[i];
        if (far > near && ((i > 0 && coarse[i - 1].first < far) || (i < samples && coarse[i + 1].first < far))) {
            continue;
        }
        const auto fine = sampled(around - end / samples, around + end / samples, finer);
        for (std::size_t j = 0; j < fine.size(); ++j) { // where the speed is small two of them may be minima
            if ((j > 0 && fine[j - 1].first < fine[j].first) || (j < finer && fine[j + 1].first < fine[j].first)) {
                continue;
            }
            Real where = fine[j].second;
            for (Real step = 2 * end / samples / finer; step > 1e-11L; step /= 3) {
                for (const Real middle = where; const int k : {-3, -2, -1, 1, 2, 3}) {
                    where = apart(middle + k * step) < apart(where) ? middle + k * step : where;
                }
            }
            best = std::min(best, apart(where));
        }
    }
    return best;
}

std::string line_of(const Control& p, bool first, int order) {
    char text[100];
    std::snprintf(text, sizeof text, "%sX%.6f Y%.6f P%.6f", first ? "G5.2 " : "", static_cast<double>(p.x),
                  static_cast<double>(p.y), static_cast<double>(p.w));
    return std::string(text) + (first ? " L" + std::to_string(order) : "");
}

} // namespace

TEST_CASE("random NURBS are the pieces that they become", "[program][nurbs]") {
    const unsigned seed = random_seed();
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const auto six_decimals = [](double value) {
        return std::round(value * 1e6) / 1e6;
    };
    for (int round = 0; round < rounds(10); ++round) {
        const int order = 3 + static_cast<int>(random() % 4);
        const int count = order + static_cast<int>(random() % 12);
        const bool rational = random() % 2 == 0;
        std::vector<Control> points{{0, 0, 1}};
        for (int i = 1; i < count; ++i) {
            points.push_back({static_cast<Real>(six_decimals(20 * unit(random))),
                              static_cast<Real>(six_decimals(20 * unit(random))),
                              rational ? static_cast<Real>(six_decimals(1.5 + unit(random))) : 1.0L});
        }
        CAPTURE(order, count, rational);
        GcodeRun<double> run;
        run.run("F600");
        for (int i = 1; i < count; ++i) {
            REQUIRE(run.push(line_of(points[static_cast<std::size_t>(i)], i == 1, order)).ok());
        }
        const std::size_t early = run.items().size();
        REQUIRE(run.push("G5.3").ok());
        if (count >= 2 * (order - 1) + 1) {
            CHECK(early > 0); // motion begins before the end is known
        }
        std::array<Real, 2> from{};
        Real worst = 0;
        Real u = 0;
        const Real end = count - order + 1;
        for (const auto& item : run.items()) {
            const PathElement<double>& element = item.element;
            if (!rational) {
                REQUIRE(element.bezier.degree == order - 1);
            }
            for (int i = 0; i <= 8; ++i) {
                const auto p = on_bezier(element, from, i / 8.0L);
                if (!rational) { // at the same parameter
                    const auto q = at(points, order, std::min(u + i / 8.0L, end));
                    worst = std::max(worst, std::hypot(p[0] - q[0], p[1] - q[1]));
                } else if (i % 2 == 0) { // the nearest point of the curve
                    const Real best = distance(points, order, p);
                    worst = std::max(worst, best);
                }
            }
            if (!rational) {
                u += 1;
            }
            from = {static_cast<Real>(to_mm(element.to[0])), static_cast<Real>(to_mm(element.to[1]))};
        }
        CHECK(worst < (rational ? 2e-6L : 2e-8L));
        CHECK(from[0] == Approx(static_cast<double>(points.back().x)));
        CHECK(from[1] == Approx(static_cast<double>(points.back().y)));
    }
}

TEST_CASE("a circle of weights", "[program][nurbs]") {
    GcodeRun<double> run;
    run.run("F600 G0 X10 Y0");
    const auto items = run.run("G5.2 X10 Y10 P0.707106781 L3\nX0 Y10 P1\nG5.3");
    std::array<Real, 2> from{10, 0};
    for (const auto& item : items) {
        for (int i = 0; i <= 8; ++i) {
            const auto p = on_bezier(item.element, from, i / 8.0L);
            CHECK(std::fabs(std::hypot(p[0], p[1]) - 10.0L) < 1e-6L);
        }
        from = {static_cast<Real>(to_mm(item.element.to[0])), static_cast<Real>(to_mm(item.element.to[1]))};
        CHECK(item.element.joined == (&item != &items.front()));
    }
}

TEST_CASE("a piece of weights is one move: under G61.1 the machine stops at its end", "[program][nurbs]") {
    GcodeRun<double> run;
    run.run("F600 G61.1 G0 X10 Y0");
    const auto items = run.run("G5.2 X10 Y10 P0.707106781 L3\nX0 Y10 P1\nG5.3");
    REQUIRE(items.size() > 1);
    for (const auto& item : items) {
        CHECK((item.element.mode == PathMode::exact_stop) == (&item == &items.back()));
    }
}

TEST_CASE("a curve ends at its last point, whatever its weight", "[program][nurbs]") {
    for (const std::string weight : {"0.5", "0.7", "3", "1.1"}) {
        for (int angle = 0; angle < 90; angle += 7) {
            CAPTURE(weight, angle);
            GcodeRun<double> run;
            run.run("G10 L2 P2 R" + std::to_string(angle) + "\nG55 F5\nG5.2 X1 Y1\nX3 Y1.3 P" + weight + "\nG5.3");
            CHECK(run.items().back().element.to == run.interpreter().position());
        }
    }
}
