// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/flow_block.hpp"

#include "support/catch.hpp"

#include <sstream>

using namespace splinefeed::host;

namespace {

FlowBlock block_of(const std::string& text) {
    FlowBlock out(1);
    std::istringstream lines(text);
    SourceLine line;
    while (std::getline(lines, line.text)) {
        ++line.number;
        std::size_t wrong = 0;
        has_flow_word(line.text) ? out.add(line, read_flow_word(line.text, wrong).value()) : out.add(line);
    }
    return out;
}

} // namespace

TEST_CASE("Each word of a structure knows the others") {
    FlowBlock block =
        block_of("o1 sub\no2 if [1]\no2 elseif [1]\nG0 X1\no2 else\no3 repeat [2]\no3 break\no3 endrepeat\n"
                 "o2 endif\no4 do\no4 continue\no4 while [1]\no4 while [1]\no4 endwhile\no1 endsub");
    REQUIRE(block.link().empty());
    const auto is = [&](std::size_t line, std::size_t begin, std::size_t end) {
        return block.place(line)->begin == begin && block.place(line)->end == end;
    };
    CHECK((is(0, 0, 14) && is(14, 0, 14)));
    CHECK((is(1, 1, 8) && is(2, 1, 8) && is(4, 1, 8) && is(8, 1, 8)));
    CHECK(block.place(1)->next == 2);
    CHECK(block.place(2)->next == 4);
    CHECK(block.place(4)->next == 8);
    CHECK(block.place(3) == nullptr);
    CHECK(block.place(6)->begin == 5);
    CHECK(block.place(10)->begin == 9);
    CHECK((is(9, 9, 11) && is(11, 9, 11) && is(12, 12, 13)));
    const FlowBlock part = block.part(5, 2);
    CHECK(part.size() == 3);
    CHECK(part.number() == 2);
    CHECK(part.line(2).number == 8);
    CHECK(part.place(1)->begin == 0);
    CHECK(part.place(2)->end == 2);
}

TEST_CASE("What does not fit together is told at its line") {
    const auto problems = [](const std::string& text) {
        return block_of(text).link();
    };
    const auto open = problems("o1 while [1]\no2 repeat [1]\n");
    REQUIRE(open.size() == 2);
    CHECK(open[0].text == "o1 has no end; write o1 endwhile behind its last line");
    CHECK((open[1].line == 1 && open[1].text == "o2 has no end; write o2 endrepeat behind its last line"));
    const auto crossed = problems("o1 while [1]\no2 repeat [1]\no1 endwhile\no2 endrepeat");
    REQUIRE(crossed.size() == 2);
    CHECK(crossed[0].line == 2);
    CHECK(crossed[1].text == "o2 has no begin");
    CHECK(problems("o1 while [1]\no1 endwhile\no1 break").at(0).text == "there is no loop o1 around this line");
    std::string deep;
    for (std::size_t i = 0; i <= FlowBlock::deepest; ++i) {
        deep += "o" + std::to_string(i) + " if [1]\n";
    }
    CHECK(problems(deep).at(0).text == "O words are nested more than 1000 deep");
}
