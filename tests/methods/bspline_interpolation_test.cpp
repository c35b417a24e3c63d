// SPDX-License-Identifier: MIT
#include "host_sim/curve/methods/method_table.hpp"
#include "support/catch.hpp"
#include "support/golden.hpp"

#include <cmath>

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;
using nlohmann::json;

namespace {

DescribedCurve made(const json& input, ScalarKind scalar = ScalarKind::float64) {
    return describe_curve("bspline_interpolation", input, scalar);
}

const json plain = {{"points", {{0, 0}, {1, 2}, {3, 3}, {5, 2}, {6, 0}, {8, 1}}}};

} // namespace

TEST_CASE("Reference vectors of interpolation in float and Fixed: condition times rounding", "[golden]") {
    // docs/explanation/numbers.md: condition (k + 1) (4 u of solving + 4 u of the parameters, which the knots follow),
    // and what the spacing makes of the rounding of a parameter: u times the number of spans over the shortest.
    const json set = golden_set("002_bspline_curve.json");
    REQUIRE_FALSE(set["cases"].empty());
    for (const json& item : set["cases"]) {
        const std::string id = item["id"];
        const double condition = std::stod(item["condition"].get<std::string>());
        const double k = item["input"]["degree"].get<double>();
        double shortest = 1e300;
        const json& params = item["expected"]["params"];
        const double domain = std::stod(item["input"]["domain_length"].get<std::string>());
        for (std::size_t i = 0; i + 1 < params.size(); ++i) {
            shortest = std::min(shortest,
                                std::stod(params[i + 1].get<std::string>()) - std::stod(params[i].get<std::string>()));
        }
        for (const ScalarKind scalar : {ScalarKind::float32, ScalarKind::fixed}) {
            const double u = scalar == ScalarKind::float32 ? 0x1p-24 : 0x1p-46;
            const double bound = condition * (k + 1.0) * 4.0 * u * (1.0 + domain / shortest);
            const DescribedCurve curve = made(item["input"], scalar);
            CAPTURE(id, condition, scalar == ScalarKind::float32, bound);
            REQUIRE(curve.pieces.size() == item["expected"]["segments"].size());
            REQUIRE(control_error(item, curve) <= bound);
            if (scalar == ScalarKind::fixed && condition < 1000.0) {
                REQUIRE(control_error(item, curve) <= 1e-11);
                REQUIRE(curve.results["continuity_order_in_t"].get<int>() ==
                        item["expected"]["continuity_order_in_t"].get<int>());
            }
        }
    }
}

TEST_CASE("Interpolation: defaults and spellings", "[methods]") {
    const DescribedCurve curve = made(plain);
    CHECK(curve.pieces.size() == 3);
    CHECK(curve.pieces.front().degree == 3);
    CHECK(curve.results["params"].back() == 5.0);
    CHECK(curve.results["continuity_order_in_t"] == 2);
    json chordal = plain;
    chordal["parameters"] = "chordal";
    chordal["derivative_start"] = nullptr;
    CHECK(made(chordal).results == curve.results);
    json uniform = plain;
    uniform["parameters"] = "uniform";
    CHECK(made(uniform).results["params"].get<std::vector<double>>() == std::vector<double>{0, 1, 2, 3, 4, 5});
    json given = plain;
    given["parameters"] = {0, 1, 2, 3, 4, 5};
    CHECK(made(given).results["control_points"] == made(uniform).results["control_points"]);
    given["knots"] = {0, 0, 0, 0, 2, 3, 5, 5, 5, 5};
    CHECK(made(given).results["control_points"] == made(uniform).results["control_points"]);
    json closed = plain;
    closed["closed"] = true;
    CHECK(made(closed).results["knots"][3] == made(closed).results["params"][0]);
    closed["degree"] = 2;
    const DescribedCurve ring = made(closed);
    CHECK(ring.pieces.size() == 6);
    closed["points"].push_back(closed["points"][0]); // explicitly closed
    CHECK(made(closed).results == ring.results);
    // Two points are a straight line, whatever degree is asked for; three without a degree a parabola.
    json two = {{"points", {{0, 0, 0}, {3, 4, 5}}}, {"degree", 3}};
    CHECK(made(two).pieces.front().degree == 1);
    two["points"].push_back({1, 1, 1});
    two.erase("degree");
    CHECK(made(two).pieces.front().degree == 2);
}

TEST_CASE("Interpolation in Fixed finds a unit for what overshoots", "[methods]") {
    json wild = plain;
    wild["derivative_start"] = {0, 4000.0};
    wild["derivative_end"] = {0, -4000.0};
    wild["degree"] = 7;
    const DescribedCurve exact = made(wild);
    const DescribedCurve fixed = made(wild, ScalarKind::fixed);
    double size = 0.0;
    for (const auto& piece : exact.pieces) {
        for (int i = 0; i <= piece.degree; ++i) {
            size = std::max(size, std::fabs(piece.point(i)[1]));
        }
    }
    REQUIRE(size > 1000.0);
    for (std::size_t j = 0; j < exact.pieces.size(); ++j) {
        for (int i = 0; i <= exact.pieces[j].degree; ++i) {
            CHECK(std::fabs(exact.pieces[j].point(i)[1] - fixed.pieces[j].point(i)[1]) <= 1e-9 * size);
        }
    }
}
