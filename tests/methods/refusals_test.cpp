// SPDX-License-Identifier: MIT
//
// What a description is refused for, in the words that name the reason and the limits.
#include "host_sim/curve/methods/method_table.hpp"
#include "host_sim/surface/described_surface.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;
using nlohmann::json;

namespace {

constexpr std::array every_scalar{ScalarKind::fixed, ScalarKind::float32, ScalarKind::float64};

/// The sentence; empty where the curve is made.
std::string refusal(const char* method, const json& input, ScalarKind scalar) {
    try {
        static_cast<void>(describe_curve(method, input, scalar));
    } catch (const DescriptionError& error) {
        return error.what();
    }
    return "";
}

void check_mentions(const std::string& sentence, const char* words) {
    CAPTURE(sentence, words);
    CHECK(sentence.find(words) != std::string::npos);
}

} // namespace

TEST_CASE("Refusals: lambda and mu of Ferguson curves by their limits", "[methods][refusals]") {
    const json points = {{0, 0}, {1, 2}, {3, 2}, {4, 0}, {6, 1}};
    for (const ScalarKind scalar : every_scalar) {
        const double usual_mu = 0.0;
        for (const double lambda : {1e7, 1e-7, 1e200, 1e-200}) {
            const json input{{"points", points}, {"lambda", lambda}, {"mu", usual_mu}};
            check_mentions(refusal("ferguson", input, scalar), "lambda between 1/16 and 16 and mu between");
        }
        for (const double mu : {1e19, -1e19, 1e300}) {
            check_mentions(refusal("ferguson", {{"points", points}, {"mu", mu}}, scalar), "lambda must lie between");
        }
    }
    CHECK(refusal("ferguson", {{"points", points}, {"lambda", 1e5}}, ScalarKind::float64).find("lie between") ==
          std::string::npos);
}

TEST_CASE("Refusals: automatic mu is not advised to whom it did not help", "[methods][refusals]") {
    json points;
    for (int i = 0; i < 60; ++i) {
        points.push_back({i, (i * 7) % 5});
    }
    for (const ScalarKind scalar : every_scalar) {
        for (const double lambda : {0.0625, 0.5, 1.0, 2.0, 4.0, 16.0}) {
            for (const int delta : {1, -1}) {
                CAPTURE(lambda, delta);
                const json input{{"points", points}, {"lambda", lambda}, {"delta", delta}, {"mu", "auto"}};
                CHECK(refusal("ferguson", input, scalar).empty());
            }
        }
    }
    const json singular{{"points", {{0, 0}, {1, 2}, {3, 2}}}, {"delta", -1}, {"mu", 0}};
    check_mentions(refusal("ferguson", singular, ScalarKind::float64), "or \"mu\": \"auto\"");
}

TEST_CASE("Refusals: the factor of modified Catmull-Rom curves by its limits", "[methods][refusals]") {
    const json points = {{0, 0}, {1, 1}, {3, 4}};
    const auto with = [&](const char* mode, double factor, ScalarKind scalar) {
        return refusal("catmull_rom_modified", {{"points", points}, {"mode", mode}, {"factor", factor}}, scalar);
    };
    for (const ScalarKind scalar : every_scalar) {
        CHECK(with("chord", 2.0, scalar).empty());
        check_mentions(with("chord", 2.5, scalar), "\"chord\" it must lie between 0 and 2");
        check_mentions(with("chord", -1e300, scalar), "\"chord\" it must lie between 0 and 2");
        check_mentions(with("constant", -1.0, scalar), "as a constant length it must lie between 0 and");
        check_mentions(with("constant", 1e300, scalar), "as a constant length it must lie between 0 and");
        CHECK(with("constant", 16.0, scalar).empty());
    }
    // A coordinate of 4 becomes 2^17 units, the limit is 2^20 of them.
    check_mentions(with("constant", 50.0, ScalarKind::fixed), "between 0 and 32 mm in fixed-point numbers");
    CHECK(with("constant", 32.0, ScalarKind::fixed).empty());
    CHECK(with("constant", 50.0, ScalarKind::float64).empty());
}

TEST_CASE("Refusals: a key that the method does not know, with the nearest one", "[methods][refusals]") {
    const json points = {{0, 0}, {1, 1}, {3, 4}, {4, 4}};
    const auto with = [](const char* method, json input, const char* key) {
        CHECK(refusal(method, input, ScalarKind::float64).empty());
        input[key] = 2;
        return refusal(method, input, ScalarKind::float64);
    };
    CHECK(with("bspline_interpolation", {{"points", points}}, "degre") ==
          "\"input\" has an unknown key 'degre'; did you mean 'degree'?");
    check_mentions(with("catmull_rom", {{"points", points}}, "tensoin"), "did you mean 'tension'?");
    check_mentions(with("catmull_rom_modified", {{"points", points}}, "facter"), "did you mean 'factor'?");
    check_mentions(with("ferguson", {{"points", points}}, "lamda"), "did you mean 'lambda'?");
    check_mentions(with("bspline", {{"vertices", points}}, "points"), "known are vertices, degree, closed");
    json chain = json::parse(R"({"degree": 3, "first_polygon": [[0, 0], [1, 1], [3, 4], [4, 4]],
                                 "free_points": [[[5, 5]]], "betas": [{"beta1": 1}]})");
    check_mentions(with("beta_chain", chain, "ordre"), "did you mean 'order'?");
    chain["betas"][0]["beta3"] = 1;
    check_mentions(refusal("beta_chain", chain, ScalarKind::float64), "\"betas\", joint 1 has an unknown key 'beta3'");
}

TEST_CASE("Refusals: a key that a surface does not know, with the nearest one", "[methods][refusals]") {
    const json row = {{0, 0, 0}, {1, 0, 1}, {2, 0, 0}};
    const json next = {{0, 1, 0}, {1, 1, 2}, {2, 1, 0}};
    const auto with = [](const char* method, json input, const char* key) {
        CHECK_NOTHROW(describe_surface(method, input));
        input[key] = 2;
        try {
            static_cast<void>(describe_surface(method, input));
        } catch (const DescriptionError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    check_mentions(with("bspline_surface", {{"grid", {row, next}}}, "degreeu"), "did you mean 'degree_u'?");
    check_mentions(with("bspline_skin", {{"sections", {row, next}}}, "domain"), "unknown key 'domain'");
    json skin = json::parse(R"({"sections": [[[0, 0], [1, 1], [2, 0]], [[0, 0], [1, 2], [2, 0]]],
                                "spine": {"points": [[0, 0, 0], [0, 9, 0]]}})");
    check_mentions(with("bspline_skin", skin, "spin"), "did you mean 'spine'?");
    skin["spine"]["station"] = 1;
    CHECK_THROWS_WITH(describe_surface("bspline_skin", skin),
                      "\"spine\" has an unknown key 'station'; did you mean 'stations'?");
}

TEST_CASE("Refusals: a closed curve of even degree with its knots at the points", "[methods][refusals]") {
    const json input = json::parse(R"({"points": [[0, 0], [1, 2], [3, 2], [4, 0], [6, -1], [2, -3]], "degree": 2,
                                       "closed": true, "knots": "uniform", "parameters": "uniform"})");
    for (const ScalarKind scalar : every_scalar) {
        check_mentions(refusal("bspline_interpolation", input, scalar), "cannot have its knots at the points");
    }
}

TEST_CASE("Refusals: points that are too near, not only the same", "[methods][refusals]") {
    const json near = {{0, 0}, {1e-170, 0}, {2e-170, 1e-170}, {3e-170, 0}};
    const json points = {{0, 0}, {1, 2}, {3, 2}, {4, 0}};
    const json steep{{"points", points}, {"derivative_start", {1e29, 0}}, {"derivative_end", {0, 1}}};
    for (const ScalarKind scalar : every_scalar) {
        check_mentions(refusal("bspline_interpolation", {{"points", near}}, scalar), "or too near beside");
    }
    check_mentions(refusal("bspline_interpolation", steep, ScalarKind::fixed), "largest coordinate or derivative");
}

TEST_CASE("Refusals: a bias that is 0 in the numbers of the scalar", "[methods][refusals]") {
    const json input = json::parse(R"({"degree": 3, "first_polygon": [[0, 0], [1, 2], [3, 2], [4, 0]],
                                       "free_points": [[[9, 0]]], "betas": [{"beta1": 1e-300}]})");
    for (const ScalarKind scalar : {ScalarKind::fixed, ScalarKind::float32}) {
        check_mentions(refusal("beta_chain", input, scalar), "joint 1: beta1 is 1e-300, which is 0 in these numbers");
    }
    CHECK(refusal("beta_chain", input, ScalarKind::float64).find("must be greater") == std::string::npos);
}
