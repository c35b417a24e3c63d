// SPDX-License-Identifier: MIT
#include "host_sim/base/json_text.hpp"

#include "refusal.hpp"
#include "support/catch.hpp"

#include <nlohmann/json.hpp>

using namespace splinefeed::host;

namespace {

std::string refusal(const std::string& text) {
    return splinefeed_test::refusal_of([&] { static_cast<void>(parse_json(text, "c.json")); });
}

std::string nested(int depth, const std::string& open, const std::string& close, const std::string& inside) {
    std::string text = inside;
    std::string before;
    for (int i = 0; i < depth; ++i) {
        before += open;
        text += close;
    }
    return before + text;
}

} // namespace

TEST_CASE("documents are read up to a depth") {
    CHECK(parse_json("{\"a\": [1, 2]}", "c.json")["a"][1] == 2);
    CHECK(refusal(nested(deepest_json, "[", "]", "1")) == "accepted");
    const std::string deep = "c.json:1: arrays and objects are nested more than 64 deep; a curve needs six levels";
    CHECK(refusal(nested(deepest_json + 1, "[", "]", "1")) == deep);
    CHECK(refusal(nested(200'000, "{\"a\":", "}", "1")) == deep);
    CHECK(refusal(std::string(1'000'000, '[')) == deep);
    CHECK(refusal("{\"a\":\n\n" + nested(200'000, "[", "]", "1") + "}").rfind("c.json:3: ", 0) == 0);
}

TEST_CASE("brackets in texts are no depth") {
    CHECK(refusal("{\"name\": \"" + std::string(1000, '[') + "\"}") == "accepted");
    CHECK(refusal("{\"name\": \"\\\"" + std::string(1000, '{') + "\"}") == "accepted");
    CHECK(refusal("{\"name\": \"\\\\\", \"b\": " + nested(100, "[", "]", "1") + "}").find("nested") !=
          std::string::npos);
}

TEST_CASE("what is no JSON is told with its line") {
    CHECK(refusal("{\n\"a\": 1,\n}").rfind("c.json:3: not JSON: ", 0) == 0);
    CHECK(refusal("{\"a\": \"\xff\"}").rfind("c.json:1: not JSON: ", 0) == 0);
    CHECK(refusal("[1e999]") == "c.json: a number is out of range; coordinates must lie within +-1048576 mm");
    CHECK(splinefeed_test::refusal_of([] { static_cast<void>(parse_json("[", "c.json", "write a curve")); }) ==
          "c.json:1: not JSON; write a curve");
}
