// SPDX-License-Identifier: MIT
#include "host_sim/curve/curve_file.hpp"

#include "host_sim/base/input_error.hpp"
#include "refusal.hpp"
#include "support/catch.hpp"

#include <nlohmann/json.hpp>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

std::string refusal(const std::string& text) {
    return splinefeed_test::refusal_of([&] { static_cast<void>(parse_curve(text, "c.json")); });
}

} // namespace

TEST_CASE("A curve file holds Bezier segments") {
    const CurveFile file = parse_curve(R"({"curve": "g2", "closed": true, "segments": [
        {"degree": 1, "control_points": [[0, 0], [10, 5]]},
        {"control_points": [[10, 5], [10, 0], [0, "-1.5e0"], [0, 0]], "note": 1}]})",
                                       "c.json");
    CHECK(file.method == "bezier");
    CHECK(file.closed);
    CHECK(file.axes == 2);
    REQUIRE(file.segments.size() == 2);
    CHECK(file.segments[1].degree == 3);
    CHECK(file.segments[1].first_point == 2);
    CHECK(file.at(4, 1) == -1.5);
    CHECK(parse_curve(R"({"method": "bezier", "input": {"segments": [{"control_points": [[0], [1]]}]}})", "c.json")
              .axes == 1);
}

TEST_CASE("A description names a method and its points") {
    const CurveFile file = parse_curve(
        R"({"id": "p1", "method": "catmull_rom", "input": {"closed": false, "tension": "0.25", "points": [[0, 0, 1], ["1e1", 2, 3]]}})",
        "c.json");
    CHECK(file.method == "catmull-rom");
    CHECK(file.described);
    REQUIRE(file.segments.size() == 1);
    CHECK(file.axes == 3);
    CHECK(file.at(1, 0) == Approx(10.0 / 12.0));
    CHECK(file.at(3, 0) == 10.0);
    CHECK(file.results->at("tangents")[0][0] == 2.5);
}

TEST_CASE("A computed curve must fit a machine before one is sent along it") {
    const auto refused = [](const std::string& points) -> std::string {
        const CurveFile file =
            parse_curve(R"({"method": "catmull_rom", "input": {"points": [)" + points + "]}}", "c.json");
        try {
            require_executable(file, "c.json");
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    CHECK(refused("[0], [60000]") == "accepted");
    CHECK(refused("[0], [70000]").find("c.json: segment 1 of the curve is longer than 65536 mm") == 0);
    CHECK(refused("[1048000], [1048300], [1048600]").find("c.json: segment 2 of the curve reaches") == 0);
}

TEST_CASE("Every malformed curve file is refused in one line") {
    const auto segments = [](const std::string& list) {
        return R"({"segments": [)" + list + "]}";
    };
    const auto points = [&](const std::string& list) {
        return segments(R"({"control_points": [)" + list + "]}");
    };
    const auto rom = [](const std::string& input) {
        return R"({"method": "catmull_rom", "input": {)" + input + "}}";
    };
    struct Case {
        std::string text;
        std::string start;
        std::string part;
    };
    const std::vector<Case> cases{
        {"", "c.json:1: ", "JSON"},
        {"{\n\"segments\": [\n}", "c.json:3: ", "JSON"},
        {"{\"segments\": \"\xff\"}", "c.json:1: ", "JSON"},
        {"[]", "c.json: ", "object"},
        {"{}", "c.json: ", "neither"},
        {R"({"segments": 3})", "c.json: ", "array"},
        {segments(""), "c.json: ", "at least one"},
        {segments("3"), "c.json: ", "segment 1"},
        {segments(R"({"points": []})"), "c.json: ", "control_points"},
        {points("[0, 0]"), "c.json: ", "1 control points"},
        {points("[0],[1],[2],[3],[4],[5],[6],[7],[8],[9],[10]"), "c.json: ", "11 control points"},
        {points("[0, 0], [1]"), "c.json: ", "control point 2"},
        {points("[], []"), "c.json: ", "one to 6"},
        {points("[0,0,0,0,0,0,0], [0,0,0,0,0,0,1]"), "c.json: ", "one to 6"},
        {points("[0], [\"a\"]"), "c.json: ", "not a number"},
        {points("[0], [\"inf\"]"), "c.json: ", "not finite"},
        {points("[0], [null]"), "c.json: ", "number"},
        {points("[0], [1e999]"), "c.json", "out of range"},
        {points("[0], [2e6]"), "c.json: ", "1048576"},
        {points("[0], [70000]"), "c.json: ", "65536"},
        {points("[1, 2], [1, 2]"), "c.json: ", "same"},
        {segments(R"({"degree": 2, "control_points": [[0], [1]]})"), "c.json: ", "must be 1"},
        {segments(R"({"degree": "x", "control_points": [[0], [1]]})"), "c.json: ", "must be 1"},
        {segments(R"({"control_points": [[0], [1]]}, {"control_points": [[1.00001], [2]]})"),
         "c.json: ", "segment 2 starts"},
        {R"({"closed": 1, "segments": [{"control_points": [[0], [1]]}]})", "c.json: ", "true or false"},
        {R"({"closed": true, "segments": [{"control_points": [[0], [1]]}]})", "c.json: ", "closed"},
        {R"({"method": "catmul_rom", "input": {}})", "c.json: ", "did you mean 'catmull_rom'"},
        {R"({"method": "bezier", "input": {"segment": []}})",
         "c.json: ", "unknown key 'segment'; did you mean 'segments'?"},
        {R"({"method": 3, "input": {}})", "c.json: ", "in quotes"},
        {R"({"method": "bezier"})", "c.json: ", "\"input\""},
        {rom(""), "c.json: ", "points"},
        {rom(R"("points": [[0]])"), "c.json: ", "2 points"},
        {rom(R"("points": [[0], [1, 2]])"), "c.json: ", "point 2"},
        {rom(R"("points": [[0], [1]], "tension": 11)"), "c.json: ", "between 0 and 10"},
    };
    for (const Case& c : cases) {
        const std::string told = refusal(c.text);
        CAPTURE(c.text, told);
        CHECK(told.compare(0, c.start.size(), c.start) == 0);
        CHECK(told.find(c.part) != std::string::npos);
        CHECK(told.find('\n') == std::string::npos);
    }
}
