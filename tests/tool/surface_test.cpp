// SPDX-License-Identifier: MIT
#include "tool.hpp"

#include "support/catch.hpp"
#include "support/places.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

using splinefeed::test::Call;
using splinefeed::test::contains;
using splinefeed::test::Tool;

namespace {

const std::string examples = splinefeed::test::source_folder() + "/examples/";

} // namespace

TEST_CASE("surface: the examples become tool paths that run as they are") {
    const Tool tool;
    const Call dome = tool("surface '" + examples + "dome.json' --along u --scallop 0.05 --ball-radius 6 -o dome.csv");
    CAPTURE(dome.error);
    REQUIRE(dome.status == 0);
    CHECK(tool.read("dome.csv").substr(0, 13) == "x,y,z,corner\n");
    for (const std::string scalar : {"fixed", "double"}) {
        const Call run = tool("run dome.csv --summary json --scalar " + scalar);
        CAPTURE(run.error);
        CHECK(run.status == 0);
        CHECK(contains(run.output, "\"stopped\": false"));
    }
    for (const std::string options : {"--along u --lines 9 -o blade.json", "--along v --lines 5 -o blade.json",
                                      "--along v --lines 6 --ball-radius 4 --tool centre -o blade.json",
                                      "--along u --lines 6 --pattern one-way --lift 4 -o blade.csv",
                                      "--along v --scallop 0.05 --ball-radius 4 -o blade.csv"}) {
        const Call blade = tool("surface '" + examples + "blade.json' " + options);
        CAPTURE(options, blade.error);
        REQUIRE(blade.status == 0);
        const Call run = tool("run " + options.substr(options.rfind("blade")) + " --summary json");
        CAPTURE(run.error);
        CHECK(run.status == 0);
    }
}

TEST_CASE("surface: standard input is read as json, by name or without") {
    const Tool tool;
    const Call named = tool("surface '" + examples + "dome.json'");
    for (const std::string options : {"-", "- --format json", "--format json --quiet -"}) {
        const Call piped =
            tool.shell("'" + splinefeed::test::tool_path() + "' surface " + options + " < '" + examples + "dome.json'");
        CAPTURE(options, piped.error);
        CHECK(piped.status == 0);
        CHECK(piped.output == named.output);
    }
}

TEST_CASE("surface: a pole is no hollow, wherever it lies") {
    const Tool tool;
    for (const double z : {0.0, 3.0, 7.3, 500.1}) {
        nlohmann::json grid = nlohmann::json::array();
        for (int i = 0; i < 6; ++i) {
            nlohmann::json row = nlohmann::json::array();
            for (int j = 0; j < 5; ++j) {
                const double a = 0.2 * i;
                const double b = 0.4 * j;
                row.push_back(
                    {20.0 * std::sin(a) * std::cos(b), 20.0 * std::sin(a) * std::sin(b), z + 20.0 * std::cos(a)});
            }
            grid.push_back(row);
        }
        tool.write("pole.json", nlohmann::json{{"method", "bspline_surface"}, {"input", {{"grid", grid}}}}.dump());
        for (const std::string along : {"u", "v"}) {
            const Call call = tool("surface pole.json --along " + along + " --lines 5 --ball-radius 3 -o pole.csv");
            CAPTURE(z, along, call.error);
            CHECK(call.status == 0);
        }
    }
}

TEST_CASE("surface: without a path it prints the surface") {
    const Tool tool;
    const Call printed = tool("surface '" + examples + "dome.json'");
    REQUIRE(printed.status == 0);
    const auto json = nlohmann::json::parse(printed.output);
    for (const char* key : {"degree_u", "degree_v", "params_u", "params_v", "knots_u", "knots_v", "net", "samples"}) {
        CHECK(json.contains(key));
    }
    CHECK(json["net"].size() == 7);
    REQUIRE(tool("surface '" + examples + "blade.json' -o skin.json").status == 0);
    const auto skin = nlohmann::json::parse(tool.read("skin.json"));
    CHECK(skin["params_u"].is_null());
    CHECK(skin["merged_knots_u"] == skin["knots_u"]);
}
