// SPDX-License-Identifier: MIT
//
// Descriptions at the limits of what is taken; tests/tool/refusals/curves.txt has what is refused behind them.
#include "host_sim/curve/methods/method_table.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;
using nlohmann::json;

namespace {

constexpr std::array every_scalar{ScalarKind::fixed, ScalarKind::float32, ScalarKind::float64};

} // namespace

TEST_CASE("Ferguson curves: automatic mu serves every lambda and delta", "[methods]") {
    json points;
    for (int i = 0; i < 60; ++i) {
        points.push_back({i, (i * 7) % 5});
    }
    for (const ScalarKind scalar : every_scalar) {
        for (const double lambda : {0.0625, 0.5, 1.0, 2.0, 4.0, 16.0}) {
            for (const int delta : {1, -1}) {
                CAPTURE(lambda, delta);
                const json input{{"points", points}, {"lambda", lambda}, {"delta", delta}, {"mu", "auto"}};
                CHECK_NOTHROW(describe_curve("ferguson", input, scalar));
            }
        }
    }
}

TEST_CASE("Modified Catmull-Rom curves: factors up to the limits of each scalar", "[methods]") {
    const auto make = [](const char* mode, double factor, ScalarKind scalar) {
        const json input{{"points", {{0, 0}, {1, 1}, {3, 4}}}, {"mode", mode}, {"factor", factor}};
        return describe_curve("catmull_rom_modified", input, scalar);
    };
    for (const ScalarKind scalar : every_scalar) {
        CHECK_NOTHROW(make("chord", 2.0, scalar));
        CHECK_NOTHROW(make("constant", 32.0, scalar)); // a coordinate of 4 is 2^17 units, the limit of Fixed 2^20
    }
    CHECK_NOTHROW(make("constant", 50.0, ScalarKind::float64));
}

TEST_CASE("Beta chains: in double also those that are too wide for Fixed", "[methods]") {
    json input = json::parse(R"({"degree": 3, "first_polygon": [[0, 0], [1, 2], [3, 3], [5, 2]],
                                 "free_points": [[[9, -1]]], "betas": [{"beta1": 9000}]})");
    CHECK_NOTHROW(describe_curve("beta_chain", input, ScalarKind::float64));
    input["free_points"] = input["betas"] = json::array();
    for (int j = 0; j < 12; ++j) {
        input["free_points"].push_back({{9 + j, -1}});
        input["betas"].push_back({{"beta1", 8}});
    }
    CHECK_NOTHROW(describe_curve("beta_chain", input, ScalarKind::float64));
}
