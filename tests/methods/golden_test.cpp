// SPDX-License-Identifier: MIT
//
// Every case of the reference vectors (tests/golden, computed with 60 digits), every output within the case's
// tolerance.
#include "support/golden.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

DescribedCurve curve_of(const nlohmann::json& item) {
    return describe_curve(item["method"].get<std::string>(), item["input"], ScalarKind::float64);
}

} // namespace

TEST_CASE("Reference vectors: double within the tolerance of each case", "[golden]") {
    const auto file =
        GENERATE(Catch::Generators::as<std::string>{}, "000_beta.json", "001_hermite_delta_lambda_mu.json",
                 "002_bspline_curve.json", "003_boehm.json", "004_catmull_rom.json", "004_catmull_rom_modified.json");
    const nlohmann::json set = golden_set(file);
    REQUIRE_FALSE(set["cases"].empty());
    for (const nlohmann::json& item : set["cases"]) {
        const std::string id = item["id"];
        CAPTURE(file, id);
        const std::vector<std::string> found = differences(item, curve_of(item));
        CHECK(found == std::vector<std::string>{});
    }
}

TEST_CASE("The comparison with reference vectors sees what it should", "[golden]") {
    const nlohmann::json item = golden_set("004_catmull_rom.json")["cases"][0];
    const DescribedCurve right = curve_of(item);
    const double e = 1e-12 * std::stod(item["scale"].get<std::string>());
    REQUIRE(differences(item, right).empty());
    DescribedCurve wrong = right;
    wrong.pieces[1].control[0][2] += 3.0 * e;
    CHECK_FALSE(differences(item, wrong).empty());
    wrong = right;
    wrong.results["tangents"][0][1] = wrong.results["tangents"][0][1].get<double>() + 3.0 * e;
    CHECK_FALSE(differences(item, wrong).empty());
    wrong = right;
    wrong.results.erase("tangents");
    CHECK_FALSE(differences(item, wrong).empty());
    wrong = right;
    wrong.results["joints"][0]["class"] = "C2";
    CHECK_FALSE(differences(item, wrong).empty());
    wrong = right;
    wrong.pieces.pop_back();
    CHECK_FALSE(differences(item, wrong).empty());
}
