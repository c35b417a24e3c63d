// SPDX-License-Identifier: MIT
//
// The worked examples, as docs/explanation/curves.md tells to run them.
#include "support/catch.hpp"
#include "support/places.hpp"
#include "tool.hpp"

#include <nlohmann/json.hpp>

using nlohmann::json;
using splinefeed::test::Call;
using splinefeed::test::Tool;

namespace {

const std::string examples = "'" + splinefeed::test::source_folder() + "/examples/";

// over_least: the cycle time over the least possible one is at most so much, as measured and rounded up
json run(const Tool& tool, const std::string& arguments, double over_least) {
    const Call call = tool("run " + arguments + " --summary json --quiet");
    CAPTURE(arguments, call.error);
    REQUIRE(call.status == 0);
    json summary = json::parse(call.output);
    CHECK_FALSE(summary["stopped"].get<bool>());
    for (const auto& [limit, axes] : summary["limit_use"].items()) {
        for (const auto& [axis, use] : axes.items()) {
            CAPTURE(limit, axis);
            if (!use.is_null()) {
                CHECK(use.get<double>() <= 0.999995); // 6e-6 of each limit is kept for rounding
            }
        }
    }
    CHECK(summary["cycle_time_s"].get<double>() <= over_least * summary["optimum_time_s"].get<double>());
    CHECK(summary["optimum_time_s"].get<double>() < summary["cycle_time_s"].get<double>());
    const json& share = summary["limit_share"];
    CHECK(share["none"].get<double>() < 0.5);
    CHECK(share["feed"].get<double>() + share["none"].get<double>() <= 1.0);
    return summary;
}

json curve(const Tool& tool, const std::string& arguments) {
    const Call call = tool("curve " + arguments + " --scalar double");
    CAPTURE(arguments, call.error);
    REQUIRE(call.status == 0);
    return json::parse(call.output);
}

} // namespace

TEST_CASE("Example: a closed cam is C2 all round and runs without a stop") {
    const Tool tool;
    const json cam = curve(tool, examples + "cam.json'");
    CHECK(cam["closed"].get<bool>());
    REQUIRE(cam["joints"].size() == cam["segments"].size());
    for (const json& joint : cam["joints"]) {
        CHECK(joint["class"] == "C2");
    }
    const json summary = run(tool, examples + "cam.json'", 1.002);
    CHECK(summary["length_mm"].get<double>() == Approx(2.0 * 3.14159265 * 24.0).epsilon(0.05));
}

TEST_CASE("Example: points 0.02 to 20 mm apart are met within a hundredth of a nanometre") {
    const Tool tool;
    const json summary = run(tool, examples + "cloud.csv'", 1.003);
    CHECK(summary["waypoint_error_mm"].get<double>() <= 1e-8);
    CHECK(summary["stops"].get<int>() == 0);
}

TEST_CASE("Example: a logo shaped by beta1 and beta2 is G2 with the betas asked for") {
    const Tool tool;
    const json logo = curve(tool, examples + "logo.json'");
    REQUIRE(logo["joints"].size() == 10);
    for (std::size_t i = 0; i < 10; ++i) {
        CHECK(logo["joints"][i]["class"] == "G2");
        CHECK(logo["joints"][i]["length_ratio_d1"].get<double>() == Approx(i % 2 == 0 ? 0.6 : 1.666667));
    }
    run(tool, examples + "logo.json'", 1.008);
}
