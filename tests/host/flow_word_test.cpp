// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/flow_word.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;

TEST_CASE("O words are known behind an N number, in any case and spacing") {
    for (const char* const text : {"o100 sub", "O100SUB", " n10 o 100 s u b", "N5o0100sub(comment)"}) {
        CAPTURE(text);
        REQUIRE(has_flow_word(text));
        std::size_t wrong = 0;
        const auto word = read_flow_word(text, wrong);
        REQUIRE(word);
        CHECK(word->label == "100");
        CHECK(word->kind == FlowKind::sub);
    }
    CHECK_FALSE(has_flow_word("G1 X0"));
    CHECK_FALSE(has_flow_word("(o100 sub)"));
    CHECK_FALSE(has_flow_word(""));
}

TEST_CASE("Names and expressions are labels, and what follows the keyword is found") {
    std::size_t wrong = 0;
    auto word = read_flow_word("o<My Hole> call [1] [2]", wrong);
    REQUIRE(word);
    CHECK(word->label == "myhole");
    CHECK(word->kind == FlowKind::call);
    CHECK(std::string("o<My Hole> call [1] [2]").substr(word->rest) == "[1] [2]");
    word = read_flow_word("o[#1+[2*3]] call", wrong);
    REQUIRE(word);
    CHECK(word->label.empty());
    CHECK(word->label_at == 1);
    word = read_flow_word("o1elseif[1]", wrong);
    REQUIRE(word);
    CHECK(word->kind == FlowKind::elseif);
}

TEST_CASE("Words without a label or a keyword are wrong at their place") {
    std::size_t wrong = 0;
    CHECK_FALSE(read_flow_word("o sub", wrong));
    CHECK_FALSE(read_flow_word("o<> sub", wrong));
    CHECK_FALSE(read_flow_word("o<abc sub", wrong));
    CHECK_FALSE(read_flow_word("o100 loop", wrong));
    CHECK(wrong == 5);
    CHECK_FALSE(read_flow_word("o", wrong));
}
