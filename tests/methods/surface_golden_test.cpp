// SPDX-License-Identifier: MIT
//
// Every reference vector of surfaces and skins, every output within the case's tolerance.
#include "host_sim/surface/described_surface.hpp"

#include "splinefeed/splines/bspline_interpolation.hpp"
#include "splinefeed/splines/spline_parameters.hpp"
#include "support/catch.hpp"
#include "support/golden.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;
using nlohmann::json;

namespace {

double real(const json& value) {
    return value.is_string() ? std::stod(value.get<std::string>()) : value.get<double>();
}

double largest(const json& value) {
    double most = 0.0;
    if (!value.is_array()) {
        return std::fabs(real(value));
    }
    for (const json& item : value) {
        most = std::max(most, largest(item));
    }
    return most;
}

// The largest difference in units of the tolerance.
double worst(const json& actual, const json& expected, double tolerance) {
    if (!expected.is_array()) {
        return std::fabs(real(actual) - real(expected)) / tolerance;
    }
    if (!actual.is_array() || actual.size() != expected.size()) {
        return std::numeric_limits<double>::infinity();
    }
    double most = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        most = std::max(most, worst(actual[i], expected[i], tolerance));
    }
    return most;
}

/// By what the equations of an interpolation multiply errors: sum of |inverse| a row at most; and how often its domain
/// holds the shortest span of parameters, by which their rounding counts.
struct Growth {
    double condition = 0.0;
    double spans = 0.0;
};

Growth growth_of(const std::vector<double>& parameters, const std::vector<double>& knots, int degree) {
    const InterpolationKind kind{degree};
    const std::size_t n = parameters.size();
    std::vector<double> entries(kind.band(n).entries());
    BsplineInterpolation<double> system;
    REQUIRE(system.prepare(kind, parameters, knots, entries, {}).ok());
    std::vector<double> rows(n);
    Growth growth;
    for (std::size_t i = 0; i < n; ++i) {
        std::vector<Point<double>> unit(n);
        unit[i][0] = 1.0;
        REQUIRE(system.solve(unit, 1, 0, 1).ok());
        for (std::size_t row = 0; row < n; ++row) {
            rows[row] += std::fabs(unit[row][0]);
        }
        const double span = i == 0 ? parameters.back() : parameters[i] - parameters[i - 1];
        growth.spans = std::max(growth.spans, parameters.back() / span);
    }
    growth.condition = *std::max_element(rows.begin(), rows.end());
    return growth;
}

Growth along_u(const json& item, const DescribedSurface& surface) {
    if (!surface.params_u.empty()) {
        return growth_of(surface.params_u, surface.knots_u, surface.degree_u);
    }
    Growth most; // carried along a spine a section keeps its chords
    const json knots = surface.results["section_knots"];
    for (std::size_t s = 0; s < knots.size(); ++s) {
        const PointList section = points_of(item["input"]["sections"][s], "a section", 2);
        std::vector<double> parameters(section.points.size());
        REQUIRE(spline_parameters<double>(section.points, section.axes, Parameterization::chordal, false,
                                          surface.knots_u.back(), parameters)
                    .ok());
        const Growth one = growth_of(parameters, knots[s].get<std::vector<double>>(), surface.degree_u);
        most = {std::max(most.condition, one.condition), std::max(most.spans, one.spans)};
    }
    return most;
}

double net_error(const DescribedSurface& a, const DescribedSurface& b) {
    REQUIRE(a.net.size() == b.net.size());
    double most = 0.0;
    for (std::size_t i = 0; i < a.net.size(); ++i) {
        for (std::size_t k = 0; k < a.net[i].size(); ++k) {
            most = std::max(most, std::fabs(a.net[i][k] - b.net[i][k]));
        }
    }
    return most;
}

double size_of(const DescribedSurface& surface) {
    double most = 0.0;
    for (const Point<double>& point : surface.net) {
        for (const double x : point) {
            most = std::max(most, std::fabs(x));
        }
    }
    return most;
}

} // namespace

TEST_CASE("Reference vectors of surfaces: float and Fixed within their bound", "[golden][surface]") {
    const auto file = GENERATE(Catch::Generators::as<std::string>{}, "002_bspline_surface.json", "002_skinning.json");
    double worst_double = 0.0;
    double worst_single = 0.0;
    double worst_fixed = 0.0;
    const json set = golden_set(file);
    for (const json& item : set["cases"]) {
        const std::string id = item["id"];
        const auto made = [&](ScalarKind scalar) {
            return describe_surface(item["method"].get<std::string>(), item["input"], scalar);
        };
        const DescribedSurface exact = made(ScalarKind::float64);
        const Growth u = along_u(item, exact);
        const Growth v = growth_of(exact.params_v, exact.knots_v, exact.degree_v);
        // Two interpolations after one another: docs/explanation/numbers.md, Interpolation by B-splines.
        const double bound = u.condition * v.condition * 4.0 * (exact.degree_u + exact.degree_v + 2) *
                             (1.0 + u.spans + v.spans) * size_of(exact);
        const double in_float = net_error(made(ScalarKind::float32), exact);
        const double in_fixed = net_error(made(ScalarKind::fixed), exact);
        CAPTURE(id, u.condition, v.condition, in_float / size_of(exact), in_fixed / size_of(exact),
                bound / size_of(exact));
        CHECK(in_float <= bound * 0x1p-24);
        CHECK(in_fixed <= bound * 0x1p-46);
        CHECK(in_fixed < in_float);
        worst_double = std::max(
            worst_double, worst(json(surface_report(exact))["net"], item["expected"]["net"], real(item["scale"])));
        worst_single = std::max(worst_single, in_float / real(item["scale"]));
        worst_fixed = std::max(worst_fixed, in_fixed / real(item["scale"]));
    }
    if (std::getenv("SPLINEFEED_FIGURES") != nullptr) { // the table of docs/explanation/numbers.md
        WARN(file << ": double " << worst_double << ", float " << worst_single << ", Fixed " << worst_fixed);
    }
}

TEST_CASE("Reference vectors of surfaces: double within the tolerance of each case", "[golden][surface]") {
    const auto file = GENERATE(Catch::Generators::as<std::string>{}, "002_bspline_surface.json", "002_skinning.json");
    const json set = golden_set(file);
    REQUIRE_FALSE(set["cases"].empty());
    for (const json& item : set["cases"]) {
        const std::string id = item["id"];
        const json report = json(surface_report(describe_surface(item["method"].get<std::string>(), item["input"])));
        const double scale = real(item["scale"]);
        const double tol_rel = real(item["tol_rel"]);
        for (const auto& [key, expected] : item["expected"].items()) {
            CAPTURE(id, key);
            REQUIRE(report.contains(key));
            if (key == "samples") {
                REQUIRE(report[key].size() == expected.size());
                for (const std::string name : {"u", "v", "S", "Su", "Sv", "Suu", "Suv", "Svv"}) {
                    double size = scale;
                    for (const json& sample : expected) {
                        size = std::max(size, largest(sample[name]));
                    }
                    for (std::size_t i = 0; i < expected.size(); ++i) {
                        CAPTURE(name, i);
                        CHECK(worst(report[key][i][name], expected[i][name], tol_rel * size) <= 1.0);
                    }
                }
            } else {
                const bool parameters =
                    key.find("params") != std::string::npos || key.find("knots") != std::string::npos;
                CHECK(worst(report[key], expected,
                            tol_rel * (parameters ? std::max(largest(expected), 1e-300) : scale)) <= 1.0);
            }
        }
    }
}
