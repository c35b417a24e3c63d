// SPDX-License-Identifier: MIT
#include "host_sim/program/problem_list.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;

namespace {

bool add(ProblemList& list, std::uint64_t line, const std::string& text, const std::string& cause = {}) {
    return list.add({"part.nc", line, std::uint64_t{3}, text}, line, cause);
}

} // namespace

TEST_CASE("A cause is told once, with the lines of the others") {
    ProblemList list;
    CHECK(list.empty());
    CHECK(add(list, 12, "'E1': no such axis", "E no such axis"));
    CHECK(list.texts() == std::vector<std::string>{"part.nc:12:3: 'E1': no such axis"});
    CHECK(add(list, 40, "'E2': no such axis", "E no such axis"));
    CHECK(list.texts()[0] == "part.nc:12:3: 'E1': no such axis; also on line 40");
    CHECK(add(list, 41, "'E3': no such axis", "E no such axis"));
    CHECK(list.texts()[0] == "part.nc:12:3: 'E1': no such axis; also on lines 40 and 41");
    CHECK_FALSE(add(list, 41, "'E3': no such axis", "E no such axis")); // of a line that runs twice
    for (std::uint64_t line = 42; line < 50; ++line) {
        add(list, line, "'E4': no such axis", "E no such axis");
    }
    CHECK(list.texts()[0] == "part.nc:12:3: 'E1': no such axis; also on lines 40, 41, 42 and 7 more");
    CHECK(add(list, 12, "M2 is missing")); // another cause of the same line: its text
    CHECK(list.texts().size() == 2);
    CHECK(list.count() == 12);
}

TEST_CASE("Lines of another file than that of the first problem name it") {
    ProblemList list;
    const auto add_of = [&](const std::string& file, std::uint64_t line) {
        return list.add({file, line, "no such axis"}, line, {}, file);
    };
    CHECK(add_of("sub.ngc", 3));
    CHECK(add_of("part.ngc", 3));
    CHECK(add_of("sub.ngc", 7));
    CHECK_FALSE(add_of("sub.ngc", 3));
    CHECK(list.texts() == std::vector<std::string>{"sub.ngc:3: no such axis; also on lines part.ngc:3 and 7"});
}

TEST_CASE("That causes are too many is said") {
    ProblemList list;
    for (std::uint64_t line = 1; line <= ProblemList::most_causes + 5; ++line) {
        add(list, line, "cause " + std::to_string(line));
    }
    CHECK(list.count() == ProblemList::most_causes + 5);
    REQUIRE(list.texts().size() == ProblemList::most_causes + 1);
    CHECK(list.texts().back() == "5 more problems of other causes are not listed: 100 causes are enough");
}
