// SPDX-License-Identifier: MIT
#include "host_sim/program/kept_line.hpp"
#include "host_sim/program/line_filter.hpp"

#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

TEST_CASE("Lines that change the order of blocks or the coordinates are no option's to leave out") {
    struct Case {
        const char* line;
        const char* word;
        CodeEffect effect;
    };
    const Case cases[] = {
        {"WHILE[#1LT5]DO1", "WHILE", CodeEffect::flow},
        {"IF [#1 EQ 5] THEN #2=3", "IF", CodeEffect::flow},
        {"if[#1EQ5]goto10", "if", CodeEffect::flow},
        {"N20 GOTO 10", "GOTO", CodeEffect::flow},
        {"/N20GOTO10", "GOTO10", CodeEffect::flow},
        {" END1", "END1", CodeEffect::flow},
        {"DO2", "DO2", CodeEffect::flow},
        {"CYCLE83(5,0,1)", "CYCLE83", CodeEffect::motion},
        {"TRANS X5", "TRANS", CodeEffect::coordinates},
        {"SET_GCODE_OFFSET Z=1", "SET_GCODE_OFFSET", CodeEffect::coordinates},
        {"force_move STEPPER=x", "force_move", CodeEffect::motion},
        {"SDCARD_LOOP_BEGIN COUNT=3", "SDCARD_LOOP_BEGIN", CodeEffect::flow},
        {"$J=G91X5F100", "$J", CodeEffect::motion},
        {"$RST=#", "$RST", CodeEffect::coordinates},
    };
    GcodeSettings settings;
    settings.ignores_unknown = true;
    for (const Dialect dialect : {Dialect::linuxcnc, Dialect::grbl, Dialect::fanuc, Dialect::klipper}) {
        settings.dialect = dialect;
        for (const Case& test : cases) {
            CAPTURE(test.line);
            const std::optional<KeptLine> line = kept_line(test.line);
            REQUIRE(line);
            CHECK(line->word == test.word);
            CHECK(line->effect == test.effect);
            CHECK(left_out_line(test.line, settings).empty());
            settings.ignored_lines = {std::string(test.word), "$*", "I*"};
            CHECK(left_out_line(test.line, settings).empty());
            settings.ignored_lines.clear();
        }
    }
    CHECK(refusal({"IF", CodeEffect::flow}).find("'IF': it changes the order of the blocks, and") == 0);
    CHECK(refusal({"TRANS", CodeEffect::coordinates}).find("O words") == std::string::npos);
}

TEST_CASE("Other lines are no such lines") {
    for (const char* const line : {"", "G1 X5", "N10 G1 X5", "N", "X SIN[30]", "END", "DO", "IFS", "START_PRINT", "$X",
                                   "$32=1", "o1 if [1]", "#1=2", "; IF", "(GOTO)", "M117 IF", "END_PRINT", "I5"}) {
        CAPTURE(line);
        CHECK_FALSE(kept_line(line));
    }
}
