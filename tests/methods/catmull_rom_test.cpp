// SPDX-License-Identifier: MIT
//
// Descriptions of the original Catmull-Rom curve: joints of degenerate points.
#include "host_sim/curve/methods/method_table.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;
using nlohmann::json;

namespace {

DescribedCurve made(const json& points, const json& tension = 0.5, bool closed = false,
                    ScalarKind scalar = ScalarKind::float64) {
    return describe_curve("catmull_rom", {{"points", points}, {"tension", tension}, {"closed", closed}}, scalar);
}

std::string class_of(const DescribedCurve& curve, std::size_t joint) {
    return curve.results.at("joints").at(joint).at("class").get<std::string>();
}

} // namespace

TEST_CASE("catmull_rom: classes of degenerate joints", "[methods][catmull_rom]") {
    for (const ScalarKind scalar : {ScalarKind::float64, ScalarKind::float32, ScalarKind::fixed}) {
        const json reversal = {{0, 0}, {3, 1}, {0, 0}, {5, 5}};
        const DescribedCurve turn = made(reversal, 0.5, false, scalar);
        CHECK(class_of(turn, 0) == "C1+singular");
        CHECK(turn.results["joints"][0]["G1"].is_null());
        CHECK(class_of(turn, 1) == "C1");
        const json square = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
        const DescribedCurve polygon = made(square, 0, true, scalar);
        for (std::size_t i = 0; i < 4; ++i) {
            CHECK(class_of(polygon, i) == "C1+singular");
        }
        const DescribedCurve twice = made({{0, 0}, {4, 0}, {4, 0}, {4, 4}}, 0.5, false, scalar);
        CHECK(class_of(twice, 0) == "C1");
        CHECK(made({{0, 0}, {4, 3}}, 0.5, false, scalar).pieces.size() == 1);
        CHECK(made({{0, 0}, {4, 0}, {4, 4}, {0, 0}}, 0.5, true, scalar).pieces.size() == 3); // the repeat is dropped
    }
}
