// SPDX-License-Identifier: MIT
//
// What is valid, but hardly meant: sentences beside the results, for every scalar.
#include "host_sim/curve/methods/method_table.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;
using nlohmann::json;

namespace {

std::vector<std::string> warnings(const char* method, const json& input, ScalarKind scalar = ScalarKind::fixed) {
    const DescribedCurve curve = describe_curve(method, input, scalar);
    CHECK(json(curve.results.at("warnings")) == json(curve.warnings));
    return curve.warnings;
}

} // namespace

TEST_CASE("Warnings: nothing is said of what is in order", "[methods][warnings]") {
    const json points = {{0, 0}, {1, 2}, {3, 3}, {5, 2}};
    for (const char* method : {"ferguson", "bspline_interpolation", "catmull_rom", "catmull_rom_modified"}) {
        CHECK(warnings(method, {{"points", points}}).empty());
    }
    CHECK(describe_curve("catmull_rom", {{"points", points}}, ScalarKind::float64).results.at("warnings").is_array());
}

TEST_CASE("Warnings: equal neighbours and turned curvature of Ferguson curves", "[methods][warnings]") {
    const json twice = {{0, 0}, {1, 2}, {3, 3}, {3, 3}, {5, 2}};
    const std::vector<std::string> loop{"points 3 and 4 are the same: the curve makes a small loop there"};
    for (const ScalarKind scalar : {ScalarKind::fixed, ScalarKind::float32, ScalarKind::float64}) {
        CHECK(warnings("ferguson", {{"points", twice}}, scalar) == loop);
    }
    // A closed curve may repeat its first point at the end, as often as it likes.
    const json ring = {{0, 0}, {4, 0}, {4, 4}, {0, 0}, {0, 0}};
    CHECK(warnings("ferguson", {{"points", ring}, {"closed", true}}).empty());
    const json points = {{0, 0}, {1, 2}, {3, 3}, {5, 2}};
    CHECK(warnings("ferguson", {{"points", points}, {"delta", -1}, {"mu", 6}}) ==
          std::vector<std::string>{"the curvature flips at 2 points: |kappa| is continuous, the curve is not G2"});
    CHECK(warnings("ferguson", {{"points", points}, {"delta", {1, -1}}, {"mu", 6}}) ==
          std::vector<std::string>{"the curvature flips at 1 point: |kappa| is continuous, the curve is not G2"});
}

TEST_CASE("Warnings: interpolation of high degree", "[methods][warnings]") {
    json points;
    for (int i = 0; i < 12; ++i) {
        points.push_back({i, i % 3});
    }
    CHECK(warnings("bspline_interpolation", {{"points", points}, {"degree", 7}}).empty());
    const auto found = warnings("bspline_interpolation", {{"points", points}, {"degree", 8}});
    REQUIRE(found.size() == 1);
    CHECK(found[0].find("condition grows") != std::string::npos);
}
