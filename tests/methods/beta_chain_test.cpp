// SPDX-License-Identifier: MIT
//
// Descriptions of beta chains: the error of float and Fixed against its bound, and what is said of bad ones.
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

std::string refusal(const nlohmann::json& input, ScalarKind scalar = ScalarKind::float64) {
    try {
        static_cast<void>(describe_curve("beta_chain", input, scalar));
    } catch (const DescriptionError& error) {
        return error.what();
    }
    return "none";
}

nlohmann::json good_input() {
    return nlohmann::json::parse(R"({"degree": 3, "order": 2, "closed": false,
        "first_polygon": [[0, 0], [1, 2], [3, 3], [5, 2]], "free_points": [[[9, -1]], [[8, -6]]],
        "betas": [{"beta1": 1, "beta2": 0}, {"beta1": "1.5", "beta2": -1}]})");
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

TEST_CASE("beta_chain: a bad description is refused in a sentence", "[methods][beta]") {
    REQUIRE(refusal(good_input()) == "none");
    const auto with = [](const char* path, const nlohmann::json& value) {
        nlohmann::json input = good_input();
        input[nlohmann::json::json_pointer(path)] = value;
        return refusal(input);
    };
    const auto says = [](const std::string& text, const char* part) {
        INFO(text);
        return text.find(part) != std::string::npos;
    };
    CHECK(says(with("/degree", 1), "order 2 takes at least 2"));
    CHECK(says(with("/degree", 10), "\"degree\""));
    CHECK(says(with("/order", 3), "\"order\""));
    CHECK(says(with("/closed", true), "2 order + 1"));
    CHECK(says(with("/betas/1/beta1", 0), "joint 2: beta1"));
    CHECK(says(with("/betas/0/beta1", -2), "joint 1: beta1"));
    CHECK(says(with("/betas/0", 1), "joint 1 must be an object"));
    CHECK(says(with("/betas/0/beta1", nullptr), "\"beta1\" is missing"));
    CHECK(says(with("/betas/0/beta2", "nan"), "beta2"));
    CHECK(says(with("/betas", nlohmann::json::array()), "2 polygons"));
    CHECK(says(with("/free_points", 3), "\"free_points\""));
    CHECK(says(with("/free_points/0", nlohmann::json::parse("[[1, 2], [3, 4]]")), "it must have 1"));
    CHECK(says(with("/free_points/1", nlohmann::json::parse("[[1, 2, 3]]")), "like those before"));
    CHECK(says(with("/first_polygon", nullptr), "\"first_polygon\""));
    CHECK(says(with("/first_polygon/2", nlohmann::json::parse("[5, 2]")), "tangent vanishes"));
    nlohmann::json growing = good_input();
    for (int j = 0; j < 40; ++j) {
        growing["free_points"].push_back(growing["free_points"][0]);
        growing["betas"].push_back(growing["betas"][0]);
    }
    CHECK(says(refusal(growing, ScalarKind::fixed), "grows from joint to joint"));
    CHECK(refusal(growing) == "none");
    nlohmann::json wide = good_input();
    wide["betas"][0]["beta1"] = 9000;
    CHECK_THROWS_AS(describe_curve("beta_chain", wide, ScalarKind::fixed), DescriptionError);
    CHECK_NOTHROW(describe_curve("beta_chain", wide, ScalarKind::float64));
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
