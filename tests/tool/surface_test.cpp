// SPDX-License-Identifier: MIT
#include "tool.hpp"

#include "support/catch.hpp"
#include "support/places.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

using splinefeed::test::Call;
using splinefeed::test::Tool;

namespace {

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

const std::string examples = splinefeed::test::source_folder() + "/examples/";

} // namespace

TEST_CASE("surface: the examples become tool paths that run as they are") {
    const Tool tool;
    for (const std::string scalar : {"fixed", "double"}) {
        const Call dome =
            tool("surface '" + examples + "dome.json' --along u --scallop 0.05 --ball-radius 6 -o dome.csv");
        CAPTURE(dome.error);
        REQUIRE(dome.status == 0);
        CHECK(tool.read("dome.csv").substr(0, 13) == "x,y,z,corner\n");
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
    const Call csv = tool("surface '" + examples + "dome.json' --format csv");
    CHECK(csv.status == 2);
    CHECK(contains(csv.error, "--format 'csv': a surface is described in json"));
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

TEST_CASE("surface: what is wrong is told in one line, and nothing is written") {
    const Tool tool;
    const auto refused = [&tool](const std::string& arguments, const std::string& what) {
        const Call call = tool("surface " + arguments);
        CAPTURE(arguments, call.error);
        CHECK(call.status == 2);
        CHECK(std::count(call.error.begin(), call.error.end(), '\n') == 1);
        CHECK(contains(call.error, what));
        CHECK(call.output.empty());
        CHECK(tool.holds_only("g.json"));
    };
    const std::string dome = "'" + examples + "dome.json' -o out.csv ";
    refused(dome + "--lines 5", "--lines is for a tool path; add --along");
    refused(dome + "--along w --lines 5", "--along 'w'");
    refused(dome + "--along u", "needs one of --lines and --scallop");
    refused(dome + "--along u --lines 5 --scallop 0.1 --ball-radius 3", "needs one of --lines and --scallop");
    refused(dome + "--along u --lines 1", "--lines '1' is out of range");
    refused(dome + "--along u --lines 2.5", "whole number");
    refused(dome + "--along u --scallop 0.01", "--scallop needs --ball-radius");
    refused(dome + "--along u --lines 5 --tool tip", "--tool needs --ball-radius");
    refused(dome + "--along u --lines 5 --ball-radius 3 --tool top", "--tool 'top': it must be one of");
    refused(dome + "--along u --lines 5 --lift 3", "--lift is for --pattern one-way");
    refused(dome + "--along u --lines 5 --ball-radius nan", "--ball-radius");
    refused("'" + examples + "blade.json' --along u --lines 4 --ball-radius 9000 -o out.csv", "does not fit");
    refused("missing.json", "missing.json: cannot be opened");
    const auto file = [&](const std::string& text, const std::string& what, const std::string& options = "") {
        tool.write("g.json", text);
        refused("g.json -o out.json " + options, "g.json");
        refused("g.json -o out.json " + options, what);
    };
    file("[", "not JSON");
    file("[]", "there must be \"method\"");
    file(R"({"method": "bezier", "input": {}})", "it must be one of bspline_surface");
    const std::string head = R"({"method": "bspline_surface", "input": {"grid": )";
    file(head + "[]}}", "at least 2 rows");
    file(head + "[[[0,0],[1,0]], [[0,1]]]}}", "row 2");
    file(head + "[[[0,0],[1,0]], [[0,1],[1,1],[2,1]]]}}", "row 2 has 3 points");
    file(head + "[[[0,0],[1,0]], [[0,1],[1,1,1]]]}}", "row 2, point 2 has 3 numbers");
    file(head + "[[[0,0],[1,\"inf\"]], [[0,1],[1,1]]]}}", "row 1, point 2");
    file(head + R"([[[0,0],[1,0]], [[0,1],[1,1]]], "degree_u": 2}})", "\"degree_u\" is 2; 2 rows allow 1");
    file(head + R"([[[0,0],[0,0]], [[0,1],[0,1]]]}})", "two neighbours coincide");
    file(head + "[[[0,0],[1,0]], [[0,1],[1,1]]]}}", "a tool path needs x, y and z", "--along u --lines 3");
    file(head + "[[[0,0,0],[1,0,0],[2,0,1]], [[0,1,0],[1,1,0],[2,1,1]]], \"degree_v\": 1}}", "creases",
         "--along u --lines 3 --ball-radius 1");
    file(head + "[[[0,0,0],[2e9,0,0]], [[0,1,0],[2e9,1,0]]]}}", "lies at 2e+09 mm; a position must lie within",
         "--along v --lines 2");
    const char* const countless = "more than 100000000 waypoints";
    file(head + "[[[0,0,0],[1e6,0,0]], [[0,1,0],[1e6,1,0]]]}}", countless,
         "--along v --lines 2 --step 0.001 --ball-radius 1");
    refused("g.json -o out.csv --along v --lines 2 --step 0.001", countless); // a .json has no waypoints without a ball
    file(head + "[[[0,0,0],[1,0,0]], [[0,0,1],[1,0,1]]]}}", "stands upright", "--along u --lines 3 --ball-radius 1");
}
