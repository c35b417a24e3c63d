// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/flow_code.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;

TEST_CASE("M98 and M99 are known in any case and spacing, and not in comments") {
    for (const auto programs : {NumberedPrograms::linuxcnc, NumberedPrograms::fanuc}) {
        const FlowRules rules{programs};
        for (const char* const text :
             {"M98 P100 L2", "n5 m 0 9 8p100L2", "/M98P100L2;x", "(M99) M98 P100 (twice) L2"}) {
            CAPTURE(text);
            const auto word = read_flow_code(text, rules);
            REQUIRE(word);
            CHECK(word->kind == FlowKind::call_program);
            CHECK(word->has_number);
            CHECK(std::string(text).substr(word->label_at, 3) == "100");
            CHECK(text[word->rest] == '2');
            CHECK(word->others.empty());
        }
        CHECK(read_flow_code("N9 M99", rules)->kind == FlowKind::end_program);
        for (const char* const text : {"", "(M98 P1)", "G1 X0 ; M98", "M980", "M9", "M98.5 P1", "#<m98>=3", "G1 X98"}) {
            CAPTURE(text);
            CHECK_FALSE(read_flow_code(text, rules));
        }
        CHECK_FALSE(read_flow_code("/M99", {programs, true}));
    }
    CHECK_FALSE(read_flow_code("M98 P1", {}));
}

TEST_CASE("Other words of the line stay at their places") {
    const FlowRules rules{NumberedPrograms::fanuc};
    CHECK(read_flow_code("G0 X[1+2] M98 P7 Y#1", rules)->others == "G0 X[1+2]        Y#1");
    CHECK(read_flow_code("N7 G80 M99 (end)", rules)->others == "N7 G80     (end)");
    CHECK(read_flow_code("N7 M99 (end)", rules)->others.empty());
    CHECK_FALSE(read_flow_code("G80 M99", {NumberedPrograms::linuxcnc}));
    CHECK_FALSE(read_flow_code("M98 P1 X2", {NumberedPrograms::linuxcnc})->others.empty());
}
