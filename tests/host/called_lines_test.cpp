// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/called_lines.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;

namespace {

const std::string file = "sub.ngc";

SourceLine of_program(std::uint64_t number) {
    return {"", number};
}

SourceLine of_file(std::uint64_t number) {
    return {"", number, true, &file};
}

} // namespace

TEST_CASE("Lines of the program are their numbers, those of other files know their call") {
    CalledLines lines;
    lines.pass(of_program(7));
    CHECK(lines.take(of_program(7)) == 7);
    lines.pass(of_program(9)); // a call
    lines.pass(of_file(3));
    const std::uint32_t in_file = lines.take(of_file(3));
    CHECK(in_file >= CalledLines::first);
    lines.pass(of_program(10));
    const std::uint32_t later = lines.take(of_file(3)); // called again
    CHECK(lines.in_program() == 10);
    const LinePlace own = lines.place(7);
    CHECK((own.file == nullptr && own.number == 7 && own.in_program == 7));
    const LinePlace place = lines.place(in_file);
    CHECK((place.file == &file && place.number == 3 && place.in_program == 9));
    CHECK(lines.place(later).in_program == 10);
}

TEST_CASE("Old lines of files are forgotten, and never taken for those of the program") {
    CalledLines lines;
    std::uint32_t first = 0;
    std::uint32_t last = 0;
    for (std::uint64_t i = 1; i <= 3 * CalledLines::most; ++i) {
        lines.pass(of_program(i));
        last = lines.take(of_file(i));
        first = i == 1 ? last : first;
    }
    CHECK(lines.place(last).number == 3 * CalledLines::most);
    CHECK(lines.place(last - std::uint32_t{CalledLines::most} + 1).number == 2 * CalledLines::most + 1);
    CHECK(lines.place(first).number == 2 * CalledLines::most + 1); // the oldest one that is known
}
