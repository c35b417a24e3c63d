// SPDX-License-Identifier: MIT
//
// Every reference vector of surfaces and skins, every output within the case's tolerance.
#include "host_sim/surface/described_surface.hpp"

#include "support/catch.hpp"
#include "support/golden.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

} // namespace

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
