// SPDX-License-Identifier: MIT
//
// Descriptions of beta chains: the error of float and Fixed against its bound.
#include "splinefeed/splines/beta_chain.hpp"

#include "support/catch.hpp"
#include "support/golden.hpp"

#include <cmath>

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

// docs/explanation/numbers.md, "Beta joints": e' = f (e + 12 u M), relative to the scale of the case.
double bound_of(const nlohmann::json& golden, const DescribedCurve& curve, double u) {
    const nlohmann::json& betas = golden["input"]["betas"];
    const int order = golden["input"]["order"];
    double e = 0.0;
    double largest = 0.0;
    for (std::size_t j = 0; j < betas.size(); ++j) {
        const BezierPiece<double>& before = curve.pieces[j];
        double m = 0.0;
        for (int i = 0; i <= before.degree; ++i) {
            for (const double x : before.point(i)) {
                m = std::fmax(m, std::fabs(x));
            }
        }
        const Beta<double> beta{number_in(betas[j], "beta1"), number_in(betas[j], "beta2")};
        e = *beta_growth(beta, before.degree, order) * (e + 12.0 * u * m);
        largest = std::fmax(largest, std::fmax(e, 12.0 * u * m));
    }
    return largest / number_in(golden, "scale");
}

} // namespace

TEST_CASE("beta_chain: float and Fixed keep their bound on the reference vectors", "[methods][beta]") {
    const nlohmann::json set = golden_set("000_beta.json");
    for (const nlohmann::json& item : set["cases"]) {
        const std::string id = item["id"];
        CAPTURE(id);
        const auto exact = describe_curve("beta_chain", item["input"], ScalarKind::float64);
        const auto single = describe_curve("beta_chain", item["input"], ScalarKind::float32);
        const auto fixed = describe_curve("beta_chain", item["input"], ScalarKind::fixed);
        CHECK(control_error(item, single) <= bound_of(item, exact, 0x1p-24));
        CHECK(control_error(item, fixed) <= bound_of(item, exact, 0x1p-33));
        for (std::size_t j = 0; j < item["expected"]["joint_points"].size(); ++j) {
            const auto& joint = item["expected"]["joint_points"][j];
            if (joint.contains("gamma")) { // undefined in every scalar, or in none
                CHECK(fixed.results["joint_points"][j]["gamma"].is_null() == joint["gamma"].is_null());
                CHECK(single.results["joint_points"][j]["T"].is_null() == joint["T"].is_null());
            } else {
                CHECK_FALSE(fixed.results["joint_points"][j].contains("gamma"));
            }
        }
    }
}

// The second segment is 3e7 times as large as the first, which has a tangent all the same.
TEST_CASE("beta_chain: a small segment beside a large one is regular in every scalar", "[methods][beta_chain]") {
    const auto input = nlohmann::json::parse(R"({"degree": 3, "first_polygon": [[0, 0], [1, 2], [3, 2], [4, 0]],
                                       "free_points": [[[9, 0]]], "betas": [{"beta1": 8000, "beta2": 0}]})");
    for (const ScalarKind scalar : {ScalarKind::fixed, ScalarKind::float32, ScalarKind::float64}) {
        const DescribedCurve curve = describe_curve("beta_chain", input, scalar);
        CHECK(curve.results["joints"][0]["class"] == "G2");
        CHECK(curve.results["joints"][0]["regular"] == true);
    }
}
